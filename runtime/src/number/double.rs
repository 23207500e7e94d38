//! `f64` as a [`Number`].

use std::ops::{Deref, DerefMut};

use super::scaled::scaled;
use super::{BLOCK, LaneAccess, Lanes, Number, Real};
use crate::Rational;
use num_traits::ToPrimitive;

/// A number of its own.
#[derive(Debug)]
pub struct Copied<N>(pub(super) N);

impl<N> Deref for Copied<N> {
    type Target = N;

    #[inline]
    fn deref(&self) -> &N {
        &self.0
    }
}

impl<N> DerefMut for Copied<N> {
    #[inline]
    fn deref_mut(&mut self) -> &mut N {
        &mut self.0
    }
}

/// 3 (2x)² is below the largest `f64`, 1.797e308.
pub(super) const LARGEST_SQUARED: f64 = 3.8e153;

impl Number for f64 {
    type Context = ();
    type Block = [Self; BLOCK];
    const KEEPS_INCREMENTS: bool = true;
    const IN_VECTORS: bool = true;
    const LANE_ACCESS: Option<LaneAccess<f64, Lanes<8>>> =
        Some(LaneAccess { set: |lanes, lane, x| lanes.0[lane] = *x, number: |lanes, lane| lanes.0[lane] });
    type InLanes = Lanes<8>;
    type Register<'a> = Copied<f64>;

    crate::number::without_derivatives!();

    #[inline]
    fn register(&mut self) -> Copied<f64> {
        Copied(*self)
    }

    fn zero((): &()) -> f64 {
        0.0
    }

    fn from_rational(value: &Rational, (): &()) -> f64 {
        value.to_f64().expect("every rational has a nearest f64")
    }

    fn context(&self) {}

    fn assign_zero(&mut self) {
        *self = 0.0;
    }

    fn assign(&mut self, a: &f64) {
        *self = *a;
    }

    fn assign_sum(&mut self, a: &f64, b: &f64) {
        *self = a + b;
    }

    fn assign_difference(&mut self, a: &f64, b: &f64) {
        *self = a - b;
    }

    fn assign_product(&mut self, a: &f64, b: &f64) {
        *self = a * b;
    }

    fn assign_quotient(&mut self, a: &f64, b: &f64) {
        *self = a / b;
    }

    fn assign_sqrt(&mut self, a: &f64) {
        *self = a.sqrt();
    }

    fn assign_reciprocal_sqrt(&mut self, a: &f64) {
        *self = a.sqrt().recip();
    }

    fn assign_exp(&mut self, a: &f64) {
        *self = a.exp();
    }

    fn assign_sin(&mut self, a: &f64) {
        *self = a.sin();
    }

    fn assign_cos(&mut self, a: &f64) {
        *self = a.cos();
    }

    fn assign_root(&mut self, a: &f64, n: u32) {
        let root = match n {
            1 => a.abs(),
            2 => a.abs().sqrt(),
            3 => a.abs().cbrt(),
            _ => a.abs().powf(1.0 / f64::from(n)),
        };
        *self = if *a < 0.0 && n.is_multiple_of(2) { f64::NAN } else { root.copysign(*a) };
    }

    fn assign_log(&mut self, a: &f64) {
        *self = a.ln();
    }

    fn assign_tan(&mut self, a: &f64) {
        *self = a.tan();
    }

    fn assign_sinh(&mut self, a: &f64) {
        *self = a.sinh();
    }

    fn assign_cosh(&mut self, a: &f64) {
        *self = a.cosh();
    }

    fn assign_tanh(&mut self, a: &f64) {
        *self = a.tanh();
    }

    fn assign_atan(&mut self, a: &f64) {
        *self = a.atan();
    }

    fn assign_asin(&mut self, a: &f64) {
        *self = a.asin();
    }

    fn assign_acos(&mut self, a: &f64) {
        *self = a.acos();
    }

    fn add(&mut self, a: &f64) {
        *self += a;
    }

    fn subtract(&mut self, a: &f64) {
        *self -= a;
    }

    fn multiply(&mut self, a: &f64) {
        *self *= a;
    }

    fn divide(&mut self, a: &f64) {
        *self /= a;
    }

    fn add_product(&mut self, a: &f64, b: &f64) {
        *self += a * b;
    }

    fn subtract_product(&mut self, a: &f64, b: &f64) {
        *self -= a * b;
    }

    fn multiply_integer(&mut self, n: i32) {
        *self *= f64::from(n);
    }

