//! MPFR's numbers, [`rug::Float`], as a [`Number`].

use super::high_precision::ScaledInteger;
use super::{BLOCK, Number, Precision, Real};
use crate::Rational;
use num_bigint::BigInt;
use num_traits::Signed;
use rug::float::{self, Special};
use rug::integer::Order;
use rug::{Assign, Float, Integer};
use std::f64::consts::LOG10_2;

/// Whether a number has a sine here, as those of limbs: the time and the memory of one grow with the exponent, which
/// has 62 bits.
fn has_sine(a: &Float) -> bool {
    a.get_exp().is_none_or(|exponent| exponent <= 1 << 16)
}

impl Number for Float {
    type Context = Precision;
    type Block = [Self; BLOCK];
    type InLanes = Self;
    type Register<'a> = &'a mut Float;

    crate::number::without_derivatives!();

    fn register(&mut self) -> &mut Float {
        self
    }

    fn zero(precision: &Precision) -> Float {
        Float::new(precision.in_bits())
    }

    fn from_rational(value: &Rational, precision: &Precision) -> Float {
        let exact = rug::Rational::from((integer(value.numer()), integer(value.denom())));
        Float::with_val(precision.in_bits(), exact)
    }

    fn context(&self) -> Precision {
        Precision::of_bits(self.prec())
    }

    fn coarser(precision: &Precision, bits: u32) -> Precision {
        Precision::bits(bits).map_or(*precision, |coarser| coarser.min(*precision))
    }

    fn assign_zero(&mut self) {
        Assign::assign(self, Special::Zero);
    }

    fn assign(&mut self, a: &Float) {
        Assign::assign(self, a);
    }

    fn assign_sum(&mut self, a: &Float, b: &Float) {
        Assign::assign(self, a + b);
    }

    fn assign_difference(&mut self, a: &Float, b: &Float) {
        Assign::assign(self, a - b);
    }

    fn assign_product(&mut self, a: &Float, b: &Float) {
        Assign::assign(self, a * b);
    }

    fn assign_quotient(&mut self, a: &Float, b: &Float) {
        Assign::assign(self, a / b);
    }

    fn assign_sqrt(&mut self, a: &Float) {
        Assign::assign(self, a.sqrt_ref());
    }

    fn assign_reciprocal_sqrt(&mut self, a: &Float) {
        Assign::assign(self, a.recip_sqrt_ref());
    }

    fn assign_exp(&mut self, a: &Float) {
        Assign::assign(self, a.exp_ref());
    }

    fn assign_sin(&mut self, a: &Float) {
        if !has_sine(a) {
            return Assign::assign(self, Special::Nan);
        }
        Assign::assign(self, a.sin_ref());
    }

    fn assign_cos(&mut self, a: &Float) {
        if !has_sine(a) {
            return Assign::assign(self, Special::Nan);
        }
        Assign::assign(self, a.cos_ref());
    }

    fn assign_root(&mut self, a: &Float, n: u32) {
        Assign::assign(self, a.root_ref(n));
    }

    fn assign_log(&mut self, a: &Float) {
        Assign::assign(self, a.ln_ref());
    }

    fn assign_tan(&mut self, a: &Float) {
        if !has_sine(a) {
            return Assign::assign(self, Special::Nan);
        }
        Assign::assign(self, a.tan_ref());
    }

    fn assign_sinh(&mut self, a: &Float) {
        Assign::assign(self, a.sinh_ref());
    }

    fn assign_cosh(&mut self, a: &Float) {
        Assign::assign(self, a.cosh_ref());
    }

    fn assign_tanh(&mut self, a: &Float) {
        Assign::assign(self, a.tanh_ref());
    }

    fn assign_atan(&mut self, a: &Float) {
        Assign::assign(self, a.atan_ref());
    }

    fn assign_asin(&mut self, a: &Float) {
        Assign::assign(self, a.asin_ref());
    }

    fn assign_acos(&mut self, a: &Float) {
        Assign::assign(self, a.acos_ref());
    }

