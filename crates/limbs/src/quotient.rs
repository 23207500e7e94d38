//! Quotients, correctly rounded.

use crate::Limbs;
use crate::fixed::{self, Divisor};
use std::cmp::Ordering;
use std::ops::{Div, DivAssign};

impl<const L: usize> Limbs<L> {
    /// x ← a / b, correctly rounded.
    #[inline]
    pub fn set_quotient(&mut self, a: &Self, b: &Self) {
        *self = a / b;
    }

    /// a / b, correctly rounded: limb by limb, with the exact remainder.
    #[inline]
    fn quotient(a: &Self, b: &Self) -> Self {
        let negative = a.negative ^ b.negative;
        if !(a.is_regular() && b.is_regular()) {
            return special(a, b);
        }
        let mut exponent = a.exponent - b.exponent;
        let (mut remainder, mut next) = (a.mantissa, 0);
        if fixed::compare(&a.mantissa, &b.mantissa) != Ordering::Less {
            next = a.mantissa[0] << 63;
            remainder = fixed::shift_down(&a.mantissa, 1);
            exponent += 1;
        }
        let divisor = TwoLimbs::new(b.mantissa[L - 1], b.mantissa[L - 2]);
        let mut quotient = [0; L];
        for limb in quotient.iter_mut().rev() {
            *limb = next_limb(&mut remainder, next, &b.mantissa, &divisor);
            next = 0;
        }
        Limbs::rounded(negative, exponent, quotient, below(&remainder, &b.mantissa))
    }

    /// x / n, correctly rounded.
    #[inline]
    pub fn over_integer(&self, n: i32) -> Self {
        let negative = self.negative ^ (n < 0);
        if !self.is_regular() || n == 0 {
            return special(self, &Limbs::from(n));
        }
        let n = n.unsigned_abs();
        if n.is_power_of_two() {
            return Limbs { negative, ..*self }.times_power_of_two(-(n.trailing_zeros() as i32));
        }
        let mut quotient = self.mantissa;
        let (below, more) = fixed::divide_limb(&mut quotient, n.into());
        let below = below | u64::from(more);
        let zeros = quotient[L - 1].leading_zeros(); // 1 to 31
        for i in (1..L).rev() {
            quotient[i] = quotient[i] << zeros | quotient[i - 1] >> (64 - zeros);
        }
        quotient[0] = quotient[0] << zeros | below >> (64 - zeros);
        Limbs::rounded(negative, self.exponent - zeros as i32, quotient, below << zeros)
    }
}

/// The next limb of the quotient; the remainder, which is less than d, moves up by a limb, `next` comes below it, and
/// the limb times d is taken away.
#[inline(always)]
fn next_limb<const L: usize>(remainder: &mut [u64; L], next: u64, d: &[u64; L], divisor: &TwoLimbs) -> u64 {
    let third = if L > 2 { remainder[L - 3] } else { next };
    let mut limb = divisor.quotient(remainder[L - 1], remainder[L - 2], third);
    let highest = remainder[L - 1];
    *remainder = fixed::limb_up(remainder);
    remainder[0] = next;
    if fixed::subtract_product_limb(remainder, d, limb) > highest {
        limb -= 1;
        fixed::add(remainder, d);
    }
    limb
}

/// As a limb below the quotient: how the remainder compares to d/2, and whether it is 0.
#[inline(always)]
fn below<const L: usize>(remainder: &[u64; L], d: &[u64; L]) -> u64 {
    match fixed::compare(remainder, &fixed::difference(d, remainder)) {
        Ordering::Less => u64::from(!fixed::is_zero(remainder)),
        Ordering::Equal => 1 << 63,
        Ordering::Greater => 1 << 63 | 1,
    }
}

/// The two highest limbs of a divisor and their reciprocal ⌊(2^192 − 1)/d⌋ − 2^64 (Möller and Granlund, algorithms 5
/// and 6).
pub(crate) struct TwoLimbs {
    limbs: u128,
    reciprocal: u64,
}

impl TwoLimbs {
    #[inline(always)]
    pub(crate) fn new(d1: u64, d0: u64) -> TwoLimbs {
        let mut reciprocal = Divisor::new(d1).reciprocal();
        let (mut p, carries) = d1.wrapping_mul(reciprocal).overflowing_add(d0);
        if carries {
            reciprocal -= 1;
            if p >= d1 {
                reciprocal -= 1;
                p -= d1;
            }
            p = p.wrapping_sub(d1);
        }
        let (low, high) = reciprocal.carrying_mul(d0, 0);
        let (p, carries) = p.overflowing_add(high);
        let limbs = u128::from(d1) << 64 | u128::from(d0);
        if carries {
            reciprocal -= 1;
            if u128::from(p) << 64 | u128::from(low) >= limbs {
                reciprocal -= 1;
            }
        }
        TwoLimbs { limbs, reciprocal }
    }

    /// ⌊u / d⌋ of three limbs, where the higher two are at most d; 2^64 − 1 where that is larger.
    #[inline(always)]
    pub(crate) fn quotient(&self, u2: u64, u1: u64, u0: u64) -> u64 {
        let high = u128::from(u2) << 64 | u128::from(u1);
        if high >= self.limbs {
            return u64::MAX;
        }
        let (d1, d0) = ((self.limbs >> 64) as u64, self.limbs as u64);
        let q = (u128::from(self.reciprocal) * u128::from(u2)).wrapping_add(high);
        let (mut q1, q0) = ((q >> 64) as u64, q as u64);
        let r1 = u1.wrapping_sub(q1.wrapping_mul(d1));
        let mut r = (u128::from(r1) << 64 | u128::from(u0))
            .wrapping_sub(u128::from(d0) * u128::from(q1))
            .wrapping_sub(self.limbs);
        q1 = q1.wrapping_add(1);
        if (r >> 64) as u64 >= q0 {
            q1 = q1.wrapping_sub(1);
            r = r.wrapping_add(self.limbs);
        }
        if r >= self.limbs { q1.wrapping_add(1) } else { q1 }
    }
}

/// Where a or b is 0, infinite or NaN.
#[cold]
fn special<const L: usize>(a: &Limbs<L>, b: &Limbs<L>) -> Limbs<L> {
    let negative = a.negative ^ b.negative;
    if a.is_nan() || b.is_nan() || a.is_zero() && b.is_zero() || a.is_infinite() && b.is_infinite() {
        Limbs::NAN
    } else if a.is_zero() || b.is_infinite() {
        Limbs { negative, ..Limbs::ZERO }
    } else {
        Limbs { negative, ..Limbs::INFINITY }
    }
}

impl<const L: usize> Div for &Limbs<L> {
    type Output = Limbs<L>;

    #[inline]
    fn div(self, b: &Limbs<L>) -> Limbs<L> {
        Limbs::quotient(self, b)
    }
}

impl<const L: usize> DivAssign<&Limbs<L>> for Limbs<L> {
    #[inline]
    fn div_assign(&mut self, b: &Limbs<L>) {
        *self = Limbs::quotient(self, b);
    }
}
