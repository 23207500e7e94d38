//! Protects steps whose ends are made as one map: the same states up to round-off for every table and number type, n +
//! 1 kicks for n steps, the bits of the merged maps one by one, in all lanes and vector instructions.

use proptest::prelude::*;
use shadowstep::number::counting::{Counting, Operations, count};
use shadowstep::number::instructions::Instructions;
use shadowstep::number::{Float, Fused, Lanes, Limbs, Number, Real};
use shadowstep::problems::HenonHeiles;
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::{Carried, Motion, Rational, Scheme, Stepper, System, UnitMasses, ValidFor, splitting_scheme, tables};
use shadowstep_schemes::First;
use shadowstep_tests::shipped::{Visitor, for_each_kind_of_step, twins};
use shadowstep_tests::{log10_largest_distance, precision, rational, same_bits};

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct KickFirst;

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml", first = "drift")]
struct DriftFirst;

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

type Star<N> = Motion<N, [N; 2], HenonHeiles, UnitMasses>;

fn start<N: Number>(context: &N::Context) -> Star<N> {
    let number = |text| N::from_rational(&rational(text), context);
    Motion::new(HenonHeiles, UnitMasses, [number("0.1"), number("0.2")], [number("0.1"), number("-0.05")]).unwrap()
}

/// The states after a number of merged steps, and after as many one by one.
fn both<S: Scheme + ValidFor<Quadratic>, N: Number>(
    stepper: &Stepper<S, N>,
    start: &Star<N>,
    steps: u64,
) -> [Vec<N>; 2] {
    let [mut merged, mut one_by_one] = [start.clone(), start.clone()];
    stepper.merged_steps(std::slice::from_mut(&mut merged), steps);
    (0..steps).for_each(|_| stepper.step(&mut one_by_one));
    [merged, one_by_one].map(|motion| [motion.q(), motion.p()].concat())
}

// ---------------------------------------------------------------------------------------------------------------
// The same states

fn assert_same_states<S: Scheme + ValidFor<Quadratic>>(name: &str, scheme: S) {
    let stepper = Stepper::new(scheme, "1/20").unwrap();
    for steps in [0, 1, 2, 5] {
        // 134 digits, of which some hundred operations with numbers of size 1 lose a few
        let [merged, one_by_one] = both(&stepper, &start::<Limbs<7>>(&()), steps);
        let off = log10_largest_distance(&merged, &one_by_one);
        assert!(off < -130.0, "{name}, {steps} steps: 1e{off}");
    }
}

struct SameStates;

impl Visitor for SameStates {
    fn visit<S: Scheme + ValidFor<Quadratic> + Copy>(&mut self, name: &str, _: Option<First>, scheme: &'static S) {
        assert_same_states(name, *scheme);
    }
}

#[test]
fn merged_steps_make_the_same_states() {
    twins().for_each(|(name, scheme)| assert_same_states(&name, scheme));
    for_each_kind_of_step(&mut SameStates);
}

/// Each digit more of the numbers is a digit more in which the states agree.
#[test]
fn merged_steps_agree_to_the_digits_of_mpfr() {
    fn off<S: Scheme + ValidFor<Quadratic>>(scheme: S, digits: u32) -> f64 {
        let stepper = Stepper::with_context(scheme, "1/20", &precision(digits)).unwrap();
        let [merged, one_by_one] = both(&stepper, &start::<Float>(&precision(digits)), 100);
        log10_largest_distance(&merged, &one_by_one)
    }
    for digits in [50, 200, 1000] {
        // 100 steps round about 1000 times, and the flow of 5 units of time stretches what is off by less than 100
        let most = 4.0 - f64::from(digits);
        for off in [off(KickFirst, digits), off(DriftFirst, digits), off(Yoshida4, digits)] {
            assert!((most - 8.0..most).contains(&off), "{digits} digits: 1e{off}");
        }
    }
}

