//! Exact rationals.
//!
//! Comparisons, hashes and the search for common divisors are not taken from `num_rational`: the first two recurse
//! along continued fractions, for long numbers beyond the end of the stack, and the last takes a pass over the numbers
//! for every bit.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::iter::{Product, Sum};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign};
use std::str::FromStr;

use num_bigint::BigInt;
use num_rational::{BigRational, ParseRatioError};
use num_traits::{FromPrimitive, Num, One, Signed, ToPrimitive, Zero};

use crate::symbolic::number::divisor::common_divisor;
use crate::symbolic::number::ratio::{Ratio, compare};

/// A rational number numerator/denominator in lowest terms, with a positive denominator.
///
/// ```
/// use shadowstep_schemes::symbolic::Rational;
///
/// let third = Rational::new(2.into(), 6.into());
/// assert_eq!(third.to_string(), "1/3");
/// assert_eq!(&third + &third, "2/3".parse()?);
/// assert!(third < Rational::from_integer(1.into()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Rational(BigRational);

impl Rational {
    /// numerator/denominator
    ///
    /// # Panics
    /// If the denominator is 0.
    pub fn new(numerator: BigInt, denominator: BigInt) -> Self {
        assert!(!denominator.is_zero(), "the denominator must not be 0");
        let divisor = common_divisor(&numerator, &denominator);
        let (numerator, denominator) = (divided(numerator, &divisor), divided(denominator, &divisor));
        match denominator.is_negative() {
            true => Rational::new_raw(-numerator, -denominator),
            false => Rational::new_raw(numerator, denominator),
        }
    }

    /// numerator/denominator without a search for common divisors; there must be none, and the denominator must be
    /// positive.
    pub(crate) fn new_raw(numerator: BigInt, denominator: BigInt) -> Self {
        Rational(BigRational::new_raw(numerator, denominator))
    }

    /// An integer.
    pub fn from_integer(integer: BigInt) -> Self {
        Rational(BigRational::from_integer(integer))
    }

    /// A floating-point number, exactly; `None` if it is infinite or not a number.
    pub fn from_float(number: f64) -> Option<Self> {
        BigRational::from_float(number).map(Rational)
    }

    /// The numerator in lowest terms.
    pub fn numer(&self) -> &BigInt {
        self.0.numer()
    }

    /// The denominator in lowest terms, positive.
    pub fn denom(&self) -> &BigInt {
        self.0.denom()
    }

    /// Numerator and denominator.
    pub(crate) fn into_parts(self) -> (BigInt, BigInt) {
        self.0.into_raw()
    }

    /// Whether the denominator is 1.
    pub fn is_integer(&self) -> bool {
        self.0.is_integer()
    }

    /// The integer next to it towards 0.
    pub fn to_integer(&self) -> BigInt {
        self.0.to_integer()
    }

    /// The largest integer that is not greater.
    pub fn floor(&self) -> Self {
        Rational(self.0.floor())
    }

    /// 1/x
    ///
    /// # Panics
    /// If x is 0.
    pub fn recip(&self) -> Self {
        Rational(self.0.recip())
    }

    /// x^exponent
    ///
    /// # Panics
    /// If x is 0 and the exponent negative.
    pub fn pow(&self, exponent: i32) -> Self {
        Rational(self.0.pow(exponent))
    }
}

// ---- equality, order and hash: by the parts ----

impl PartialEq for Rational {
    fn eq(&self, other: &Self) -> bool {
        self.numer() == other.numer() && self.denom() == other.denom()
    }
}

impl Eq for Rational {}

impl Hash for Rational {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.numer().hash(state);
        self.denom().hash(state);
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        compare(self, other)
    }
}

impl Ratio for Rational {
    fn numer(&self) -> &BigInt {
        self.0.numer()
    }

    fn denom(&self) -> &BigInt {
        self.0.denom()
    }
}

// ---- arithmetic ----

/// number/divisor, which is an integer
fn divided(number: BigInt, divisor: &BigInt) -> BigInt {
    if divisor.is_one() { number } else { number / divisor }
}

/// a + b, with the least divisors searched for (Knuth, The Art of Computer Programming 2, 4.5.1)
fn sum(a: &Rational, b: &Rational) -> Rational {
    if a.is_zero() || b.is_zero() {
        return if a.is_zero() { b.clone() } else { a.clone() };
    }
    let divisor = common_divisor(a.denom(), b.denom());
    if divisor.is_one() {
        return Rational::new_raw(a.numer() * b.denom() + b.numer() * a.denom(), a.denom() * b.denom());
    }
    let [of_a, of_b] = [a, b].map(|number| number.denom() / &divisor);
    let numerator = a.numer() * &of_b + b.numer() * &of_a;
    let common = common_divisor(&numerator, &divisor);
    Rational::new_raw(divided(numerator, &common), of_a * divided(b.denom().clone(), &common))
}

