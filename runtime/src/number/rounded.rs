//! Numbers that an MPFR number of more digits is rounded to.

use rug::{Assign, Float};

use super::{Ordered, Precision};

/// A number that takes an MPFR number of any precision with one rounding.
pub trait Rounded: Ordered {
    /// The precision of the numbers of a context.
    fn precision(context: &Self::Context) -> Precision;

    /// x ← the number nearest to a
    fn assign_rounded(&mut self, a: &Float);
}

impl Rounded for f64 {
    fn precision((): &()) -> Precision {
        Precision::bits(f64::MANTISSA_DIGITS).expect("53 bits")
    }

    fn assign_rounded(&mut self, a: &Float) {
        *self = a.to_f64();
    }
}

impl Rounded for Float {
    fn precision(context: &Precision) -> Precision {
        *context
    }

    fn assign_rounded(&mut self, a: &Float) {
        Assign::assign(self, a);
    }
}
