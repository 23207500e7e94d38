//! Power series in fixed point, each term to the precision that it still needs.

use super::tables::Coefficient;

/// Σ ± u^n c\[n\] from n = 1 on, for 0 ≤ u < 2^-bits, to a few units of the last limb; all signs are +, or they
/// alternate and begin with +.
///
/// By Horner's rule: the sum from n on is multiplied by u^n, so its lowest n bits/64 limbs are left out, and so are its
/// highest ones that are 0. Its product with u has the limbs of the sum from n − 1 on.
#[inline(always)]
pub(super) fn series<const W: usize>(u: &[u64; W], bits: usize, c: &[Coefficient], alternate: bool) -> [u64; W] {
    let bits = bits.min(64 * W);
    let window = |n: usize| (n * bits / 64, W - c[n].zeros.min(W));
    let mut terms = 0;
    while terms + 1 < c.len() && window(terms + 1).0 < window(terms + 1).1 {
        terms += 1;
    }
    let (mut sum, mut product) = ([0; W], [0; W]);
    for n in (1..=terms).rev() {
        let (low, high) = window(n);
        let coefficient = &c[n].value[c[n].value.len() - W..];
        add_or_subtract(&mut sum[low..high], &coefficient[low..high], &product[low..high], alternate);
        let low = window(n - 1).0;
        high_product(&u[W - (high - low)..], &sum[low..high], &mut product[low..high]);
    }
    product
}

/// sum ← c ± product
#[inline(always)]
fn add_or_subtract(sum: &mut [u64], c: &[u64], product: &[u64], minus: bool) {
    let mut carry = false;
    for ((sum, c), product) in sum.iter_mut().zip(c).zip(product) {
        (*sum, carry) = if minus { c.borrowing_sub(*product, carry) } else { c.carrying_add(*product, carry) };
    }
}

/// The upper half of a b, of as many limbs as each of them, too small by a unit or so.
#[inline(always)]
fn high_product(a: &[u64], b: &[u64], high: &mut [u64]) {
    let n = a.len();
    high.fill(0);
    let mut below = 0;
    for (i, a) in a.iter().enumerate() {
        let mut carry = if i + 1 < n { a.carrying_mul(b[n - 2 - i], 0).1 } else { 0 };
        (below, carry) = a.carrying_mul_add(b[n - 1 - i], below, carry);
        for (high, b) in high[..i].iter_mut().zip(&b[n - i..]) {
            (*high, carry) = a.carrying_mul_add(*b, *high, carry);
        }
        high[i] = carry;
    }
}
