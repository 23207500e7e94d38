//! Residues modulo a prime, where independence and simple roots are seen at once: what holds there holds for integers.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::ToPrimitive;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::symbolic::Rational;

/// 2^61 − 1
pub(crate) const PRIME: u64 = (1 << 61) - 1;

pub(crate) fn product(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(PRIME)) as u64
}

pub(crate) fn power(base: u64, mut exponent: u64) -> u64 {
    let (mut result, mut square) = (1, base);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = product(result, square);
        }
        square = product(square, square);
        exponent >>= 1;
    }
    result
}

/// row += factor·other
pub(crate) fn add_multiple(row: &mut [u64], factor: u64, other: &[u64]) {
    for (value, other) in row.iter_mut().zip(other) {
        *value = ((u128::from(*value) + u128::from(factor) * u128::from(*other)) % u128::from(PRIME)) as u64;
    }
}

/// Arithmetic modulo the prime, for weights whose denominators it does not divide.
pub(crate) struct Residues;

impl Arithmetic for Residues {
    type Value = u64;
    fn zero(&self) -> u64 {
        0
    }
    fn one(&self) -> u64 {
        1
    }
    fn weight(&self, weight: &Rational) -> u64 {
        product(residue(weight.numer()), power(residue(weight.denom()), PRIME - 2))
    }
    fn add_product(&self, target: &mut u64, a: &u64, b: &u64) {
        *target = (*target + product(*a, *b)) % PRIME;
    }
    fn divide(&self, a: &u64, n: u32) -> u64 {
        product(*a, power(n.into(), PRIME - 2))
    }
}

pub(crate) fn residue(value: &BigInt) -> u64 {
    value.mod_floor(&PRIME.into()).to_u64().expect("it is less than the prime")
}
