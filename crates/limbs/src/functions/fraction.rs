//! Numbers from 0 to 1 as fractions Σ x\[i\] 2^(64 (i − W)) in fixed point.

use crate::{Limbs, fixed};

/// ⌊|x| 2^(64 W)⌋ of |x| < 1
#[inline(always)]
pub(super) fn fraction<const W: usize>(x: &Limbs<W>) -> [u64; W] {
    fixed::shift_down(&x.mantissa, x.exponent.unsigned_abs())
}

/// The fraction times 2^exponent.
#[inline(always)]
pub(super) fn number<const W: usize>(fraction: &[u64; W], exponent: i64) -> Limbs<W> {
    if fixed::is_zero(fraction) {
        return Limbs::ZERO;
    }
    let zeros = fixed::leading_zeros(fraction);
    Limbs::in_range(false, exponent - i64::from(zeros), fixed::shift_up(fraction, zeros))
}

/// a b
#[inline(always)]
pub(super) fn product<const W: usize>(a: &[u64; W], b: &[u64; W]) -> [u64; W] {
    fixed::high_product(a, b).0
}

/// a²
#[inline(always)]
pub(super) fn square<const W: usize>(a: &[u64; W]) -> [u64; W] {
    fixed::high_square(a).0
}

/// The multiple i of 1/64 nearest to x, and x − i/64: its magnitude, and whether it is negative.
#[inline(always)]
pub(super) fn split<const W: usize>(x: &[u64; W]) -> (usize, [u64; W], bool) {
    let i = (x[W - 1] + (1 << 57)) >> 58;
    let mut rest = *x;
    rest[W - 1] = rest[W - 1].wrapping_sub(i << 58);
    let is_negative = fixed::is_negative(&rest);
    if is_negative {
        fixed::negate(&mut rest);
    }
    (i as usize, rest, is_negative)
}
