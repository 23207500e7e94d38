//! Numbers of limbs as a [`Number`]: [`Limbs`], whose number of limbs is part of the type, and [`AnyLimbs`], for which
//! it is chosen at run time.
//!
//! All functions are `inline`, so that only the crates that use these numbers compile them: most programs compute in
//! `f64`.

use super::{BLOCK, LimbAccess, Number, Parts, Real};
use crate::Rational;
use num_traits::{Signed, Zero};
use shadowstep_limbs::{AnyLimbs, LimbCount, Limbs};
use std::f64::consts::LOG10_2;

/// How a number of limbs is made.
trait Nearest: Number {
    /// The number nearest to ± Σ magnitude\[i\] 2^(64 i + exponent), where `more` stands for some part of a unit of
    /// that sum.
    fn nearest(negative: bool, magnitude: &[u64], exponent: i64, more: bool, context: &Self::Context) -> Self;

    /// The same number as an `f64`.
    fn exact(x: f64, context: &Self::Context) -> Self;
}

impl<const L: usize> Nearest for Limbs<L> {
    fn nearest(negative: bool, magnitude: &[u64], exponent: i64, more: bool, (): &()) -> Self {
        Limbs::from_magnitude(negative, magnitude, exponent, more)
    }

    fn exact(x: f64, (): &()) -> Self {
        Limbs::from(x)
    }
}

impl Nearest for AnyLimbs {
    #[inline]
    fn nearest(negative: bool, magnitude: &[u64], exponent: i64, more: bool, count: &LimbCount) -> Self {
        AnyLimbs::from_magnitude(negative, magnitude, exponent, more, *count)
    }

    #[inline]
    fn exact(x: f64, count: &LimbCount) -> Self {
        AnyLimbs::from_f64(x, *count)
    }
}

