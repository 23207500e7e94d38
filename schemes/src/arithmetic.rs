//! Three arithmetics for the same order conditions: exact, in fixed point with an error bound, and the
//! sensitivity of a condition to the last digit of the weights.

mod units;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{FromPrimitive, One, Signed, ToPrimitive, Zero};

use crate::symbolic::{Fraction, Ratio, Rational};
use units::Units;

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

    /// A whole number, which is exact.
    fn integer(&self, n: i32) -> Self::Value {
        self.weight(&Rational::from_integer(n.into()))
    }

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
    /// Limbs of 64 bits after the point.
    limbs: usize,
}

/// The true value lies within `error` units of `units`.
#[derive(Clone, Debug)]
pub struct Fixed {
    units: Units,
    error: f64,
}

impl Fixed {
    /// A value that is known to within `error` units.
    pub fn within(units: &BigInt, error: f64) -> Fixed {
        Fixed { units: units.into(), error }
    }

    /// The approximate value, in units.
    pub fn units(&self) -> BigInt {
        (&self.units).into()
    }

    /// The bound of the error, in units.
    pub fn error(&self) -> f64 {
        self.error
    }
}

/// The bits beyond those that are needed, for the growth of the error.
const GUARD_BITS: u32 = 64;

impl FixedPoint {
    /// Room for `digits` decimals and for the growth of the error (19 decimals).
    pub fn new(digits: u32) -> FixedPoint {
        FixedPoint::with_bits((f64::from(digits) * std::f64::consts::LOG2_10) as u32 + GUARD_BITS)
    }

    /// Numbers with at least this number of bits after the point.
    pub fn with_bits(bits: u32) -> FixedPoint {
        FixedPoint { limbs: bits.div_ceil(64) as usize }
    }

    /// The bits after the point, a multiple of 64.
    pub fn bits(&self) -> u32 {
        64 * self.limbs as u32
    }

    /// The number 1 in units.
    pub fn unit(&self) -> BigInt {
        BigInt::one() << self.bits()
    }

    /// The middle and the bound of the error as fractions with the denominator of the unit.
    pub fn read(&self, value: &Fixed) -> (Fraction, Fraction) {
        let unit = self.unit();
        // a bound that overflowed bounds nothing
        let error = BigInt::from_f64(value.error.ceil()).unwrap_or_else(|| BigInt::one() << (2 * self.bits()));
        (Fraction::new(value.units(), unit.clone()), Fraction::new(error, unit))
    }

    /// The numerator of a multiple of 1/`denominator`, if the bound of the error leaves only one.
    pub(crate) fn multiple(&self, value: &Fixed, denominator: &BigInt) -> Option<BigInt> {
        let (middle, error) = self.read(value);
        let unit = self.unit();
        let numerator = (middle.numer() * denominator * 2u32 + &unit).div_floor(&(&unit * 2u32));
        let distance = (middle.numer() * denominator - &numerator * &unit).abs();
        let error = error.numer() * denominator;
        // the next multiples are a whole one away
        (distance <= error && error * 2u32 < unit).then_some(numerator)
    }

    /// A bound of |value|.
    fn size(&self, value: &Fixed) -> f64 {
        let bits = i64::from(self.bits());
        // |units| < 2^b
        power_of_two(value.units.bits() as i64 - bits) + value.error * power_of_two(-bits)
    }
}

/// A power of two, or an upper bound of one that is too small for a normal number.
fn power_of_two(exponent: i64) -> f64 {
    const BIAS: i64 = 1023;
    f64::from_bits(((exponent.clamp(-1000, BIAS) + BIAS) as u64) << (f64::MANTISSA_DIGITS - 1))
}

/// A sum of a few positive numbers of f64 with its own rounding added: a bound of the true sum.
fn bound(sum: f64) -> f64 {
    sum * (1.0 + 8.0 * f64::EPSILON)
}

impl Arithmetic for FixedPoint {
    type Value = Fixed;
    fn zero(&self) -> Fixed {
        Fixed { units: Units::default(), error: 0.0 }
    }
    fn one(&self) -> Fixed {
        Fixed { units: Units::power(self.limbs), error: 0.0 }
    }
    fn weight(&self, weight: &Rational) -> Fixed {
        Fixed::within(&((weight.numer() << self.bits()) / weight.denom()), 1.0)
    }
    fn integer(&self, n: i32) -> Fixed {
        Fixed::within(&(BigInt::from(n) << self.bits()), 0.0)
    }
    fn add_product(&self, target: &mut Fixed, a: &Fixed, b: &Fixed) {
        target.units.add_product(&a.units, &b.units, self.limbs);
        // |ab − a'b'| ≤ |a|·δb + |b'|·δa, and the product drops less than a unit, but for what `bound` adds
        target.error = bound(target.error + self.size(a) * b.error + self.size(b) * a.error + 1.0);
    }
    fn divide(&self, a: &Fixed, n: u32) -> Fixed {
        Fixed { units: a.units.divided(n), error: bound(a.error / f64::from(n) + 1.0) }
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
    /// Its size: the bound is of sums without signs.
    fn integer(&self, n: i32) -> Sensitive {
        Sensitive { value: f64::from(n).abs(), slope: 0.0 }
    }
    fn add_product(&self, target: &mut Sensitive, a: &Sensitive, b: &Sensitive) {
        target.value += a.value * b.value;
        target.slope += a.slope * b.value + a.value * b.slope;
    }
    fn divide(&self, a: &Sensitive, n: u32) -> Sensitive {
        Sensitive { value: a.value / f64::from(n), slope: a.slope / f64::from(n) }
    }
}
