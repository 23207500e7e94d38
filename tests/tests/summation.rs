//! Protects compensated sums and fixed point: sums lose nothing, states are saved with their remainders, steps are
//! undone to the last bit.

use num_traits::Signed;
use rug::Float;
use shadowstep::number::{CorrectlyRounded, DoubleDouble, Number};
use shadowstep::problems::{HenonHeiles, Kepler};
use shadowstep::shadow::run::{ShadowRun, States, Trajectory, energy_drift};
use shadowstep::shadow::{Bilinear, ShadowEnergy, Verdict};
use shadowstep::systems::kinetic::Quadratic;
use shadowstep::systems::linear_part::LinearPart;
use shadowstep::systems::many_parts::{SystemOfParts, parts};
use shadowstep::systems::summation::RangeError;
use shadowstep::{
    Carried, Integrator as _, Motion, Rational, Real, Remainders, Scheme, Stepper, System, UnitMasses, ValidFor, exact,
    tables,
};
use shadowstep_tests::general;
use shadowstep_tests::shipped::{all, all_for_every_kinetic};
use shadowstep_tests::systems::{AnyMotion, Masses, Problem, system};
use shadowstep_tests::{Bits, numbers, precision, rational, stepper};

/// Eccentricity 0.6 from the pericentre.
fn comet() -> Motion<f64, [f64; 2], Kepler, UnitMasses> {
    Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap()
}

fn all_bits<M: System<Number = f64> + ?Sized>(system: &M) -> Vec<u64> {
    let Remainders { q, p } = system.state().remainders();
    system.state().q().iter().chain(system.state().p()).chain(&q).chain(&p).map(|x| x.to_bits()).collect()
}

// ---------------------------------------------------------------------------------------------------------------
// Compensated sums

/// The exact value of a number.
trait Exactly: Bits {
    fn exactly(&self) -> Rational;
}

impl Exactly for f64 {
    fn exactly(&self) -> Rational {
        Rational::from_float(*self).unwrap()
    }
}

impl Exactly for Float {
    fn exactly(&self) -> Rational {
        rational(&self.to_rational().unwrap().to_string())
    }
}

/// Coordinates with their remainders as exact numbers.
fn exactly<N: Exactly>(values: &[N], remainders: &[N]) -> Vec<Rational> {
    values.iter().zip(remainders).map(|(x, rest)| x.exactly() + rest.exactly()).collect()
}

/// After a + e and an increment δ the exact sum of the new a and e is a and the sum y of e and δ, which alone is
/// rounded; but for ε y where y is larger than a.
fn no_part_of_a_sum_is_lost<N: Exactly>(problem: Problem, context: &N::Context) {
    let mut motion = system::<N>(problem, Masses::Unit, context).compensated();
    let mut gradient = vec![N::zero(context); motion.q().len()];
    let mut scratch = vec![N::zero(context); shadowstep::Potential::<N>::scratch(motion.potential())];
    let weights = numbers::<N>(&["1/7", "-1/30", "3/11", "-1/8"], context);
    // a + y, and what may be lost of it
    let expected = |a: &[N], rest: &[N], increments: &[N]| -> Vec<(Rational, Rational)> {
        let sum = |((a, rest), increment): ((&N, &N), &N)| {
            let mut y = rest.clone();
            y.add(increment);
            let (a, y) = (a.exactly(), y.exactly());
            let epsilon = 10_f64.powf(increment.log10_epsilon());
            let lost = if y.abs() > a.abs() { y.abs() * epsilon.exactly() } else { rational("0") };
            (a + y, lost)
        };
        a.iter().zip(rest).zip(increments).map(sum).collect()
    };
    let agrees = |found: Vec<Rational>, expected: Vec<(Rational, Rational)>, weight: &N| {
        for (found, (expected, lost)) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() <= lost, "{problem:?}, {weight}");
        }
    };
    let mut kept = 0;
    for weight in weights.iter().cycle().take(200) {
        let times = |values: &[N], sign: i32| -> Vec<N> {
            let product = |x: &N| {
                let mut product = N::zero(context);
                product.add_product(x, weight);
                product.multiply_integer(sign);
                product
            };
            values.iter().map(product).collect()
        };
        let Remainders { q: rest, .. } = motion.state().remainders();
        let q = expected(motion.q(), &rest, &times(motion.p(), 1));
        motion.drift(weight, Carried::Nothing);
        agrees(exactly(motion.q(), &motion.state().remainders().q), q, weight);
        shadowstep::Potential::<N>::gradient(motion.potential(), motion.q(), &mut gradient, &mut scratch);
        let Remainders { p: rest, .. } = motion.state().remainders();
        let p = expected(motion.p(), &rest, &times(&gradient, -1));
        motion.kick(weight, Carried::Nothing);
        // MPFR rounds −w g and e − w g to one number at once
        if N::KEEPS_INCREMENTS {
            agrees(exactly(motion.p(), &motion.state().remainders().p), p, weight);
        }
        kept += motion.state().remainders().p.iter().filter(|rest| rest.log10_abs().is_finite()).count();
    }
    assert!(kept > 100, "{kept} remainders are not 0");
}

