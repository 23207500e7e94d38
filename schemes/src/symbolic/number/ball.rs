//! Fixed-point numbers with error bounds: every operation adds its own error to the errors of its operands.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::rational::Rational;

/// A number between (middle − radius)/2^bits and (middle + radius)/2^bits.
///
/// The operands of an operation have the same bits. Shifts and quotients of the middle and of the radius are each off
/// by less than one unit, so the radius grows by two.
#[derive(Debug, Clone)]
pub(crate) struct Ball {
    middle: BigInt,
    radius: BigInt,
    bits: u64,
}

impl Ball {
    pub(crate) fn one(bits: u64) -> Self {
        Ball { middle: BigInt::one() << bits, radius: BigInt::zero(), bits }
    }

    pub(crate) fn zero(bits: u64) -> Self {
        Ball { middle: BigInt::zero(), radius: BigInt::zero(), bits }
    }

    /// numerator/denominator, which need not be in lowest terms; the denominator is positive.
    pub(crate) fn ratio(numerator: &BigInt, denominator: &BigInt, bits: u64) -> Self {
        let (middle, rest) = (numerator << bits).div_mod_floor(denominator);
        Ball { middle, radius: BigInt::from(u8::from(!rest.is_zero())), bits }
    }

    /// The bits after the point.
    pub(crate) fn bits(&self) -> u64 {
        self.bits
    }

    /// About −log2 |x|: the zeros between the point and the first bit of the middle; 0 if that is before the point.
    pub(crate) fn leading_zeros(&self) -> u64 {
        self.bits.saturating_sub(self.middle.bits())
    }

    /// The number of correct bits.
    pub(crate) fn certain_bits(&self) -> u64 {
        self.middle.bits().saturating_sub(self.radius.bits())
    }

    /// An upper bound of |x|, in units.
    pub(crate) fn size(&self) -> BigInt {
        self.middle.abs() + &self.radius
    }

    /// Whether the middle is at most one unit, so that a series may end with it.
    pub(crate) fn is_negligible(&self) -> bool {
        self.middle.bits() <= 1
    }

    /// The same number with other bits after the point.
    pub(crate) fn with_bits(&self, bits: u64) -> Self {
        if bits >= self.bits {
            let more = bits - self.bits;
            return Ball { middle: &self.middle << more, radius: &self.radius << more, bits };
        }
        Ball { bits, ..self.shifted_down(self.bits - bits) }
    }

    /// x/2^count
    pub(crate) fn shifted_down(&self, count: u64) -> Self {
        if count == 0 {
            return self.clone();
        }
        Ball { middle: &self.middle >> count, radius: (&self.radius >> count) + 2, bits: self.bits }
    }

    /// The sum with an unknown number of at most this many units.
    pub(crate) fn widened(self, units: BigInt) -> Self {
        Ball { radius: self.radius + units, ..self }
    }

    pub(crate) fn negate(&self) -> Self {
        Ball { middle: -&self.middle, ..self.clone() }
    }

    pub(crate) fn add(&self, other: &Self) -> Self {
        debug_assert_eq!(self.bits, other.bits);
        Ball { middle: &self.middle + &other.middle, radius: &self.radius + &other.radius, bits: self.bits }
    }

    pub(crate) fn subtract(&self, other: &Self) -> Self {
        self.add(&other.negate())
    }

    pub(crate) fn multiply(&self, other: &Self) -> Self {
        debug_assert_eq!(self.bits, other.bits);
        let middle = (&self.middle * &other.middle) >> self.bits;
        // |xy − ab| <= |a| |y−b| + |b| |x−a| + |x−a| |y−b|
        let spread = self.middle.abs() * &other.radius + other.size() * &self.radius;
        Ball { middle, radius: (spread >> self.bits) + 2, bits: self.bits }
    }

    /// n x
    pub(crate) fn times(&self, n: &BigInt) -> Self {
        Ball { middle: &self.middle * n, radius: &self.radius * n.abs(), bits: self.bits }
    }

    /// x/n
    pub(crate) fn over(&self, n: u64) -> Self {
        Ball { middle: &self.middle / n, radius: &self.radius / n + 2, bits: self.bits }
    }

