//! The precision of numbers with many digits.

use std::f64::consts::{LOG2_10, LOG10_2};

use shadowstep_limbs::LimbCount;
use thiserror::Error;

/// The precision of a number in bits, and in the decimal digits that it holds.
///
/// `n` decimal digits are ⌈n log₂10⌉ + 1 bits, so that any text of `n` digits survives being
/// read and printed:
///
/// ```
/// use shadowstep::number::Precision;
///
/// let precision = Precision::digits(120)?;
/// assert_eq!(precision.in_bits(), 400);
/// assert_eq!(precision.in_digits(), 120);
/// # Ok::<(), shadowstep::number::PrecisionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Precision {
    bits: u32,
}

/// A precision out of range.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum PrecisionError {
    /// in decimal digits
    #[error("the precision is {0} digits, but has to be from {least} to {most}",
        least = Precision::LEAST.in_digits(), most = Precision::MOST.in_digits())]
    Digits(u32),
    /// in bits
    #[error("the precision is {0} bits, but has to be from {least} to {most}",
        least = Precision::LEAST.bits, most = Precision::MOST.bits)]
    Bits(u32),
}

shadowstep_schemes::debug_as_text!(PrecisionError);

impl Precision {
    const LEAST: Precision = Precision { bits: 5 };
    const MOST: Precision = Precision { bits: 3_321_930 };

    /// The precision for this many decimal digits, from 1 to 1 000 000.
    pub fn digits(digits: u32) -> Result<Precision, PrecisionError> {
        let bits = (f64::from(digits) * LOG2_10).ceil() as u32; // `as` saturates: no overflow
        Precision::bits(bits.saturating_add(1)).map_err(|_| PrecisionError::Digits(digits))
    }

    /// The precision of this many bits, from 5 (1 digit) to 3 321 930 (1 000 000 digits).
    pub fn bits(bits: u32) -> Result<Precision, PrecisionError> {
        let precision = Precision { bits };
        if (Precision::LEAST..=Precision::MOST).contains(&precision) {
            Ok(precision)
        } else {
            Err(PrecisionError::Bits(bits))
        }
    }

    /// The precision of a number, which has as many bits as are allowed.
    pub(crate) const fn of_bits(bits: u32) -> Precision {
        Precision { bits }
    }

    /// The precision of numbers of this number of limbs of 64 bits.
    pub const fn of_limbs(limbs: usize) -> Precision {
        Precision { bits: u64::BITS * limbs as u32 }
    }

    /// The size of the significand in bits.
    pub fn in_bits(self) -> u32 {
        self.bits
    }

    /// The fewest limbs of 64 bits with this precision; none beyond [`LimbCount::MOST`], 327 digits.
    ///
    /// ```
    /// use shadowstep::number::Precision;
    ///
    /// assert_eq!(Precision::digits(120)?.limbs().unwrap().get(), 7);
    /// # Ok::<(), shadowstep::number::PrecisionError>(())
    /// ```
    pub fn limbs(self) -> Option<LimbCount> {
        LimbCount::of_bits(self.bits)
    }

    /// How many decimal digits of a text survive: ⌊(bits − 1) log₁₀2⌋.
    pub fn in_digits(self) -> u32 {
        (f64::from(self.bits - 1) * LOG10_2) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_for_digits() {
        for (digits, bits) in [(1, 5), (15, 51), (16, 55), (34, 114), (120, 400), (1000, 3323), (1_000_000, 3_321_930)]
        {
            let precision = Precision::digits(digits).unwrap();
            assert_eq!(precision.in_bits(), bits);
            assert_eq!(precision.in_digits(), digits);
            assert_eq!(Precision::bits(bits), Ok(precision));
        }
        assert_eq!(Precision::bits(53).unwrap().in_digits(), 15);
    }

    #[test]
    fn precision_out_of_range() {
        for digits in [0, 1_000_001, u32::MAX] {
            assert_eq!(Precision::digits(digits), Err(PrecisionError::Digits(digits)));
        }
        for bits in [0, 4, 3_321_931, u32::MAX] {
            assert_eq!(Precision::bits(bits), Err(PrecisionError::Bits(bits)));
        }
        assert_eq!(PrecisionError::Digits(0).to_string(), "the precision is 0 digits, but has to be from 1 to 1000000");
        assert_eq!(PrecisionError::Bits(4).to_string(), "the precision is 4 bits, but has to be from 5 to 3321930");
    }
}