#[test]
fn compensated_sums_lose_nothing() {
    for problem in [Problem::HenonHeiles, Problem::Pendulum] {
        no_part_of_a_sum_is_lost::<f64>(problem, &());
        no_part_of_a_sum_is_lost::<Float>(problem, &precision(40));
    }
}

/// The sum of many increments, which a run makes of increments far smaller than the coordinate.
#[test]
fn a_long_sum_is_exact_to_the_size_of_its_increments() {
    let stepper = stepper::<f64>("stormer-verlet", "1/1000", &());
    let [mut plain, mut compensated] = [rational("0"), rational("0")];
    let (mut one, mut other) = (comet(), comet().compensated());
    let start = Rational::from_float(0.4).unwrap();
    for _ in 0..5000 {
        stepper.step_augmented(&mut one);
        stepper.step_augmented(&mut other);
        plain += one.increments().q[0].exactly();
        compensated += other.increments().q[0].exactly();
    }
    let off = |sum: Rational, reached: Rational| f64::from_rational(&(start.clone() + sum - reached), &()).abs();
    let plain = off(plain, one.q()[0].exactly());
    let compensated = off(compensated, other.q()[0].exactly() + other.state().remainders().q[0].exactly());
    println!("{plain:e}, {compensated:e}");
    // each sum of the one is rounded by 1e-16, each of the other by 1e-19
    assert!(plain > 1e-15 && compensated < 1e-17, "{plain:e}, {compensated:e}");
}

/// Steps with increments have the bits of plain steps, remainders included; so has a choice at run time.
#[test]
fn all_steps_of_a_kind_have_the_same_bits() {
    let stepper = stepper::<f64>("yoshida4", "1/20", &());
    fn same<A: System<Number = f64, Class = Quadratic>, B: System<Number = f64, Class = Quadratic>>(
        stepper: &Stepper<impl Scheme + ValidFor<Quadratic>, f64>,
        mut plain: A,
        mut augmented: B,
    ) -> Vec<u64> {
        for _ in 0..100 {
            stepper.step(&mut plain);
            stepper.step_augmented(&mut augmented);
            assert_eq!(all_bits(&plain), all_bits(&augmented));
        }
        all_bits(&plain)
    }
    let plain = same(&stepper, comet(), comet().compensated_if(false));
    let compensated = same(&stepper, comet().compensated(), comet().compensated_if(true));
    let fixed = || comet().fixed_point(&[2.0; 2], &[4.0; 2]).unwrap();
    let fixed = same(&stepper, fixed(), fixed());
    assert_eq!([plain.len(), compensated.len(), fixed.len()], [4, 8, 8]);
    assert!(plain != compensated[..4] && compensated != fixed);
}

/// A state is q and p with their remainders: from these a run has the bits of the one that went on.
#[test]
fn a_state_is_saved_with_its_remainders() {
    fn check<M: System<Number = f64, Class = Quadratic> + Clone>(start: M) {
        let stepper = stepper::<f64>("ruth3", "1/20", &());
        let mut gone_on = start.clone();
        (0..100).for_each(|_| stepper.step(&mut gone_on));
        let [mut saved, mut without] = [start.clone(), start];
        saved.state_mut().set(gone_on.state().q(), gone_on.state().p());
        saved.state_mut().set_remainders(&gone_on.state().remainders());
        without.state_mut().set(gone_on.state().q(), gone_on.state().p());
        assert_eq!(all_bits(&saved), all_bits(&gone_on));
        assert_ne!(all_bits(&without), all_bits(&gone_on), "the remainders were dropped");
        for _ in 0..100 {
            stepper.step(&mut gone_on);
            stepper.step(&mut saved);
        }
        assert_eq!(all_bits(&saved), all_bits(&gone_on));
    }
    check(comet().compensated());
    check(comet().fixed_point(&[2.0; 2], &[4.0; 2]).unwrap());
}

