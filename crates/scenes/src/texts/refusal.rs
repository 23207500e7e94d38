//! Why something is refused.

use crate::texts::error::Error;

/// Why something is refused, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}\n  hint: {hint}")]
pub struct Refusal {
    /// What is wrong, one sentence.
    pub message: String,
    /// What would be right.
    pub hint: String,
}

/// Why a system does not take a kind of scheme, and what would be right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unsupported {
    /// What follows "the scheme has gradient kicks" or "the scheme is a processed scheme, which".
    pub reason: &'static str,
    /// What would be right.
    pub hint: &'static str,
}

/// Refuses something.
pub(crate) fn refuse<T>(message: impl Into<String>, hint: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::new(message, hint))
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
