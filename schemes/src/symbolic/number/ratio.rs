//! What all ratios of integers have in common, and how they compare.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};

/// A ratio of two integers: a [`Rational`](crate::symbolic::Rational), or a [`Fraction`](crate::symbolic::Fraction), which need not be in
/// lowest terms.
pub trait Ratio {
    /// The numerator.
    fn numer(&self) -> &BigInt;
    /// The denominator, positive.
    fn denom(&self) -> &BigInt;
}

/// The order of the numbers.
///
/// Signs and bit lengths decide most of the time; nearly equal ratios are multiplied out. The comparison of
/// `num_rational` goes along the common continued fraction instead, by a recursion that overflows the stack for long
/// numbers.
pub(super) fn compare(one: &impl Ratio, other: &impl Ratio) -> Ordering {
    let ((a, b), (c, d)) = ((one.numer(), one.denom()), (other.numer(), other.denom()));
    if b == d {
        return a.cmp(c);
    }
    let signs = a.sign().cmp(&c.sign());
    if signs.is_ne() || a.sign() == Sign::NoSign {
        return signs;
    }
    // |a|d < 2^left ≤ 4 |a|d, and the same with |c|b and right
    let (left, right) = (a.bits() + d.bits(), c.bits() + b.bits());
    if left.abs_diff(right) < 2 {
        return (a * d).cmp(&(c * b));
    }
    if a.sign() == Sign::Minus { right.cmp(&left) } else { left.cmp(&right) }
}

impl<R: Ratio> Ratio for &R {
    fn numer(&self) -> &BigInt {
        (*self).numer()
    }

    fn denom(&self) -> &BigInt {
        (*self).denom()
    }
}
