//! What can be wrong with a problem's name or values.

use thiserror::Error;

/// An unknown problem, or values that it cannot take.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum ProblemError {
    /// There is no such problem.
    #[error("there is no problem `{name}`; {hint}")]
    UnknownProblem {
        /// The name given.
        name: String,
        /// The nearest known one.
        hint: String,
    },
    /// The problem has no such parameter or initial value.
    #[error("{problem} has no parameter or initial value `{name}`; {hint}")]
    UnknownParameter {
        /// The problem.
        problem: &'static str,
        /// The name given.
        name: String,
        /// The nearest known one.
        hint: String,
    },
    /// A parameter is given twice.
    #[error("`{name}` is set twice; keep one")]
    SetTwice {
        /// Its name.
        name: String,
    },
    /// An expression cannot be evaluated.
    #[error("{name}={text}: {why}")]
    NoValue {
        /// The parameter.
        name: String,
        /// The expression.
        text: String,
        /// Why.
        why: String,
    },
    /// A value that the problem does not allow.
    #[error("{name}={text} is out of range: {range}")]
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// The expression.
        text: String,
        /// The allowed values, in words.
        range: &'static str,
    },
}

shadowstep_schemes::debug_as_text!(ProblemError);