    fn assign_sin_cos(sin: &mut Float, cos: &mut Float, a: &Float) {
        if !has_sine(a) {
            Assign::assign(sin, Special::Nan);
            return Assign::assign(cos, Special::Nan);
        }
        (sin, cos).assign(a.sin_cos_ref());
    }

    fn add(&mut self, a: &Float) {
        *self += a;
    }

    fn subtract(&mut self, a: &Float) {
        *self -= a;
    }

    fn multiply(&mut self, a: &Float) {
        *self *= a;
    }

    fn divide(&mut self, a: &Float) {
        *self /= a;
    }

    // On references, `+=` and `-=` of a product are one fused operation.

    fn add_product(&mut self, a: &Float, b: &Float) {
        *self += a * b;
    }

    fn subtract_product(&mut self, a: &Float, b: &Float) {
        *self -= a * b;
    }

    fn multiply_integer(&mut self, n: i32) {
        *self *= n;
    }

    fn divide_integer(&mut self, n: i32) {
        *self /= n;
    }

    fn negate(&mut self) {
        rug::ops::NegAssign::neg_assign(self);
    }

    fn make_absolute(&mut self) {
        self.abs_mut();
    }

    fn make_at_least(&mut self, a: &Float) {
        if *self < *a {
            Assign::assign(self, a);
        }
    }

    fn make_at_most(&mut self, a: &Float) {
        if *self > *a {
            Assign::assign(self, a);
        }
    }

    fn make_nan_where_square_overflows(&mut self, a: &Float) {
        if Float::is_finite(self) && !a.has_finite_square() {
            Assign::assign(self, Special::Nan);
        }
    }

    fn lane(&self, _: usize) -> (f64, i64) {
        let (significand, exponent) = self.to_f64_exp();
        (significand, exponent.into())
    }

    fn set_lane(&mut self, _: usize, m: f64, n: i64) {
        Assign::assign(self, m);
        *self <<= n.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
    }

    fn assign_lane(&mut self, _: usize, a: &Float) {
        Assign::assign(self, a);
    }

    fn is_finite(&self) -> bool {
        Float::is_finite(self)
    }
}

impl Real for Float {
    fn is_below_zero(&self) -> bool {
        *self < 0
    }

    fn has_finite_square(&self) -> bool {
        // 0 has no exponent; 3 (2x)² < (4x)²
        Float::is_finite(self) && self.get_exp().is_none_or(|exponent| exponent < float::exp_max() / 2 - 2)
    }

    fn to_f64(&self) -> f64 {
        Float::to_f64(self)
    }

    fn log10_abs(&self) -> f64 {
        let (significand, exponent) = self.to_f64_exp();
        significand.abs().log10() + f64::from(exponent) * LOG10_2
    }

    fn to_text(&self) -> String {
        if self.is_zero() || !self.is_finite() {
            return self.to_f64().to_text();
        }
        // A text that is at most this long survives being read: if there is one for this number,
        // it comes back, with zeros behind it.  If not, one or two digits more are enough.
        let mut digits = self.context().in_digits().max(1);
        loop {
            let text = decimal(self, digits);
            let read = Float::parse(&text).expect("a decimal number");
            if Float::with_val(self.prec(), read) == *self {
                return text;
            }
            digits += 1;
        }
    }
}

/// target ← the number nearest to a
pub(super) fn assign_scaled(target: &mut Float, a: &ScaledInteger) {
    let magnitude = Integer::from_digits(&a.magnitude, Order::Lsf);
    Assign::assign(target, if a.negative { -magnitude } else { magnitude });
    *target <<= i32::try_from(a.exponent).expect("exponents have less than 32 bits");
}

fn integer(value: &BigInt) -> Integer {
    let magnitude = Integer::from_digits(&value.magnitude().to_u64_digits(), Order::Lsf);
    if value.is_negative() { -magnitude } else { magnitude }
}

