//! What can go wrong with a scene, its schemes and its run.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use shadowstep::MotionError;
use shadowstep::tables::Faults;
use shadowstep_schemes::document::with_short_numbers;
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
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] NotWritten),
    /// The output cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(io::Error),
}

/// A file that cannot be written: the disk is full, for example.
///
/// Writers give it within an [`io::Error`].
#[derive(Debug, Error)]
#[error("{} cannot be written: {error}\n  hint: {hint}", path.display())]
pub struct NotWritten {
    path: PathBuf,
    error: io::Error,
    hint: String,
}

/// A file cannot be written; `then` is what helps when that is mended, such as `run the scene again`.
pub fn not_written(path: &Path, error: io::Error, then: &str) -> NotWritten {
    let hint = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => format!("make room on the disk, then {then}"),
        ErrorKind::FileTooLarge => format!("allow larger files, see `ulimit -f`, then {then}"),
        _ => format!("look after the disk and the folder, then {then}"),
    };
    NotWritten { path: path.to_owned(), error, hint }
}

impl From<NotWritten> for io::Error {
    fn from(error: NotWritten) -> Self {
        io::Error::new(error.error.kind(), error)
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        error.downcast().map_or_else(Error::Output, Error::File)
    }
}

impl Error {
    /// A wrong request, and what would be right.
    pub fn usage(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Error::Usage { message: with_short_numbers(&message.into()), hint: hint.into() }
    }

    /// A run that failed, and what may help.
    pub fn run(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Error::Run { message: with_short_numbers(&message.into()), hint: hint.into() }
    }
}

/// A state of another dimension, or a potential that cannot be computed at it.
impl From<MotionError> for Error {
    fn from(error: MotionError) -> Self {
        Error::usage(error.to_string(), "check the initial state")
    }
}

impl From<serde_json::Error> for Error {
    fn from(error: serde_json::Error) -> Self {
        io::Error::from(error).into()
    }
}

impl From<csv::Error> for Error {
    fn from(error: csv::Error) -> Self {
        match error.into_kind() {
            csv::ErrorKind::Io(error) => error.into(),
            kind => Error::Output(io::Error::other(format!("{kind:?}"))),
        }
    }
}
