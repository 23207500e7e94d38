//! Integer polynomials without their squares: what is left changes its sign where the whole does.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::prime::{self, PRIME};

/// The product of the factors of odd multiplicity, each once, with the polynomial's sign.
pub(crate) fn odd_part(polynomial: Vec<BigInt>) -> Vec<BigInt> {
    if polynomial.len() <= 2 || is_surely_squarefree(&polynomial.iter().map(prime::residue).collect::<Vec<_>>()) {
        return polynomial;
    }
    // Yun's algorithm: the factors of multiplicity 1, 2, 3, …
    let positive = polynomial.last().is_some_and(Signed::is_positive);
    let slope = derivative(&polynomial);
    let common = gcd(polynomial.clone(), slope.clone());
    let (mut b, mut c) = (quotient(&polynomial, &common), quotient(&slope, &common));
    let (mut odd, mut multiplicity) = (vec![BigInt::one()], 1);
    while b.len() > 1 {
        let d = difference(&c, &derivative(&b));
        let factor = gcd(b.clone(), d.clone());
        if multiplicity % 2 == 1 {
            odd = product(&odd, &factor);
        }
        (b, c) = (quotient(&b, &factor), quotient(&d, &factor));
        multiplicity += 1;
    }
    if odd.last().is_some_and(Signed::is_positive) != positive {
        odd.iter_mut().for_each(|value| *value = -&*value);
    }
    odd
}

fn derivative(polynomial: &[BigInt]) -> Vec<BigInt> {
    polynomial.iter().enumerate().skip(1).map(|(k, value)| value * k).collect()
}

fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut product = vec![BigInt::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

fn difference(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let at = |values: &[BigInt], i: usize| values.get(i).cloned().unwrap_or_default();
    trimmed((0..a.len().max(b.len())).map(|i| at(a, i) - at(b, i)).collect())
}

fn trimmed(mut polynomial: Vec<BigInt>) -> Vec<BigInt> {
    while polynomial.last().is_some_and(Zero::is_zero) {
        polynomial.pop();
    }
    polynomial
}

/// The quotient of a division that leaves nothing.
fn quotient(polynomial: &[BigInt], divisor: &[BigInt]) -> Vec<BigInt> {
    let Some(length) = (polynomial.len() + 1).checked_sub(divisor.len()) else { return Vec::new() };
    let (mut rest, mut quotient) = (polynomial.to_vec(), vec![BigInt::zero(); length]);
    let (lead, lower) = divisor.split_last().expect("a divisor is not 0");
    for i in (0..length).rev() {
        quotient[i] = &rest[i + lower.len()] / lead;
        for (j, value) in lower.iter().enumerate() {
            rest[i + j] -= &quotient[i] * value;
        }
    }
    quotient
}

/// The greatest common divisor with coprime coefficients, the leading one positive: Euclid's algorithm with
/// pseudo-remainders.
fn gcd(mut a: Vec<BigInt>, mut b: Vec<BigInt>) -> Vec<BigInt> {
    while !b.is_empty() {
        while a.len() >= b.len() {
            let (lead, other) = (a[a.len() - 1].clone(), &b[b.len() - 1]);
            let shift = a.len() - b.len();
            a.iter_mut().for_each(|value| *value *= other);
            b.iter().zip(&mut a[shift..]).for_each(|(value, rest)| *rest -= &lead * value);
            a = trimmed(a);
        }
        a = primitive(a);
        std::mem::swap(&mut a, &mut b);
    }
    let a = primitive(a);
    if a.last().is_some_and(Signed::is_negative) { a.iter().map(|value| -value).collect() } else { a }
}

/// Without the common divisor of the coefficients.
fn primitive(polynomial: Vec<BigInt>) -> Vec<BigInt> {
    let content = polynomial.iter().fold(BigInt::zero(), |content, value| content.gcd(value));
    if content.is_zero() { polynomial } else { polynomial.iter().map(|value| value / &content).collect() }
}

/// Whether a polynomial, given by its residues modulo the prime, has no multiple root there, and so none at all. One
/// that has none fails the test only if the prime divides its discriminant.
pub(crate) fn is_surely_squarefree(residues: &[u64]) -> bool {
    let mut a = residues.to_vec();
    let mut b: Vec<u64> = a.iter().enumerate().skip(1).map(|(k, value)| prime::product(*value, k as u64)).collect();
    if a.last() == Some(&0) {
        return false;
    }
    while let Some(position) = b.iter().rposition(|value| *value != 0) {
        b.truncate(position + 1);
        let inverse = prime::power(b[position], PRIME - 2);
        while a.len() >= b.len() {
            let factor = PRIME - prime::product(a.pop().expect("it is long enough"), inverse);
            let shift = a.len() - position;
            prime::add_multiple(&mut a[shift..], factor, &b[..position]);
        }
        std::mem::swap(&mut a, &mut b);
    }
    a.len() == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integers(values: &[i64]) -> Vec<BigInt> {
        values.iter().map(|value| BigInt::from(*value)).collect()
    }

    /// −7 (x − 1) (x + 2)² (2x − 3)³ (x² + 1)
    fn with_squares() -> Vec<BigInt> {
        let factors: [&[i64]; 8] = [&[-7], &[-1, 1], &[2, 1], &[2, 1], &[-3, 2], &[-3, 2], &[-3, 2], &[1, 0, 1]];
        factors.iter().fold(integers(&[1]), |whole, factor| product(&whole, &integers(factor)))
    }

    #[test]
    fn factors_of_odd_multiplicity_stay_once() {
        let odd: [&[i64]; 4] = [&[-1], &[-1, 1], &[-3, 2], &[1, 0, 1]];
        let odd = odd.iter().fold(integers(&[1]), |whole, factor| product(&whole, &integers(factor)));
        assert_eq!(odd_part(with_squares()), odd);
        assert_eq!(odd_part(integers(&[-4, 8, -4])), integers(&[-1]));
    }

    #[test]
    fn what_has_no_squares_stays_as_it_is() {
        let residues = |polynomial: &[BigInt]| -> Vec<u64> { polynomial.iter().map(prime::residue).collect() };
        for polynomial in [integers(&[2, -4, 1]), integers(&[6, 0, -6]), integers(&[3, -2]), integers(&[5])] {
            assert!(is_surely_squarefree(&residues(&polynomial)));
            assert_eq!(odd_part(polynomial.clone()), polynomial);
        }
        assert!(!is_surely_squarefree(&residues(&with_squares())));
    }
}