/// A run makes states before its first one, and comes back to it with its remainders.
#[test]
fn a_run_from_a_state_with_remainders_has_the_states_of_the_steps() {
    let stepper = stepper::<f64>("stormer-verlet", "1/20", &());
    let mut start = comet().compensated();
    (0..57).for_each(|_| stepper.step(&mut start));
    let mut steps = start.clone();
    let mut run = ShadowRun::new(stepper.with(start.clone()), 50, &Bilinear::new(8)).unwrap();
    while let Some((_, estimate)) = run.advance().unwrap() {
        assert_eq!((estimate.q, estimate.p), (steps.q(), steps.p()));
        stepper.step(&mut steps);
    }
    let mut trajectory = Trajectory::new(stepper.with(start), 54, 0).unwrap();
    while trajectory.advance().unwrap().is_some() {}
    (0..3).for_each(|_| stepper.step(&mut steps));
    assert_eq!(all_bits(trajectory.integrator().system()), all_bits(&steps));
}

/// Systems of other parts than T(p) and U(q): beside the same steps in double-double compensated sums are off by less
/// than plain ones, and have remainders.
#[test]
fn every_system_has_compensated_sums() {
    fn off<M: System<Number = f64>, D: System<Number = DoubleDouble, Class = M::Class>, S>(
        scheme: S,
        [mut plain, mut compensated]: [M; 2],
        mut exact: D,
    ) where
        S: Scheme + Clone + ValidFor<M::Class>,
    {
        let stepper = Stepper::<S, f64>::new(scheme.clone(), "1/512").unwrap();
        let doubled = Stepper::<S, DoubleDouble>::new(scheme, "1/512").unwrap();
        for _ in 0..20_000 {
            stepper.step(&mut plain);
            stepper.step(&mut compensated);
            doubled.step(&mut exact);
        }
        let distance = |system: &M| {
            let pairs = system
                .state()
                .q()
                .iter()
                .chain(system.state().p())
                .zip(exact.state().q().iter().chain(exact.state().p()));
            pairs.map(|(x, y)| (x - y.to_f64()).abs()).fold(0.0, f64::max)
        };
        let [plain_off, compensated_off] = [&plain, &compensated].map(distance);
        println!("{plain_off:e}, {compensated_off:e}");
        assert!(compensated_off < plain_off / 4.0, "{plain_off:e}, {compensated_off:e}");
        let has_remainders = |system: &M| system.state().remainders().q.iter().any(|rest| *rest != 0.0);
        assert!(!has_remainders(&plain) && has_remainders(&compensated));
    }
    fn linear<N: CorrectlyRounded>(number: impl Fn(f64) -> N, compensated: bool) -> LinearPart<N, HenonHeiles> {
        let [zero, one] = ["0", "1"].map(|text| exact(text).unwrap());
        let stiffness = [vec![one.clone(), zero.clone()], vec![zero, one.clone()]];
        let (q, p) = ([0.1, -0.3].map(&number), [0.2, 0.1].map(&number));
        LinearPart::new(HenonHeiles, &[one.clone(), one], &stiffness, &q, &p).unwrap().compensated_if(compensated)
    }
    fn in_parts<N: CorrectlyRounded<Context = ()> + 'static>(
        number: impl Fn(f64) -> N,
        compensated: bool,
    ) -> SystemOfParts<N> {
        let formulas = ["(px^2 + py^2)/2", "(x*py - y*px)/4 + (x^2 + y^2)/32", "cos(x) + cos(y)"];
        let parts = parts::<N>(&formulas, (&["x", "y"], &["px", "py"]), &[], &()).unwrap();
        let (q, p) = ([0.3, 0.1].map(&number), [0.5, -0.2].map(&number));
        SystemOfParts::new(parts, &q, &p).unwrap().compensated_if(compensated)
    }
    let wide = |x: f64| DoubleDouble::from_rational(&Rational::from_float(x).unwrap(), &());
    let verlet = || tables::shipped("stormer-verlet").unwrap();
    off(verlet(), [false, true].map(|sums| linear(|x| x, sums)), linear(wide, false));
    let many = verlet().for_many_parts().unwrap();
    off(many, [false, true].map(|sums| in_parts(|x| x, sums)), in_parts(wide, false));
}

