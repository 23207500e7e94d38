//! Protects what a user meets first: step sizes and what each form of them means, motions with their errors, masses
//! from numbers, a potential from a closure.

use num_traits::{One, Signed, Zero};
use rug::Float;
use shadowstep::number::Lanes;
use shadowstep::number::counting::Counting;
use shadowstep::problems::{HenonHeiles, Kepler, Pendulum};
use shadowstep::steps::scheme::Weights;
use shadowstep::systems::kinetic::MassError;
use shadowstep::systems::potential::from_fn;
use shadowstep::systems::potential_check::check_potential;
use shadowstep::{
    DiagonalMasses, FullMasses, Motion, MotionError, Potential, Rational, Real, Scheme, StepSize, StepSizeError,
    Stepper, UnitMasses, splitting_scheme,
};
use shadowstep_tests::{log10_distance, log10_largest_distance, number, numbers, precision, rational, same_bits};

#[derive(Clone, Copy)]
#[splitting_scheme("yoshida4.toml")]
struct Yoshida4;

#[derive(Clone, Copy)]
#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

fn verlet<H: TryInto<StepSize>>(h: H) -> Stepper<StormerVerlet, f64>
where
    StepSizeError: From<H::Error>,
{
    Stepper::new(StormerVerlet, h).unwrap()
}

// ---------------------------------------------------------------------------------------------------------------
// Step sizes

#[test]
fn a_step_size_is_shown_in_a_line() {
    let shown = |text: &str| format!("{:?}", StepSize::try_from(text).unwrap());
    assert_eq!(shown("-1/20"), "StepSize(-1/20)");
    assert_eq!(shown("1/3"), "StepSize(1/3)");
    assert_eq!(shown("sqrt(2)/20"), "StepSize(≈ 0.07071067811865475244)");
    assert_eq!(shown("1e-290"), "StepSize(≈ 1e-290)");
}

#[test]
fn a_text_means_the_value_of_its_formula() {
    let twentieth = Rational::new(1.into(), 20.into());
    for text in ["1/20", "0.05", "5e-2", "1/10/2", "(1 - 4/5)/4"] {
        assert_eq!(*verlet(text).h(), twentieth, "{text}");
    }
    assert_eq!(*verlet("-1/20").h(), -twentieth);
    // an irrational one is rounded to 300 digits
    let h = verlet("sqrt(2)/100").h().clone();
    let off = &h * &h * rational("10000") - rational("2");
    assert!(!off.is_zero() && off.abs() < rational("1e-298"));
}

#[test]
fn a_double_means_itself() {
    let h = verlet(0.05).h().clone();
    assert_eq!(h, Rational::new(3_602_879_701_896_397_u64.into(), 72_057_594_037_927_936_u64.into()));
    let off = h - rational("1/20");
    assert!(off.is_positive() && off < rational("2.8e-18") && off > rational("2.7e-18"));
    // dyadic fractions are the same number
    assert_eq!(verlet(0.125).h(), verlet("1/8").h());
    assert_eq!(*verlet(-0.125).h(), -Rational::one() / rational("8"));
}

#[test]
fn a_rational_and_a_step_size_mean_themselves() {
    let third = rational("1/3");
    let size = StepSize::try_from("1/3").unwrap();
    let steppers = [verlet("1/3"), verlet(third.clone()), verlet(&third), verlet(size.clone()), verlet(&size)];
    for stepper in steppers {
        assert_eq!((stepper.h(), stepper.step_size()), (&third, &size));
        assert_eq!(stepper.step_size().to_string(), "1/3");
    }
}

/// h·w is one exact product, rounded once: not h rounded times w rounded.
#[test]
fn weights_are_rounded_once() {
    fn check<N: shadowstep_tests::Bits>(context: &N::Context) {
        let of_scheme = Yoshida4.exact_weights();
        for h in ["1/20", "1/53", "-3/7"] {
            let stepper = Stepper::<_, N>::with_context(Yoshida4, h, context).unwrap();
            let products: Vec<_> = of_scheme.view().iter().map(|weight| weight * rational(h)).collect();
            let rounded: Vec<N> = products.iter().map(|product| N::from_rational(product, context)).collect();
            let negatives: Vec<N> = products.iter().map(|product| N::from_rational(&-product, context)).collect();
            let all = |weights: Weights<&[N]>| weights.iter().cloned().collect::<Vec<N>>();
            let [forward, back] = [stepper.weights(), stepper.weights_back()].map(all);
            assert!(same_bits(&forward, &rounded) && same_bits(&back, &negatives), "{h}");
        }
    }
    check::<f64>(&());
    check::<Float>(&precision(40));
}

