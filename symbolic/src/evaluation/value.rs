//! Values of a formula and its parts, and why an attempt gave none.

use std::ops::Range;

use crate::number::interval::Interval;
use crate::number::rational::Rational;
use crate::text::error::{SemanticError, SemanticFault};

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
    /// A rational multiple of π, which the interval encloses; boxed, as a deep recursion holds many values.
    OfPi(Rational, Box<Interval>),
    /// Some number in the interval.
    Enclosed(Interval),
}

impl Value {
    pub(super) fn interval(&self) -> Interval {
        match self {
            Value::Exact(exact) => Interval::point(&exact.value),
            Value::OfPi(_, interval) => (**interval).clone(),
            Value::Enclosed(interval) => interval.clone(),
        }
    }

    pub(super) fn negate(self) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: -exact.value, ..exact }),
            Value::OfPi(multiple, interval) => Value::OfPi(-multiple, Box::new(interval.negate())),
            Value::Enclosed(interval) => Value::Enclosed(interval.negate()),
        }
    }

    /// 1/x; the value must not be zero, nor an interval around it.
    pub(super) fn reciprocal(self) -> Self {
        match self {
            Value::Exact(exact) => Value::Exact(Exact { value: exact.value.recip(), ..exact }),
            Value::OfPi(_, interval) => Value::Enclosed(interval.reciprocal()),
            Value::Enclosed(interval) => Value::Enclosed(interval.reciprocal()),
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
