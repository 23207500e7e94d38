//! Numbers of many digits that exact results are computed with, before these are rounded to the numbers of a run.

use super::{AnyLimbs, LimbCount, Real};

/// A number type whose numbers can be rounded to any other.
pub trait HighPrecision: Real + 'static {
    /// What makes numbers of at least this number of bits; `None` if the type has none.
    fn context_of(bits: u32) -> Option<Self::Context>;

    /// The bits of the significand.
    fn bits(&self) -> u32;

    /// This number with at least this number of bits, rounded once where it had more.
    ///
    /// # Panics
    /// The type has no such numbers.
    #[must_use]
    fn at_bits(&self, bits: u32) -> Self;

    /// This finite number as an integer times a power of 2; `None` of infinities and NaN.
    fn scaled_integer(&self) -> Option<ScaledInteger>;
}

/// ± Σ magnitude\[i\] 2^(64 i + exponent), i = 0, 1, …
#[derive(Clone, Debug)]
pub struct ScaledInteger {
    /// Whether the sign is −.
    pub negative: bool,
    /// The lowest limb first; empty for 0.
    pub magnitude: Vec<u64>,
    /// The exponent of 2.
    pub exponent: i64,
}

impl HighPrecision for AnyLimbs {
    fn context_of(bits: u32) -> Option<LimbCount> {
        LimbCount::of_bits(bits)
    }

    fn bits(&self) -> u32 {
        self.count().bits()
    }

    #[inline]
    fn at_bits(&self, bits: u32) -> Self {
        self.resized(Self::context_of(bits).expect("at most 17 limbs"))
    }

    fn scaled_integer(&self) -> Option<ScaledInteger> {
        let (magnitude, exponent) = match self.exponent() {
            Some(exponent) => (self.mantissa(), i64::from(exponent) - i64::from(self.count().bits())),
            None if self.is_zero() => (&[][..], 0),
            None => return None,
        };
        Some(ScaledInteger { negative: self.is_sign_negative(), magnitude: magnitude.to_vec(), exponent })
    }
}

#[cfg(feature = "mpfr")]
impl HighPrecision for rug::Float {
    fn context_of(bits: u32) -> Option<super::Precision> {
        super::Precision::bits(bits).ok()
    }

    fn bits(&self) -> u32 {
        self.prec()
    }

    fn at_bits(&self, bits: u32) -> Self {
        rug::Float::with_val(bits, self)
    }

    fn scaled_integer(&self) -> Option<ScaledInteger> {
        let (integer, exponent) = self.to_integer_exp()?;
        Some(ScaledInteger {
            negative: self.is_sign_negative(),
            magnitude: integer.to_digits(rug::integer::Order::Lsf),
            exponent: exponent.into(),
        })
    }
}