    fn divide_integer(&mut self, n: i32) {
        *self /= f64::from(n);
    }

    fn negate(&mut self) {
        *self = -*self;
    }

    fn make_absolute(&mut self) {
        *self = self.abs();
    }

    fn make_at_least(&mut self, a: &f64) {
        *self = if *self < *a { *a } else { *self };
    }

    fn make_at_most(&mut self, a: &f64) {
        *self = if *self > *a { *a } else { *self };
    }

    fn make_nan_where_square_overflows(&mut self, a: &f64) {
        if self.is_finite() && !a.has_finite_square() {
            *self = f64::NAN;
        }
    }

    #[inline(always)]
    fn lane(&self, _: usize) -> (f64, i64) {
        (*self, 0)
    }

    #[inline(always)]
    fn set_lane(&mut self, _: usize, m: f64, n: i64) {
        *self = scaled(m, n);
    }

    #[inline(always)]
    fn assign_lane(&mut self, _: usize, a: &Self) {
        *self = *a;
    }

    fn is_finite(&self) -> bool {
        f64::is_finite(*self)
    }
}

impl Real for f64 {
    fn is_below_zero(&self) -> bool {
        *self < 0.0
    }

    fn has_finite_square(&self) -> bool {
        self.abs() <= LARGEST_SQUARED
    }

    fn to_f64(&self) -> f64 {
        *self
    }

    fn log10_abs(&self) -> f64 {
        self.abs().log10()
    }

