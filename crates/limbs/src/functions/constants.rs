//! π/4, log 2 and 2/π as fractions of limbs, the lowest first, rounded down: from series, at first use.

use crate::natural;
use std::sync::LazyLock;

pub(super) static QUARTER_PI: LazyLock<[u64; 18]> = LazyLock::new(|| highest(quarter_pi(1, 20), 20));

/// log 2 = 2 artanh 1/3
pub(super) static LOG_2: LazyLock<[u64; 18]> = LazyLock::new(|| highest(inverse_tangent(3, 2, 20, false), 20));

pub(super) static TWO_OVER_PI: LazyLock<[u64; 68]> = LazyLock::new(|| highest(two_over_pi(68), 68));

/// The limbs of 2/π after the point.
pub(super) fn two_over_pi(limbs: usize) -> Vec<u64> {
    let places = limbs + 2;
    let two = natural::shift_up(&[2], 128 * places as u64);
    let (mut quotient, _) = natural::quotient(&two, &quarter_pi(4, places));
    quotient.resize(places, 0);
    quotient.split_off(places - limbs)
}

/// n π/4 = n (4 arctan 1/5 − arctan 1/239) in units of 2^(-64 places)
fn quarter_pi(n: u64, places: usize) -> Vec<u64> {
    let mut angle = inverse_tangent(5, 4 * n, places, true);
    add_or_subtract(&mut angle, &inverse_tangent(239, n, places, true), true);
    angle
}

/// n arctan 1/k in units of 2^(-64 places), Σ (−1)^j n / ((2j + 1) k^(2j + 1)), or n artanh 1/k where signs do not
/// alternate.
fn inverse_tangent(k: u64, n: u64, places: usize, alternate: bool) -> Vec<u64> {
    let mut power = natural::shift_up(&[n], 64 * places as u64);
    natural::divide_by_limb(&mut power, k);
    let mut sum = power.clone();
    for j in 1.. {
        natural::divide_by_limb(&mut power, k * k);
        let mut term = power.clone();
        natural::divide_by_limb(&mut term, 2 * j + 1);
        if term.is_empty() {
            break;
        }
        add_or_subtract(&mut sum, &term, alternate && j % 2 == 1);
    }
    sum
}

/// x ← x ± a
fn add_or_subtract(x: &mut [u64], a: &[u64], minus: bool) {
    let mut carry = false;
    for (i, limb) in x.iter_mut().enumerate() {
        let a = a.get(i).copied().unwrap_or(0);
        (*limb, carry) = if minus { limb.borrowing_sub(a, carry) } else { limb.carrying_add(a, carry) };
    }
}

/// The highest limbs after the point of a number below 1 of `places` limbs.
fn highest<const N: usize>(mut number: Vec<u64>, places: usize) -> [u64; N] {
    number.resize(places, 0);
    std::array::from_fn(|i| number[places - N + i])
}
