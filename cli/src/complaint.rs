//! What a person is told when something is wrong, and how the program ends then.

use std::fmt::{self, Display};
use std::io::{self, ErrorKind, Write};

use shadowstep::problems::ProblemError;
use shadowstep::tables::Faults;

/// The exit codes; the later one weighs more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Ending {
    Done,
    AnswerIsNo,
    WrongUsage,
    RunFailed,
}

/// Why the program cannot go on.
#[derive(Debug)]
pub(crate) enum Complaint {
    /// One sentence, and what would be right.
    Usage { sentence: String, hint: String },
    /// A scene, or a table that is to be run, has faults.
    Faults(Faults),
    /// One sentence, and what may help.
    Run { sentence: String, hint: String },
    /// The output cannot be written.
    Output(io::Error),
}

impl Complaint {
    pub(crate) fn usage(sentence: impl Into<String>, hint: impl Into<String>) -> Self {
        Complaint::Usage { sentence: sentence.into(), hint: hint.into() }
    }

    pub(crate) fn run(sentence: impl Into<String>, hint: impl Into<String>) -> Self {
        Complaint::Run { sentence: sentence.into(), hint: hint.into() }
    }

    /// Tells it on stderr.
    pub(crate) fn tell(&self) -> Ending {
        match self {
            // who reads has read enough, as `head` does
            Complaint::Output(error) if error.kind() == ErrorKind::BrokenPipe => return Ending::Done,
            _ => say(format_args!("error: {self}")),
        }
        match self {
            Complaint::Usage { .. } | Complaint::Faults(_) => Ending::WrongUsage,
            Complaint::Run { .. } | Complaint::Output(_) => Ending::RunFailed,
        }
    }
}

impl Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Complaint::Usage { sentence, hint } | Complaint::Run { sentence, hint } => {
                write!(f, "{sentence}\n  hint: {hint}")
            }
            Complaint::Faults(faults) => write!(f, "{faults}"),
            Complaint::Output(error) => write!(f, "the output cannot be written: {error}"),
        }
    }
}

/// Tells something that one should know of a run that goes well.
pub(crate) fn remark(sentence: impl Display) {
    say(format_args!("remark: {sentence}"));
}

/// Tells that the answer is no, and why.
pub(crate) fn no(sentence: impl Display, hint: impl Display) -> Ending {
    say(format_args!("error: {sentence}\n  hint: {hint}"));
    Ending::AnswerIsNo
}

/// Tells what was done, where stdout has the result itself.
pub(crate) fn report(text: impl Display) {
    say(text);
}

/// A closed stderr is no reason to end.
fn say(text: impl Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

impl From<io::Error> for Complaint {
    fn from(error: io::Error) -> Self {
        Complaint::Output(error)
    }
}

impl From<serde_json::Error> for Complaint {
    fn from(error: serde_json::Error) -> Self {
        Complaint::Output(error.into())
    }
}

impl From<csv::Error> for Complaint {
    fn from(error: csv::Error) -> Self {
        Complaint::Output(error.into())
    }
}

impl From<ProblemError> for Complaint {
    fn from(error: ProblemError) -> Self {
        match error {
            ProblemError::UnknownProblem { name, hint } => {
                Complaint::usage(format!("there is no problem `{name}`"), hint)
            }
            ProblemError::UnknownParameter { problem, name, hint } => {
                let hint = format!("{hint} `shadowstep problems {problem}` says what can be set");
                Complaint::usage(format!("{problem} has no parameter or initial value `{name}`"), hint)
            }
            ProblemError::SetTwice { name } => Complaint::usage(format!("`{name}` is set twice"), "keep one"),
            ProblemError::NoValue { name, text, why } => {
                Complaint::usage(format!("--set {name}={text}: {why}"), crate::quantity::EXAMPLES)
            }
            ProblemError::OutOfRange { name, text, range } => {
                Complaint::usage(format!("--set {name}={text} is out of range"), range)
            }
        }
    }
}