fn difference(a: &Rational, b: &Rational) -> Rational {
    sum(a, &-b)
}

fn product(a: &Rational, b: &Rational) -> Rational {
    if a.is_zero() || b.is_zero() {
        return Rational::zero();
    }
    let (one, other) = (common_divisor(a.numer(), b.denom()), common_divisor(b.numer(), a.denom()));
    let part = |number: &BigInt, divisor: &BigInt| divided(number.clone(), divisor);
    Rational::new_raw(part(a.numer(), &one) * part(b.numer(), &other), part(a.denom(), &other) * part(b.denom(), &one))
}

fn quotient(a: &Rational, b: &Rational) -> Rational {
    product(a, &b.recip())
}

fn remainder(a: &Rational, b: &Rational) -> Rational {
    Rational(&a.0 % &b.0)
}

macro_rules! operators {
    ($($operator:ident, $method:ident, $assigning:ident, $assign:ident, $computed:ident;)*) => { $(
        impl $operator for Rational {
            type Output = Rational;
            fn $method(self, other: Rational) -> Rational {
                $computed(&self, &other)
            }
        }

        impl $operator<&Rational> for Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                $computed(&self, other)
            }
        }

        impl $operator<Rational> for &Rational {
            type Output = Rational;
            fn $method(self, other: Rational) -> Rational {
                $computed(self, &other)
            }
        }

        impl $operator<&Rational> for &Rational {
            type Output = Rational;
            fn $method(self, other: &Rational) -> Rational {
                $computed(self, other)
            }
        }

        impl $operator<BigInt> for Rational {
            type Output = Rational;
            fn $method(self, other: BigInt) -> Rational {
                $computed(&self, &Rational::from_integer(other))
            }
        }

        impl $operator<BigInt> for &Rational {
            type Output = Rational;
            fn $method(self, other: BigInt) -> Rational {
                $computed(self, &Rational::from_integer(other))
            }
        }

        impl $assigning for Rational {
            fn $assign(&mut self, other: Rational) {
                *self = $computed(self, &other);
            }
        }

        impl $assigning<&Rational> for Rational {
            fn $assign(&mut self, other: &Rational) {
                *self = $computed(self, other);
            }
        }

        impl $assigning<BigInt> for Rational {
            fn $assign(&mut self, other: BigInt) {
                *self = $computed(self, &Rational::from_integer(other));
            }
        }
    )* };
}

operators! {
    Add, add, AddAssign, add_assign, sum;
    Sub, sub, SubAssign, sub_assign, difference;
    Mul, mul, MulAssign, mul_assign, product;
    Div, div, DivAssign, div_assign, quotient;
    Rem, rem, RemAssign, rem_assign, remainder;
}

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        Rational(-self.0)
    }
}

impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        Rational(-&self.0)
    }
}

impl Sum for Rational {
    fn sum<I: Iterator<Item = Rational>>(terms: I) -> Rational {
        terms.fold(Rational::zero(), |sum, term| sum + term)
    }
}

impl<'a> Sum<&'a Rational> for Rational {
    fn sum<I: Iterator<Item = &'a Rational>>(terms: I) -> Rational {
        terms.fold(Rational::zero(), |sum, term| sum + term)
    }
}

impl Product for Rational {
    fn product<I: Iterator<Item = Rational>>(factors: I) -> Rational {
        factors.fold(Rational::one(), |product, factor| product * factor)
    }
}

