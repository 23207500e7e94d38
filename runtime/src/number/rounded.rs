//! Numbers that a number of more digits is rounded to.

use super::{Limbs, Ordered, Precision, Reference};

/// A number that takes a number of any precision with one rounding.
pub trait Rounded: Ordered {
    /// The precision of the numbers of a context.
    fn precision(context: &Self::Context) -> Precision;

    /// x ← the number nearest to a
    fn assign_rounded(&mut self, a: &impl Reference);
}

impl Rounded for f64 {
    fn precision((): &()) -> Precision {
        Precision::of_bits(f64::MANTISSA_DIGITS)
    }

    fn assign_rounded(&mut self, a: &impl Reference) {
        *self = a.to_f64();
    }
}

impl<const L: usize> Rounded for Limbs<L> {
    fn precision((): &()) -> Precision {
        Precision::of_limbs(L)
    }

    fn assign_rounded(&mut self, a: &impl Reference) {
        *self = a.to_limbs();
    }
}

#[cfg(feature = "mpfr")]
impl Rounded for rug::Float {
    fn precision(context: &Precision) -> Precision {
        *context
    }

    fn assign_rounded(&mut self, a: &impl Reference) {
        a.round_to(self);
    }
}
