//! Matrices of exact flows: computed in more digits than a run has, and rounded once.
//!
//! Functions are `inline`: a program without such flows compiles no numbers of limbs.

use crate::Rational;
use crate::number::{AnyLimbs, CorrectlyRounded, LimbCount, Number};

/// A matrix, row by row.
pub(crate) type Matrix<N> = Vec<Vec<N>>;

/// At most this number of flows is kept; for a caller with more times the oldest are computed again.
pub(crate) const MOST_KEPT: usize = 256;

/// With terms that fall by 16 and more, fewer make the digits of 17 limbs.
pub(crate) const MOST_TERMS: i32 = 300;

/// The flow of a quadratic form is computed for numbers of at most this number of digits.
pub const QUADRATIC_FLOW_DIGITS: u32 = 288;

/// Bits beyond the bits of the run: doubling t k times may lose 2k of them.
const GUARD_BITS: u32 = 128;

/// The numbers in which flows are computed; `None` if the run has more digits than they.
pub(crate) fn precision<N: CorrectlyRounded>(context: &N::Context) -> Option<LimbCount> {
    LimbCount::of_bits(N::precision(context).in_bits() + GUARD_BITS)
}

/// The matrix in the numbers of a run.
pub(crate) fn round<N: CorrectlyRounded>(matrix: &Matrix<AnyLimbs>, zero: &N) -> Matrix<N> {
    let rounded = |value: &AnyLimbs| {
        let mut number = zero.clone();
        number.assign_rounded(value);
        number
    };
    matrix.iter().map(|row| row.iter().map(rounded).collect()).collect()
}

/// a b
#[inline]
pub(crate) fn product(a: &Matrix<AnyLimbs>, b: &Matrix<AnyLimbs>, count: LimbCount) -> Matrix<AnyLimbs> {
    let entry = |row: &[AnyLimbs], column: usize| {
        let mut sum = AnyLimbs::zero(count);
        row.iter().zip(b).for_each(|(a, b)| sum.add_product(a, &b[column]));
        sum
    };
    a.iter().map(|row| (0..b.len()).map(|column| entry(row, column)).collect()).collect()
}

/// a ← a + b
#[inline]
pub(crate) fn add(a: &mut Matrix<AnyLimbs>, b: &Matrix<AnyLimbs>) {
    a.iter_mut().flatten().zip(b.iter().flatten()).for_each(|(a, b)| a.add(b));
}

/// a ← a n
#[inline]
pub(crate) fn scale(a: &mut Matrix<AnyLimbs>, by: i32) {
    a.iter_mut().flatten().for_each(|x| x.multiply_integer(by));
}

/// a ← a + n
#[inline]
pub(crate) fn add_to_diagonal(a: &mut Matrix<AnyLimbs>, number: u32, count: LimbCount) {
    let by = AnyLimbs::from_rational(&Rational::from_integer(number.into()), &count);
    a.iter_mut().enumerate().for_each(|(i, row)| row[i].add(&by));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Precision;

    #[test]
    fn most_digits_are_those_of_the_longest_limbs() {
        let fits = |digits| LimbCount::of_bits(Precision::digits(digits).unwrap().in_bits() + GUARD_BITS).is_some();
        assert!(fits(QUADRATIC_FLOW_DIGITS) && !fits(QUADRATIC_FLOW_DIGITS + 1));
    }
}
