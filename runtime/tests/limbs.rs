//! Protects steps and estimates in numbers of seven limbs: they agree with MPFR's to 120 digits, for every shipped
//! scheme and problem.

use rug::Float;
use shadowstep::number::{Limbs, Precision};
use shadowstep::problems::{PROBLEMS, Setup, problem};
use shadowstep::shadow::run::energy_drift;
use shadowstep::shadow::{Bilinear, Central, StoppingRule};
use shadowstep::{Number, Rational, Real, Stepper, tables};
use shadowstep_schemes::shipped_names;

type Seven = Limbs<7>;

/// As precise as seven limbs: what differs is that MPFR rounds a b + c once.
fn same_precision() -> Precision {
    Precision::bits(Seven::BITS).unwrap()
}

fn stepper<N: Real>(scheme: &str, h: &str, context: &N::Context) -> Stepper<tables::TableScheme, N> {
    Stepper::with_context(tables::shipped(scheme).unwrap(), h, context).unwrap()
}

/// q, p and β after some steps.
fn state<N: Real + 'static>(setup: &Setup, scheme: &str, steps: u32, context: &N::Context) -> Vec<N> {
    let stepper = stepper::<N>(scheme, setup.problem.description().step, context);
    let mut motion = setup.motion::<N>(context).unwrap();
    let mut beta = N::zero(context);
    for _ in 0..steps {
        stepper.step_augmented(&mut motion);
        beta.add(motion.increments().beta);
    }
    motion.q().iter().chain(motion.p()).cloned().chain([beta]).collect()
}

fn float(x: &Seven) -> Float {
    Float::with_val(Seven::BITS, Float::parse(x.to_text()).unwrap())
}

/// Checks that all numbers agree to 10^-120 of the largest one.
#[track_caller]
fn agree(what: &str, limbs: &[Seven], expected: &[Float]) {
    assert_eq!(limbs.len(), expected.len());
    let largest = expected.iter().map(|x| x.clone().abs()).fold(Float::new(10), |a, b| a.max(&b));
    assert!(largest > 0 && largest.is_finite(), "{what}");
    for (own, expected) in limbs.iter().zip(expected) {
        let digits = (float(own) - expected).log10_abs() - largest.log10_abs();
        assert!(digits < -120.0, "{what}: {own} instead of {expected}, {digits}");
    }
}

#[test]
fn every_problem_agrees_with_mpfr() {
    for problem in PROBLEMS {
        let setup = problem.setup(&[], 150).unwrap();
        let expected = state::<Float>(&setup, "yoshida4", 2, &same_precision());
        agree(problem.name(), &state::<Seven>(&setup, "yoshida4", 2, &()), &expected);
    }
}

#[test]
fn every_scheme_agrees_with_mpfr() {
    let setup = problem("kepler").unwrap().setup(&[], 150).unwrap();
    for name in shipped_names() {
        let expected = state::<Float>(&setup, name, 1, &same_precision());
        agree(name, &state::<Seven>(&setup, name, 1, &()), &expected);
    }
}

#[test]
fn estimates_agree_with_mpfr() {
    fn drift<N: Real + 'static>(context: &N::Context) -> [N; 2] {
        let setup = problem("henon-heiles").unwrap().setup(&[], 150).unwrap();
        let stepper = stepper::<N>("stormer-verlet", "1/20", context);
        let motion = || setup.motion::<N>(context).unwrap();
        [
            energy_drift(stepper.with(motion()), 30, &Bilinear::new(8)).unwrap().drift,
            energy_drift(stepper.with(motion()), 30, &Central::best(12, StoppingRule::Full)).unwrap().drift,
        ]
    }
    let limbs = drift::<Seven>(&());
    // the last of 134 digits, in differences of energies of 1/8 or so
    for (own, expected) in limbs.iter().zip(drift::<Float>(&same_precision())) {
        assert!(expected.log10_abs() < -5.0);
        assert!((float(own) - &expected).log10_abs() < -125.0, "{own} instead of {expected}");
    }
}

#[test]
fn exact_numbers_are_rounded_once() {
    let third = Rational::new(1.into(), 3.into());
    let [own, expected] = [float(&Seven::from_rational(&third, &())), Float::from_rational(&third, &same_precision())];
    assert_eq!(own, expected);
    assert_ne!(own, Float::from_rational(&third, &Precision::digits(120).unwrap()));
}
