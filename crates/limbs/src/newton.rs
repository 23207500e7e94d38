//! Newton's iteration for roots, in fixed point: numbers from 0 to 1 are integers of N limbs over 2^(64 N).
//!
//! The functions are compiled here for some widths N; a number of L limbs takes the smallest N > L.

use crate::fixed;

/// The first limbs of 1/(2√M), and the limb below, which errs by less than 2^44 units. M in (1/4, 1) is m, or half of
/// it.
pub(crate) fn reciprocal_root<const L: usize>(m: &[u64; L], halves: bool) -> ([u64; L], u64) {
    match L {
        2 => split(&reciprocal_root_3(&placed(m, halves))),
        3 => split(&reciprocal_root_4(&placed(m, halves))),
        4 => split(&reciprocal_root_5(&placed(m, halves))),
        5 => split(&reciprocal_root_6(&placed(m, halves))),
        6 | 7 => split(&reciprocal_root_8(&placed(m, halves))),
        8 | 9 => split(&reciprocal_root_10(&placed(m, halves))),
        10..=12 => split(&reciprocal_root_13(&placed(m, halves))),
        13..=16 => split(&reciprocal_root_17(&placed(m, halves))),
        _ => split(&reciprocal_root_18(&placed(m, halves))),
    }
}

/// The same of √M.
pub(crate) fn root<const L: usize>(m: &[u64; L], halves: bool) -> ([u64; L], u64) {
    match L {
        2 => split(&root_3(&placed(m, halves))),
        3 => split(&root_4(&placed(m, halves))),
        4 => split(&root_5(&placed(m, halves))),
        5 => split(&root_6(&placed(m, halves))),
        6 | 7 => split(&root_8(&placed(m, halves))),
        8 | 9 => split(&root_10(&placed(m, halves))),
        10..=12 => split(&root_13(&placed(m, halves))),
        13..=16 => split(&root_17(&placed(m, halves))),
        _ => split(&root_18(&placed(m, halves))),
    }
}

/// √M of a fraction M in [1/4, 1), to some units of its last limb.
#[inline(always)]
pub(crate) fn root_of_fraction<const N: usize>(m: &[u64; N]) -> [u64; N] {
    match N {
        3 => top(&root_3(&top(m))),
        4 => top(&root_4(&top(m))),
        5 => top(&root_5(&top(m))),
        6 => top(&root_6(&top(m))),
        8 => top(&root_8(&top(m))),
        10 => top(&root_10(&top(m))),
        13 => top(&root_13(&top(m))),
        17 => top(&root_17(&top(m))),
        _ => top(&root_18(&top(m))),
    }
}

macro_rules! compiled {
    ($($n:literal: $reciprocal:ident $root:ident $half:literal,)*) => {$(
        fn $reciprocal(m: &[u64; $n]) -> [u64; $n] {
            approximate_reciprocal::<$n>(m)
        }
        fn $root(m: &[u64; $n]) -> [u64; $n] {
            refine_root::<$half, $n>(&approximate_reciprocal(&top(m)), m)
        }
    )*};
}

// the width, and the width of the reciprocal that its square root starts from
compiled! {
    3: reciprocal_root_3 root_3 3,
    4: reciprocal_root_4 root_4 3,
    5: reciprocal_root_5 root_5 3,
    6: reciprocal_root_6 root_6 5,
    8: reciprocal_root_8 root_8 5,
    10: reciprocal_root_10 root_10 5,
    13: reciprocal_root_13 root_13 10,
    17: reciprocal_root_17 root_17 10,
    18: reciprocal_root_18 root_18 10,
}

/// M as N limbs.
#[inline(always)]
fn placed<const L: usize, const N: usize>(m: &[u64; L], halves: bool) -> [u64; N] {
    let m = top(m);
    if halves { fixed::shift_down(&m, 1) } else { m }
}

#[inline(always)]
fn split<const N: usize, const L: usize>(x: &[u64; N]) -> ([u64; L], u64) {
    (top(x), if N > L { x[N - L - 1] } else { 0 })
}

/// The highest limbs, or all limbs and zeros below.
#[inline(always)]
pub(crate) fn top<const A: usize, const B: usize>(x: &[u64; A]) -> [u64; B] {
    let mut highest = [0; B];
    for (i, limb) in highest.iter_mut().enumerate() {
        *limb = if A + i >= B && A + i - B < A { x[A + i - B] } else { 0 };
    }
    highest
}

/// 1/(2√M) to 154, 309, 617 bits or more.
#[inline(always)]
fn approximate_reciprocal<const N: usize>(m: &[u64; N]) -> [u64; N] {
    let three = start(&top(m));
    if N <= 3 {
        return top(&three);
    }
    if N <= 5 {
        return refine::<3, N>(&three, m);
    }
    let five = refine::<3, 5>(&three, &top(m));
    if N <= 10 {
        return refine::<5, N>(&five, m);
    }
    let ten = refine::<5, 10>(&five, &top(m));
    refine::<10, N>(&ten, m)
}