    fn to_text(&self) -> String {
        format!("{self:?}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::{Number, Real};
    use crate::Rational;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    fn from_rational(value: &Rational) -> f64 {
        f64::from_rational(value, &())
    }

    fn integer(n: i128) -> Rational {
        BigInt::from(n).into()
    }

    /// n 2^exponent
    fn dyadic(n: i128, exponent: i32) -> Rational {
        integer(n) * integer(2).pow(exponent)
    }

    #[test]
    fn operations_are_those_of_the_machine() {
        let [a, b, c]: [f64; 3] = [0.1, -7.3, 1e-3];
        #[rustfmt::skip]
        let expected = [
            0.0, a, a + b, a - b, a * b, a / b, a * a, a.sqrt(),
            c + a, c - a, c * a, c / a, c * -3.0, c / -3.0, -c, c.abs(), a.max(c), a.min(c), c,
        ];
        assert_eq!(operations(&a, &b, &c), expected);
        assert_eq!(products(&a, &b, &c), [c + a * b, c - a * b]);
        let ((sin, cos), b) = (a.sin_cos(), a / 100.0);
        #[rustfmt::skip]
        let expected = [
            1.0 / a.sqrt(), a.exp(), sin, cos, a.ln(), b.tan(), b.sinh(), b.cosh(), b.tanh(), a.atan(), b.asin(),
            b.acos(), a.cbrt(), a.powf(1.0 / 7.0), sin, cos,
        ];
        assert_eq!(functions(&a), expected);
        let mut root = 0.0;
        root.assign_root(&-8.0, 3);
        assert_eq!(root, -2.0);
        root.assign_root(&-8.0, 2);
        assert!(root.is_nan());
    }

    #[test]
    fn products_round_twice() {
        // a² = 1 + 2ε + ε², and rounded 1 + 2ε
        let a = 1.0 + f64::EPSILON;
        assert_eq!(products(&a, &a, &(a * a))[1], 0.0);
    }

    #[test]
    fn rational_ties_go_to_even() {
        let two_53 = 1 << 53;
        for (tie, even) in [
            (dyadic(two_53 + 1, 0), two_53 as f64),
            (dyadic(two_53 + 3, 0), (two_53 + 4) as f64),
            (dyadic(2 * two_53 - 1, 0), 2.0 * two_53 as f64), // carries
            (dyadic(1, -1075), 0.0),
            (dyadic(3, -1075), f64::from_bits(2)),
            (dyadic(5, -1075), f64::from_bits(2)),
            (dyadic(two_53 - 1, -1075), f64::MIN_POSITIVE),
            (dyadic(2 * two_53 - 1, 970), f64::INFINITY),
        ] {
            assert_eq!(from_rational(&tie), even);
            assert_eq!(from_rational(&-&tie), -even);
            let nudge = &tie * dyadic(1, -1200);
            let [below, above] = [&tie - &nudge, &tie + &nudge].map(|x| from_rational(&x));
            assert_eq!(below.next_up(), above, "{tie}");
        }
    }

    #[test]
    fn rational_out_of_range() {
        assert_eq!(from_rational(&dyadic(-1, 1024)), f64::NEG_INFINITY);
        assert_eq!(from_rational(&dyadic(3, 100_000)), f64::INFINITY);
        assert_eq!(from_rational(&(dyadic(1, 1025) / integer(3))), 4.0 / 3.0 * 2f64.powi(1023));
        assert_eq!(from_rational(&dyadic(3, -1078)), 0.0);
        assert_eq!(from_rational(&dyadic(3, -100_000)), 0.0);
        assert_eq!(from_rational(&integer(0)), 0.0);
    }

    proptest! {
        // Rust's parser rounds decimal text correctly.
        #[test]
        fn rational_agrees_with_decimal_text(digits: i128, exponent in -380i32..300) {
            let expected: f64 = format!("{digits}e{exponent}").parse().unwrap();
            let value = integer(digits) * integer(10).pow(exponent);
            prop_assert_eq!(from_rational(&value), expected);
        }

        #[test]
        fn rational_between_two_neighbours(bits in 0..f64::MAX.to_bits(), third: bool) {
            let [low, high] = [f64::from_bits(bits), f64::from_bits(bits + 1)];
            let [a, b] = [low, high].map(|x| Rational::from_float(x).unwrap());
            prop_assert_eq!(from_rational(&a), low);
            let (between, expected) = if third {
                ((a * integer(2) + b) / integer(3), low)
            } else {
                ((a + b) / integer(2), if bits % 2 == 0 { low } else { high })
            };
            prop_assert_eq!(from_rational(&between), expected);
        }

        #[test]
        fn text_reads_back(bits: u64) {
            let x = f64::from_bits(bits);
            let read: f64 = x.to_text().parse().unwrap();
            prop_assert!(read.to_bits() == bits || read.is_nan() && x.is_nan());
        }
    }

    #[test]
    fn text_is_short() {
        for (x, text) in [
            (0.1, "0.1"),
            (-0.0, "-0.0"),
            (2.0, "2.0"),
            (-1.25e-30, "-1.25e-30"),
            (1e300, "1e300"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(x.to_text(), text);
        }
    }

    #[test]
    fn powers_of_two_scale() {
        for (x, n, expected) in [
            (1.0, -1074, f64::from_bits(1)),
            (-1.5, 1023, -1.5 * 2_f64.powi(1023)),
            (f64::from_bits(1), 2097, 2_f64.powi(1023)),
            (f64::MAX, -2097, f64::from_bits(2)),
            (3.0, 1 << 40, f64::INFINITY),
            (-3.0, -1 << 40, -0.0),
            (0.0, 1 << 40, 0.0),
            (f64::INFINITY, -1 << 40, f64::INFINITY),
            (0.1, 0, 0.1),
        ] {
            assert_eq!(super::scaled(x, n).to_bits(), expected.to_bits(), "{x} · 2^{n}");
        }
    }

    #[test]
    fn signs_and_sizes() {
        for (x, below) in [(-2.5, true), (-0.0, false), (1.0, false), (f64::NAN, false)] {
            assert_eq!(x.is_below_zero(), below);
        }
        for (x, finite) in [(1e300, true), (f64::NAN, false), (f64::NEG_INFINITY, false)] {
            assert_eq!(Number::is_finite(&x), finite);
        }
        for (x, finite) in [(-3.8e153, true), (3.9e153, false), (1e300, false), (f64::NAN, false), (-0.0, true)] {
            assert_eq!(x.has_finite_square(), finite);
        }
        for (x, a, [least, most, checked]) in [
            (1.0, 2.0, [2.0, 1.0, 1.0]),
            (2.0, -3.0, [2.0, -3.0, 2.0]),
            (2.0, f64::NAN, [2.0, 2.0, f64::NAN]),
            (f64::NAN, 2.0, [f64::NAN; 3]),
            (0.0, 3.9e153, [3.9e153, 0.0, f64::NAN]),
            (f64::INFINITY, -3.9e153, [f64::INFINITY, -3.9e153, f64::INFINITY]),
        ] {
            let found: [f64; 3] = std::array::from_fn(|i| operations(&a, &a, &x)[16 + i]);
            assert_eq!(found.map(f64::to_bits), [least, most, checked].map(f64::to_bits), "{x}, {a}");
        }
        assert_eq!((-0.001).log10_abs(), -3.0);
        assert_eq!(0.0.log10_abs(), f64::NEG_INFINITY);
    }
}