    /// x/y for a y of at least 1 that is not less than |x|.
    pub(crate) fn over_larger(&self, divisor: &Self) -> Self {
        debug_assert_eq!(self.bits, divisor.bits);
        let middle = (&self.middle << self.bits).div_floor(&divisor.middle);
        // x/y − a/b = ((x−a) − (a/b) (y−b)) / y, where y >= 1 and, as the radii are small, |a/b| <= 2.
        let radius = &self.radius + &divisor.radius * 2 + 1;
        Ball { middle, radius, bits: self.bits }
    }

    /// √x for an x of at least 1/4.
    pub(crate) fn sqrt(&self) -> Self {
        // |√x − √a| = |x − a| / (√x + √a) <= |x − a|
        Ball { middle: (&self.middle << self.bits).sqrt(), radius: &self.radius + 1, bits: self.bits }
    }

    /// The integer next to x/y, up to the balls' radii.
    pub(crate) fn nearest_quotient(&self, divisor: &Self) -> BigInt {
        let two = BigInt::from(2);
        (&self.middle * &two + &divisor.middle).div_floor(&(&divisor.middle * two))
    }

    /// 2^exponent · x
    pub(crate) fn to_interval(&self, exponent: i64) -> Interval {
        let exponent = exponent - self.bits as i64;
        let end = |units| times_power_of_two(units, exponent);
        Interval { low: end(&self.middle - &self.radius), high: end(&self.middle + &self.radius) }
    }
}

/// 2^exponent · units, in lowest terms without a search for common divisors.
fn times_power_of_two(units: BigInt, exponent: i64) -> Rational {
    let places = exponent.unsigned_abs();
    if exponent >= 0 {
        return Rational::from_integer(units << places);
    }
    let common = units.trailing_zeros().map_or(places, |zeros| zeros.min(places));
    Rational::new_raw(units >> common, BigInt::one() << (places - common))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A ball around a number, with both.
    fn ball(least: i64, most: i64, bits: u64) -> impl Strategy<Value = (Ball, Rational)> {
        let scale = 1i64 << 40;
        (least * scale..most * scale, 0i64..500, -1i64..=1).prop_map(move |(n, radius, side)| {
            let number = Rational::new(n.into(), scale.into());
            let exact = Ball::ratio(number.numer(), number.denom(), bits);
            let middle = exact.middle + side * radius;
            (Ball { middle, radius: exact.radius + radius, bits }, number)
        })
    }

    fn encloses(ball: &Ball, value: &Rational) -> bool {
        let Interval { low, high } = ball.to_interval(0);
        low <= *value && *value <= high
    }

    proptest! {
        #[test]
        fn operations_enclose_what_they_compute(
            ((a, x), (b, y)) in (ball(-4, 4, 50), ball(-4, 4, 50)),
            n in 1u64..1000,
            count in 0u64..9,
        ) {
            let times = Rational::from_integer(n.into());
            let power = Rational::from_integer((1u64 << count).into());
            prop_assert!(encloses(&a, &x));
            prop_assert!(encloses(&a.add(&b), &(&x + &y)));
            prop_assert!(encloses(&a.subtract(&b), &(&x - &y)));
            prop_assert!(encloses(&a.multiply(&b), &(&x * &y)));
            prop_assert!(encloses(&a.times(&BigInt::from(n)), &(&x * &times)));
            prop_assert!(encloses(&a.over(n), &(&x / times)));
            prop_assert!(encloses(&a.shifted_down(count), &(&x / power)));
            prop_assert!(encloses(&a.with_bits(50 + count), &x));
            prop_assert!(encloses(&a.with_bits(50 - count), &x));
        }

        #[test]
        fn quotients_and_roots_enclose_what_they_compute(
            ((a, x), (b, y)) in (ball(-1, 1, 50), ball(1, 4, 50)),
        ) {
            prop_assert!(encloses(&a.over_larger(&b), &(x / &y)));
            let Interval { low, high } = b.sqrt().to_interval(0);
            prop_assert!(&low * &low <= y && y <= &high * &high);
        }
    }
}
