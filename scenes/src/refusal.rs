//! Why something is refused.

use crate::error::Error;

/// Why something is refused, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong, one sentence.
    pub message: String,
    /// What would be right.
    pub hint: String,
}

/// Why a system has no gradient kicks, and what would be right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoGradientKicks {
    /// What follows "the scheme has gradient kicks".
    pub reason: &'static str,
    /// What would be right.
    pub hint: &'static str,
}

/// Why schemes are not processed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoProcessor {
    /// What follows "the scheme is a processed scheme, which".
    pub reason: &'static str,
    /// What would be right.
    pub hint: &'static str,
}

impl Refusal {
    pub(crate) fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Refusal { message: message.into(), hint: hint.into() }
    }
}

impl From<Refusal> for Error {
    fn from(Refusal { message, hint }: Refusal) -> Self {
        Error::usage(message, hint)
    }
}
