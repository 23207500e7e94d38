//! Rounding to nearest, ties to even.
//!
//! Sums and products have two ways: a quick one that is compiled into the place of the call, whose limbs stay in
//! registers, and a function for all cases that it leaves open.

use crate::{EXPONENTS, Limbs, fixed};

const HALF: u64 = 1 << 63;

impl<const L: usize> Limbs<L> {
    /// Like [`rounded`](Self::rounded) for nearly all results: none where rounding carries beyond a limb, or out of
    /// range.
    #[inline(always)]
    pub(crate) fn quickly_rounded(negative: bool, exponent: i32, mut mantissa: [u64; L], below: u64) -> Option<Self> {
        let up = below > HALF || below == HALF && mantissa[0] & 1 != 0;
        let carries;
        (mantissa[0], carries) = mantissa[0].overflowing_add(u64::from(up));
        let fits = !carries & (exponent.unsigned_abs() < EXPONENTS as u32);
        if fits { Some(Limbs { mantissa, exponent, negative }) } else { None }
    }

    /// The number nearest to (mantissa + below / 2^64) / 2^(64 L) 2^exponent, whose highest bit is 1. Where more bits
    /// follow, the lowest bit of `below` is 1.
    pub(crate) fn rounded(negative: bool, mut exponent: i32, mut mantissa: [u64; L], below: u64) -> Self {
        let up = below > HALF || below == HALF && mantissa[0] & 1 != 0;
        let carries;
        (mantissa[0], carries) = mantissa[0].overflowing_add(u64::from(up));
        if carries {
            exponent += i32::from(carry_from_lowest(&mut mantissa));
        }
        if exponent.unsigned_abs() < EXPONENTS as u32 {
            Limbs { mantissa, exponent, negative }
        } else {
            Self::out_of_range(negative, exponent, mantissa)
        }
    }

    /// The same as a number, which may be too large or too small for one.
    pub(crate) fn in_range(negative: bool, exponent: i64, mantissa: [u64; L]) -> Self {
        if exponent.unsigned_abs() < EXPONENTS as u64 {
            Limbs { mantissa, exponent: exponent as i32, negative }
        } else {
            let beyond = 2 * i64::from(EXPONENTS) - 1;
            Self::out_of_range(negative, exponent.clamp(-beyond, beyond) as i32, mantissa)
        }
    }

    /// ±∞, or what is nearer: the smallest number or 0.
    #[cold]
    fn out_of_range(negative: bool, exponent: i32, mut mantissa: [u64; L]) -> Self {
        if exponent >= EXPONENTS {
            return Limbs { negative, ..Self::INFINITY };
        }
        mantissa[L - 1] &= !HALF;
        if exponent == -EXPONENTS && !fixed::is_zero(&mantissa) {
            Limbs { negative, ..Self::power_of_two(1 - EXPONENTS) }
        } else {
            Limbs { negative, ..Self::ZERO }
        }
    }
}

/// Carries into the second limb; whether out of the last one, which leaves 2^(64 L − 1).
#[cold]
fn carry_from_lowest<const L: usize>(mantissa: &mut [u64; L]) -> bool {
    for limb in &mut mantissa[1..] {
        let carries;
        (*limb, carries) = limb.overflowing_add(1);
        if !carries {
            return false;
        }
    }
    mantissa[L - 1] = HALF;
    true
}
