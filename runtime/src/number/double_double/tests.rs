//! Values, text and special values; the bounds of errors are in `bounds`.

#[cfg(feature = "mpfr")]
mod bounds;
#[cfg(feature = "mpfr")]
mod cases;
#[cfg(feature = "mpfr")]
mod tables;

use std::array::from_fn;

use num_bigint::BigInt;
use proptest::prelude::*;
use shadowstep_schemes::symbolic::decimal::{from_text, to_significant};

use super::super::tests::{functions, operations, products};
use super::DoubleDouble;
use super::nearest::nearest;
use crate::Rational;
use crate::number::instructions::Instructions;
use crate::number::{Lanes, Number, Real};

fn rational(text: &str) -> Rational {
    from_text(text).unwrap()
}

fn number(text: &str) -> DoubleDouble {
    nearest(&rational(text))
}

/// The exact value.
fn exactly(x: DoubleDouble) -> Rational {
    let (high, low) = x.parts();
    Rational::from_float(high).unwrap() + Rational::from_float(low).unwrap()
}

fn each(change: impl Fn(&mut DoubleDouble, &DoubleDouble), a: f64) -> f64 {
    let mut x = DoubleDouble::from(a);
    change(&mut x, &DoubleDouble::from(a));
    x.to_f64()
}

proptest! {
    /// No double-double is nearer, and the parts do not overlap.
    #[test]
    fn rational_is_rounded_once(n: i128, d in 1..i128::MAX, exponent in -300i32..300) {
        let value = Rational::new(n.into(), d.into()) * Rational::from(BigInt::from(2)).pow(exponent);
        let (high, low) = nearest(&value).parts();
        prop_assert_eq!(high, f64::from_rational(&value, &()));
        prop_assert_eq!(high + low, high);
        let rest = |low: f64| {
            num_traits::Signed::abs(&(&value - exactly(DoubleDouble { high, low })))
        };
        prop_assert!(rest(low) <= rest(low.next_up()) && rest(low) <= rest(low.next_down()));
    }

    #[test]
    fn text_reads_back(high in -1e300..1e300, ratio in -0.5..0.5, power in 0i32..200) {
        let low = high * f64::EPSILON * ratio * 2f64.powi(-power);
        let x = DoubleDouble::new(high, low);
        prop_assert_eq!(number(&x.to_text()), x);
    }

    /// The exact number to as many digits, and one digit less does not read back; at the ends of exponents and beside
    /// ties, too.
    #[test]
    fn text_is_the_shortest(bits: u64, ratio in -0.5..0.5, end in 0..6) {
        let high = f64::from_bits(bits & !(1 << 63));
        let high = match end {
            0 => f64::MIN_POSITIVE * f64::from_bits(bits >> 12 | 1.0f64.to_bits()),
            1 => f64::from_bits(bits >> 12), // subnormal
            2 => f64::from_bits(high.to_bits() & 0x7ff0_0000_0000_0000),
            _ => high,
        };
        prop_assume!(high.is_finite() && high != 0.0);
        let ulp = high - high.next_down();
        let x = DoubleDouble::new(high, if end == 3 { ulp / 2.0 } else { ulp * ratio });
        prop_assume!(x.high.is_finite());
        let text = x.to_text();
        prop_assert_eq!(number(&text), x);
        let all = text.split('e').next().unwrap().replace('.', "");
        let count = all.trim_start_matches('0').trim_end_matches('0').len();
        let rounded = |digits: usize| to_significant(&exactly(x), digits);
        prop_assert_eq!(rational(&rounded(count.max(31))), rational(&text));
        prop_assert!(count <= 31 || number(&rounded(count - 1)) != x, "{}", text);
    }

    #[test]
    fn short_text_survives(digits in -10_i128.pow(31)..10_i128.pow(31), exponent in -250i32..250) {
        let text = format!("{digits}e{exponent}");
        let significant = |text: &str| {
            let digits = text.split('e').next().unwrap().replace(['.', '-'], "");
            digits.trim_matches('0').to_owned()
        };
        prop_assert_eq!(significant(&number(&text).to_text()), significant(&text));
    }

    #[test]
    fn text_of_short_numbers_is_that_of_the_machine(n in 0i64..1_000_000, exponent in -9i32..18) {
        let text = format!("{n}e{exponent}");
        let x: f64 = text.parse().unwrap();
        prop_assert_eq!(number(&text).to_text(), x.to_text());
    }

    /// High parts are the results in `f64`, or next to them.
    #[test]
    fn results_are_near_those_of_the_machine(a in 1e-3..100.0, b in -1e3..1e3, c in -1e-3..1e60) {
        let [x, y, z] = [a, b, c].map(DoubleDouble::from);
        let alike = |own: &[DoubleDouble], machine: &[f64]| {
            own.iter().map(DoubleDouble::to_f64).zip(machine).all(|(own, &machine)| {
                own == machine || (own - machine).abs() <= 1e-14 * machine.abs()
            })
        };
        prop_assert!(alike(&operations(&x, &y, &z), &operations(&a, &b, &c)));
        let scale = c.abs() + (a * b).abs();
        for (own, machine) in products(&x, &y, &z).iter().zip(products(&a, &b, &c)) {
            prop_assert!((own.to_f64() - machine).abs() <= 1e-14 * scale);
        }
        // the arccosine near 1 depends on the last bit of a/100
        let a = 0.8 * a;
        prop_assert!(alike(&functions(&DoubleDouble::from(a)), &functions(&a)), "functions of {a}");
    }
}

