//! Functions of exact and of enclosed numbers, and where they have no value.

use std::ops::Range;

use num_traits::{One, Signed, Zero};

use super::{Evaluator, Exact, Stop, Value, fault};
use crate::decimal::to_significant;
use crate::elementary::{image, sin_and_cos};
use crate::fault::Fault;
use crate::function::{Function, exact_value};
use crate::interval::Interval;
use crate::{Expression, Rational};

impl Evaluator<'_> {
    /// function(argument)
    pub(super) fn function(
        &self,
        function: Function,
        argument: &Expression,
        range: &Range<usize>,
    ) -> Result<Value, Stop> {
        let value = self.value(argument)?;
        if let Value::Exact(Exact { value, rounded }) = &value
            && let Some(value) = exact_value(function, value)
        {
            return Ok(Value::Exact(Exact { value, rounded: *rounded }));
        }
        let interval = self.in_domain(function, value.interval(), &argument.range)?;
        self.enclosed(image(function, &interval, self.digits).and_then(|image| image.outward(self.digits)), range)
    }

    /// The part of an enclosed argument where the function has a value. At the last attempt, an argument that cannot be
    /// told from the border of the domain is there.
    fn in_domain(&self, function: Function, argument: Interval, range: &Range<usize>) -> Result<Interval, Stop> {
        let refusal = |number: &Rational| Fault::OutsideDomain { function, argument: to_significant(number, 12) };
        match function {
            Function::Log if !argument.high.is_positive() => return Err(fault(refusal(&argument.high), range)),
            Function::Log => self.without_zero(&argument, refusal(&Rational::zero()), range)?,
            Function::Exp | Function::Sinh | Function::Cosh if argument.is_wide() && !self.last => {
                return Err(Stop::Undecided);
            }
            Function::Sin | Function::Cos | Function::Tan if argument.is_wide() => match self.last {
                true => return Err(fault(Fault::VagueArgument(function), range)),
                false => return Err(Stop::Undecided),
            },
            Function::Tan => {
                let cos = sin_and_cos(&argument, self.digits).1;
                self.without_zero(&cos, refusal(&argument.low), range)?;
            }
            Function::Asin | Function::Acos => {
                let refusal = || Fault::OutsideDomain { function, argument: beyond_one(&argument.low) };
                let inside = argument.within_one().ok_or_else(|| fault(refusal(), range))?;
                if !self.last && !inside.is_same(&argument) {
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
