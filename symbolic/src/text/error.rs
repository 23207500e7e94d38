//! What can be wrong with a formula.

use std::ops::Range;

use num_bigint::BigInt;

use crate::number::function::Function;

/// The highest root; the work grows with the order.
pub(crate) const HIGHEST_ROOT: u32 = 100;

/// The largest numerator of an exponent in a formula that is differentiated.
pub(crate) const LARGEST_POWER: u32 = 10_000;

/// The most factors of a product that is differentiated: its gradient has as many terms, each as long as the product.
pub(crate) const MOST_FACTORS: usize = 64;

/// What keeps a text from having a value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The text is not a formula.
    #[error(transparent)]
    Syntax(#[from] SyntaxError),
    /// The formula has no value.
    #[error(transparent)]
    Semantic(#[from] SemanticError),
}

impl Error {
    /// The bytes of the text that the error is about.
    pub fn range(&self) -> Range<usize> {
        match self {
            Error::Syntax(error) => error.range.clone(),
            Error::Semantic(error) => error.range.clone(),
        }
    }
}

/// A text that is not a formula.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct SyntaxError {
    /// One sentence: what was found, and what would be right.
    pub message: String,
    /// The bytes of the text it is about; empty at the place where something is missing.
    pub range: Range<usize>,
}

/// Why a formula has no value, or is not a smooth function, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct SemanticError {
    /// What is wrong.
    pub fault: SemanticFault,
    /// The bytes of the text it is about.
    pub range: Range<usize>,
}

impl SemanticError {
    pub(crate) fn new(fault: SemanticFault, range: &Range<usize>) -> Self {
        SemanticError { fault, range: range.clone() }
    }
}

/// Why a formula has no value, or is not a smooth function.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SemanticFault {
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
        /// Its argument.
        argument: String,
    },
    /// A number with too many digits.
    #[error("a number of absurd size: more than about 30000 digits")]
    AbsurdSize,

    /// Of a value: a periodic function of a number that is not even known to a unit.
    #[error("the argument of {0} cannot be told to a unit: it is too large, or its parts almost cancel")]
    VagueArgument(Function),
    /// Of a value: an exponent that is irrational or was rounded.
    #[error("an exponent must be an exact rational, not an irrational or rounded number; write exp(y*log(x)) for x^y")]
    InexactExponent,
    /// Of a value: an exponent with the large denominator given.
    #[error("a root of order {0} is too high; at most {HIGHEST_ROOT} are computed")]
    HighRoot(BigInt),
    /// Of a value: a sum of large numbers that almost cancel.
    #[error("the value cannot be told to {0} digits: its parts almost cancel")]
    Cancellation(u32),

    /// Of a smooth function: a function with a kink or a jump.
    #[error(
        "`{0}` is not smooth, but the formula must be: it is differentiated, and its modified energy exists only then"
    )]
    NotSmooth(String),
    /// Of a smooth function: an exponent that is not a rational number.
    #[error("an exponent must be a rational number; write exp(y*log(x)) for x^y")]
    VariableExponent,
    /// Of a smooth function: an exponent with a large numerator or denominator.
    #[error("an exponent is at most {LARGEST_POWER}, and a root at most of order {HIGHEST_ROOT}; here it is {0}")]
    LargeExponent(String),
    /// Of a smooth function: a long product.
    #[error("a product of {0} different factors is too long; at most {MOST_FACTORS} are differentiated")]
    LongProduct(usize),
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