/// Implements [`Number`] and [`Real`], with what is different for a type.
///
/// Sums, products, quotients, square roots and their reciprocals are correctly rounded, a b + c with two roundings, and
/// elementary functions err by little more than half an ulp.
macro_rules! number_of_limbs {
    ([$($L:tt)*] $Limbs:ty { $($own:item)* }) => {
        impl<$($L)*> Number for $Limbs {
            type Register<'a> = &'a mut Self;
            type Block = [Self; BLOCK];
            type InLanes = Self;

            $($own)*

            const LIMBS: Option<LimbAccess<Self>> = Some(LimbAccess {
                limbs: |x| x.mantissa().len(),
                parts: |x| match x.exponent() {
                    Some(exponent) => Parts::Regular {
                        negative: x.is_sign_negative(),
                        exponent: exponent.into(),
                        significand: x.mantissa(),
                    },
                    None if x.is_zero() => Parts::Zero,
                    None => Parts::NotFinite,
                },
                assign: |x, negative, magnitude, exponent| {
                    *x = Nearest::nearest(negative, magnitude, exponent, false, &x.context());
                },
                assign_nan: |x| x.set_nan(),
            });

            crate::number::without_derivatives!();

            #[inline]
            fn register(&mut self) -> &mut Self {
                self
            }

            #[inline]
            fn from_rational(value: &Rational, context: &Self::Context) -> Self {
                let bits = 64 * <$Limbs as Number>::zero(context).mantissa().len() as u32;
                let (quotient, exponent, is_exact) = quotient(value, bits);
                Self::nearest(value.is_negative(), &quotient, exponent, !is_exact, context)
            }

            #[inline]
            fn assign_zero(&mut self) {
                self.set_zero();
            }

            #[inline]
            fn assign(&mut self, a: &Self) {
                *self = *a;
            }

            #[inline]
            fn assign_sum(&mut self, a: &Self, b: &Self) {
                self.set_sum(a, b);
            }

            #[inline]
            fn assign_difference(&mut self, a: &Self, b: &Self) {
                self.set_difference(a, b);
            }

            #[inline]
            fn assign_product(&mut self, a: &Self, b: &Self) {
                self.set_product(a, b);
            }

            #[inline]
            fn assign_quotient(&mut self, a: &Self, b: &Self) {
                self.set_quotient(a, b);
            }

            #[inline]
            fn assign_square(&mut self, a: &Self) {
                self.set_square(a);
            }

            #[inline]
            fn assign_sqrt(&mut self, a: &Self) {
                *self = a.sqrt();
            }

            #[inline]
            fn assign_reciprocal_sqrt(&mut self, a: &Self) {
                *self = a.reciprocal_sqrt();
            }

            #[inline]
            fn assign_root(&mut self, a: &Self, n: u32) {
                *self = a.root(n);
            }

            #[inline]
            fn assign_exp(&mut self, a: &Self) {
                *self = a.exp();
            }

            #[inline]
            fn assign_sin(&mut self, a: &Self) {
                *self = a.sin();
            }

            #[inline]
            fn assign_cos(&mut self, a: &Self) {
                *self = a.cos();
            }

            #[inline]
            fn assign_log(&mut self, a: &Self) {
                *self = a.log();
            }

            #[inline]
            fn assign_tan(&mut self, a: &Self) {
                *self = a.tan();
            }

            #[inline]
            fn assign_sinh(&mut self, a: &Self) {
                *self = a.sinh();
            }

            #[inline]
            fn assign_cosh(&mut self, a: &Self) {
                *self = a.cosh();
            }

            #[inline]
            fn assign_tanh(&mut self, a: &Self) {
                *self = a.tanh();
            }

            #[inline]
            fn assign_atan(&mut self, a: &Self) {
                *self = a.atan();
            }

            #[inline]
            fn assign_asin(&mut self, a: &Self) {
                *self = a.asin();
            }

            #[inline]
            fn assign_acos(&mut self, a: &Self) {
                *self = a.acos();
            }

            #[inline]
            fn assign_sin_cos(sin: &mut Self, cos: &mut Self, a: &Self) {
                (*sin, *cos) = a.sin_cos();
            }

            #[inline]
            fn add(&mut self, a: &Self) {
                *self += a;
            }

            #[inline]
            fn subtract(&mut self, a: &Self) {
                *self -= a;
            }

            #[inline]
            fn multiply(&mut self, a: &Self) {
                *self *= a;
            }

            #[inline]
            fn divide(&mut self, a: &Self) {
                *self /= a;
            }

            #[inline]
            fn add_product(&mut self, a: &Self, b: &Self) {
                <$Limbs>::add_product(self, a, b);
            }

            #[inline]
            fn subtract_product(&mut self, a: &Self, b: &Self) {
                <$Limbs>::subtract_product(self, a, b);
            }

            #[inline]
            fn multiply_integer(&mut self, n: i32) {
                *self = self.times_integer(n);
            }

            #[inline]
            fn divide_integer(&mut self, n: i32) {
                *self = self.over_integer(n);
            }

            #[inline]
            fn negate(&mut self) {
                *self = -*self;
            }

            #[inline]
            fn make_absolute(&mut self) {
                *self = self.abs();
            }

            #[inline]
            fn make_at_least(&mut self, a: &Self) {
                if *self < *a {
                    *self = *a;
                }
            }

            #[inline]
            fn make_at_most(&mut self, a: &Self) {
                if *self > *a {
                    *self = *a;
                }
            }

            #[inline]
            fn make_nan_where_square_overflows(&mut self, a: &Self) {
                if <$Limbs>::is_finite(self) && !a.has_finite_square() {
                    self.set_nan();
                }
            }

            #[inline]
            fn lane(&self, _: usize) -> (f64, i64) {
                let (significand, exponent) = self.to_f64_exponent();
                (significand, exponent.into())
            }

            #[inline]
            fn set_lane(&mut self, _: usize, m: f64, n: i64) {
                let n = n.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
                *self = <$Limbs as Nearest>::exact(m, &self.context()).times_power_of_two(n);
            }

            #[inline]
            fn assign_lane(&mut self, _: usize, a: &Self) {
                *self = *a;
            }

            #[inline]
            fn is_finite(&self) -> bool {
                <$Limbs>::is_finite(self)
            }
        }

        impl<$($L)*> Real for $Limbs {
            #[inline]
            fn is_below_zero(&self) -> bool {
                <$Limbs>::is_below_zero(self)
            }

            #[inline]
            fn has_finite_square(&self) -> bool {
                <$Limbs>::has_finite_square(self)
            }

            #[inline]
            fn to_f64(&self) -> f64 {
                <$Limbs>::to_f64(self)
            }

            #[inline]
            fn log10_abs(&self) -> f64 {
                let (significand, exponent) = self.to_f64_exponent();
                significand.abs().log10() + f64::from(exponent) * LOG10_2
            }

            #[inline]
            fn to_text(&self) -> String {
                <$Limbs>::to_text(self)
            }
        }
    };
}

