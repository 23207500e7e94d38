//! Why an expression has no value.

use std::ops::Range;

use num_bigint::BigInt;

/// The highest root; the work grows with the order.
pub(crate) const HIGHEST_ROOT: u32 = 100;

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
    #[error("unknown function `{0}`; known: sqrt, cbrt")]
    UnknownFunction(String),
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
    /// An exponent that is irrational or was rounded.
    #[error("an exponent must be an exact rational, not an irrational or rounded number")]
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
