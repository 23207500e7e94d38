//! Sums and differences, correctly rounded.

use crate::{Limbs, fixed};
use std::ops::{Add, AddAssign, Neg, Sub, SubAssign};

impl<const L: usize> Limbs<L> {
    /// x ← a + b, correctly rounded; in place, faster than `x = &a + &b`.
    #[inline]
    pub fn set_sum(&mut self, a: &Self, b: &Self) {
        *self = quick_sum(a, b, false).unwrap_or_else(|| sum(*a, *b, false));
    }

    /// x ← a − b, correctly rounded; in place, faster than `x = &a - &b`.
    #[inline]
    pub fn set_difference(&mut self, a: &Self, b: &Self) {
        *self = quick_sum(a, b, true).unwrap_or_else(|| sum(*a, *b, true));
    }
}

/// a ± b of numbers whose exponents differ by less than 64, where at most one bit is lost.
#[inline(always)]
fn quick_sum<const L: usize>(a: &Limbs<L>, b: &Limbs<L>, minus: bool) -> Option<Limbs<L>> {
    if !(a.is_regular() & b.is_regular()) {
        return None;
    }
    let b_negative = b.negative ^ minus;
    let (large, small, negative) = if a.exponent >= b.exponent { (a, b, a.negative) } else { (b, a, b_negative) };
    let distance = (large.exponent - small.exponent) as u32;
    if distance >= 64 {
        return None;
    }
    let (mut mantissa, mut below) = shifted_by_bits(&small.mantissa, distance);
    let mut exponent = large.exponent;
    if a.negative == b_negative {
        if fixed::add(&mut mantissa, &large.mantissa) {
            (mantissa, below) = halved(mantissa, below);
            exponent += 1;
        }
    } else {
        let borrows;
        (mantissa, below, borrows) = difference(&large.mantissa, &mantissa, below);
        if borrows || mantissa[L - 1] >> 62 == 0 {
            return None;
        }
        if mantissa[L - 1] >> 63 == 0 {
            (mantissa, below) = doubled(mantissa, below);
            exponent -= 1;
        }
    }
    Limbs::quickly_rounded(negative, exponent, mantissa, below)
}

/// a ± b of any numbers.
#[inline(never)]
fn sum<const L: usize>(a: Limbs<L>, b: Limbs<L>, minus: bool) -> Limbs<L> {
    if !(a.is_regular() && b.is_regular()) {
        return special(&a, &b, minus);
    }
    let b_negative = b.negative ^ minus;
    let (large, small, negative) = if a.exponent >= b.exponent { (&a, &b, a.negative) } else { (&b, &a, b_negative) };
    let distance = (large.exponent - small.exponent) as u32;
    let (mut mantissa, mut below) = shifted(&small.mantissa, distance);
    let mut exponent = large.exponent;
    if a.negative == b_negative {
        if fixed::add(&mut mantissa, &large.mantissa) {
            (mantissa, below) = halved(mantissa, below);
            exponent += 1;
        }
    } else {
        let borrows;
        (mantissa, below, borrows) = difference(&large.mantissa, &mantissa, below);
        if borrows || mantissa[L - 1] >> 62 == 0 {
            return cancelled(negative, exponent, mantissa, below, borrows);
        }
        if mantissa[L - 1] >> 63 == 0 {
            (mantissa, below) = doubled(mantissa, below);
            exponent -= 1;
        }
    }
    Limbs::rounded(negative, exponent, mantissa, below)
}

/// a − (b + below / 2^64) with its limb below, and whether it borrows.
#[inline(always)]
fn difference<const L: usize>(a: &[u64; L], b: &[u64; L], below: u64) -> ([u64; L], u64, bool) {
    let (below, mut borrow) = 0u64.overflowing_sub(below);
    let mut difference = [0; L];
    for i in 0..L {
        (difference[i], borrow) = a[i].borrowing_sub(b[i], borrow);
    }
    (difference, below, borrow)
}

/// Half of 2^(64 L) + x.
#[inline(always)]
fn halved<const L: usize>(x: [u64; L], below: u64) -> ([u64; L], u64) {
    let mut half = [0; L];
    for i in 0..L {
        half[i] = x[i] >> 1 | if i + 1 < L { x[i + 1] << 63 } else { 1 << 63 };
    }
    (half, x[0] << 63 | below >> 1 | below & 1)
}

/// 2 x
#[inline(always)]
fn doubled<const L: usize>(x: [u64; L], below: u64) -> ([u64; L], u64) {
    let (mut double, mut carry) = ([0; L], below >> 63 != 0);
    for i in 0..L {
        (double[i], carry) = x[i].carrying_add(x[i], carry);
    }
    (double, below << 1)
}