/// 1/(2√M) to 154 bits, from 52 of an `f64`: z ← z (1 − u/2 + 3 u²/8) with u = 4 M z² − 1, |u| < 2^-50.
#[inline(always)]
fn start(m: &[u64; 3]) -> [u64; 3] {
    let fraction = m[2] as f64 * 2f64.powi(-64);
    let z = (2f64.powi(63) / fraction.sqrt()) as u64; // 2^64 saturates
    let square = u128::from(z) * u128::from(z);
    let mut u = product_above(m, &[0, square as u64, (square >> 64) as u64], 3, 3);
    u = fixed::shift_up(&u, 2);
    let is_below = fixed::is_negative(&u);
    if is_below {
        fixed::negate(&mut u);
    }
    let mut second = product_above(&u, &u, 3, 3);
    fixed::multiply_limb(&mut second, 3);
    second = fixed::shift_down(&second, 3);
    u = fixed::shift_down(&u, 1);
    let mut start = [0, 0, z];
    if is_below {
        fixed::add(&mut u, &second);
        if fixed::add(&mut start, &product_above(&u, &[0, 0, z], 3, 3)) {
            start = [u64::MAX; 3];
        }
    } else {
        fixed::subtract(&mut u, &second);
        fixed::subtract(&mut start, &product_above(&u, &[0, 0, z], 3, 3));
    }
    start
}

/// Twice as many bits: z ← z (1 − u/2) with u = 4 M z² − 1, of which the limbs from H − 1 on differ from 0 or −1.
#[inline(always)]
fn refine<const H: usize, const N: usize>(z: &[u64; H], m: &[u64; N]) -> [u64; N] {
    let changed = (N + 1).saturating_sub(H);
    let mut u = product_above(m, &square(z), N, changed);
    let is_below = absolute_of_shifted(&mut u, changed, 2);
    let mut change = product_above(&top_limbs(z, changed), &u, changed, changed);
    for i in 0..changed {
        change[i] = change[i] >> 1 | if i + 1 < changed { change[i + 1] << 63 } else { 0 };
    }
    changed_by(z, &change, is_below)
}

/// √M from z = 1/(2√M) to half of the bits: s = 2 M z, s ← s + z (M − s²).
#[inline(always)]
fn refine_root<const H: usize, const N: usize>(z: &[u64; H], m: &[u64; N]) -> [u64; N] {
    let mut s = product_above(&top(m), z, H, H);
    s = if fixed::is_negative(&s) { [u64::MAX; H] } else { fixed::shift_up(&s, 1) };
    let changed = (N + 1).saturating_sub(H);
    let mut u = square(&s);
    fixed::subtract(&mut u, m);
    let is_below = absolute_of_shifted(&mut u, changed, 0);
    changed_by(&s, &product_above(&top_limbs(z, changed), &u, changed, changed), is_below)
}

/// z ± change
#[inline(always)]
fn changed_by<const H: usize, const N: usize>(z: &[u64; H], change: &[u64; N], plus: bool) -> [u64; N] {
    let mut changed = top(z);
    if !plus {
        fixed::subtract(&mut changed, change);
    } else if fixed::add(&mut changed, change) {
        return [u64::MAX; N];
    }
    changed
}

/// The highest limbs of z².
#[inline(always)]
fn square<const H: usize, const N: usize>(z: &[u64; H]) -> [u64; N] {
    let (low, high) = fixed::product(z, z);
    let mut square = [0; N];
    for (down, limb) in square.iter_mut().rev().enumerate() {
        *limb = match down {
            _ if down < H => high[H - 1 - down],
            _ if down < 2 * H => low[2 * H - 1 - down],
            _ => 0,
        };
    }
    square
}

/// |u 2^shift| of the lowest limbs alone, which have a sign; whether that is −.
#[inline(always)]
fn absolute_of_shifted<const N: usize>(u: &mut [u64; N], limbs: usize, shift: u32) -> bool {
    for i in (0..limbs).rev() {
        u[i] = u[i] << shift | if i > 0 { u[i - 1] >> 1 >> (63 - shift) } else { 0 };
    }
    let is_negative = u[limbs - 1] >> 63 != 0;
    let mask = u64::from(is_negative).wrapping_neg();
    let mut carry = is_negative;
    for (i, limb) in u.iter_mut().enumerate() {
        (*limb, carry) = if i < limbs { (*limb ^ mask).carrying_add(0, carry) } else { (0, false) };
    }
    is_negative
}

/// The highest limbs, as the lowest ones of an array.
#[inline(always)]
fn top_limbs<const H: usize, const N: usize>(z: &[u64; H], limbs: usize) -> [u64; N] {
    let mut highest = [0; N];
    for (i, limb) in highest.iter_mut().enumerate() {
        *limb = if i < limbs && H + i >= limbs { z[H + i - limbs] } else { 0 };
    }
    highest
}

/// The lowest `columns` limbs of ⌊a b / 2^(64 n)⌋, a and b of n limbs, too small by a unit or so.
#[inline(always)]
fn product_above<const N: usize>(a: &[u64; N], b: &[u64; N], n: usize, columns: usize) -> [u64; N] {
    let (mut high, mut below) = ([0; N], 0);
    for i in 0..n {
        let mut carry = if i + 1 < n { a[i].carrying_mul(b[n - 2 - i], 0).1 } else { 0 };
        (below, carry) = a[i].carrying_mul_add(b[n - 1 - i], below, carry);
        for j in n - i..n {
            if i + j < n + columns {
                (high[i + j - n], carry) = a[i].carrying_mul_add(b[j], high[i + j - n], carry);
            }
        }
        if i < columns {
            high[i] = carry;
        }
    }
    high
}