impl Zero for Rational {
    fn zero() -> Self {
        Rational(BigRational::zero())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl One for Rational {
    fn one() -> Self {
        Rational(BigRational::one())
    }

    fn is_one(&self) -> bool {
        self.is_integer() && self.numer().is_one()
    }
}

impl Num for Rational {
    type FromStrRadixErr = ParseRatioError;

    fn from_str_radix(text: &str, radix: u32) -> Result<Self, ParseRatioError> {
        BigRational::from_str_radix(text, radix).map(Rational)
    }
}

impl Signed for Rational {
    fn abs(&self) -> Self {
        Rational(self.0.abs())
    }

    fn abs_sub(&self, other: &Self) -> Self {
        if self > other { self - other } else { Rational::zero() }
    }

    fn signum(&self) -> Self {
        Rational(self.0.signum())
    }

    fn is_positive(&self) -> bool {
        self.numer().is_positive()
    }

    fn is_negative(&self) -> bool {
        self.numer().is_negative()
    }
}

// ---- conversions ----

impl From<BigInt> for Rational {
    fn from(integer: BigInt) -> Self {
        Rational::from_integer(integer)
    }
}

impl From<BigRational> for Rational {
    fn from(value: BigRational) -> Self {
        Rational(value.reduced())
    }
}

impl From<Rational> for BigRational {
    fn from(value: Rational) -> Self {
        value.0
    }
}

impl FromPrimitive for Rational {
    fn from_i64(number: i64) -> Option<Self> {
        BigRational::from_i64(number).map(Rational)
    }

    fn from_u64(number: u64) -> Option<Self> {
        BigRational::from_u64(number).map(Rational)
    }

    fn from_f64(number: f64) -> Option<Self> {
        Rational::from_float(number)
    }
}

/// To integers towards 0; to the nearest `f64`, half to even, infinite beyond the largest.
impl ToPrimitive for Rational {
    fn to_i64(&self) -> Option<i64> {
        self.0.to_i64()
    }

    fn to_u64(&self) -> Option<u64> {
        self.0.to_u64()
    }

    fn to_f64(&self) -> Option<f64> {
        self.0.to_f64()
    }
}

/// An integer or a fraction of two: `-7`, `7/24`.
impl FromStr for Rational {
    type Err = ParseRatioError;

    fn from_str(text: &str) -> Result<Self, ParseRatioError> {
        text.parse().map(Rational)
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// As [`Display`](fmt::Display).
impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::HashSet;

    /// F_n and F_(n+1) of 200 000 digits: the common continued fraction of two quotients of neighbours is all ones, the
    /// longest there is.
    fn fibonacci_quotients() -> [Rational; 2] {
        let (mut a, mut b) = (BigInt::from(0), BigInt::from(1)); // F_0 and F_1
        let n = 957_000u32;
        for bit in (0..u32::BITS - n.leading_zeros()).rev() {
            // F_2k = F_k (2 F_k+1 − F_k), F_2k+1 = F_k² + F_k+1²
            (a, b) = (&a * (2 * &b - &a), &a * &a + &b * &b);
            if n >> bit & 1 == 1 {
                (a, b) = (b.clone(), a + b);
            }
        }
        let c = &a + &b;
        assert!(a.bits() > 200_000 * 10 / 3 - 10_000);
        [Rational::new_raw(b.clone(), a), Rational::new_raw(c, b)]
    }

    /// The comparison of `num_rational` recurses once or twice for each term of the common continued fraction.
    #[test]
    fn long_rationals_are_compared_on_a_small_stack() {
        let [x, y] = fibonacci_quotients();
        // F_(n+1)² − F_n F_(n+2) = (−1)^n
        assert!(x > y);
        assert!(x != y);
        assert_eq!([x.cmp(&x.clone()), y.cmp(&x)], [Ordering::Equal, Ordering::Less]);
        assert!(x == x.clone());
        assert_eq!(HashSet::from([x.clone(), y, x]).len(), 2);
    }

    proptest! {
        #[test]
        fn order_and_equality_are_those_of_short_ratios(a in -40i64..40, b in 1i64..40, c in -40i64..40, d in 1i64..40) {
            let [x, y] = [(a, b), (c, d)].map(|(n, d)| Rational::new(n.into(), d.into()));
            prop_assert_eq!(x.cmp(&y), (a * d).cmp(&(c * b)));
            prop_assert_eq!(x == y, a * d == c * b);
        }

        #[test]
        fn the_arithmetic_is_that_of_num_rational((a, b) in (any::<i64>(), any::<i64>()), (c, d) in (any::<i32>(), any::<i32>())) {
            let of = |n: i128, d: i128| (Rational::new(n.into(), d.into()), BigRational::new(n.into(), d.into()));
            let (b, d) = (if b == 0 { 1 } else { b }, if d == 0 { 1 } else { d });
            // denominators alike, with common divisors, and with none
            for below in [d.into(), i128::from(b), i128::from(b) * i128::from(d)] {
                let ((x, one), (y, other)) = (of(a.into(), b.into()), of(c.into(), below));
                prop_assert_eq!(BigRational::from(&x + &y), &one + &other);
                prop_assert_eq!(BigRational::from(&x - &y), &one - &other);
                prop_assert_eq!(BigRational::from(&x * &y), &one * &other);
                if c != 0 {
                    prop_assert_eq!(BigRational::from(&x / &y), &one / &other);
                    prop_assert_eq!(BigRational::from(&x % &y), &one % &other);
                }
                let mut sum = x.clone();
                sum -= BigInt::from(c);
                prop_assert_eq!(BigRational::from(sum), one - BigInt::from(c));
            }
        }

        /// Numbers of very different sizes, and of nearly the same.
        #[test]
        fn order_is_that_of_the_difference(a: i128, b in 1..i128::MAX, shift in 0u32..128, nudge in -3i128..4) {
            let x = Rational::new(a.into(), b.into());
            let y = Rational::new(BigInt::from(a >> shift) + nudge, BigInt::from(b >> shift) + 1);
            prop_assert_eq!(x.cmp(&y), (&x - &y).cmp(&Rational::zero()));
            prop_assert_eq!(x > y, (x - y).is_positive());
        }
    }
}