/// A number with at most `digits` significant digits, without zeros at the end, laid out as Rust does for an `f64`.
fn decimal(value: &Float, digits: u32) -> String {
    let (negative, digits, point) = value.to_sign_string_exp(10, Some(digits as usize));
    let point = point.expect("neither infinite nor NaN");
    let digits = digits.trim_end_matches('0'); // 0.digits 10^point
    let sign = if negative { "-" } else { "" };
    match usize::try_from(point) {
        _ if !(-3..=16).contains(&point) => {
            let (first, rest) = digits.split_at(1);
            let dot = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{dot}{rest}e{}", point - 1)
        }
        Ok(point) if point >= digits.len() => format!("{sign}{digits:0<point$}.0"),
        Ok(point) if point > 0 => format!("{sign}{}.{}", &digits[..point], &digits[point..]),
        _ => format!("{sign}0.{}{digits}", "0".repeat(point.unsigned_abs() as usize)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::{Number, Precision, Real};
    use crate::Rational;
    use num_bigint::BigInt;
    use proptest::prelude::*;
    use rug::Float;

    /// As precise as an `f64`.
    fn float(x: f64) -> Float {
        Float::with_val(53, x)
    }

    fn integer(n: i128) -> Rational {
        BigInt::from(n).into()
    }

    /// Numbers of fewer bits take those of more as operands.
    #[test]
    fn coarser_numbers_round() {
        let fine = Precision::digits(1000).unwrap();
        let coarse = Float::coarser(&fine, 64);
        assert_eq!((coarse.in_bits(), Float::coarser(&coarse, 1000)), (64, coarse));
        let (third, mut sum) = (Float::from_rational(&Rational::new(1.into(), 3.into()), &fine), Float::zero(&coarse));
        sum.add_product(&third, &third);
        assert_eq!((sum.prec(), sum.to_f64()), (64, 1.0 / 9.0));
    }

    /// A sine of 2^(2^28) takes minutes and gigabytes.
    #[test]
    fn numbers_of_large_exponents_have_no_sine() {
        let power = |exponent: u32| Float::with_val(53, 1) << exponent;
        let of = |x: &Float| {
            let mut found = [float(0.0), float(0.0), float(0.0), float(0.0), float(0.0)];
            let [sin, cos, tan, both @ ..] = &mut found;
            sin.assign_sin(x);
            cos.assign_cos(x);
            tan.assign_tan(x);
            let [of_both, and_cos] = both;
            Float::assign_sin_cos(of_both, and_cos, x);
            found
        };
        assert!(of(&power(1 << 28)).iter().all(Float::is_nan));
        let [sin, cos, tan, of_both, and_cos] = of(&power(1000));
        // by mpmath
        assert_eq!((sin.to_f64(), cos.to_f64()), (-0.15920170308624243, 0.9872460775989135));
        assert_eq!((of_both, and_cos), (sin, cos));
        assert!((tan.to_f64() + 0.16125837995065806).abs() < 1e-16);
        assert_eq!(of(&float(0.0)).map(|x| x.to_f64()), [0.0, 1.0, 0.0, 0.0, 1.0]);
    }

    proptest! {
        #[test]
        fn operations_at_53_bits_are_those_of_the_machine(
            a in 1e-60..1e60, b in -1e3..1e3, c in -1e-3..1e60
        ) {
            let [x, y, z] = [a, b, c].map(float);
            prop_assert_eq!(operations(&x, &y, &z), operations(&a, &b, &c).map(float));
            prop_assert_eq!(products(&x, &y, &z), [b, -b].map(|b| float(a.mul_add(b, c))));
        }

        #[test]
        fn functions_at_53_bits_are_close_to_those_of_the_machine(a in 0.0..100.0) {
            for (x, y) in functions(&float(a)).iter().zip(functions(&a)) {
                prop_assert!((x.to_f64() - y).abs() <= 2.0 * f64::EPSILON * y.abs());
            }
        }

        #[test]
        fn rational_is_rounded_once(n: i128, d in 1..i128::MAX) {
            let value = Rational::new(n.into(), d.into());
            let x = Float::from_rational(&value, &Precision::bits(53).unwrap());
            prop_assert_eq!(x.to_f64(), f64::from_rational(&value, &()));
        }

        #[test]
        fn text_reads_back(n: i128, exponent in -2000i32..2000, bits in 1u32..500) {
            let x = Float::with_val(bits, n) << exponent;
            let read = Float::with_val(bits, Float::parse(x.to_text()).unwrap());
            prop_assert_eq!(read, x);
        }

        #[test]
        fn short_text_survives(digits: i64, exponent in -300i32..300) {
            let precision = Precision::digits(20).unwrap();
            let value = integer(digits.into()) * integer(10).pow(exponent);
            let x = Float::from_rational(&value, &precision);
            let significant = |text: &str| {
                let digits = text.split('e').next().unwrap().replace(['.', '-'], "");
                digits.trim_matches('0').to_owned()
            };
            prop_assert_eq!(significant(&x.to_text()), significant(&digits.to_string()));
        }

        #[test]
        fn text_is_as_short_as_that_of_the_machine(bits: u64) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_normal());
            let text = float(x).to_text();
            prop_assert_eq!(text.parse(), Ok(x));
            prop_assert_eq!(text.len(), x.to_text().len());
        }

        #[test]
        fn text_of_usual_size_is_that_of_the_machine(n in 0i64..1_000_000, exponent in -9i32..18) {
            let x: f64 = format!("{n}e{exponent}").parse().unwrap();
            prop_assert_eq!(float(x).to_text(), x.to_text());
        }
    }

    #[test]
    fn reciprocal_sqrt_is_rounded_once() {
        for n in 512..1024 {
            let [mut few_bits, mut many_bits] = [Float::new(10), Float::new(200)];
            few_bits.assign_reciprocal_sqrt(&Float::with_val(10, n));
            many_bits.assign_reciprocal_sqrt(&Float::with_val(10, n));
            assert_eq!(few_bits, Float::with_val(10, many_bits), "1/√{n}");
        }
    }

    #[test]
    fn functions_of_many_digits() {
        let precision = Precision::digits(40).unwrap();
        let third = Float::from_rational(&Rational::new(1.into(), 3.into()), &precision);
        assert_eq!(third.context(), precision);
        let mut sixty_degrees = Float::zero(&precision);
        sixty_degrees.assign_product(&Float::with_val(200, rug::float::Constant::Pi), &third);
        let mut error = functions(&sixty_degrees)[3].clone();
        error.subtract(&Float::with_val(2, 0.5));
        assert!(error.log10_abs() < -40.0, "cos 60° − 1/2 = {error}");
    }

    #[test]
    fn sizes_beyond_an_f64() {
        let precision = Precision::digits(30).unwrap();
        for exponent in [-400, -5, 0, 7, 400] {
            let mut x = Float::from_rational(&integer(10).pow(exponent), &precision);
            x.negate();
            assert!((x.log10_abs() - f64::from(exponent)).abs() < 1e-13);
        }
        assert_eq!(Float::zero(&precision).log10_abs(), f64::NEG_INFINITY);
    }

    #[test]
    fn signs_and_what_is_no_number() {
        assert!(float(-2.5).is_below_zero());
        for x in [-0.0, 0.0, 1.0, f64::NAN] {
            assert!(!float(x).is_below_zero());
        }
        assert!(Number::is_finite(&float(1.0)));
        let mut x = float(1.0);
        x.divide_integer(0);
        assert!(!Number::is_finite(&x));
        assert_eq!(x.to_text(), "inf");
    }

    #[test]
    fn squares_are_finite_up_to_half_of_the_exponents() {
        let mut x = float(-3.0);
        assert!(x.has_finite_square() && float(0.0).has_finite_square());
        x <<= rug::float::exp_max() / 2;
        assert!(Number::is_finite(&x) && !x.has_finite_square());
        let same = x.clone();
        x.multiply(&same);
        assert!(!Number::is_finite(&x) && !x.has_finite_square());
    }
}
