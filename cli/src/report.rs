//! Messages on stderr, and how the program ends.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use shadowstep_scenes::{Error, Summary};

/// The exit status; of several, the greatest counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Status {
    Success,
    NegativeAnswer,
    UsageError,
    RunFailed,
}

/// Reports an error and gives the status that it means.
pub(crate) fn error(error: &Error) -> Status {
    match error {
        // the reader of a pipe, such as `head`, has closed it
        Error::Output(error) if error.kind() == ErrorKind::BrokenPipe => return Status::Success,
        _ => write(format_args!("error: {error}")),
    }
    match error {
        Error::Usage { .. } | Error::Faults(_) => Status::UsageError,
        Error::Run { .. } | Error::Output(_) => Status::RunFailed,
    }
}

/// Reports something that the user should know and that is not wrong.
pub(crate) fn note(note: impl Display) {
    write(format_args!("note: {note}"));
}

/// Reports a negative answer and its reason.
pub(crate) fn negative_answer(message: impl Display, hint: impl Display) -> Status {
    write(format_args!("error: {message}\n  hint: {hint}"));
    Status::NegativeAnswer
}

/// Writes the summary of a run to stderr: as text, or as one JSON object.
pub(crate) fn summary(summary: &Summary, json: bool) {
    if json { write(serde_json::json!({ "summary": summary })) } else { write(summary) }
}

/// Writes lines to stderr. That stderr is closed is not a reason to stop.
pub(crate) fn write(lines: impl Display) {
    let _ = writeln!(io::stderr(), "{lines}");
}
