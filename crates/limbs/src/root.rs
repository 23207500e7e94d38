//! √x and 1/√x, correctly rounded.

use crate::newton::{reciprocal_root, root};
use crate::{Limbs, fixed};

/// Limbs enough for the product of a number and the square of one with a bit more.
type Product = [u64; 54];

impl<const L: usize> Limbs<L> {
    /// √x, correctly rounded: of −0 it is −0, of x < 0 NaN.
    pub fn sqrt(&self) -> Self {
        if !self.is_regular() || self.negative {
            return match self {
                _ if self.is_zero() || self.is_infinite() && !self.negative => *self,
                _ => Limbs::NAN,
            };
        }
        let (mantissa, mut below) = root(&self.mantissa, self.halves());
        if near_a_tie(below) {
            let is_above = exceeds_square_of_middle(&self.mantissa, self.halves(), &mantissa);
            below = if is_above { u64::MAX } else { 0 };
        }
        Limbs::rounded(false, self.root_exponent(), mantissa, below)
    }

    /// 1/√x, correctly rounded: of 0 and −0 it is +∞, of x < 0 NaN.
    pub fn reciprocal_sqrt(&self) -> Self {
        if !self.is_regular() || self.negative {
            return match self {
                _ if self.is_zero() => Limbs::INFINITY,
                _ if self.is_infinite() && !self.negative => Limbs::ZERO,
                _ => Limbs::NAN,
            };
        }
        let exponent = 1 - self.root_exponent();
        if self.halves() && self.mantissa == Self::ONE.mantissa {
            return Self::power_of_two(exponent + 1);
        }
        let (mantissa, mut below) = reciprocal_root(&self.mantissa, self.halves());
        if near_a_tie(below) {
            let is_above = is_above_middle_of_reciprocal(&self.mantissa, self.halves(), &mantissa);
            below = if is_above { u64::MAX } else { 0 };
        }
        Limbs::rounded(false, exponent, mantissa, below)
    }

    /// Whether x = M 4^n with M half of the mantissa; else M is the mantissa.
    fn halves(&self) -> bool {
        self.exponent & 1 != 0
    }

    /// That n.
    fn root_exponent(&self) -> i32 {
        (self.exponent + 1) >> 1
    }
}

/// Whether the limb below an approximation, which errs by less than 2^44 units, is too close to 1/2.
fn near_a_tie(below: u64) -> bool {
    below.abs_diff(1 << 63) < 1 << 44
}

/// Whether M is above the square of (c + 1/2) / 2^(64 L).
#[cold]
fn exceeds_square_of_middle<const L: usize>(m: &[u64; L], halves: bool, c: &[u64; L]) -> bool {
    let square = square_of_middle(c);
    let m = halved(m, halves);
    let from_top = |i: usize| if i <= L { m[L - i] } else { 0 };
    (0..2 * L + 2).map(from_top).gt((0..2 * L + 2).map(|i| square[2 * L + 1 - i]))
}

/// Whether 1/(2√M) is above y = (c + 1/2) / 2^(64 L), that is, M y² below 1/4.
#[cold]
fn is_above_middle_of_reciprocal<const L: usize>(m: &[u64; L], halves: bool, c: &[u64; L]) -> bool {
    let mut product: Product = [0; 54];
    multiply(&halved(m, halves)[..L + 1], &square_of_middle(c)[..2 * L + 2], &mut product);
    product[3 * L + 2] >> 62 == 0
}

fn square_of_middle<const L: usize>(c: &[u64; L]) -> Product {
    let (mut middle, mut square) = ([0; 54], [0; 54]);
    middle[0] = 1 << 63;
    middle[1..=L].copy_from_slice(c);
    multiply(&middle[..=L], &middle[..=L], &mut square);
    square
}

/// M as L + 1 limbs.
fn halved<const L: usize>(m: &[u64; L], halves: bool) -> Product {
    let mut halved = [0; 54];
    halved[1..=L].copy_from_slice(m);
    if halves { fixed::shift_down(&halved, 1) } else { halved }
}

fn multiply(a: &[u64], b: &[u64], product: &mut Product) {
    for (i, a) in a.iter().enumerate() {
        let mut carry = 0;
        for (j, b) in b.iter().enumerate() {
            (product[i + j], carry) = a.carrying_mul_add(*b, product[i + j], carry);
        }
        product[i + b.len()] = carry;
    }
}