proptest! {
    /// Any step size, number of steps and state of an orbit that stays regular.
    #[test]
    fn merged_steps_are_steps_up_to_round_off(
        numerator in -20_i64..=20, steps in 0_u64..200, state in prop::array::uniform4(-0.15_f64..0.15), scheme in 0..3,
    ) {
        prop_assume!(numerator != 0);
        let h = Rational::new(numerator.into(), 200.into());
        let [x, y, u, v] = state;
        let start = Motion::new(HenonHeiles, UnitMasses, [x, y], [u, v]).unwrap();
        let ([merged, one_by_one], maps) = match scheme {
            0 => (both(&Stepper::new(KickFirst, h).unwrap(), &start, steps), 3.0),
            1 => (both(&Stepper::new(DriftFirst, h).unwrap(), &start, steps), 3.0),
            _ => (both(&Stepper::new(Yoshida4, h).unwrap(), &start, steps), 7.0),
        };
        // each map rounds numbers below 1/2 a few times, and an error grows at most like the time
        let (time, steps) = (steps as f64 * numerator.abs() as f64 / 200.0, steps as f64);
        let most = 2.0 * f64::EPSILON * maps * steps * (1.0 + time);
        for (merged, one) in merged.iter().zip(&one_by_one) {
            prop_assert!((merged - one).abs() <= most, "{merged} is not {one}");
        }
    }
}

// ---------------------------------------------------------------------------------------------------------------
// The maps

/// A multiple of the operations.
fn times(count: u64, operations: Operations) -> [u64; 3] {
    [operations.additions, operations.multiplications, operations.divisions].map(|of_kind| count * of_kind)
}

fn sum(parts: [[u64; 3]; 3]) -> [u64; 3] {
    std::array::from_fn(|i| parts.iter().map(|part| part[i]).sum())
}

#[test]
fn so_many_merged_steps_have_one_kick_more() {
    const STEPS: u64 = 10;
    let fresh = || start::<Counting<f64>>(&());
    let weight = Counting(0.05);
    let mut motion = fresh();
    let ((), gradient_and_kick) = count(|| motion.kick(&weight, Carried::Nothing));
    let ((), kick) = count(|| motion.kick(&weight, Carried::Nothing));
    let ((), drift) = count(|| motion.drift(&weight, Carried::Nothing));
    let of = |merged: bool| {
        let (stepper, mut motion) = (Stepper::new(KickFirst, "1/20").unwrap(), fresh());
        let ((), made) = count(|| match merged {
            true => stepper.merged_steps(std::slice::from_mut(&mut motion), STEPS),
            false => stepper.steps(std::slice::from_mut(&mut motion), STEPS),
        });
        (times(1, made), motion.evaluations())
    };
    let (n, drifts) = (STEPS, times(STEPS, drift));
    assert_eq!(of(true), (sum([times(n + 1, gradient_and_kick), times(0, kick), drifts]), n + 1));
    // one by one each step but the last has a kick more, which takes the gradient of the one before
    assert_eq!(of(false), (sum([times(n + 1, gradient_and_kick), times(n - 1, kick), drifts]), n + 1));
}

#[test]
fn a_drift_less_a_step_is_as_many_kicks() {
    let of = |merged: bool| {
        let (stepper, mut motion) = (Stepper::new(DriftFirst, "1/20").unwrap(), start::<Counting<f64>>(&()));
        let ((), made) = count(|| match merged {
            true => stepper.merged_steps(std::slice::from_mut(&mut motion), 10),
            false => stepper.steps(std::slice::from_mut(&mut motion), 10),
        });
        (made, motion.evaluations())
    };
    let [(merged, evaluations), (one_by_one, evaluations_one_by_one)] = [of(true), of(false)];
    // a product and a sum for each of two coordinates, in nine of ten steps
    assert_eq!(one_by_one.additions - merged.additions, 9 * 2);
    assert_eq!(one_by_one.multiplications - merged.multiplications, 9 * 2);
    assert_eq!((evaluations, evaluations_one_by_one), (10, 10));
}