/// A difference that lost more than a bit, thus exact, of numbers whose exponents differ by at most 1: below 0 only
/// where they are equal.
fn cancelled<const L: usize>(
    mut negative: bool,
    exponent: i32,
    mut mantissa: [u64; L],
    below: u64,
    borrow: bool,
) -> Limbs<L> {
    if borrow {
        fixed::negate(&mut mantissa);
        negative = !negative;
    }
    if fixed::is_zero(&mantissa) {
        // the exponents differed by 1, and 2^(64 L − 1) − (2^(64 L) − 1)/2 = 1/2
        let last = exponent - Limbs::<L>::BITS as i32;
        return if below == 0 {
            Limbs::ZERO
        } else {
            Limbs::rounded(negative, last, Limbs::<L>::power_of_two(1).mantissa, 0)
        };
    }
    let zeros = fixed::leading_zeros(&mantissa);
    mantissa = fixed::shift_up(&mantissa, zeros);
    fixed::add(&mut mantissa, &lowest(below, zeros));
    Limbs::rounded(negative, exponent - zeros as i32, mantissa, 0)
}

/// The bit below a difference, at its place after the shift.
fn lowest<const L: usize>(below: u64, zeros: u32) -> [u64; L] {
    let mut bit = [0; L];
    bit[0] = below >> 63;
    if zeros == 0 { [0; L] } else { fixed::shift_up(&bit, zeros - 1) }
}

/// a / 2^n: its integer part and the 64 bits below, the lowest of which is 1 where any after them is.
fn shifted<const L: usize>(a: &[u64; L], n: u32) -> ([u64; L], u64) {
    if n < 64 { shifted_by_bits(a, n) } else { shifted_by_limbs(a, n) }
}

/// The same for n < 64.
#[inline(always)]
fn shifted_by_bits<const L: usize>(a: &[u64; L], n: u32) -> ([u64; L], u64) {
    let n = n & 63;
    let mut shifted = [0; L];
    for i in 0..L - 1 {
        shifted[i] = a[i] >> n | a[i + 1] << 1 << (63 - n);
    }
    shifted[L - 1] = a[L - 1] >> n;
    (shifted, a[0] << 1 << (63 - n))
}

fn shifted_by_limbs<const L: usize>(a: &[u64; L], n: u32) -> ([u64; L], u64) {
    let (limbs, bits) = ((n / 64) as usize, n % 64);
    if limbs > L {
        return ([0; L], 1);
    }
    let at = |i: usize| if i < L { a[i] } else { 0 };
    let mut shifted = [0; L];
    for (i, limb) in shifted.iter_mut().enumerate() {
        *limb = at(i + limbs) >> bits | at(i + limbs + 1) << 1 << (63 - bits);
    }
    let mut lost = a[limbs - 1] << 1 << (63 - bits);
    for (i, limb) in a.iter().enumerate() {
        lost |= if i + 1 < limbs { *limb } else { 0 };
    }
    let below = a[limbs - 1] >> bits | at(limbs) << 1 << (63 - bits);
    (shifted, below | u64::from(lost != 0))
}

/// Where a or b is 0, infinite or NaN.
fn special<const L: usize>(a: &Limbs<L>, b: &Limbs<L>, minus: bool) -> Limbs<L> {
    let b = Limbs { negative: b.negative ^ minus, ..*b };
    let opposite = a.negative != b.negative;
    if a.is_nan() || b.is_nan() || a.is_infinite() && b.is_infinite() && opposite {
        Limbs::NAN
    } else if a.is_zero() && b.is_zero() {
        Limbs { negative: a.negative && b.negative, ..*a }
    } else if b.is_zero() || a.is_infinite() {
        *a
    } else {
        b
    }
}

impl<const L: usize> Add for &Limbs<L> {
    type Output = Limbs<L>;

    #[inline]
    fn add(self, b: &Limbs<L>) -> Limbs<L> {
        quick_sum(self, b, false).unwrap_or_else(|| sum(*self, *b, false))
    }
}

impl<const L: usize> Sub for &Limbs<L> {
    type Output = Limbs<L>;

    #[inline]
    fn sub(self, b: &Limbs<L>) -> Limbs<L> {
        quick_sum(self, b, true).unwrap_or_else(|| sum(*self, *b, true))
    }
}

impl<const L: usize> AddAssign<&Limbs<L>> for Limbs<L> {
    #[inline]
    fn add_assign(&mut self, b: &Limbs<L>) {
        *self = quick_sum(self, b, false).unwrap_or_else(|| sum(*self, *b, false));
    }
}

impl<const L: usize> SubAssign<&Limbs<L>> for Limbs<L> {
    #[inline]
    fn sub_assign(&mut self, b: &Limbs<L>) {
        *self = quick_sum(self, b, true).unwrap_or_else(|| sum(*self, *b, true));
    }
}

impl<const L: usize> Neg for Limbs<L> {
    type Output = Limbs<L>;

    #[inline]
    fn neg(self) -> Limbs<L> {
        Limbs { negative: !self.negative, ..self }
    }
}
