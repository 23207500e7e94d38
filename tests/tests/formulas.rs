//! Protects potentials from formulas: compiled and read at run time they have the same bits; a wrong text has its
//! place.

use rug::Float;
use shadowstep::problems::{HarmonicOscillator, HenonHeiles, Kepler, Pendulum, Scattering};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::{Number, Potential, potential};
use shadowstep_tests::{Bits, numbers, potential_values, precision};

potential! {
    /// Uses every function, with parameters alone, with coordinates alone, and with both.
    struct Everything { depth, width }
    U(x, y) = -depth * exp(-(x^2 + y^2)/width^2) + log(2 + sin(x)*cos(y)) + tan(x/3) * sinh(y) / cosh(x)
        + tanh(width*x) * atan(y) + asin(x/4) * acos(y/5) + cbrt(3 + x) * (2 + y)^(2/5) + sqrt(depth) * x^4/7 - 0.3*y
}

const EVERYTHING: &str = "-depth * exp(-(x^2 + y^2)/width^2) + log(2 + sin(x)*cos(y)) + tan(x/3) * sinh(y) / cosh(x) \
    + tanh(width*x) * atan(y) + asin(x/4) * acos(y/5) + cbrt(3 + x) * (2 + y)^(2/5) + sqrt(depth) * x^4/7 - 0.3*y";

fn assert_twins<N: Bits>(
    formula: &str,
    coordinates: &[&str],
    parameters: &[(&str, N)],
    compiled: &impl Potential<N>,
    context: &N::Context,
) {
    let read = FormulaPotential::new(formula, coordinates, parameters).unwrap();
    for point in [["0.3", "-0.7"], ["1/7", "1.2"], ["-0.9", "2/3"]] {
        let q = numbers::<N>(&point[..coordinates.len()], context);
        let (one, other) = (potential_values(compiled, &q), potential_values(&read, &q));
        assert!(one.iter().all(Number::is_finite), "{formula} at {point:?}");
        for (one, other) in one.iter().zip(&other) {
            assert!(one.same_bits(other), "{formula} at {point:?}: {one} and {other}");
        }
    }
}

fn all_are_twins<N: Bits>(context: &N::Context) {
    let number = |text: &str| numbers::<N>(&[text], context).remove(0);
    assert_twins::<N>("-1/sqrt(x^2 + y^2)", &["x", "y"], &[], &Kepler, context);
    assert_twins::<N>("-cos(q)", &["q"], &[], &Pendulum, context);
    assert_twins::<N>("(x^2 + y^2)/2 + x^2*y - y^3/3", &["x", "y"], &[], &HenonHeiles, context);
    assert_twins::<N>("exp(-(x^2 + y^2))", &["x", "y"], &[], &Scattering, context);
    let omega = HarmonicOscillator { omega: number("3/7") };
    assert_twins("omega^2 * q^2/2", &["q"], &[("omega", number("3/7"))], &omega, context);
    let everything = Everything { depth: number("1.7"), width: number("0.6") };
    let parameters = [("depth", number("1.7")), ("width", number("0.6"))];
    assert_twins(EVERYTHING, &["x", "y"], &parameters, &everything, context);
}

#[test]
fn compiled_and_read_have_the_same_bits_in_double() {
    all_are_twins::<f64>(&());
}

#[test]
fn compiled_and_read_have_the_same_bits_at_120_digits() {
    all_are_twins::<Float>(&precision(120));
}

/// Central differences of U with a step of 1e-30 at 120 digits are off by about 1e-60.
#[test]
fn gradient_and_rate_are_those_of_the_energy() {
    let context = precision(120);
    let potential = Everything {
        depth: numbers::<Float>(&["1.7"], &context).remove(0),
        width: shadowstep_tests::number("0.6", 120),
    };
    let q = numbers::<Float>(&["0.3", "-0.7"], &context);
    let found = potential_values(&potential, &q);
    let [energy, rate, x_slope, y_slope] = &found[..4] else { unreachable!("U, rate, U_x, U_y") };
    let step = shadowstep_tests::number("1e-30", 120);
    for (i, slope) in [x_slope, y_slope].into_iter().enumerate() {
        let at = |sign: i32| {
            let mut moved = q.clone();
            moved[i] += step.clone() * sign;
            potential_values(&potential, &moved).remove(0)
        };
        let quotient = (at(1) - at(-1)) / (step.clone() * 2);
        assert!(shadowstep_tests::log10_distance(&quotient, slope) < -55.0, "{quotient} and {slope}");
    }
    let expected = q[0].clone() * x_slope + q[1].clone() * y_slope - energy.clone() * 2;
    // the rate is summed term by term
    assert!(shadowstep_tests::log10_distance(&expected, rate) < -115.0, "{expected} and {rate}");
}

#[test]
fn a_wrong_formula_is_refused_at_its_place() {
    for (text, range, message) in [
        ("x^2 + yy", 6..8, "unknown name `yy`; did you mean `y`?"),
        ("x^2 +", 5..5, "unexpected end"),
        ("abs(x)", 0..6, "`abs` is not smooth"),
        ("sin(x, y)", 0..9, "`sin` takes one argument, not 2"),
        ("x^y", 2..3, "an exponent must be a rational number"),
    ] {
        let error = FormulaPotential::<f64>::new(text, &["x", "y"], &[]).unwrap_err();
        assert!(error.to_string().starts_with(message), "{text}: {error}");
        assert_eq!(error.range(), range, "{text}: {error}");
    }
}

#[test]
fn names_differ() {
    let repeated = FormulaPotential::<f64>::new("x*y", &["x", "y", "x"], &[]).unwrap_err();
    let message = "`x` is there twice; the names of coordinates and parameters must differ";
    assert_eq!((repeated.to_string().as_str(), repeated.range()), (message, 0..0));
    assert!(FormulaPotential::new("x*y", &["x"], &[("y", 1.0), ("y", 2.0)]).is_err());
    let constant = FormulaPotential::new("pi*x", &["x"], &[("pi", 3.0)]).unwrap_err();
    assert_eq!(constant.to_string(), "`pi` is a constant; give the coordinate or parameter another name");
    assert!(FormulaPotential::new("x*y", &["x", "y"], &[("y", 2.0)]).is_err());
}

mod derived {
    //! What a user derives and documents as well.
    #![deny(missing_docs)]

    shadowstep::potential! {
        /// A spring.
        #[derive(Clone, PartialEq, Debug)]
        pub struct Spring {
            /// Its strength.
            k,
        }
        U(x) = k*x^2/2
    }
}

#[test]
fn traits_may_be_derived_beside_those_that_come_along() {
    let spring = derived::Spring { k: 2.0 };
    assert_eq!(spring.clone(), spring);
    assert_eq!(format!("{spring:?}"), "Spring { k: 2.0 }");
}
