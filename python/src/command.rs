//! The program `shadowstep`, as the package's own command.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;

/// Runs the program with its arguments, the first of which is its name; gives its exit code. `program` is the path
/// under which job scripts can call it.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>, program: Option<PathBuf>) -> u8 {
    py.detach(|| shadowstep_cli::main(arguments, program))
}
