//! Natural numbers of any size, lowest limb first, for decimal text.

use crate::quotient::TwoLimbs;

/// Removes the zeros above the highest limb.
fn trim(x: &mut Vec<u64>) {
    while x.last() == Some(&0) {
        x.pop();
    }
}

/// ⌊log₂ x⌋ + 1, of 0 it is 0.
pub(crate) fn bits(x: &[u64]) -> u64 {
    x.last().map_or(0, |highest| 64 * x.len() as u64 - u64::from(highest.leading_zeros()))
}

/// x ← n x + digit
pub(crate) fn multiply_and_add(x: &mut Vec<u64>, n: u64, digit: u64) {
    let mut carry = digit;
    for limb in &mut *x {
        (*limb, carry) = limb.carrying_mul(n, carry);
    }
    if carry != 0 {
        x.push(carry);
    }
}

/// x ← ⌊x / n⌋; the remainder.
pub(crate) fn divide_by_limb(x: &mut Vec<u64>, n: u64) -> u64 {
    let mut remainder = 0;
    for limb in x.iter_mut().rev() {
        let dividend = u128::from(remainder) << 64 | u128::from(*limb);
        *limb = (dividend / u128::from(n)) as u64;
        remainder = (dividend % u128::from(n)) as u64;
    }
    trim(x);
    remainder
}

/// a b
pub(crate) fn product(a: &[u64], b: &[u64]) -> Vec<u64> {
    let mut product = vec![0; a.len() + b.len()];
    for (i, a) in a.iter().enumerate() {
        let mut carry = 0;
        for (j, b) in b.iter().enumerate() {
            (product[i + j], carry) = a.carrying_mul_add(*b, product[i + j], carry);
        }
        product[i + b.len()] = carry;
    }
    trim(&mut product);
    product
}

/// x 2^n
pub(crate) fn shift_up(x: &[u64], n: u64) -> Vec<u64> {
    let (limbs, bits) = ((n / 64) as usize, n % 64);
    let at = |i: usize| x.get(i).copied().unwrap_or(0);
    let mut shifted = vec![0; limbs];
    shifted.extend((0..=x.len()).map(|i| at(i) << bits | at(i.wrapping_sub(1)) >> 1 >> (63 - bits)));
    trim(&mut shifted);
    shifted
}

/// ⌊x / 2^n⌋, and whether the remainder is 0.
pub(crate) fn shift_down(x: &[u64], n: u64) -> (Vec<u64>, bool) {
    let (limbs, bits) = ((n / 64) as usize, n % 64);
    let at = |i: usize| x.get(i).copied().unwrap_or(0);
    let mut shifted: Vec<u64> = (limbs..x.len()).map(|i| at(i) >> bits | at(i + 1) << 1 << (63 - bits)).collect();
    trim(&mut shifted);
    let lost = x.iter().take(limbs).any(|limb| *limb != 0) || at(limbs) & ((1 << bits) - 1) != 0;
    (shifted, !lost)
}

/// ⌊a / b⌋, and whether the remainder is 0; b > 0.
pub(crate) fn quotient(a: &[u64], b: &[u64]) -> (Vec<u64>, bool) {
    let zeros = u64::from(b[b.len() - 1].leading_zeros());
    let (mut b, mut remainder) = (shift_up(b, zeros), shift_up(a, zeros));
    if b.len() == 1 {
        b.insert(0, 0); // the algorithm takes two limbs of the divisor
        remainder.insert(0, 0);
    }
    let n = b.len();
    remainder.resize(remainder.len().max(n) + 1, 0);
    let divisor = TwoLimbs::new(b[n - 1], b[n - 2]);
    let mut quotient = vec![0; remainder.len() - n];
    for k in (0..quotient.len()).rev() {
        let mut limb = divisor.quotient(remainder[k + n], remainder[k + n - 1], remainder[k + n - 2]);
        let part = &mut remainder[k..=k + n];
        let mut carry = 0;
        for (x, b) in part.iter_mut().zip(b.iter().chain([&0])) {
            let (product, high) = b.carrying_mul(limb, carry);
            let (difference, borrow) = x.overflowing_sub(product);
            (*x, carry) = (difference, high + u64::from(borrow));
        }
        if carry != 0 {
            limb -= 1;
            let mut carry = false;
            for (x, b) in part.iter_mut().zip(b.iter().chain([&0])) {
                (*x, carry) = x.carrying_add(*b, carry);
            }
        }
        quotient[k] = limb;
    }
    trim(&mut quotient);
    (quotient, remainder.iter().all(|limb| *limb == 0))
}

/// The decimal digits; none of 0.
pub(crate) fn digits(mut x: Vec<u64>) -> String {
    const CHUNK: usize = 19;
    let mut chunks = Vec::new();
    while !x.is_empty() {
        chunks.push(divide_by_limb(&mut x, 10u64.pow(CHUNK as u32)));
    }
    let text: String = chunks.iter().rev().map(|chunk| format!("{chunk:0CHUNK$}")).collect();
    text.trim_start_matches('0').to_owned()
}
