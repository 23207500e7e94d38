//! Steps and functions in numbers of seven limbs, of a number of limbs chosen at run time, and MPFR's of 120 digits, as
//! ratios within one run.
//!
//! `cargo bench -p shadowstep --bench limbs`

mod timing;

use std::hint::black_box;

use shadowstep::number::{AnyLimbs, Float, Limbs, Precision};
use shadowstep::problems::{HenonHeiles, Kepler, Pendulum};
use shadowstep::{Motion, Number, Potential, Real, Stepper, UnitMasses, exact, splitting_scheme};

use timing::{Contestant, compare};

#[splitting_scheme("stormer-verlet.toml")]
struct StormerVerlet;

fn motion<N: Real, P: Potential<N>, const D: usize>(
    potential: P,
    context: &N::Context,
    q: [&str; D],
    p: [&str; D],
) -> Motion<N, [N; D], P, UnitMasses> {
    let number = |text| N::from_rational(&exact(text).expect("an exact number"), context);
    Motion::new(potential, UnitMasses, q.map(number), p.map(number)).expect("the dimensions agree")
}

fn steps<'a, N: Real + 'a, P: Potential<N> + 'a, const D: usize>(
    name: &'static str,
    mut motion: Motion<N, [N; D], P, UnitMasses>,
    augmented: bool,
) -> Contestant<'a> {
    let stepper = Stepper::with_context(StormerVerlet, "1/100", &motion.context()).expect("h is not 0");
    let run = move |repetitions| {
        for _ in 0..repetitions {
            if augmented { stepper.step_augmented(&mut motion) } else { stepper.step(&mut motion) }
        }
        black_box(motion.q());
    };
    (name, Box::new(run))
}

fn functions<'a, N: Real + 'a>(name: &'static str, context: &N::Context, apply: fn(&mut N, &N)) -> Contestant<'a> {
    let number = |i: i64| N::from_rational(&exact(&format!("{i}/997")).expect("a number"), context);
    let (arguments, mut result): (Vec<N>, N) = ((1..=64).map(|i| number(11 * i)).collect(), N::zero(context));
    let run = move |repetitions| {
        for i in 0..repetitions {
            apply(&mut result, black_box(&arguments[i as usize % 64]));
            black_box(&mut result);
        }
    };
    (name, Box::new(run))
}

fn main() {
    let digits = Precision::digits(120).expect("120 digits are allowed");
    let any = digits.limbs().expect("few enough");
    type Seven = Limbs<7>;
    for (title, augmented) in [("Step", false), ("Step with β", true)] {
        let state = (["0.4", "0"], ["0", "2"]);
        compare(
            &format!("{title}, 120 digits, Kepler"),
            vec![
                steps("MPFR", motion::<Float, _, 2>(Kepler, &digits, state.0, state.1), augmented),
                steps("7 limbs", motion::<Seven, _, 2>(Kepler, &(), state.0, state.1), augmented),
                steps("any limbs", motion::<AnyLimbs, _, 2>(Kepler, &any, state.0, state.1), augmented),
            ],
            300,
        );
        let state = (["0.1", "-0.2"], ["0.3", "0.1"]);
        compare(
            &format!("{title}, 120 digits, Hénon–Heiles"),
            vec![
                steps("MPFR", motion::<Float, _, 2>(HenonHeiles, &digits, state.0, state.1), augmented),
                steps("7 limbs", motion::<Seven, _, 2>(HenonHeiles, &(), state.0, state.1), augmented),
                steps("any limbs", motion::<AnyLimbs, _, 2>(HenonHeiles, &any, state.0, state.1), augmented),
            ],
            300,
        );
        compare(
            &format!("{title}, 120 digits, pendulum"),
            vec![
                steps("MPFR", motion::<Float, _, 1>(Pendulum, &digits, ["0.1"], ["1.5"]), augmented),
                steps("7 limbs", motion::<Seven, _, 1>(Pendulum, &(), ["0.1"], ["1.5"]), augmented),
                steps("any limbs", motion::<AnyLimbs, _, 1>(Pendulum, &any, ["0.1"], ["1.5"]), augmented),
            ],
            100,
        );
    }
    for (name, float, limbs) in functions_by_name() {
        compare(
            &format!("{name}, 120 digits"),
            vec![functions("MPFR", &digits, float), functions("7 limbs", &(), limbs)],
            100,
        );
    }
}

type Apply<N> = fn(&mut N, &N);

fn functions_by_name() -> [(&'static str, Apply<Float>, Apply<Limbs<7>>); 11] {
    fn sin_cos<N: Number>(x: &mut N, a: &N) {
        N::assign_sin_cos(x, &mut a.clone(), a);
    }
    fn product<N: Number>(x: &mut N, a: &N) {
        x.assign_product(a, a);
    }
    [
        ("Product", product, product),
        ("Square root", Number::assign_sqrt, Number::assign_sqrt),
        ("1/√", Number::assign_reciprocal_sqrt, Number::assign_reciprocal_sqrt),
        ("Sine and cosine", sin_cos, sin_cos),
        ("Exponential function", Number::assign_exp, Number::assign_exp),
        ("Logarithm", Number::assign_log, Number::assign_log),
        ("Arc tangent", Number::assign_atan, Number::assign_atan),
        ("Tangent", Number::assign_tan, Number::assign_tan),
        ("Hyperbolic sine", Number::assign_sinh, Number::assign_sinh),
        ("Arc sine or not a number", Number::assign_asin, Number::assign_asin),
        ("Root of order 7", |x, a| x.assign_root(a, 7), |x, a| x.assign_root(a, 7)),
    ]
}
