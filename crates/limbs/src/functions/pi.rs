//! 2/π to any number of limbs, for sines of huge arguments.

use crate::natural;

/// The limbs of 2/π after the point, the lowest first, from π = 16 arctan 1/5 − 4 arctan 1/239.
pub(super) fn two_over_pi(limbs: usize) -> Vec<u64> {
    let places = limbs + 2;
    let mut pi = inverse_tangent(5, 16, places);
    let other = inverse_tangent(239, 4, places);
    subtract(&mut pi, &other);
    let two = natural::shift_up(&[2], 128 * places as u64);
    let (mut quotient, _) = natural::quotient(&two, &pi);
    quotient.resize(places, 0);
    quotient.split_off(places - limbs)
}

/// n arctan 1/k in units of 2^(-64 places): Σ (−1)^j n / ((2j + 1) k^(2j + 1)).
fn inverse_tangent(k: u64, n: u64, places: usize) -> Vec<u64> {
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
        if j % 2 == 0 { add(&mut sum, &term) } else { subtract(&mut sum, &term) }
    }
    sum
}

fn add(x: &mut [u64], a: &[u64]) {
    let mut carry = false;
    for (i, limb) in x.iter_mut().enumerate() {
        (*limb, carry) = limb.carrying_add(a.get(i).copied().unwrap_or(0), carry);
    }
}

fn subtract(x: &mut [u64], a: &[u64]) {
    let mut borrow = false;
    for (i, limb) in x.iter_mut().enumerate() {
        (*limb, borrow) = limb.borrowing_sub(a.get(i).copied().unwrap_or(0), borrow);
    }
}
