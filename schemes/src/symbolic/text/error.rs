//! Errors of formulas.

use std::ops::Range;

use num_bigint::BigInt;

use crate::symbolic::number::function::Function;

/// The highest root; the work grows with the order.
pub(crate) const HIGHEST_ROOT: u32 = 100;

/// The largest numerator of an exponent in a formula that is differentiated.
pub(crate) const LARGEST_POWER: u32 = 10_000;

/// The most factors of a product that is differentiated: its gradient has as many terms, each as long as the product.
pub(crate) const MOST_FACTORS: usize = 64;

/// Why a text has no value.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    /// The text is not a formula.
    #[error(transparent)]
    Syntax(#[from] SyntaxError),
    /// The formula has no value.
    #[error(transparent)]
    Semantic(#[from] SemanticError),
}

crate::debug_as_text!(Error);

impl Error {
    /// The place of the error in the text, in bytes.
    pub fn range(&self) -> Range<usize> {
        match self {
            Error::Syntax(error) => error.range.clone(),
            Error::Semantic(error) => error.range.clone(),
        }
    }
}

/// A text that is not a valid formula.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct SyntaxError {
    /// One sentence: what was found, and what would be right.
    pub message: String,
    /// The place in the text, in bytes; empty where something is missing.
    pub range: Range<usize>,
}

crate::debug_as_text!(SyntaxError);

/// Why a formula has no value, or is not a smooth function, and where.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct SemanticError {
    /// What is wrong.
    pub fault: SemanticFault,
    /// The place in the text, in bytes.
    pub range: Range<usize>,
}

crate::debug_as_text!(SemanticError);

impl SemanticError {
    pub(crate) fn new(fault: SemanticFault, range: &Range<usize>) -> Self {
        SemanticError { fault, range: range.clone() }
    }
}

/// Why a formula has no value, or is not a smooth function.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
pub enum SemanticFault {
    /// An unknown name.
    #[error("unknown name `{name}`; {hint}")]
    UnknownName {
        /// The name.
        name: String,
        /// The known names, and the nearest of them.
        hint: String,
    },
    /// An unknown function.
    #[error("unknown function `{name}`; {hint}")]
    UnknownFunction {
        /// The name.
        name: String,
        /// The known functions, and the nearest of them.
        hint: String,
    },
    /// A function with a number of arguments other than one.
    #[error("`{function}` takes one argument, not {found}")]
    ArgumentCount {
        /// The function.
        function: String,
        /// How many arguments were found.
        found: usize,
    },
    /// A divisor that is zero, or cannot be distinguished from zero.
    #[error("division by zero")]
    DivisionByZero,
    /// The power 0^0.
    #[error("0^0 is undefined")]
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
    #[error("a number is too long: it has more than about 30000 digits")]
    TooLong,

    /// In [`evaluate`](crate::symbolic::evaluate()): the [`Budget`](crate::symbolic::Budget) of computing time is used up.
    #[error("this takes too long to compute: its numbers are too long, or there are too many of them")]
    TooMuchWork,

    /// In [`evaluate`](crate::symbolic::evaluate()): a periodic function of a number that is not known to within 1.
    #[error("the argument of {0} is not known to within 1: it is too large, or its terms almost cancel")]
    ImpreciseArgument(Function),
    /// In [`evaluate`](crate::symbolic::evaluate()): an exponent that is irrational or was rounded.
    #[error("an exponent must be an exact rational, not an irrational or rounded number; write exp(y*log(x)) for x^y")]
    InexactExponent,
    /// In [`evaluate`](crate::symbolic::evaluate()): an exponent with this large denominator.
    #[error("a root of order {0} is too high: at most {HIGHEST_ROOT} is allowed")]
    HighRoot(BigInt),
    /// In [`evaluate`](crate::symbolic::evaluate()): large terms that almost cancel.
    #[error("the value cannot be computed to {0} digits: its terms almost cancel")]
    Cancellation(u32),

    /// In [`Graph::build`](crate::symbolic::Graph::build): a function with a kink or a jump.
    #[error(
        "`{0}` is not smooth: the formula is differentiated, and the modified energy exists only for smooth functions"
    )]
    NotSmooth(String),
    /// In [`Graph::build`](crate::symbolic::Graph::build): an exponent that is not a rational number.
    #[error("an exponent must be a rational number; write exp(y*log(x)) for x^y")]
    VariableExponent,
    /// In [`Graph::build`](crate::symbolic::Graph::build): an exponent with a large numerator or denominator.
    #[error(
        "the exponent {0} is out of range: numerators up to {LARGEST_POWER} and roots up to order {HIGHEST_ROOT} are allowed"
    )]
    LargeExponent(String),
    /// In [`Graph::build`](crate::symbolic::Graph::build): a product of this many factors.
    #[error("a product of {0} different factors is too long: at most {MOST_FACTORS} are allowed")]
    LongProduct(usize),
}

crate::debug_as_text!(SemanticFault);

/// The domain of a function, in words.
fn domain(function: Function) -> &'static str {
    match function {
        Function::Log => "the argument must be positive",
        Function::Asin | Function::Acos => "the argument must be from -1 to 1",
        // of the other functions only tan has poles
        _ => "the argument cannot be distinguished from an odd multiple of pi/2",
    }
}