type InLanes = DoubleDouble<Lanes<4>>;

fn in_lanes(numbers: &[DoubleDouble]) -> InLanes {
    DoubleDouble::of((Lanes(from_fn(|i| numbers[i].high)), Lanes(from_fn(|i| numbers[i].low))))
}

/// The bits of a lane; of a NaN its name.
fn bits(high: f64, low: f64) -> Option<[u64; 2]> {
    (!high.is_nan()).then(|| [high, low].map(f64::to_bits))
}

proptest! {
    /// Also where others are special; but for products that underflow.
    #[test]
    fn a_lane_has_the_bits_of_one_number(numbers in prop::collection::vec(small_or_special(), 12)) {
        let (a, b, c) = (&numbers[..4], &numbers[4..8], &numbers[8..]);
        let [x, y, z] = [a, b, c].map(in_lanes);
        for instructions in Instructions::available() {
            let (some, others, more) = instructions.only(|| {
                InLanes::in_widest_instructions(
                    #[inline(always)]
                    || (operations(&x, &y, &z), products(&x, &y, &z), functions(&x)),
                )
            });
            let found = some.iter().chain(&others).chain(&more);
            let found: Vec<_> = found.map(|lanes| lanes.parts()).collect();
            for lane in 0..4 {
                let (a, b, c) = (&a[lane], &b[lane], &c[lane]);
                let (some, others, more) = (operations(a, b, c), products(a, b, c), functions(a));
                for (i, (found, own)) in found.iter().zip(some.iter().chain(&others).chain(&more)).enumerate() {
                    let found = bits(found.0.0[lane], found.1.0[lane]);
                    prop_assert_eq!(found, bits(own.high, own.low), "{:?} operation {}: {:?} {:?} \
                        {:?}", instructions, i, a, b, c);
                }
            }
        }
    }
}

fn small_or_special() -> impl Strategy<Value = DoubleDouble> {
    let special = prop::sample::select(vec![0.0, -0.0, 1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e300]);
    let usual = (-1e3..1e3_f64, -0.5..0.5).prop_map(|(x, ratio)| DoubleDouble::new(x, x * f64::EPSILON * ratio));
    prop_oneof![special.prop_map(DoubleDouble::from), usual.clone(), usual]
}

