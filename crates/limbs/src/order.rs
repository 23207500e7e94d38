//! The order of numbers, as of `f64`: −0 = 0, and NaN has no place in it.

use crate::{Limbs, fixed};
use std::cmp::Ordering;

impl<const L: usize> Limbs<L> {
    /// The order of |a| and |b|, neither of which is NaN.
    pub(crate) fn compare_magnitudes(&self, b: &Self) -> Ordering {
        self.exponent.cmp(&b.exponent).then_with(|| fixed::compare(&self.mantissa, &b.mantissa))
    }

    /// Whether x < 0: false for −0 and for NaN.
    #[inline]
    pub const fn is_below_zero(&self) -> bool {
        self.negative && !self.is_zero() && !self.is_nan()
    }
}

impl<const L: usize> PartialEq for Limbs<L> {
    fn eq(&self, b: &Self) -> bool {
        self.partial_cmp(b) == Some(Ordering::Equal)
    }
}

impl<const L: usize> PartialOrd for Limbs<L> {
    fn partial_cmp(&self, b: &Self) -> Option<Ordering> {
        if self.is_nan() || b.is_nan() {
            return None;
        }
        if self.is_zero() && b.is_zero() {
            return Some(Ordering::Equal);
        }
        Some(match (self.negative, b.negative) {
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
            (false, false) => self.compare_magnitudes(b),
            (true, true) => b.compare_magnitudes(self),
        })
    }
}
