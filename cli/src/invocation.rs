//! How the program was called: by its arguments, and under which path others can call it again; and what can be called.

use std::env;
use std::ffi::OsString;
use std::io;
use std::path::PathBuf;
use std::sync::OnceLock;

use shadowstep_scenes::shell_word;

struct Invocation {
    arguments: Vec<OsString>,
    program: Option<PathBuf>,
    commands: fn() -> clap::Command,
}

static INVOCATION: OnceLock<Invocation> = OnceLock::new();

/// Keeps the arguments, the first of which is the name, the path of the program where that is not the running one, and
/// all commands.
pub(crate) fn keep(arguments: &[OsString], program: Option<PathBuf>, commands: fn() -> clap::Command) {
    let _ = INVOCATION.set(Invocation { arguments: arguments.to_vec(), program, commands });
}

/// All commands with their flags and help.
pub(crate) fn commands() -> clap::Command {
    INVOCATION.get().map(|invocation| (invocation.commands)()).unwrap_or_default()
}

/// The command line as it was given, for the head of files.
pub(crate) fn command() -> String {
    let arguments = INVOCATION.get().map_or(&[][..], |invocation| &invocation.arguments);
    let words = arguments.iter().skip(1).map(shell_word);
    format!("shadowstep {}", words.collect::<Vec<_>>().join(" "))
}

/// The path of the program.
///
/// # Errors
/// As [`env::current_exe`].
pub(crate) fn program() -> io::Result<PathBuf> {
    match INVOCATION.get().and_then(|invocation| invocation.program.clone()) {
        Some(program) => Ok(program),
        None => env::current_exe(),
    }
}