/// In `f64` the decimal and the double nearest to it give weights that differ in the last place at most; with more
/// digits they are two step sizes.
#[test]
fn decimals_and_doubles_differ_where_there_are_digits_for_it() {
    let [fraction, decimal] = ["1/20", "0.05"].map(|h| Stepper::<_, f64>::new(Yoshida4, h).unwrap());
    let double = Stepper::<_, f64>::new(Yoshida4, 0.05).unwrap();
    for ((one, same), near) in fraction.weights().iter().zip(decimal.weights().iter()).zip(double.weights().iter()) {
        assert_eq!(one.to_bits(), same.to_bits());
        assert!(one.to_bits().abs_diff(near.to_bits()) <= 1, "{one:e}, {near:e}");
    }
    // the weight 1 of a drift
    assert_eq!(verlet("0.05").weights().drifts[0].to_bits(), 0.05_f64.to_bits());
    assert_eq!(verlet(0.05).weights().drifts[0].to_bits(), 0.05_f64.to_bits());

    let context = precision(40);
    let [decimal, double] = [StepSize::try_from("0.05"), StepSize::try_from(0.05)].map(|h| {
        let stepper = Stepper::<_, Float>::with_context(StormerVerlet, h.unwrap(), &context).unwrap();
        stepper.weights().drifts[0].clone()
    });
    let off = log10_distance(&decimal, &double);
    assert!((-17.6..-17.5).contains(&off), "10^{off}");
}

#[test]
fn step_sizes_that_are_not_valid_are_refused() {
    fn refusal<H: TryInto<StepSize>>(h: H) -> String
    where
        StepSizeError: From<H::Error>,
    {
        Stepper::<_, f64>::new(StormerVerlet, h).map(drop).unwrap_err().to_string()
    }
    let zero = "the step size must be nonzero";
    assert_eq!(["0", "0.0", "-0", "1/2 - 0.5"].map(refusal), [zero; 4]);
    assert_eq!([0.0, -0.0].map(refusal), [zero; 2]);
    let rational_zero = Rational::zero();
    assert_eq!([refusal(&rational_zero), refusal(rational_zero)], [zero; 2]);
    assert_eq!(refusal(f64::NAN), "the step size must be finite, not NaN");
    assert_eq!(refusal(f64::INFINITY), "the step size must be finite, not inf");
    assert_eq!(refusal(f64::NEG_INFINITY), "the step size must be finite, not -inf");
    assert_eq!(refusal("1/0"), "the step size `1/0` is not a valid number: division by zero");
    for text in ["", "x", "NaN", "inf", "1/20 s", "0,05", "sqrt(-1)"] {
        let sentence = refusal(text);
        assert!(sentence.starts_with(&format!("the step size `{text}` is not a valid number: ")), "{sentence}");
    }
    // the same where the numbers have a context
    let error = Stepper::<_, Float>::with_context(StormerVerlet, 0.0, &precision(30)).map(drop).unwrap_err();
    assert_eq!(error, StepSizeError::Zero);
}

#[test]
fn step_sizes_beyond_the_range_of_doubles_are_refused() {
    let refused = |h: &str| StepSize::try_from(h) == Err(StepSizeError::BeyondRange);
    assert_eq!(["1e-301", "-1e301", "1e-300", "1e300", "-1e-300"].map(refused), [true, true, false, false, false]);
}

#[test]
fn a_clone_makes_the_same_steps() {
    let stepper = Stepper::new(Yoshida4, "1/20").unwrap();
    let clone = stepper.clone();
    let mut motions = [(); 2].map(|()| Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]).unwrap());
    for _ in 0..100 {
        stepper.step(&mut motions[0]);
        clone.step(&mut motions[1]);
    }
    assert!(same_bits(motions[0].q(), motions[1].q()) && same_bits(motions[0].p(), motions[1].p()));
    assert_eq!((stepper.scheme().summary(), stepper.h()), (clone.scheme().summary(), clone.h()));
    // numbers that count have no context either
    let counting = Stepper::<_, Counting<f64>>::new(Yoshida4, "1/20").unwrap();
    assert!(counting.weights().iter().map(|weight| weight.0).eq(stepper.weights().iter().copied()));
}

