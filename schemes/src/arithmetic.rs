//! Three arithmetics for the same order conditions: exact, in fixed point with an error bound, and the
//! sensitivity of a condition to the last digit of the weights.

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};
use shadowstep_symbolic::{Fraction, Rational};

/// Sums of products, as order conditions need them.
pub trait Arithmetic {
    /// A value.
    type Value: Clone;
    /// 0
    fn zero(&self) -> Self::Value;
    /// 1
    fn one(&self) -> Self::Value;
    /// A weight of the scheme.
    fn weight(&self, weight: &Rational) -> Self::Value;
    /// target += a·b
    fn add_product(&self, target: &mut Self::Value, a: &Self::Value, b: &Self::Value);
    /// a/n
    fn divide(&self, a: &Self::Value, n: u32) -> Self::Value;

    /// a·b
    fn product(&self, a: &Self::Value, b: &Self::Value) -> Self::Value {
        let mut product = self.zero();
        self.add_product(&mut product, a, b);
        product
    }
}

/// Rationals.
pub struct ExactArithmetic;

impl Arithmetic for ExactArithmetic {
    type Value = Rational;
    fn zero(&self) -> Rational {
        Rational::zero()
    }
    fn one(&self) -> Rational {
        Rational::one()
    }
    fn weight(&self, weight: &Rational) -> Rational {
        weight.clone()
    }
    fn add_product(&self, target: &mut Rational, a: &Rational, b: &Rational) {
        *target += a * b;
    }
    fn divide(&self, a: &Rational, n: u32) -> Rational {
        a / BigInt::from(n)
    }
}

/// Numbers m·2^−bits with a bound of their error in units of 2^−bits.
pub struct FixedPoint {
    bits: u32,
}

/// The true value lies within `error` units of `units`.
#[derive(Clone, Debug)]
pub struct Fixed {
    /// The approximate value, in units.
    pub units: BigInt,
    error: u128,
}

impl FixedPoint {
    /// Room for `digits` decimals and for the growth of the bound (19 decimals).
    pub fn new(digits: u32) -> FixedPoint {
        FixedPoint { bits: (f64::from(digits) * std::f64::consts::LOG2_10) as u32 + 64 }
    }

    /// The number 1 in units.
    pub fn unit(&self) -> BigInt {
        BigInt::one() << self.bits
    }

    /// The middle and the bound of the error as fractions with the denominator of the unit.
    pub fn read(&self, value: &Fixed) -> (Fraction, Fraction) {
        let unit = self.unit();
        // a bound that overflowed bounds nothing
        let error = if value.error == u128::MAX { BigInt::one() << (2 * self.bits) } else { value.error.into() };
        (Fraction::new(value.units.clone(), unit.clone()), Fraction::new(error, unit))
    }

    /// A power of two, at least 1, that |value| does not exceed.
    fn size(&self, value: &Fixed) -> u128 {
        let bits = u64::from(self.bits);
        if u64::from(u128::BITS - value.error.leading_zeros()) >= bits {
            return u128::MAX;
        }
        // |units| < 2^b and error < 2^(bits − 1)
        let above = (value.units.bits() + 1).saturating_sub(bits);
        if above < 127 { 1 << above } else { u128::MAX }
    }
}

impl Arithmetic for FixedPoint {
    type Value = Fixed;
    fn zero(&self) -> Fixed {
        Fixed { units: BigInt::zero(), error: 0 }
    }
    fn one(&self) -> Fixed {
        Fixed { units: self.unit(), error: 0 }
    }
    fn weight(&self, weight: &Rational) -> Fixed {
        Fixed { units: (weight.numer() << self.bits) / weight.denom(), error: 1 }
    }
    fn add_product(&self, target: &mut Fixed, a: &Fixed, b: &Fixed) {
        target.units += (&a.units * &b.units) >> self.bits;
        // |ab − a'b'| ≤ |a|·δb + |b'|·δa, and the shift drops less than one unit
        let error = self.size(a).saturating_mul(b.error).saturating_add(self.size(b).saturating_mul(a.error));
        target.error = target.error.saturating_add(error).saturating_add(1);
    }
    fn divide(&self, a: &Fixed, n: u32) -> Fixed {
        let error = if a.error == u128::MAX { a.error } else { a.error / u128::from(n) + 2 };
        Fixed { units: &a.units / n, error }
    }
}

/// How far a condition can move when each weight moves by at most one unit of its last digit: the
/// derivative of the condition at |a_s|, |b_s|, in units of that digit. The conditions are polynomials
/// with positive coefficients, so this bounds the true movement (to first order in the last digit).
pub struct Sensitivity;

/// A value of |weights| and its derivative.
#[derive(Clone, Copy, Debug)]
pub struct Sensitive {
    value: f64,
    /// The derivative.
    pub slope: f64,
}

impl Arithmetic for Sensitivity {
    type Value = Sensitive;
    fn zero(&self) -> Sensitive {
        Sensitive { value: 0.0, slope: 0.0 }
    }
    fn one(&self) -> Sensitive {
        Sensitive { value: 1.0, slope: 0.0 }
    }
    fn weight(&self, weight: &Rational) -> Sensitive {
        let value = weight.to_f64().unwrap_or(f64::MAX).abs();
        // a weight of exactly 0 is not rounded
        Sensitive { value, slope: if weight.is_zero() { 0.0 } else { value.max(1.0) } }
    }
    fn add_product(&self, target: &mut Sensitive, a: &Sensitive, b: &Sensitive) {
        target.value += a.value * b.value;
        target.slope += a.slope * b.value + a.value * b.slope;
    }
    fn divide(&self, a: &Sensitive, n: u32) -> Sensitive {
        Sensitive { value: a.value / f64::from(n), slope: a.slope / f64::from(n) }
    }
}
