//! Arithmetic with new numbers for its results: for reports, not for steps.

use crate::Rational;
use crate::number::Real;

pub(super) fn integer<N: Real>(n: u64, context: &N::Context) -> N {
    N::from_rational(&Rational::from_integer(n.into()), context)
}

pub(super) fn difference<N: Real>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.subtract(b);
    result
}

pub(super) fn quotient<N: Real>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.divide(b);
    result
}

pub(super) fn root<N: Real>(a: &N) -> N {
    let mut result = a.clone();
    result.assign_sqrt(a);
    result
}
