//! Arithmetic with new numbers for its results: for reports, not for steps.

use crate::Rational;
use crate::number::Number;

pub(super) fn integer<N: Number>(n: u64, context: &N::Context) -> N {
    N::from_rational(&Rational::from_integer(n.into()), context)
}

pub(super) fn difference<N: Number>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.subtract(b);
    result
}

pub(super) fn quotient<N: Number>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.divide(b);
    result
}

pub(super) fn root<N: Number>(a: &N) -> N {
    let mut result = a.clone();
    result.assign_sqrt(a);
    result
}
