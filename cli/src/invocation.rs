//! How the program was called: by its arguments, and under which path others can call it again.

use std::env;
use std::ffi::OsString;
use std::io;
use std::path::PathBuf;
use std::sync::OnceLock;

use shadowstep_scenes::shell_word;

static INVOCATION: OnceLock<(Vec<OsString>, Option<PathBuf>)> = OnceLock::new();

/// Keeps the arguments, the first of which is the name, and the path of the program where that is not the running one.
pub(crate) fn keep(arguments: &[OsString], program: Option<PathBuf>) {
    let _ = INVOCATION.set((arguments.to_vec(), program));
}

/// The command line as it was given, for the head of files.
pub(crate) fn command() -> String {
    let arguments = INVOCATION.get().map_or(&[][..], |(arguments, _)| arguments);
    let words = arguments.iter().skip(1).map(|word| shell_word(word));
    format!("shadowstep {}", words.collect::<Vec<_>>().join(" "))
}

/// The path of the program.
///
/// # Errors
/// As [`env::current_exe`].
pub(crate) fn program() -> io::Result<PathBuf> {
    match INVOCATION.get().and_then(|(_, program)| program.clone()) {
        Some(program) => Ok(program),
        None => env::current_exe(),
    }
}
