//! Where roots, quotients and functions have values.
//!
//! A number that is enclosed may be on either side of a border. Then more digits are needed; at the last attempt it
//! counts as the border.

use std::ops::Range;

use num_traits::{One, Signed, Zero};

use crate::evaluation::value::{Stop, fault};
use crate::number::elementary::sin_and_cos;
use crate::number::function::Function;
use crate::number::interval::Interval;
use crate::number::rational::Rational;
use crate::text::decimal::to_significant;
use crate::text::error::SemanticFault;

/// How a number is computed.
#[derive(Clone, Copy)]
pub(super) struct Attempt {
    /// The significant digits of the ends of intervals.
    pub(super) digits: u32,
    /// Whether no attempt with more digits follows.
    pub(super) last: bool,
}

impl Attempt {
    /// Refuses zero, and at the last attempt what cannot be told from zero.
    pub(super) fn without_zero(
        self,
        interval: &Interval,
        refusal: SemanticFault,
        range: &Range<usize>,
    ) -> Result<(), Stop> {
        match interval.contains_zero() {
            true if self.last => Err(fault(refusal, range)),
            true => Err(Stop::Undecided),
            false => Ok(()),
        }
    }

    /// Refuses a negative number; at the last attempt, what cannot be told from zero begins there.
    pub(super) fn not_negative(self, interval: Interval, range: &Range<usize>) -> Result<Interval, Stop> {
        if interval.high.is_negative() {
            return Err(fault(SemanticFault::EvenRoot(to_significant(&interval.high, 12)), range));
        }
        match interval.low.is_negative() {
            false => Ok(interval),
            true if self.last => Ok(Interval { low: Rational::zero(), ..interval }),
            true => Err(Stop::Undecided),
        }
    }

    /// The part of an enclosed argument where the function has a value. At the last attempt, an argument that cannot be
    /// told from the border of the domain is there.
    pub(super) fn in_domain(
        self,
        function: Function,
        argument: Interval,
        range: &Range<usize>,
    ) -> Result<Interval, Stop> {
        let refusal =
            |number: &Rational| SemanticFault::OutsideDomain { function, argument: to_significant(number, 12) };
        match function {
            Function::Log if !argument.high.is_positive() => return Err(fault(refusal(&argument.high), range)),
            Function::Log => self.without_zero(&argument, refusal(&Rational::zero()), range)?,
            Function::Exp | Function::Sinh | Function::Cosh if argument.is_wide() && !self.last => {
                return Err(Stop::Undecided);
            }
            Function::Sin | Function::Cos | Function::Tan if argument.is_wide() => match self.last {
                true => return Err(fault(SemanticFault::VagueArgument(function), range)),
                false => return Err(Stop::Undecided),
            },
            Function::Tan => {
                let cos = sin_and_cos(&argument, self.digits).1;
                self.without_zero(&cos, refusal(&argument.low), range)?;
            }
            Function::Asin | Function::Acos => {
                let refusal = || SemanticFault::OutsideDomain { function, argument: beyond_one(&argument.low) };
                let inside = argument.within_one().ok_or_else(|| fault(refusal(), range))?;
                if !self.last && inside != argument {
                    return Err(Stop::Undecided);
                }
                return Ok(inside);
            }
            _ => {}
        }
        Ok(argument)
    }
}

/// A number beyond ±1, to few digits but not as ±1.
fn beyond_one(number: &Rational) -> String {
    match to_significant(number, 12) {
        text if text == "1" => format!("1 + {}", to_significant(&(number - Rational::one()), 3)),
        text if text == "-1" => format!("-1 - {}", to_significant(&(-number - Rational::one()), 3)),
        text => text,
    }
}