number_of_limbs! { [const L: usize] Limbs<L> {
    type Context = ();

    #[inline]
    fn zero((): &()) -> Limbs<L> {
        Limbs::ZERO
    }

    #[inline]
    fn context(&self) {}
} }

number_of_limbs! { [] AnyLimbs {
    type Context = LimbCount;

    #[inline]
    fn zero(count: &LimbCount) -> AnyLimbs {
        AnyLimbs::zero(*count)
    }

    #[inline]
    fn context(&self) -> LimbCount {
        self.count()
    }
} }

/// |value| as an integer of more than this number of bits, rounded down, times a power of 2, and whether it is exact.
fn quotient(value: &Rational, bits: u32) -> (Vec<u64>, i64, bool) {
    let (n, d) = (value.numer().magnitude(), value.denom().magnitude());
    let shift = (u64::from(bits) + 2 + d.bits()).saturating_sub(n.bits());
    let dividend = n << shift;
    let quotient = &dividend / d;
    let is_exact = (dividend - &quotient * d).is_zero();
    (quotient.to_u64_digits(), -(shift as i64), is_exact)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{functions, operations, products};
    use super::{AnyLimbs, LimbCount, Limbs, Number, Real};
    use crate::Rational;
    use num_bigint::BigInt;

    fn rational(n: i128, d: i128) -> Rational {
        Rational::new(n.into(), d.into())
    }

    #[test]
    fn signs_sizes_and_what_is_not_a_number() {
        assert!(Limbs::<2>::from(-2.5).is_below_zero());
        for x in [-0.0, 0.0, 1.0, f64::NAN] {
            assert!(!Limbs::<2>::from(x).is_below_zero());
        }
        let mut x = Limbs::<2>::ONE;
        x.divide_integer(0);
        assert!(!Number::is_finite(&x));
        assert_eq!(Real::to_text(&x), "inf");
        for exponent in [-400, -5, 0, 7, 400] {
            let x = Limbs::<2>::from_rational(&-Rational::from(BigInt::from(10)).pow(exponent), &());
            assert!((x.log10_abs() - f64::from(exponent)).abs() < 1e-13);
        }
        assert_eq!(Limbs::<2>::ZERO.log10_abs(), f64::NEG_INFINITY);
    }

    #[test]
    fn squares_are_finite_up_to_half_of_the_exponents() {
        let mut x = Limbs::<3>::from(-3.0);
        assert!(x.has_finite_square() && Limbs::<3>::ZERO.has_finite_square());
        x = x.times_power_of_two(1 << 29);
        assert!(Number::is_finite(&x) && !x.has_finite_square());
        let mut one = Limbs::ONE;
        one.make_nan_where_square_overflows(&x);
        assert!(one.is_nan());
        x = x.square();
        assert!(!Number::is_finite(&x) && !x.has_finite_square());
    }

    fn bits_are_those_of_limbs<const L: usize>() {
        let numbers = ["17/3", "-1/7", "100/7"].map(|text| crate::exact(text).unwrap());
        let [a, b, c] = numbers.each_ref().map(|value| Limbs::<L>::from_rational(value, &()));
        let of_any =
            numbers.each_ref().map(|value| AnyLimbs::from_rational(value, &LimbCount::of_bits(64 * L as u32).unwrap()));
        let [x, y, z] = &of_any;
        let same = |found: &[AnyLimbs], expected: &[Limbs<L>]| {
            let text = |x: &dyn std::fmt::Debug| format!("{x:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert_eq!((text(found), Real::to_text(found)), (text(expected), Real::to_text(expected)));
            }
        };
        same(&of_any, &[a, b, c]);
        same(&operations(x, y, z), &operations(&a, &b, &c));
        same(&products(x, y, z), &products(&a, &b, &c));
        same(&functions(x), &functions(&a));
    }

    #[test]
    fn bits_are_those_of_so_many_limbs() {
        bits_are_those_of_limbs::<2>();
        bits_are_those_of_limbs::<7>();
        bits_are_those_of_limbs::<11>();
        bits_are_those_of_limbs::<16>();
    }

    #[cfg(feature = "mpfr")]
    mod beside_mpfr {
        use super::*;
        use proptest::prelude::*;
        use rug::integer::Order;
        use rug::{Float, Integer};

        const BITS: u32 = 64 * 7;

        fn float(x: &Limbs<7>) -> Float {
            let magnitude = Float::with_val(BITS, Integer::from_digits(x.mantissa(), Order::Lsf)) >> BITS;
            let magnitude = magnitude << x.exponent().unwrap_or(0);
            if x.is_sign_negative() { -magnitude } else { magnitude }
        }

        proptest! {
            #[test]
            fn operations_have_the_same_bits(a in 1e-60..1e60, b in -1e3..1e3, c in -1e-3..1e60) {
                // thirds have all bits
                let [a, b, c] = [a, b, c].map(|x| Limbs::<7>::from(x).over_integer(3));
                let [x, y, z] = [a, b, c].map(|x| float(&x));
                prop_assert_eq!(operations(&a, &b, &c).map(|x| float(&x)), operations(&x, &y, &z));
                let product = Float::with_val(BITS, &x * &y);
                let expected = [Float::with_val(BITS, &z + &product), Float::with_val(BITS, &z - &product)];
                prop_assert_eq!(products(&a, &b, &c).map(|x| float(&x)), expected);
            }

            #[test]
            fn functions_differ_by_at_most_the_last_bit(a in 0.0..100.0) {
                let a = Limbs::<7>::from(a).over_integer(3);
                for (own, expected) in functions(&a).iter().zip(functions(&float(&a))) {
                    let own = float(own);
                    let difference = Float::with_val(BITS, &own - &expected).abs();
                    prop_assert!(own.is_nan() && expected.is_nan() || difference <= expected.abs() >> (BITS as i32 - 1));
                }
            }

            #[test]
            fn rational_is_rounded_once(n: i128, d in 1..i128::MAX, exponent in -2000i32..2000) {
                let value = rational(n, d) * Rational::from(BigInt::from(2)).pow(exponent);
                let [own, expected] = [
                    float(&Limbs::from_rational(&value, &())),
                    Float::from_rational(&value, &crate::number::Precision::bits(BITS).unwrap()),
                ];
                prop_assert_eq!(own, expected);
            }
        }
    }

    #[test]
    fn rational_ties_go_to_even() {
        let two_128 = Rational::from(BigInt::from(2)).pow(128);
        for (above, even) in [(1, 0), (3, 4), (-1, 0)] {
            let tie = &two_128 + rational(above, if above < 0 { 2 } else { 1 });
            let expected = &two_128 + rational(even, 1);
            assert_eq!(Limbs::<2>::from_rational(&tie, &()), Limbs::from_rational(&expected, &()));
            let nudged = tie * (rational(1, 1) + rational(1, 1 << 100).pow(2));
            assert!(Limbs::<2>::from_rational(&nudged, &()) >= Limbs::from_rational(&expected, &()));
        }
    }
}
