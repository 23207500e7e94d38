//! The programs of Slurm: how they are called, and how their failures are reported.

use std::io::ErrorKind;
use std::process::{Command, Stdio};

use shadowstep_scenes::Error;

/// Why a program of Slurm has given no answer.
#[derive(Debug)]
pub(super) enum Failure {
    /// It is not on the PATH.
    NotFound,
    /// Its message.
    Refused(String),
}

/// Calls a program and returns what it prints.
pub(super) fn call(program: &str, arguments: &[String]) -> Result<String, Failure> {
    let output =
        Command::new(program).args(arguments).stdin(Stdio::null()).output().map_err(|error| match error.kind() {
            ErrorKind::NotFound => Failure::NotFound,
            _ => Failure::Refused(error.to_string()),
        })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let message = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = message.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    Err(Failure::Refused(if lines.is_empty() { output.status.to_string() } else { lines.join("; ") }))
}

impl Failure {
    /// As an error of the program; `hint` is what may help where it refuses.
    pub(super) fn error(self, program: &str, hint: impl Into<String>) -> Error {
        match self {
            Failure::NotFound => Error::usage(
                format!("{program} is not found"),
                "Slurm is not installed here, or its programs are not on the PATH",
            ),
            Failure::Refused(message) => {
                let prefix = format!("{program}: ");
                let message = if message.starts_with(&prefix) { message } else { prefix + &message };
                Error::run(message, hint)
            }
        }
    }
}
