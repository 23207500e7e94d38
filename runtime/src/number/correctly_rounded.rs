//! Numbers that a number of more digits is rounded to.

use super::{AnyLimbs, DoubleDouble, HighPrecision, LimbCount, Limbs, Precision, Real};
use crate::Rational;

/// A number that takes a number of any precision with one rounding.
pub trait CorrectlyRounded: Real {
    /// The precision of the numbers of a context.
    fn precision(context: &Self::Context) -> Precision;

    /// x ← the number nearest to a
    fn assign_rounded(&mut self, a: &impl HighPrecision);

    /// How many derivatives it has: those of [dual numbers](super::Dual).
    const DERIVATIVES: usize = 0;

    /// The derivative k as a text, as [`Real::to_text`].
    fn derivative_text(&self, k: usize) -> String {
        unreachable!("it has no derivative {k}")
    }

    /// The derivative k ← the number nearest to a
    fn assign_rounded_derivative(&mut self, k: usize, a: &impl HighPrecision) {
        unreachable!("it has no derivative {k} for {}", a.to_f64())
    }
}

impl CorrectlyRounded for f64 {
    fn precision((): &()) -> Precision {
        Precision::of_bits(f64::MANTISSA_DIGITS)
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        *self = a.to_f64();
    }
}

impl<const L: usize> CorrectlyRounded for Limbs<L> {
    fn precision((): &()) -> Precision {
        Precision::of_limbs(L)
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        *self = match a.scaled_integer() {
            Some(a) => Limbs::from_magnitude(a.negative, &a.magnitude, a.exponent, false),
            None => Limbs::from(a.to_f64()),
        };
    }
}

impl CorrectlyRounded for AnyLimbs {
    fn precision(count: &LimbCount) -> Precision {
        Precision::of_bits(count.bits())
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        let count = self.count();
        *self = match a.scaled_integer() {
            Some(a) => AnyLimbs::from_magnitude(a.negative, &a.magnitude, a.exponent, false, count),
            None => AnyLimbs::from_f64(a.to_f64(), count),
        };
    }
}

#[cfg(feature = "mpfr")]
impl CorrectlyRounded for rug::Float {
    fn precision(context: &Precision) -> Precision {
        *context
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        match a.scaled_integer() {
            Some(a) => super::multiprecision::assign_scaled(self, &a),
            None => rug::Assign::assign(self, a.to_f64()),
        }
    }
}

impl CorrectlyRounded for DoubleDouble {
    /// 107 bits: the sign of the low part is one.
    fn precision((): &()) -> Precision {
        Precision::of_bits(2 * f64::MANTISSA_DIGITS + 1)
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        let high = a.to_f64();
        *self = Rational::from_float(high).map_or(DoubleDouble::from(high), |exact| {
            let mut rest = a.clone();
            rest.subtract(&from_rational_like(a, &exact)); // exact
            DoubleDouble::new(high, rest.to_f64())
        });
    }
}

fn from_rational_like<R: HighPrecision>(a: &R, value: &Rational) -> R {
    R::from_rational(value, &a.context())
}