#[test]
fn text_is_laid_out_as_that_of_the_machine() {
    for text in ["0.1", "-0.1", "2.0", "-1.25e-30", "1e300", "0.00012", "1.2e-5", "1234567890123456.0", "1.5e17", "0.0"]
    {
        assert_eq!(number(text).to_text(), text);
    }
    assert_eq!(DoubleDouble::from(-0.0).to_text(), "-0.0");
    assert_eq!(number("1/3").to_text(), "0.333333333333333333333333333333332");
    // the machine's 0.1 is not one tenth
    assert_eq!(DoubleDouble::from(0.1).to_text(), "0.1000000000000000055511151231257827021181583404541015625");
    let far = DoubleDouble::new(1.0, 2f64.powi(-300));
    assert_eq!(number(&far.to_text()), far);
}

#[test]
fn what_is_not_finite() {
    let [zero, one, infinity, nan] = [0.0, 1.0, f64::INFINITY, f64::NAN].map(DoubleDouble::from);
    let large = DoubleDouble::new(1e308, 1e291);
    for (a, b) in [
        (one, zero),
        (-one, zero),
        (zero, zero),
        (one, infinity),
        (infinity, one),
        (infinity, -infinity),
        (infinity, zero),
        (zero, infinity),
        (infinity, infinity),
        (nan, one),
        (one, nan),
        (large, large),
        (-large, large),
        (zero, one),
    ] {
        let machine = operations(&a.high, &b.high, &one.high);
        let own = operations(&a, &b, &one);
        for (own, machine) in own.iter().zip(machine) {
            let alike = own.high == machine || own.high.is_nan() && machine.is_nan();
            assert!(alike && !own.low.is_nan(), "{a:?}, {b:?}: {own:?}, {machine}");
            assert_eq!(Number::is_finite(own), machine.is_finite());
        }
        let [own, machine] = [products(&a, &b, &one).map(|x| x.high), products(&a.high, &b.high, &1.0)];
        assert_eq!(own.map(|x| x.to_text()), machine.map(|x| x.to_text()), "{a:?}, {b:?}");
    }
    for a in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0, 1000.0, -1000.0] {
        let own = functions(&DoubleDouble::from(a)).map(|x| x.high);
        for (i, (own, machine)) in own.into_iter().zip(functions(&a)).enumerate() {
            let alike =
                own == machine || own.is_nan() && machine.is_nan() || (own - machine).abs() < 1e-13 * machine.abs();
            assert!(alike, "function {i} of {a}: {own}, {machine}");
        }
    }
    assert_eq!([infinity, -infinity, nan].map(|x| x.to_text()), ["inf", "-inf", "NaN"]);
    assert_eq!(each(|x, a| x.assign_sqrt(a), 0.0), 0.0);
    assert!(each(|x, a| x.assign_sqrt(a), -1.0).is_nan());
    assert_eq!(each(|x, a| x.assign_sqrt(a), f64::INFINITY), f64::INFINITY);
}

#[test]
fn order_is_that_of_the_values() {
    let [one, more] = [number("1"), DoubleDouble::new(1.0, 1e-30)];
    assert!(one < more && -more < -one && DoubleDouble::new(1.0, -1e-30) < one);
    assert!(number("-1e-40").is_below_zero() && !DoubleDouble::from(-0.0).is_below_zero());
    assert!(number("3.8e153").has_finite_square() && !number("3.9e153").has_finite_square());
    assert_eq!(number("1e-5").log10_abs(), -5.0);
}

#[test]
fn powers_of_two_are_exact_factors() {
    let third = number("1/3");
    for n in [1, 2, -4, 1 << 30, i32::MIN] {
        let [mut product, mut quotient] = [third; 2];
        product.multiply_integer(n);
        quotient.divide_integer(n);
        assert_eq!(exactly(product), exactly(third) * BigInt::from(n));
        assert_eq!(exactly(quotient), exactly(third) / BigInt::from(n));
    }
}
