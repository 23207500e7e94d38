//! Products and squares, correctly rounded.

use crate::{Limbs, fixed};
use std::ops::{Mul, MulAssign};

impl<const L: usize> Limbs<L> {
    /// x ← a b, correctly rounded; in place, faster than `x = &a * &b`.
    #[inline]
    pub fn set_product(&mut self, a: &Self, b: &Self) {
        *self = quick_product(a, b).unwrap_or_else(|| product(*a, *b));
    }

    /// x ← a², correctly rounded; in place, faster than `x = a.square()`.
    #[inline]
    pub fn set_square(&mut self, a: &Self) {
        *self = quick_square(a).unwrap_or_else(|| product(*a, *a));
    }

    /// x ← x + a b, with two roundings.
    #[inline]
    pub fn add_product(&mut self, a: &Self, b: &Self) {
        *self += &(a * b);
    }

    /// x ← x − a b, with two roundings.
    #[inline]
    pub fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self -= &(a * b);
    }

    /// x², correctly rounded.
    #[inline]
    pub fn square(&self) -> Self {
        quick_square(self).unwrap_or_else(|| product(*self, *self))
    }

    /// n x, correctly rounded.
    #[inline]
    pub fn times_integer(&self, n: i32) -> Self {
        let negative = self.negative ^ (n < 0);
        if !self.is_regular() || n == 0 {
            return special(self, &Limbs::from(n));
        }
        let mut mantissa = self.mantissa;
        let above = fixed::multiply_limb(&mut mantissa, n.unsigned_abs().into());
        let bits = 64 - above.leading_zeros();
        if bits == 0 {
            return Limbs { negative, ..*self };
        }
        let below = mantissa[0] << (64 - bits);
        for i in 0..L {
            let next = if i + 1 < L { mantissa[i + 1] } else { above };
            mantissa[i] = mantissa[i] >> 1 >> (bits - 1) | next << (64 - bits);
        }
        Limbs::rounded(negative, self.exponent + bits as i32, mantissa, below)
    }
}

/// The product, unless an operand is 0, infinite or NaN, or the rounding needs more limbs.
#[inline(always)]
fn quick_product<const L: usize>(a: &Limbs<L>, b: &Limbs<L>) -> Option<Limbs<L>> {
    if !(a.is_regular() & b.is_regular()) {
        return None;
    }
    let (mantissa, below) = fixed::high_product(&a.mantissa, &b.mantissa);
    normalised(a.negative ^ b.negative, a.exponent + b.exponent, mantissa, below)
}

/// The same of a square.
#[inline(always)]
fn quick_square<const L: usize>(a: &Limbs<L>) -> Option<Limbs<L>> {
    if !a.is_regular() {
        return None;
    }
    let (mantissa, below) = fixed::high_square(&a.mantissa);
    normalised(false, 2 * a.exponent, mantissa, below)
}

/// The rounded product from its upper half, unless the limb below, which is too small by less than 2 L units, is too
/// close to a tie.
#[inline(always)]
fn normalised<const L: usize>(
    negative: bool,
    exponent: i32,
    mut mantissa: [u64; L],
    mut below: u64,
) -> Option<Limbs<L>> {
    // 1/4 ≤ product < 1: doubled where below 1/2, without a branch
    let double = (mantissa[L - 1] >> 63).wrapping_sub(1);
    let mut carry;
    (below, carry) = below.carrying_add(below & double, false);
    for limb in &mut mantissa {
        (*limb, carry) = limb.carrying_add(*limb & double, carry);
    }
    let missing = 4 * L as u64;
    if below.wrapping_sub((1 << 63) - missing) <= missing {
        return None;
    }
    Limbs::quickly_rounded(negative, exponent + double as i32, mantissa, below)
}

/// The product of any numbers, from all limbs.
#[cold]
#[inline(never)]
fn product<const L: usize>(a: Limbs<L>, b: Limbs<L>) -> Limbs<L> {
    if !(a.is_regular() && b.is_regular()) {
        return special(&a, &b);
    }
    let (mut low, mut high) = fixed::product(&a.mantissa, &b.mantissa);
    let mut exponent = a.exponent + b.exponent;
    if high[L - 1] >> 63 == 0 {
        high = fixed::shift_up(&high, 1);
        high[0] |= low[L - 1] >> 63;
        low = fixed::shift_up(&low, 1);
        exponent -= 1;
    }
    let more = low[..L - 1].iter().any(|limb| *limb != 0);
    Limbs::rounded(a.negative ^ b.negative, exponent, high, low[L - 1] | u64::from(more))
}

/// Where a or b is 0, infinite or NaN.
fn special<const L: usize>(a: &Limbs<L>, b: &Limbs<L>) -> Limbs<L> {
    let negative = a.negative ^ b.negative;
    let (zero, infinite) = (a.is_zero() || b.is_zero(), a.is_infinite() || b.is_infinite());
    match (a.is_nan() || b.is_nan(), zero, infinite) {
        (true, ..) | (false, true, true) => Limbs::NAN,
        (false, true, false) => Limbs { negative, ..Limbs::ZERO },
        (false, false, _) => Limbs { negative, ..Limbs::INFINITY },
    }
}

impl<const L: usize> Mul for &Limbs<L> {
    type Output = Limbs<L>;

    #[inline]
    fn mul(self, b: &Limbs<L>) -> Limbs<L> {
        quick_product(self, b).unwrap_or_else(|| product(*self, *b))
    }
}

impl<const L: usize> MulAssign<&Limbs<L>> for Limbs<L> {
    #[inline]
    fn mul_assign(&mut self, b: &Limbs<L>) {
        *self = quick_product(self, b).unwrap_or_else(|| product(*self, *b));
    }
}