/// What the increments give belongs to the states that are reported, within round-off.
#[test]
fn the_modified_energy_of_compensated_steps_is_conserved() {
    let stepper = stepper::<f64>("stormer-verlet", "1/20", &());
    let start = || Motion::new(HenonHeiles, UnitMasses, [0.1, -0.3], [0.2, 0.1]).unwrap();
    let [plain, compensated] = [
        energy_drift(stepper.with(start()), 2000, &Bilinear::new(12)).unwrap().drift,
        energy_drift(stepper.with(start().compensated()), 2000, &Bilinear::new(12)).unwrap().drift,
    ];
    println!("{plain:e}, {compensated:e}");
    assert!(compensated < 2e-16 && plain > 2.0 * compensated, "{plain:e}, {compensated:e}");
    let mut motion = start().compensated();
    let mut alone = motion.clone();
    let mut monitor = ShadowEnergy::new(stepper.clone(), &mut motion, &Bilinear::with_error(8)).unwrap().every(50);
    for _ in 0..5000 {
        monitor.step(&mut motion).unwrap();
        stepper.step(&mut alone);
    }
    let report = monitor.report();
    assert_eq!(
        (report.verdict, report.mismatches, all_bits(&motion)),
        (Verdict::Bounded, 0, all_bits(&alone)),
        "{report}"
    );
}

/// H̄ of a state with its remainders, by steps of 40 digits around it.
fn modified(h: &str, system: &impl System<Number = f64>) -> Float {
    let context = precision(40);
    let Remainders { q, p } = system.state().remainders();
    let with = |values: &[f64], rest: &[f64]| -> Vec<Float> {
        let rest = rest.iter().copied().chain(std::iter::repeat(0.0));
        let sum = |(x, rest): (&f64, f64)| x.exactly() + rest.exactly();
        values.iter().zip(rest).map(|pair| Float::from_rational(&sum(pair), &context)).collect()
    };
    let motion =
        Motion::new(HenonHeiles, UnitMasses, with(system.state().q(), &q), with(system.state().p(), &p)).unwrap();
    let stepper = stepper("stormer-verlet", h, &context);
    let mut run = ShadowRun::new(stepper.with(motion), 0, &Bilinear::new(16)).unwrap();
    run.advance().unwrap().unwrap().1.value.clone()
}

/// The change of H̄ over some steps from several starts, root mean square.
fn wandering<M: System<Number = f64, Class = Quadratic>>(h: &str, steps: u32, start: impl Fn(f64) -> M) -> f64 {
    let stepper = stepper::<f64>("stormer-verlet", h, &());
    let change = |phase: u32| {
        let mut motion = start(0.1 + 0.6 * f64::from(phase));
        let before = modified(h, &motion);
        (0..steps).for_each(|_| stepper.step(&mut motion));
        (modified(h, &motion) - before).to_f64()
    };
    let squares: f64 = (0..8).map(|phase| change(phase).powi(2)).sum();
    (squares / 8.0).sqrt()
}

#[test]
fn round_off_moves_the_modified_energy_less() {
    let start = |phase: f64| {
        let (sin, cos) = phase.sin_cos();
        Motion::new(HenonHeiles, UnitMasses, [0.1 * cos, 0.12 * sin], [0.11 * sin, 0.1 * cos]).unwrap()
    };
    let (h, steps) = ("1/100", 4000);
    let plain = wandering(h, steps, start);
    let compensated = wandering(h, steps, |phase| start(phase).compensated());
    let fixed = wandering(h, steps, |phase| start(phase).fixed_point(&[1.0; 2], &[1.0; 2]).unwrap());
    println!("{plain:e}, {compensated:e}, {fixed:e}");
    // by half a last place of q and p in each of the steps, and by a hundredth of that
    assert!(
        plain > 1e-17 && 10.0 * compensated < plain && 10.0 * fixed < plain,
        "{plain:e}, {compensated:e}, {fixed:e}"
    );
}

// ---------------------------------------------------------------------------------------------------------------
// Fixed point

/// Steps forth and back.
fn to_and_fro<C, M: System<Number = f64, Class = C>>(
    name: &str,
    stepper: &Stepper<impl Scheme + ValidFor<C>, f64>,
    motion: &mut M,
    steps: u32,
) {
    let start = all_bits(motion);
    (0..steps).for_each(|_| stepper.step(motion));
    let is_finite = motion.state().q().iter().chain(motion.state().p()).all(|x| x.is_finite());
    assert!(is_finite && all_bits(motion) != start, "{name}");
    (0..steps).for_each(|_| stepper.step_back(motion));
    assert_eq!(all_bits(motion), start, "{name}");
}

