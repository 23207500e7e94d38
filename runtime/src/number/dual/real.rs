//! Comparisons, texts and roundings of dual numbers: those of x.

use std::cmp::Ordering;
use std::fmt;

use super::Dual;
use crate::number::{CorrectlyRounded, HighPrecision, Precision, Real};

impl<N: PartialEq, const K: usize> PartialEq for Dual<N, K> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<N: PartialOrd, const K: usize> PartialOrd for Dual<N, K> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<N: fmt::Display, const K: usize> fmt::Display for Dual<N, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl<N: Real, const K: usize> Real for Dual<N, K> {
    fn is_below_zero(&self) -> bool {
        self.value.is_below_zero()
    }

    fn has_finite_square(&self) -> bool {
        self.value.has_finite_square()
    }

    fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    fn log10_abs(&self) -> f64 {
        self.value.log10_abs()
    }

    fn to_text(&self) -> String {
        self.value.to_text()
    }
}

/// What is rounded is a constant, until its derivatives are set.
impl<N: CorrectlyRounded, const K: usize> CorrectlyRounded for Dual<N, K> {
    fn precision(context: &N::Context) -> Precision {
        N::precision(context)
    }

    fn assign_rounded(&mut self, a: &impl HighPrecision) {
        self.value.assign_rounded(a);
        self.derivatives.iter_mut().for_each(N::assign_zero);
    }

    const DERIVATIVES: usize = K;

    fn derivative_text(&self, k: usize) -> String {
        self.derivatives[k].to_text()
    }

    fn assign_rounded_derivative(&mut self, k: usize, a: &impl HighPrecision) {
        self.derivatives[k].assign_rounded(a);
    }
}
