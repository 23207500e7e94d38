//! Why an expression has no value.

use std::ops::Range;

use num_bigint::BigInt;

use crate::function::Function;

/// The highest root; the work grows with the order.
pub(crate) const HIGHEST_ROOT: u32 = 100;

/// What there is to say of the known names where there are none.
pub(crate) const NO_NAMES: &str = "no names are known here but `pi`";

/// Why an expression has no value, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct EvaluationError {
    /// What is wrong.
    pub fault: Fault,
    /// The bytes of the text it is about.
    pub range: Range<usize>,
}

/// Why an expression has no value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// A name that stands for nothing.
    #[error("unknown name `{name}`; {hint}")]
    UnknownName {
        /// The name.
        name: String,
        /// The names there are, and the one that was probably meant.
        hint: String,
    },
    /// A function that does not exist.
    #[error("unknown function `{name}`; {hint}")]
    UnknownFunction {
        /// The name.
        name: String,
        /// The functions there are, and the one that was probably meant.
        hint: String,
    },
    /// A function of one argument with another number of them.
    #[error("`{function}` takes one argument, not {found}")]
    ArgumentCount {
        /// The function.
        function: String,
        /// How many arguments were found.
        found: usize,
    },
    /// A divisor that is zero, or cannot be told from zero.
    #[error("division by zero")]
    DivisionByZero,
    /// The power 0^0.
    #[error("0^0 has no value")]
    ZeroToTheZero,
    /// An even root of the negative number given.
    #[error("even root of the negative number {0}: it has no real value")]
    EvenRoot(String),
    /// A function at a number where it has no real value.
    #[error("{function}({argument}) has no real value: {}", domain(*function))]
    OutsideDomain {
        /// The function.
        function: Function,
        /// Its argument, to a few digits.
        argument: String,
    },
    /// A periodic function of a number that is not even known to a unit.
    #[error("the argument of {0} cannot be told to a unit: it is too large, or its parts almost cancel")]
    VagueArgument(Function),
    /// An exponent that is irrational or was rounded.
    #[error("an exponent must be an exact rational, not an irrational or rounded number; write exp(y*log(x)) for x^y")]
    InexactExponent,
    /// An exponent with the large denominator given.
    #[error("a root of order {0} is too high; at most {HIGHEST_ROOT} are computed")]
    HighRoot(BigInt),
    /// A number with too many digits.
    #[error("a number of absurd size: more than about 30000 digits")]
    AbsurdSize,
    /// A sum of large numbers that almost cancel.
    #[error("the value cannot be told to {0} digits: its parts almost cancel")]
    Cancellation(u32),
}

/// What the function's argument must be.
fn domain(function: Function) -> &'static str {
    match function {
        Function::Log => "the argument must be positive",
        Function::Asin | Function::Acos => "the argument must be from -1 to 1",
        // of the others only tan has no value somewhere
        _ => "the argument cannot be told from an odd multiple of pi/2",
    }
}
