//! Residues modulo a prime, where independence and simple roots are seen at once: what holds there holds for integers.

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
