//! A syntax tree to its value: exact while it is rational, else rounded once and correctly.
//!
//! An irrational root, value of a function or π is enclosed in an interval, and so is all that depends on it. If both
//! ends of the whole formula's interval round to the same decimal, that is the value; if not, the formula is computed
//! again with twice the digits.

pub(crate) mod budget;
mod domain;
mod evaluator;
pub(crate) mod value;

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::symbolic::evaluation::budget::Budget;
use crate::symbolic::evaluation::domain::Attempt;
use crate::symbolic::evaluation::evaluator::Evaluator;
use crate::symbolic::evaluation::value::{AttemptError, Exact, Value};
use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::number::rounding::at_places;
use crate::symbolic::text::decimal::round_significant;
use crate::symbolic::text::error::{SemanticError, SemanticFault};
use crate::symbolic::text::syntax::Expression;

/// Irrational values are not computed to more digits: they would take long and exceed the largest size of numbers.
pub const MOST_EVALUATED_DIGITS: u32 = 5000;

/// Digits beyond those asked for in the first attempt.
const GUARD_DIGITS: u32 = 20;

/// Each attempt has twice the digits of the one before.
const ATTEMPTS: u32 = 4;

/// Computes an expression.
///
/// Rational arithmetic, roots of perfect powers, and the few rational values of functions, such as
/// `exp(0)` and `acos(1)`, are exact, whatever the names were computed from. With any other root or
/// value of a function, or with `pi` (unless a name hides it), the value of the whole expression is
/// correctly rounded to `digits` significant decimal digits (at least 1, at most 5000), half to even.
///
/// sin, cos and tan of a rational multiple of π subtract the nearest multiple of π/2 exactly, so that
/// `sin(1000000*pi/9)` takes no more than `sin(pi/9)`.
///
/// The functions are sqrt, cbrt, exp, log (the natural logarithm), sin, cos, tan, sinh, cosh, tanh,
/// atan, asin and acos. They are enclosed rigorously, in integer arithmetic alone.
///
/// Numbers that cannot be distinguished with eight times these digits count as equal: an irrational expression and
/// zero, so that `sin(pi)` is 0; an expression and the middle between two decimals; the argument of a root or function
/// and the boundary of its domain, so that `asin(sin(pi/2))` is pi/2 and `log(sin(pi))` and `tan(pi/2)` have no value.
///
/// # Errors
/// A [`SemanticError`] for an unknown name or function, a division by zero, `0^0`, an even root
/// of a negative number, a function outside its domain, an exponent that is not an exact rational,
/// and for numbers that are too large, too small or too near to each other to compute with, or that take longer than a
/// [`Budget`] of their own.
pub fn evaluate(expression: &Expression, names: &BTreeMap<String, Exact>, digits: u32) -> Result<Exact, SemanticError> {
    evaluate_within(expression, names, digits, &Budget::default())
}

/// Computes an expression as [`evaluate`] does, within a budget that it shares with others.
///
/// # Errors
/// As [`evaluate`].
pub fn evaluate_within(
    expression: &Expression,
    names: &BTreeMap<String, Exact>,
    digits: u32,
    budget: &Budget,
) -> Result<Exact, SemanticError> {
    let digits = digits.clamp(1, MOST_EVALUATED_DIGITS);
    for attempt in 0..ATTEMPTS {
        let last = attempt + 1 == ATTEMPTS;
        let attempt = Attempt { digits: (digits + GUARD_DIGITS) << attempt, last };
        let found = (Evaluator { names, attempt, budget }).value(expression).map(|value| match value {
            Value::Exact(exact) => Some(exact),
            other => settled(&other.interval(attempt.digits), digits, last).map(|value| Exact { value, rounded: true }),
        });
        match found {
            Ok(Some(exact)) => return Ok(exact),
            Ok(None) => {}
            Err(AttemptError::Fault(error)) => return Err(error),
            Err(AttemptError::Undecided) => {}
        }
    }
    Err(SemanticError::new(SemanticFault::Cancellation(digits), &expression.range))
}

/// The decimal that all numbers in the interval round to, if it is one.
fn settled(interval: &Interval, digits: u32, last: bool) -> Option<Rational> {
    let rounded = |digits| {
        let low = round_significant(&interval.low, digits);
        (low == round_significant(&interval.high, digits)).then_some(low)
    };
    if !last {
        return rounded(digits);
    }
    // A number this close to zero, or to the middle between two decimals, counts as equal to it.
    let tiny = at_places(BigInt::one(), 4 * i64::from(digits));
    let width = &interval.high - &interval.low;
    if interval.contains_zero() && width < tiny {
        return Some(Rational::zero());
    }
    rounded(digits).or_else(|| Some(round_significant(&rounded(4 * digits)?, digits)))
}