// ---------------------------------------------------------------------------------------------------------------
// Motions

/// A potential of no coordinates, which no motion can have.
struct Nothing;

impl Potential<f64> for Nothing {
    fn dimension(&self) -> usize {
        0
    }
    fn energy(&self, _: &[f64], energy: &mut f64, _: &mut [f64]) {
        *energy = 0.0;
    }
    fn gradient(&self, _: &[f64], _: &mut [f64], _: &mut [f64]) {}
}

#[test]
fn a_motion_whose_parts_do_not_fit_is_refused() {
    fn refusal<N: Real, P: Potential<N>, K: shadowstep::Kinetic<N>>(
        potential: P,
        kinetic: K,
        q: Vec<N>,
        p: Vec<N>,
        expected: &MotionError,
    ) -> String {
        let error = Motion::new(potential, kinetic, q, p).map(drop).unwrap_err();
        assert_eq!(error, *expected);
        error.to_string()
    }
    let none = MotionError::NoCoordinates;
    assert_eq!(refusal(Nothing, UnitMasses, vec![], vec![], &none), "a motion needs at least one coordinate");
    assert_eq!(
        refusal(Kepler, UnitMasses, vec![1.0, 0.0], vec![0.0], &MotionError::Momenta { coordinates: 2, momenta: 1 }),
        "q has 2 coordinates, but p has 1"
    );
    let other = MotionError::Potential { coordinates: 3, dimension: 2 };
    assert_eq!(
        refusal(HenonHeiles, UnitMasses, vec![0.0; 3], vec![0.0; 3], &other),
        "q has 3 coordinates, but the potential is a function of 2"
    );
    let other = MotionError::Kinetic { coordinates: 2, dimension: 3 };
    let sentence = "p has 2 components, but the kinetic energy is a function of 3";
    let masses = DiagonalMasses::from_numbers(&[1.0; 3]).unwrap();
    assert_eq!(refusal(Kepler, masses, vec![1.0, 0.0], vec![0.0, 1.0], &other), sentence);
    let one = |i: usize| (0..3).map(|j| rational(if i == j { "1" } else { "0" })).collect::<Vec<_>>();
    let masses = FullMasses::<f64>::from_inverse(&[one(0), one(1), one(2)], &()).unwrap();
    assert_eq!(refusal(Kepler, masses, vec![1.0, 0.0], vec![0.0, 1.0], &other), sentence);

    for (q, p, name) in [
        (vec![1.0, f64::NAN], vec![0.0; 2], "q2"),
        (vec![1.0, 0.0], vec![f64::INFINITY, f64::NAN], "p1"),
        (vec![f64::NEG_INFINITY; 2], vec![0.0; 2], "q1"),
    ] {
        let error = MotionError::NotFinite { name: name.to_owned() };
        let sentence = format!("the initial value of {name} is not finite");
        assert_eq!(refusal(Kepler, UnitMasses, q, p, &error), sentence);
    }
    // of trajectories in lanes, the others go on
    let lanes = || vec![Lanes([1.0, f64::NAN, 1.0, 1.0])];
    assert!(Motion::new(Pendulum, UnitMasses, lanes(), lanes()).is_ok());

    let sentence = "the numbers of q and p must have the same precision";
    let (few, many) = (number("1", 20), number("1", 30));
    let error = MotionError::Precision;
    assert_eq!(refusal(Pendulum, UnitMasses, vec![few.clone()], vec![many.clone()], &error), sentence);
    let zeros = || numbers::<Float>(&["0", "0"], &precision(20));
    assert_eq!(refusal(Kepler, UnitMasses, vec![few.clone(), many.clone()], zeros(), &error), sentence);
    assert_eq!(refusal(Kepler, UnitMasses, zeros(), vec![few, many], &error), sentence);
}

#[test]
fn an_error_of_masses_is_one_of_motions() {
    let error: MotionError = DiagonalMasses::from_numbers(&[2.0, -1.0]).unwrap_err().into();
    assert_eq!(error, MotionError::Masses(MassError::NotPositive { index: 1, mass: "-1.0".to_owned() }));
    assert_eq!(error.to_string(), "mass 1 is -1.0; masses must be positive and finite");
}

