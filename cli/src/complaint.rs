//! What is reported on stderr, and how the program ends.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use shadowstep::problems::ProblemError;
pub(crate) use shadowstep_scenes::Error as Complaint;
use shadowstep_scenes::arithmetic::NUMBER_EXAMPLES;

/// The exit codes; the later one weighs more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Ending {
    Done,
    AnswerIsNo,
    WrongUsage,
    RunFailed,
}

/// Reports an error on stderr.
pub(crate) fn tell(error: &Complaint) -> Ending {
    match error {
        // who reads has read enough, as `head` does
        Complaint::Output(error) if error.kind() == ErrorKind::BrokenPipe => return Ending::Done,
        _ => say(format_args!("error: {error}")),
    }
    match error {
        Complaint::Usage { .. } | Complaint::Faults(_) => Ending::WrongUsage,
        Complaint::Run { .. } | Complaint::Output(_) => Ending::RunFailed,
    }
}

/// Reports something that the user should know of a run that goes well.
pub(crate) fn remark(note: impl Display) {
    say(format_args!("note: {note}"));
}

/// Reports that the answer is no, and why.
pub(crate) fn no(message: impl Display, hint: impl Display) -> Ending {
    say(format_args!("error: {message}\n  hint: {hint}"));
    Ending::AnswerIsNo
}

/// Reports what was done, where stdout has the result itself.
pub(crate) fn report(text: impl Display) {
    say(text);
}

/// A closed stderr is not a reason to end.
fn say(text: impl Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// A problem or a value of `--set` that is wrong.
pub(crate) fn of_problem(error: ProblemError) -> Complaint {
    match error {
        ProblemError::UnknownProblem { name, hint } => Complaint::usage(format!("there is no problem `{name}`"), hint),
        ProblemError::UnknownParameter { problem, name, hint } => {
            let hint = format!("{hint} `shadowstep problems {problem}` says what can be set");
            Complaint::usage(format!("{problem} has no parameter or initial value `{name}`"), hint)
        }
        ProblemError::SetTwice { name } => Complaint::usage(format!("`{name}` is set twice"), "keep one"),
        ProblemError::NoValue { name, text, why } => {
            Complaint::usage(format!("--set {name}={text}: {why}"), NUMBER_EXAMPLES)
        }
        ProblemError::OutOfRange { name, text, range } => {
            Complaint::usage(format!("--set {name}={text} is out of range"), range)
        }
    }
}
