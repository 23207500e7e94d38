//! Arithmetic with new numbers for its results: for reports, not for steps.

use crate::Rational;
use crate::number::Ordered;

pub(super) fn integer<N: Ordered>(n: u64, context: &N::Context) -> N {
    N::from_rational(&Rational::from_integer(n.into()), context)
}

pub(super) fn difference<N: Ordered>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.subtract(b);
    result
}

pub(super) fn quotient<N: Ordered>(a: &N, b: &N) -> N {
    let mut result = a.clone();
    result.divide(b);
    result
}

pub(super) fn root<N: Ordered>(a: &N) -> N {
    let mut result = a.clone();
    result.assign_sqrt(a);
    result
}
