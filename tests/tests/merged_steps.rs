//! Protects steps whose ends are made as one map: the same states up to round-off for every table, and fewer operations.

use shadowstep::number::counting::{Counting, Operations, count};
use shadowstep::number::{Limbs, Number, Ordered};
use shadowstep::problems::HenonHeiles;
use shadowstep::{Motion, Scheme, Stepper, UnitMasses, exact, splitting_scheme};
use shadowstep_schemes::First;
use shadowstep_tests::shipped::{Visitor, for_each};

fn start<N: Number<Context = ()>>() -> Motion<N, [N; 2], HenonHeiles, UnitMasses> {
    let number = |text| N::from_rational(&exact(text).unwrap(), &());
    Motion::new(HenonHeiles, UnitMasses, [number("0.1"), number("0.2")], [number("0.1"), number("-0.05")]).unwrap()
}

/// The largest difference of the states after so many steps, in decades.
fn difference<S: Scheme>(stepper: &Stepper<S, Limbs<7>>, steps: u64) -> f64 {
    let [mut merged, mut one_by_one] = [start(), start()];
    stepper.merged_steps(std::slice::from_mut(&mut merged), steps);
    stepper.steps(std::slice::from_mut(&mut one_by_one), steps);
    let pairs = merged.q().iter().chain(merged.p()).zip(one_by_one.q().iter().chain(one_by_one.p()));
    let distance = |(a, b): (&Limbs<7>, &Limbs<7>)| {
        let mut distance = *a;
        distance.subtract(b);
        distance.log10_abs()
    };
    pairs.map(distance).fold(f64::NEG_INFINITY, f64::max)
}

struct SameStates;

impl Visitor for SameStates {
    fn visit<S: Scheme + Copy>(&mut self, name: &str, first: Option<First>, scheme: &'static S) {
        let stepper = Stepper::new(*scheme, "1/20").unwrap();
        for steps in [0, 1, 2, 5] {
            // 134 digits, of which some hundred operations with numbers of size 1 lose a few
            let off = difference(&stepper, steps);
            assert!(off < -130.0, "{name}, {first:?}, {steps} steps: 1e{off}");
        }
    }
}

#[test]
fn merged_steps_make_the_same_states() {
    for_each(&mut SameStates);
}

#[splitting_scheme("stormer-verlet.toml")]
struct KickFirst;

#[splitting_scheme("stormer-verlet.toml", first = "drift")]
struct DriftFirst;

/// Operations of ten steps.
fn operations<S: Scheme>(scheme: S, merged: bool) -> Operations {
    let stepper = Stepper::<_, Counting<f64>>::new(scheme, "1/20").unwrap();
    let mut motion = start::<Counting<f64>>();
    let ((), made) = count(|| match merged {
        true => stepper.merged_steps(std::slice::from_mut(&mut motion), 10),
        false => stepper.steps(std::slice::from_mut(&mut motion), 10),
    });
    made
}

#[test]
fn a_merged_step_is_a_map_less() {
    let kicks = [operations(KickFirst, false), operations(KickFirst, true)];
    let drifts = [operations(DriftFirst, false), operations(DriftFirst, true)];
    for [one_by_one, merged] in [kicks, drifts] {
        // a product and a sum for each of two coordinates, in nine of ten steps
        assert_eq!(one_by_one.additions - merged.additions, 9 * 2);
        assert_eq!(one_by_one.multiplications - merged.multiplications, 9 * 2);
    }
}
