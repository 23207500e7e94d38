//! The domains of roots, quotients and functions.
//!
//! An enclosed number may be on either side of a boundary. Then more digits are needed; at the last attempt the number
//! counts as the boundary.

use std::ops::Range;

use num_traits::{One, Signed, Zero};

use crate::symbolic::evaluation::value::{AttemptError, fault};
use crate::symbolic::number::elementary::sin_and_cos;
use crate::symbolic::number::function::Function;
use crate::symbolic::number::interval::Interval;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::decimal::to_significant;
use crate::symbolic::text::error::SemanticFault;

/// How precisely a number is computed.
#[derive(Clone, Copy)]
pub(super) struct Attempt {
    /// The significant digits of the ends of intervals.
    pub(super) digits: u32,
    /// Whether no attempt with more digits follows.
    pub(super) last: bool,
}

impl Attempt {
    /// Rejects zero, and at the last attempt what cannot be distinguished from zero.
    pub(super) fn without_zero(
        self,
        interval: &Interval,
        otherwise: SemanticFault,
        range: &Range<usize>,
    ) -> Result<(), AttemptError> {
        match interval.contains_zero() {
            true if self.last => Err(fault(otherwise, range)),
            true => Err(AttemptError::Undecided),
            false => Ok(()),
        }
    }

    /// Rejects a negative number; at the last attempt, an interval around zero is cut off at zero.
    pub(super) fn not_negative(self, interval: Interval, range: &Range<usize>) -> Result<Interval, AttemptError> {
        if interval.high.is_negative() {
            return Err(fault(SemanticFault::EvenRoot(to_significant(&interval.high, 12)), range));
        }
        match interval.low.is_negative() {
            false => Ok(interval),
            true if self.last => Ok(Interval { low: Rational::zero(), ..interval }),
            true => Err(AttemptError::Undecided),
        }
    }

    /// The part of an enclosed argument inside the function's domain. At the last attempt, an argument that cannot be
    /// distinguished from the boundary of the domain counts as the boundary.
    pub(super) fn in_domain(
        self,
        function: Function,
        argument: Interval,
        range: &Range<usize>,
    ) -> Result<Interval, AttemptError> {
        let otherwise =
            |number: &Rational| SemanticFault::OutsideDomain { function, argument: to_significant(number, 12) };
        match function {
            Function::Log if !argument.high.is_positive() => return Err(fault(otherwise(&argument.high), range)),
            Function::Log => self.without_zero(&argument, otherwise(&Rational::zero()), range)?,
            Function::Exp | Function::Sinh | Function::Cosh if argument.is_wide() && !self.last => {
                return Err(AttemptError::Undecided);
            }
            Function::Sin | Function::Cos | Function::Tan if argument.is_wide() => match self.last {
                true => return Err(fault(SemanticFault::ImpreciseArgument(function), range)),
                false => return Err(AttemptError::Undecided),
            },
            Function::Tan => {
                let cos = sin_and_cos(&argument, self.digits).1;
                self.without_zero(&cos, otherwise(&argument.low), range)?;
            }
            Function::Asin | Function::Acos => {
                let otherwise = || SemanticFault::OutsideDomain { function, argument: beyond_one(&argument.low) };
                let inside = argument.within_one().ok_or_else(|| fault(otherwise(), range))?;
                if !self.last && inside != argument {
                    return Err(AttemptError::Undecided);
                }
                return Ok(inside);
            }
            _ => {}
        }
        Ok(argument)
    }
}

/// A number outside ±1, to few digits but not as ±1.
fn beyond_one(number: &Rational) -> String {
    match to_significant(number, 12) {
        text if text == "1" => format!("1 + {}", to_significant(&(number - Rational::one()), 3)),
        text if text == "-1" => format!("-1 - {}", to_significant(&(-number - Rational::one()), 3)),
        text => text,
    }
}
