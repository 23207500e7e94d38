//! Values of a formula and its parts, and why an attempt gave none.

use std::ops::Range;

use crate::symbolic::number::elementary::pi;
use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::error::{SemanticError, SemanticFault};

/// A number as a rational.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exact {
    /// The number, or the decimal that stands for it.
    pub value: Rational,
    /// Whether it depends on an irrational number (a root, a value of a function or π), directly or through a name.
    pub rounded: bool,
}

/// The value of a part of the expression.
pub(super) enum Value {
    Exact(Exact),
    /// A rational multiple of π.
    OfPi(Rational),
    /// Some number in the interval.
    Enclosed(Interval),
}

impl Value {
    /// An interval that it is in, of a multiple of π to some digits.
    pub(super) fn interval(&self, digits: u32) -> Interval {
        match self {
            Value::Exact(exact) => Interval::point(&exact.value),
            Value::OfPi(multiple) => pi(digits).times(multiple),
            Value::Enclosed(interval) => interval.clone(),
        }
    }

    pub(super) fn negate(self) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: -exact.value, ..exact }),
            Value::OfPi(multiple) => Value::OfPi(-multiple),
            Value::Enclosed(interval) => Value::Enclosed(interval.negate()),
        }
    }

    /// 1/x, of a multiple of π to some digits; the value must not be zero, nor an interval around it.
    pub(super) fn reciprocal(self, digits: u32) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: exact.value.recip(), ..exact }),
            other => Value::Enclosed(other.interval(digits).reciprocal()),
        }
    }
}

/// Why an attempt has no result.
pub(super) enum AttemptError {
    Fault(SemanticError),
    /// More digits are needed to decide whether a number is zero or negative.
    Undecided,
}

pub(super) fn fault(fault: SemanticFault, range: &Range<usize>) -> AttemptError {
    AttemptError::Fault(SemanticError::new(fault, range))
}
