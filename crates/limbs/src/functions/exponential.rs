//! The exponential function, and the hyperbolic ones.
//!
//! x = k log 2 + i/64 + d with |d| ≤ 1/128, and e^d = sinh d + √(1 + sinh² d): the series of the hyperbolic sine has
//! half of the terms.

use super::constants::LOG_2;
use super::fraction::{fraction, number, product, split, square};
use super::series::series;
use super::tables::{EXPONENTIALS, INVERSE_FACTORIALS};
use crate::newton::{root_of_fraction, top};
use crate::{Limbs, fixed};

/// e^x
pub(super) fn exp<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if x.is_regular() {
        return exp_times_power(x, 0);
    }
    match x {
        _ if x.is_nan() => Limbs::NAN,
        _ if x.is_zero() => Limbs::ONE,
        _ if x.negative => Limbs::ZERO,
        _ => Limbs::INFINITY,
    }
}

/// e^x 2^n, of x finite and not 0.
pub(super) fn exp_times_power<const W: usize>(x: &Limbs<W>, n: i64) -> Limbs<W> {
    if x.exponent > 31 {
        return if x.negative { Limbs::ZERO } else { Limbs::INFINITY };
    }
    let (k, rest) = over_log_2(x);
    let (i, d, is_negative) = split(&rest);
    let sinh = small_sinh(&d);
    // √(1 + sinh²)/2
    let mut quarter = fixed::shift_down(&square(&sinh), 2);
    quarter[W - 1] |= 1 << 62;
    let mut half = root_of_fraction(&quarter);
    let half_sinh = fixed::shift_down(&sinh, 1);
    if is_negative {
        fixed::subtract(&mut half, &half_sinh);
    } else {
        fixed::add(&mut half, &half_sinh);
    }
    number(&product(&half, &top(&EXPONENTIALS[i])), k + 2 + n)
}

/// k and x − k log 2 from 0 to log 2 or slightly more.
#[inline(always)]
fn over_log_2<const W: usize>(x: &Limbs<W>) -> (i64, [u64; W]) {
    let (whole, part) = if x.exponent > 0 {
        let bits = x.exponent as u32;
        (x.mantissa[W - 1] >> (64 - bits), fixed::shift_up(&x.mantissa, bits))
    } else {
        (0, fraction(x))
    };
    let log_2 = top(&LOG_2);
    let mut k = (x.abs().to_f64() / std::f64::consts::LN_2) as u64 + u64::from(x.negative);
    let mut rest = log_2;
    let carried = fixed::multiply_limb(&mut rest, k);
    let (above, borrows);
    if x.negative {
        borrows = fixed::subtract(&mut rest, &part);
        above = carried.wrapping_sub(whole).wrapping_sub(u64::from(borrows));
    } else {
        let product = std::mem::replace(&mut rest, part);
        borrows = fixed::subtract(&mut rest, &product);
        above = whole.wrapping_sub(carried).wrapping_sub(u64::from(borrows));
    }
    if above != 0 {
        // k from an `f64` was off by one
        fixed::add(&mut rest, &log_2);
        k = if x.negative { k + 1 } else { k - 1 };
    }
    (if x.negative { -(k as i64) } else { k as i64 }, rest)
}

/// sinh d of 0 ≤ d ≤ 1/128
#[inline(always)]
fn small_sinh<const W: usize>(d: &[u64; W]) -> [u64; W] {
    let mut sinh = product(d, &series(&square(d), 14, &INVERSE_FACTORIALS, false));
    fixed::add(&mut sinh, d);
    sinh
}

/// x sinh(d)/d for the fraction d of a number |x| ≤ 1/128: with the relative error of x however small that is.
fn sinh_of_small<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    let mut factor = fixed::shift_down(&series(&square(&fraction(x)), 14, &INVERSE_FACTORIALS, false), 1);
    factor[W - 1] |= 1 << 63;
    x * &number(&factor, 1)
}

/// Whether |x| ≤ 1/128.
fn is_small<const W: usize>(x: &Limbs<W>) -> bool {
    x.exponent <= -7
}

/// sinh x
pub(super) fn sinh<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if !x.is_regular() {
        return *x;
    }
    if is_small(x) {
        return sinh_of_small(x);
    }
    let (growing, decaying) = halves(x);
    Limbs { negative: x.negative, ..&growing - &decaying }
}

/// cosh x
pub(super) fn cosh<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if !x.is_regular() {
        return if x.is_zero() { Limbs::ONE } else { x.abs() };
    }
    let (growing, decaying) = halves(x);
    &growing + &decaying
}

/// e^|x|/2 and e^−|x|/2
fn halves<const W: usize>(x: &Limbs<W>) -> (Limbs<W>, Limbs<W>) {
    let growing = exp_times_power(&x.abs(), -1);
    (growing, (&Limbs::ONE / &growing).times_power_of_two(-2))
}

/// tanh x
pub(super) fn tanh<const W: usize>(x: &Limbs<W>) -> Limbs<W> {
    if x.is_infinite() || x.is_regular() && x.exponent > 12 {
        return Limbs { negative: x.negative, ..Limbs::ONE }; // 1 − tanh < e^−4096
    }
    if !x.is_regular() {
        return *x;
    }
    if is_small(x) {
        let sinh = sinh_of_small(x);
        return &sinh / &(&Limbs::ONE + &sinh.square()).sqrt();
    }
    let square = exp_times_power(&x.abs().times_power_of_two(1), 0);
    let tanh = &(&square - &Limbs::ONE) / &(&square + &Limbs::ONE);
    Limbs { negative: x.negative, ..tanh }
}
