//! Intervals with rational ends that enclose a real number.

use num_bigint::BigInt;
use num_traits::{One, Signed};

use crate::symbolic::number::rational::Rational;
use crate::symbolic::number::rounding::{self, Direction, at_places, magnitude, scaled};

/// The largest power of ten, up or down, that an enclosed number may have.
const LARGEST_MAGNITUDE: i64 = 30_000;

/// The numbers from `low` to `high`; `low <= high`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: Rational,
    pub(crate) high: Rational,
}

impl Interval {
    pub(crate) fn point(value: &Rational) -> Self {
        Interval { low: value.clone(), high: value.clone() }
    }

    pub(crate) fn contains_zero(&self) -> bool {
        !self.low.is_positive() && !self.high.is_negative()
    }

    pub(crate) fn is_point(&self) -> bool {
        self.low == self.high
    }

    /// Whether the ends are 1 apart, or more.
    pub(crate) fn is_wide(&self) -> bool {
        !self.is_point() && &self.high - &self.low >= Rational::one()
    }

    /// The part between −1 and 1, if there is one.
    pub(crate) fn within_one(&self) -> Option<Self> {
        let one = Rational::one();
        let low = self.low.clone().max(-&one);
        let high = self.high.clone().min(one);
        (low <= high).then_some(Interval { low, high })
    }

    pub(crate) fn negate(&self) -> Self {
        Interval { low: -&self.high, high: -&self.low }
    }

    pub(crate) fn add(&self, other: &Self) -> Self {
        Interval { low: &self.low + &other.low, high: &self.high + &other.high }
    }

    pub(crate) fn multiply(&self, other: &Self) -> Self {
        let mut products =
            [&self.low * &other.low, &self.low * &other.high, &self.high * &other.low, &self.high * &other.high];
        products.sort();
        let [low, _, _, high] = products;
        Interval { low, high }
    }

    /// The product with a number.
    pub(crate) fn times(&self, factor: &Rational) -> Self {
        let [one, other] = [&self.low * factor, &self.high * factor];
        if factor.is_negative() { Interval { low: other, high: one } } else { Interval { low: one, high: other } }
    }

    /// 1/x; the interval must not contain zero.
    pub(crate) fn reciprocal(&self) -> Self {
        Interval { low: self.high.recip(), high: self.low.recip() }
    }

    /// x^exponent, rounded outward after every product; `None` as for [`Interval::outward`].
    pub(crate) fn power(&self, exponent: u32, digits: u32) -> Option<Self> {
        if exponent == 0 {
            return Some(Interval::point(&Rational::one()));
        }
        let mut result = self.outward(digits)?;
        for bit in (0..u32::BITS - 1 - exponent.leading_zeros()).rev() {
            result = result.multiply(&result).outward(digits)?;
            if exponent >> bit & 1 == 1 {
                result = result.multiply(self).outward(digits)?;
            }
        }
        Some(result)
    }

    /// The real q-th root to `digits` significant digits; for an even q the interval must not
    /// reach below zero.
    pub(crate) fn root(&self, q: u32, digits: u32) -> Self {
        if self.is_point() && !self.low.is_negative() {
            let [low, high] = root_between(&self.low, q, digits);
            return Interval { low, high };
        }
        Interval { low: root(&self.low, q, digits, Direction::Down), high: root(&self.high, q, digits, Direction::Up) }
    }

    /// Rounds the ends outward to `digits` significant digits, so that they do not grow with every operation.
    ///
    /// `None` if the number in the interval is too large or too small.
    pub(crate) fn outward(&self, digits: u32) -> Option<Self> {
        let sizes = [magnitude(&self.low), magnitude(&self.high)];
        let too_large = sizes.iter().any(|size| *size > LARGEST_MAGNITUDE);
        let too_small = !self.contains_zero() && sizes.iter().any(|size| *size < -LARGEST_MAGNITUDE);
        if too_large || too_small {
            return None;
        }
        // Around zero, more places than this would only take time.
        let finest = if self.contains_zero() { 2 * i64::from(digits) } else { i64::MAX };
        let round = |end, direction| rounding::to_places(end, rounding::places(end, digits).min(finest), direction);
        Some(Interval { low: round(&self.low, Direction::Down), high: round(&self.high, Direction::Up) })
    }
}

/// The real q-th root, rounded down or up to `digits` significant digits.
fn root(value: &Rational, q: u32, digits: u32, direction: Direction) -> Rational {
    if value.is_negative() {
        let opposite = match direction {
            Direction::Up => Direction::Down,
            _ => Direction::Up,
        };
        return -root(&-value, q, digits, opposite);
    }
    let [low, high] = root_between(value, q, digits);
    if matches!(direction, Direction::Up) { high } else { low }
}

/// The real q-th root of a number that is not negative, rounded down and up.
fn root_between(value: &Rational, q: u32, digits: u32) -> [Rational; 2] {
    let size = magnitude(value).div_euclid(i64::from(q));
    let places = i64::from(digits) - 1 - size;
    let (numerator, denominator) = scaled(value, places * i64::from(q));
    let floor: BigInt = (&numerator / &denominator).nth_root(q);
    let inexact = floor.pow(q) * denominator != numerator;
    let low = at_places(floor.clone(), places);
    let high = if inexact { at_places(floor + 1, places) } else { low.clone() };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rational() -> impl Strategy<Value = Rational> {
        (any::<i32>(), 1..i32::MAX).prop_map(|(n, d)| Rational::new(n.into(), d.into()))
    }

    fn encloses(interval: &Interval, value: &Rational) -> bool {
        &interval.low <= value && value <= &interval.high
    }

    proptest! {
        #[test]
        fn rounding_outward_keeps_the_number(value in rational(), digits in 1u32..12) {
            let rounded = Interval::point(&value).outward(digits).unwrap();
            prop_assert!(encloses(&rounded, &value));
        }

        #[test]
        fn a_root_is_between_its_ends(value in rational(), q in 2u32..7, digits in 1u32..12) {
            let value = if q % 2 == 0 { value.abs() } else { value };
            let Interval { low, high } = Interval::point(&value).root(q, digits);
            let powers = Interval { low: low.pow(q as i32), high: high.pow(q as i32) };
            prop_assert!(encloses(&powers, &value));
            prop_assert!(low < high || powers.low == value, "equal ends are the root");
        }

        #[test]
        fn operations_enclose_what_they_compute(a in rational(), b in rational(), n in 0u32..9) {
            let near = |value: &Rational| Interval::point(value).outward(2).unwrap();
            let (x, y) = (near(&a), near(&b));
            prop_assert!(encloses(&x.add(&y), &(&a + &b)));
            prop_assert!(encloses(&x.multiply(&y), &(&a * &b)));
            prop_assert!(encloses(&x.negate(), &-&a));
            prop_assert!(encloses(&x.times(&b), &(&a * &b)));
            prop_assert!(encloses(&x.power(n, 3).unwrap(), &a.pow(n as i32)));
            if !x.contains_zero() {
                prop_assert!(encloses(&x.reciprocal(), &a.recip()));
            }
        }
    }
}