#[test]
fn every_scheme_is_undone_to_the_last_bit() {
    let h = rational("1/50");
    let masses = |dimension| Masses::<f64>::all(dimension, &());
    for scheme in all::<f64>(&h, &()) {
        let stepper = Stepper::<_, f64>::new(scheme.twin, &h).unwrap();
        for (problem, masses) in [Problem::Kepler, Problem::Scattering].into_iter().zip(masses(2)) {
            let motion: AnyMotion<f64> = system(problem, masses, &());
            let mut motion = motion.fixed_point(&[64.0; 2], &[64.0; 2]).unwrap();
            to_and_fro(&scheme.name, &stepper, &mut motion, 30);
        }
    }
    for scheme in all_for_every_kinetic::<f64>(&h, &()) {
        let stepper = Stepper::<_, f64>::new(scheme.twin, &h).unwrap();
        for problem in [general::Problem::Plane, general::Problem::LotkaVolterra] {
            let motion = problem.system::<f64>(&());
            let ranges = vec![16.0; motion.q().len()];
            let mut motion = motion.fixed_point(&ranges, &ranges).unwrap();
            to_and_fro(&scheme.name, &stepper, &mut motion, 30);
        }
    }
}

#[test]
fn many_steps_are_undone_to_the_last_bit() {
    let mut motion = comet().fixed_point(&[2.0; 2], &[4.0; 2]).unwrap();
    to_and_fro("Kepler", &stepper("stormer-verlet", "1/20", &()), &mut motion, 20_000);
    // in f64 the way back is another one
    let mut plain = comet();
    let verlet = stepper("stormer-verlet", "1/20", &());
    (0..20_000).for_each(|_| verlet.step(&mut plain));
    (0..20_000).for_each(|_| verlet.step_back(&mut plain));
    assert_ne!(plain.q(), [0.4, 0.0]);
}

/// A coordinate that is set anew is rounded before the next step.
#[test]
fn a_state_that_is_set_is_rounded() {
    let mut motion = comet().fixed_point(&[2.0; 2], &[4.0; 2]).unwrap();
    let third = 1.0 / 3.0;
    motion.state_mut().set(&[third, 1e-10 * third], &[0.1, 0.2]);
    let unit = 2.0 / 2.0_f64.powi(62);
    assert_eq!(motion.q()[0], third);
    assert!(motion.q()[1] != 1e-10 * third && (motion.q()[1] - 1e-10 * third).abs() <= unit / 2.0);
    motion.q_mut()[1] = 1e-12 * third;
    let start = motion.q()[1];
    let verlet = stepper::<f64>("stormer-verlet", "1/1000", &());
    verlet.step(&mut motion);
    verlet.step_back(&mut motion);
    assert!((motion.q()[1] - start).abs() <= unit / 2.0);
}

/// It is not finite from then on, and a run stops there.
#[test]
fn a_coordinate_that_leaves_its_range_is_not_finite() {
    let stepper = stepper::<f64>("stormer-verlet", "1/20", &());
    let mut motion = comet().fixed_point(&[0.5; 2], &[4.0; 2]).unwrap();
    let mut steps = 0;
    while motion.is_finite() && steps < 100 {
        stepper.step(&mut motion);
        steps += 1;
    }
    // y is 0.8 at most, x is −1.6 at half a period, 63 steps: beyond twice the range, 1, and at most four times
    assert!((20..63).contains(&steps), "{steps}");
    (0..10).for_each(|_| stepper.step(&mut motion));
    assert!(motion.q()[0].is_nan() && !motion.is_finite());
    motion.state_mut().set(&[0.4, 0.0], &[0.0, 2.0]);
    stepper.step(&mut motion);
    assert!(motion.is_finite());
    let run = comet().fixed_point(&[0.5; 2], &[4.0; 2]).unwrap();
    assert!(energy_drift(stepper.with(run), 100, &Bilinear::new(4)).unwrap_err().to_string().contains("NaN"));
}

#[test]
fn ranges_that_are_not_valid_are_refused() {
    let refused = |q: &[f64], p: &[f64]| {
        let motion = Motion::new(Kepler, UnitMasses, vec![0.4, 0.0], vec![0.0, 2.0]).unwrap();
        motion.fixed_point(q, p).unwrap_err().to_string()
    };
    assert_eq!(refused(&[1.0], &[4.0; 2]), "q has 2 coordinates, but 1 ranges");
    assert_eq!(refused(&[1.0; 2], &[4.0, 0.0]), "the range of p[1] is 0e0; it must be from 1e-280 to 1e280");
    assert_eq!(refused(&[1.0, f64::NAN], &[4.0; 2]), "the range of q[1] is NaN; it must be from 1e-280 to 1e280");
    assert_eq!(refused(&[1.0; 2], &[1.0; 2]), "p[1] = 2e0 is beyond its range, 1e0");
    let error = comet().fixed_point(&[0.1; 2], &[4.0; 2]).map(|_| ()).unwrap_err();
    assert_eq!(error, RangeError::Beyond { name: "q", index: 0, value: 0.4, range: 0.1 });
}
