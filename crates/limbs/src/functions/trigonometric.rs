//! Sine, cosine and tangent.
//!
//! x = k π/2 + r with |r| ≤ π/4, however large x is: 2/π is multiplied with as many limbs as are needed (Payne and
//! Hanek). Then
//! |r| = i/64 + d with |d| ≤ 1/128, sin d by its series and cos d = √(1 − sin² d).

use super::constants::{QUARTER_PI, TWO_OVER_PI, two_over_pi};
use super::fraction::{fraction, number, product, split, square};
use super::series::series;
use super::tables::{INVERSE_FACTORIALS, SINES};
use crate::newton::{root_of_fraction, top};
use crate::{Limbs, fixed};

/// Numbers of larger exponents have no sine here.
pub(super) const LARGEST_EXPONENT: i32 = 1 << 16;

/// sin x and cos x
pub(super) fn sin_cos<const W: usize>(x: &Limbs<W>) -> (Limbs<W>, Limbs<W>) {
    if !x.is_regular() || x.exponent > LARGEST_EXPONENT {
        return if x.is_zero() { (*x, Limbs::ONE) } else { (Limbs::NAN, Limbs::NAN) };
    }
    let (quadrant, r) = reduced(&x.abs());
    let (sin, cos) = of_eighth(&r.abs());
    let sin = Limbs { negative: r.negative, ..sin };
    let (sin, cos) = match quadrant {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    };
    (Limbs { negative: sin.negative ^ x.negative, ..sin }, cos)
}

/// tan x
pub(super) fn tan<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    let (sin, cos) = sin_cos(x);
    &sin / &cos
}

/// sin r and cos r for 0 ≤ r ≤ π/4
#[inline(always)]
fn of_eighth<const W: usize>(r: &Limbs<W>) -> (Limbs<W>, Limbs<W>) {
    let (i, d, is_negative) = split(&fraction(r));
    let less = series(&square(&d), 14, &INVERSE_FACTORIALS, true); // 1 − sin(d)/d
    let sin = fixed::difference(&d, &product(&d, &less));
    let cos = cos_from(&sin);
    if i == 0 {
        let mut factor = less;
        fixed::negate(&mut factor);
        let sin = if fixed::is_zero(&less) { *r } else { r * &number(&factor, 0) };
        return (sin, cos.map_or(Limbs::ONE, |cos| number(&cos, 0)));
    }
    let cos = cos.unwrap_or([u64::MAX; W]);
    let [sin_i, cos_i] = SINES[i].each_ref().map(top);
    let (mut sum, mut difference) = (product(&sin_i, &cos), product(&cos_i, &cos));
    let (change, other) = (product(&cos_i, &sin), product(&sin_i, &sin));
    if is_negative {
        fixed::subtract(&mut sum, &change);
        fixed::add(&mut difference, &other);
    } else {
        fixed::add(&mut sum, &change);
        fixed::subtract(&mut difference, &other);
    }
    (number(&sum, 0), number(&difference, 0))
}

/// √(1 − sin²), if that is less than 1.
#[inline(always)]
fn cos_from<const W: usize>(sin: &[u64; W]) -> Option<[u64; W]> {
    let mut m = square(sin);
    if fixed::is_zero(&m) {
        return None;
    }
    fixed::negate(&mut m);
    Some(root_of_fraction(&m))
}

/// k modulo 4 and r = x − k π/2, |r| ≤ π/4, of x > 0: with the relative error of a number, however close x is to a
/// multiple of π/2.
#[inline(always)]
fn reduced<const W: usize>(x: &Limbs<W>) -> (u64, Limbs<W>) {
    if x.exponent < 0 {
        return (0, *x);
    }
    let (quadrant, part) = match quarters(x, W + 1) {
        (quadrant, part, zeros) if zeros < 40 => (quadrant, part),
        _ => {
            let (quadrant, part, _) = quarters(x, 2 * W + 2);
            (quadrant, part)
        }
    };
    (quadrant, &part * &number(&top(&QUARTER_PI), 1))
}

/// The integer k nearest to 2 x/π, modulo 4, and 2 x/π − k from a number of limbs after the point, and how many of
/// their leading bits are 0.
#[inline(always)]
fn quarters<const W: usize>(x: &Limbs<W>, limbs: usize) -> (u64, Limbs<W>, u32) {
    let (up, bits) = (x.exponent as usize / 64, x.exponent as u32 % 64);
    let stored: &[u64] = &*TWO_OVER_PI;
    let computed = if up + limbs > stored.len() { two_over_pi(up + limbs) } else { Vec::new() };
    let digits = if computed.is_empty() { stored } else { &computed };
    // x = m 2^(64 (up − W)), m of W + 1 limbs, and the product by columns of weight 2^(64 (column − limbs))
    let mut m = [0; 18];
    m[..W].copy_from_slice(&x.mantissa);
    let m = fixed::shift_up(&m, bits);
    let mut product = [0; 38];
    for (i, limb) in m.iter().enumerate().take(W + 1) {
        let Some(end) = (i + up + limbs).checked_sub(W) else { continue };
        let mut carry = 0;
        for column in 0..end.min(limbs + 1) {
            let digit = digits[digits.len() - (end - column)];
            (product[column], carry) = limb.carrying_mul_add(digit, product[column], carry);
        }
        if end <= limbs {
            product[end] = carry;
        }
    }
    rounded(&mut product, limbs)
}

/// The integer nearest to the columns, and the rest with its sign and leading zeros.
#[inline(always)]
fn rounded<const W: usize>(columns: &mut [u64; 38], limbs: usize) -> (u64, Limbs<W>, u32) {
    let mut quadrant = columns[limbs];
    let negative = columns[limbs - 1] >> 63 != 0;
    if negative {
        quadrant = quadrant.wrapping_add(1);
        fixed::negate(columns);
    }
    columns[limbs..].fill(0);
    let part = Limbs::from_magnitude(negative, &columns[..limbs], -64 * limbs as i64, true);
    (quadrant & 3, part, part.exponent().map_or(u32::MAX, i32::unsigned_abs))
}
