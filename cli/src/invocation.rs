//! How the program was called: by its arguments, and under which path others can call it again.

use std::env;
use std::ffi::OsString;
use std::io;
use std::path::PathBuf;
use std::sync::OnceLock;

static INVOCATION: OnceLock<(Vec<OsString>, Option<PathBuf>)> = OnceLock::new();

/// Keeps the arguments, the first of which is the name, and the path of the program where that is not the running one.
pub(crate) fn keep(arguments: &[OsString], program: Option<PathBuf>) {
    let _ = INVOCATION.set((arguments.to_vec(), program));
}

/// The arguments without the name.
pub(crate) fn words() -> impl Iterator<Item = String> {
    let arguments = INVOCATION.get().map_or(&[][..], |(arguments, _)| arguments);
    arguments.iter().skip(1).map(|word| word.to_string_lossy().into_owned())
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
