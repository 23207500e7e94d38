//! Messages on stderr, and how the program ends.

use std::fmt::Display;
use std::io::{ErrorKind, Write};

use anstyle::Style;
use shadowstep_scenes::{Error, Summary};

use crate::colour::{ERROR, HINT, NOTE, of_verdict, styled};

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
        _ => write(message("error:", ERROR, error)),
    }
    match error {
        Error::Usage { .. } | Error::Faults(_) => Status::UsageError,
        Error::Run { .. } | Error::File(_) | Error::Output(_) => Status::RunFailed,
    }
}

/// Reports something that the user should know and that is not wrong.
pub(crate) fn note(note: impl Display) {
    write(message("note:", NOTE, note));
}

/// Reports a negative answer and its reason.
pub(crate) fn negative_answer(message: impl Display, hint: impl Display) -> Status {
    write(self::message("error:", ERROR, format_args!("{message}\n  hint: {hint}")));
    Status::NegativeAnswer
}

/// Options that the libraries name in messages, such as `force`: here they are flags.
const FLAGS: [(&str, &str); 3] = [("`restart`", "--restart"), ("`force`", "--force"), ("`control`", "--control")];

/// A message of the libraries, in which options are flags.
pub(crate) fn with_flags(text: &str) -> String {
    FLAGS.iter().fold(text.to_owned(), |text, (name, flag)| text.replace(name, flag))
}

/// A message behind its word, with the word of its hint, both in colours.
fn message(word: &str, style: Style, text: impl Display) -> String {
    let text = with_flags(&text.to_string()).replace("\n  hint: ", &format!("\n  {} ", styled("hint:", HINT)));
    format!("{} {text}", styled(word, style))
}

/// Writes the summary of a run to stderr: as text, or as one JSON object.
pub(crate) fn summary(summary: &Summary, json: bool) {
    if json {
        write(serde_json::json!({ "summary": summary }));
    } else {
        let verdict = styled(summary.verdict(), of_verdict(summary.is_bounded()));
        write(summary.to_string().replacen(summary.verdict(), &verdict, 1));
    }
}

/// Writes lines to stderr, without colours where it is not a terminal. That stderr is closed is not a reason to stop.
pub(crate) fn write(lines: impl Display) {
    let _ = writeln!(anstream::stderr(), "{lines}");
}