/// The merged maps of Störmer–Verlet with the exact weights h/2, h, h/2, one by one.
fn by_hand(motion: &mut Star<f64>, h: &str, steps: u64) {
    let [half, whole] = [format!("{h}/2"), h.to_owned()].map(|text| f64::from_rational(&rational(&text), &()));
    motion.kick(&half, Carried::Nothing);
    for step in 1..=steps {
        motion.drift(&whole, Carried::Nothing);
        motion.kick(if step < steps { &whole } else { &half }, Carried::Nothing);
    }
}

#[test]
fn merged_steps_have_the_bits_of_their_maps() {
    // 1/70 and 1/35 are rounded
    for (h, steps) in [("1/35", 1), ("1/35", 2), ("1/35", 3), ("1/35", 1000), ("-1/35", 50)] {
        let stepper = Stepper::new(KickFirst, h).unwrap();
        let [mut merged, mut expected] = [start::<f64>(&()), start(&())];
        stepper.merged_steps(std::slice::from_mut(&mut merged), steps);
        by_hand(&mut expected, h, steps);
        assert!(same_bits(merged.q(), expected.q()) && same_bits(merged.p(), expected.p()), "{steps} steps of {h}");
    }
}

/// A table that is read at run time, and systems that take turns.
#[test]
fn merged_steps_have_the_same_bits_however_they_are_made() {
    let generated = Stepper::new(Yoshida4, "1/35").unwrap();
    let read = Stepper::new(tables::shipped("yoshida4").unwrap(), "1/35").unwrap();
    assert_eq!(bits_after_50(&generated), bits_after_50(&read));
}

/// The bits after 50 merged steps, of one system and of several.
fn bits_after_50<S: Scheme + ValidFor<Quadratic>>(stepper: &Stepper<S, f64>) -> Vec<u64> {
    let mut systems = vec![start::<f64>(&()); 4];
    let (one, several) = systems.split_at_mut(1);
    stepper.merged_steps(one, 50);
    stepper.merged_steps(several, 50);
    let bits = |motion: &Star<f64>| motion.q().iter().chain(motion.p()).map(|x| x.to_bits()).collect::<Vec<_>>();
    let expected = bits(&systems[0]);
    assert!(systems.iter().all(|motion| bits(motion) == expected));
    expected
}

#[test]
fn lanes_have_the_bits_of_merged_steps_alone() {
    let stepper = Stepper::<_, f64>::new(Yoshida4, "1/35").unwrap();
    let x = |t: usize| 0.01 * t as f64;
    let alone = |t: usize| {
        let mut motion = Motion::new(HenonHeiles, UnitMasses, [x(t), 0.2], [0.1, -0.05]).unwrap();
        stepper.merged_steps(std::slice::from_mut(&mut motion), 60);
        [motion.q(), motion.p()].concat()
    };
    let of_lanes = Stepper::<_, Lanes<8>>::new(Yoshida4, "1/35").unwrap();
    let all = Lanes::<8>::all;
    let motion = |first: usize| {
        let x = Lanes(std::array::from_fn(|lane| x(first + lane)));
        Motion::new(HenonHeiles, UnitMasses, [x, all(0.2)], [all(0.1), all(-0.05)]).unwrap()
    };
    for instructions in Instructions::available() {
        for systems in [1, 3] {
            let mut motions: Vec<_> = (0..systems).map(|i| motion(8 * i)).collect();
            instructions.only(|| of_lanes.merged_steps(&mut motions, 60));
            for t in 0..8 * systems {
                let found = motions[t / 8].q().iter().chain(motions[t / 8].p()).map(|x| x.0[t % 8]);
                assert!(same_bits(&found.collect::<Vec<_>>(), &alone(t)), "{instructions:?}, trajectory {t}");
            }
        }
    }
}

#[test]
fn fused_numbers_merge_as_well() {
    let stepper = Stepper::<_, Fused>::new(KickFirst, "1/35").unwrap();
    let [merged, one_by_one] = both(&stepper, &start(&()), 100);
    for (merged, one) in merged.iter().zip(&one_by_one) {
        assert!((merged.to_f64() - one.to_f64()).abs() < 1e-14, "{merged} is not {one}");
    }
}