// ---------------------------------------------------------------------------------------------------------------
// Masses from numbers

#[test]
fn masses_from_numbers_are_those_of_their_values() {
    let texts = ["4", "0.75"];
    let of_numbers = DiagonalMasses::from_numbers(&[4.0, 0.75]).unwrap();
    let of_rationals = DiagonalMasses::<f64>::new(&texts.map(rational), &()).unwrap();
    let motion = |masses| Motion::new(HenonHeiles, masses, [0.1, -0.3], [0.2, 0.1]).unwrap();
    let (mut one, mut other) = (motion(of_numbers), motion(of_rationals));
    let stepper = Stepper::new(Yoshida4, 0.1).unwrap();
    for _ in 0..100 {
        stepper.step(&mut one);
        stepper.step(&mut other);
        assert!(same_bits(one.q(), other.q()) && same_bits(one.p(), other.p()));
    }
    let context = precision(50);
    let masses = DiagonalMasses::from_numbers(&numbers::<Float>(&texts, &context)).unwrap();
    let [q, p] = [["0.1", "-0.3"], ["0.2", "0.1"]].map(|texts| numbers::<Float>(&texts, &context));
    let mut motion = Motion::new(HenonHeiles, masses, q, p).unwrap();
    // 0.2²/8 + 0.1²/1.5 + 0.01/2 + 0.09/2 − 0.003 + 0.009
    let energy = number("0.04/8 + 0.01/1.5 + 0.005 + 0.045 - 0.003 + 0.009", 50);
    assert!(log10_distance(&motion.energy(), &energy) < -49.0);
}

