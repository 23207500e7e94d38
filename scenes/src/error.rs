//! What can go wrong with a scene, its schemes and its run.

use std::io;

use shadowstep::tables::Faults;
use thiserror::Error;

/// Why something cannot be read or run.
///
/// Displayed with what would be right, or with what may help, on a second line.
#[derive(Debug, Error)]
pub enum Error {
    /// The request is wrong: an unknown name, a missing file, a number out of range.
    #[error("{message}\n  hint: {hint}")]
    Usage {
        /// What is wrong, one sentence.
        message: String,
        /// What would be right.
        hint: String,
    },
    /// A scene, or a table that is to be run, has faults, each with its place.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// A run failed: a state or an energy was not finite.
    #[error("{message}\n  hint: {hint}")]
    Run {
        /// What happened, one sentence.
        message: String,
        /// What may help.
        hint: String,
    },
    /// The output cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
}

impl Error {
    /// A wrong request, and what would be right.
    pub fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Error::Usage { message: message.into(), hint: hint.into() }
    }

    /// A run that failed, and what may help.
    pub fn run(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Error::Run { message: message.into(), hint: hint.into() }
    }
}

impl From<serde_json::Error> for Error {
    fn from(error: serde_json::Error) -> Self {
        Error::Output(error.into())
    }
}

impl From<csv::Error> for Error {
    fn from(error: csv::Error) -> Self {
        Error::Output(error.into())
    }
}