#[test]
fn masses_that_are_not_positive_numbers_are_refused() {
    for (mass, text) in [(0.0, "0.0"), (-2.5, "-2.5"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let error = DiagonalMasses::from_numbers(&[1.0, 1.0, mass]).unwrap_err();
        assert_eq!(error, MassError::NotPositive { index: 2, mass: text.to_owned() });
        assert_eq!(error.to_string(), format!("mass 2 is {text}; masses must be positive and finite"));
    }
}

/// 1/m is infinite or 0, so that the body would be lost, or not move.
#[test]
fn masses_that_overflow_or_underflow_are_refused() {
    for (mass, text) in [("1e-400", "1e-400"), ("1e400", "1e400"), ("1e-310", "1e-310")] {
        let error = DiagonalMasses::<f64>::new(&[rational("1"), rational(mass)], &()).unwrap_err();
        assert_eq!(error, MassError::OutOfRange { index: 1, mass: text.to_owned() });
        let sentence = "the mass or its inverse overflows or underflows in this number type";
        assert_eq!(error.to_string(), format!("mass 1 is {text}: {sentence}"));
        assert!(DiagonalMasses::<Float>::new(&[rational(mass)], &precision(20)).is_ok());
    }
    let error = DiagonalMasses::from_numbers(&[1e-310]).unwrap_err();
    assert_eq!(error, MassError::OutOfRange { index: 0, mass: "1e-310".to_owned() });
    assert!(DiagonalMasses::from_numbers(&[1e-300, 1e300]).is_ok());
}

#[test]
fn an_inverse_mass_matrix_must_be_positive_definite() {
    fn refusal<N: Real>(rows: &[&[&str]], context: &N::Context) -> Option<MassError> {
        let rows: Vec<Vec<_>> = rows.iter().map(|row| row.iter().map(|entry| rational(entry)).collect()).collect();
        FullMasses::<N>::from_inverse(&rows, context).err()
    }
    let row = |error: Option<MassError>| match error {
        Some(MassError::NotPositiveDefinite { row, .. }) => Some(row),
        None => None,
        other => panic!("{other:?}"),
    };
    // eigenvalues 3 and −1; 2/3 and 0; 4, 3 and −1
    assert_eq!(row(refusal::<f64>(&[&["1", "2"], &["2", "1"]], &())), Some(1));
    assert_eq!(row(refusal::<f64>(&[&["1/3", "1/3"], &["1/3", "1/3"]], &())), Some(1));
    assert_eq!(row(refusal::<f64>(&[&["4", "0", "0"], &["0", "1", "2"], &["0", "2", "1"]], &())), Some(2));
    // positive definite, by 12 and by 30 digits
    let nearly = |off: &str| [["1", off].map(str::to_owned), [off, "1"].map(str::to_owned)];
    let decide = |off: &str, digits: Option<u32>| {
        let rows = nearly(off);
        let rows: Vec<Vec<&str>> = rows.iter().map(|row| row.iter().map(String::as_str).collect()).collect();
        let rows: Vec<&[&str]> = rows.iter().map(Vec::as_slice).collect();
        match digits {
            None => row(refusal::<f64>(&rows, &())),
            Some(digits) => row(refusal::<Float>(&rows, &precision(digits))),
        }
    };
    assert_eq!(decide("1 - 1e-12", None), None);
    assert_eq!(decide("1 - 1e-30", None), Some(1), "beyond double precision");
    assert_eq!(decide("1 - 1e-30", Some(40)), None);
    assert_eq!(decide("1 + 1e-30", Some(40)), Some(1));
    // the scales of the coordinates do not matter
    assert_eq!(row(refusal::<f64>(&[&["1e-200", "0.9"], &["0.9", "1e200"]], &())), None);
    assert_eq!(row(refusal::<f64>(&[&["1e-200", "1.1"], &["1.1", "1e200"]], &())), Some(1));
    let error = refusal::<f64>(&[&["1e400", "0"], &["0", "1"]], &()).unwrap();
    assert_eq!(error, MassError::OutOfRange { index: 0, mass: "1e-400".to_owned() });
}

// ---------------------------------------------------------------------------------------------------------------
// A potential from a closure

/// The potential of Hénon and Heiles.
fn closure() -> impl Potential<f64> + Clone {
    from_fn(2, |q, gradient| {
        let [x, y] = [q[0], q[1]];
        gradient[0] = x + 2.0 * x * y;
        gradient[1] = y + x * x - y * y;
        (x * x + y * y) / 2.0 + x * x * y - y.powi(3) / 3.0
    })
}

fn henon_heiles<P: Potential<f64>>(potential: P) -> Motion<f64, [f64; 2], P, UnitMasses> {
    Motion::new(potential, UnitMasses, [0.1, -0.3], [0.2, 0.1]).unwrap()
}

#[test]
fn a_closure_gives_the_trajectory_of_its_formula() {
    let stepper = Stepper::new(Yoshida4, 0.05).unwrap();
    let (mut one, mut other) = (henon_heiles(closure()), henon_heiles(HenonHeiles));
    for n in 1..=1000 {
        stepper.step_augmented(&mut one);
        stepper.step_augmented(&mut other);
        let off = log10_largest_distance(one.q(), other.q()).max(log10_largest_distance(one.p(), other.p()));
        // a regular motion: errors of round-off grow like t
        assert!(off < -13.0, "n = {n}: 10^{off}");
        assert!((one.energy() - other.energy()).abs() < 1e-14 && (one.beta() - other.beta()).abs() < 1e-14, "n = {n}");
    }
    assert_eq!(one.evaluations(), other.evaluations());
    assert!((one.q()[0] - 0.1).abs() > 1e-3, "it moves");
    // the rate qᵀU_q − 2U, too
    let check = check_potential(&mut closure(), &[[0.1, -0.3]]).unwrap();
    assert!(check.agrees(), "{check}");
}

#[test]
fn a_closure_of_another_dimension_is_refused() {
    let error = Motion::new(closure(), UnitMasses, [0.1], [0.2]).map(drop).unwrap_err();
    assert_eq!(error, MotionError::Potential { coordinates: 1, dimension: 2 });
}

#[test]
fn initial_values_that_are_not_exact_numbers_are_refused() {
    let refusal =
        |x: &str, digits| Motion::exact(Kepler, UnitMasses, ["0", x], ["0", "2"], digits).err().map(|e| e.to_string());
    assert_eq!((refusal("1/3", 1), refusal("sqrt(2)", 327)), (None, None));
    let most = |digits| format!("the initial values cannot be rounded to {digits} digits: give a number from 1 to 327");
    assert_eq!((refusal("1", 0), refusal("1", 328)), (Some(most(0)), Some(most(328))));
    assert_eq!(refusal("1/0", 50).unwrap(), "q2: division by zero");
    assert_eq!(refusal("x", 50).unwrap(), "q2: unknown name `x`; the only known name is `pi`");
}
