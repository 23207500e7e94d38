//! Python's exceptions for the errors of scenes, with the same sentences and places as on the command line.

use pyo3::create_exception;
use pyo3::exceptions::{PyArithmeticError, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::tables::Faults;
use shadowstep_scenes::Error;
use shadowstep_scenes::library::LibraryError;

create_exception!(
    shadowstep,
    InputError,
    PyValueError,
    "What was asked for is wrong: an unknown name, a number out of range, a table or a scene with faults.\n\n\
     `hint` says what would be right, or is None; `faults` has a dictionary for each fault of a text, with its path, \
     line and column."
);
create_exception!(
    shadowstep,
    RunError,
    PyArithmeticError,
    "A run failed: a state or an energy was not finite. `hint` says what may help."
);

/// The exception of an error.
pub(crate) fn exception(py: Python<'_>, error: Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::Usage { hint, .. } => of_input(py, text, Some(hint), None),
        Error::Faults(faults) => of_input(py, text, None, Some(&faults)),
        Error::Run { hint, .. } => {
            let error = RunError::new_err(text);
            with(py, error, |value| value.setattr("hint", hint))
        }
        Error::File(_) | Error::Output(_) => PyOSError::new_err(text),
    }
}

/// A wrong request, and what would be right.
pub(crate) fn usage(py: Python<'_>, message: impl Into<String>, hint: impl Into<String>) -> PyErr {
    exception(py, Error::usage(message, hint))
}

/// The exception of a table that cannot be read.
pub(crate) fn of_library(py: Python<'_>, error: LibraryError) -> PyErr {
    exception(py, error.into())
}

fn of_input(py: Python<'_>, text: String, hint: Option<String>, faults: Option<&Faults>) -> PyErr {
    with(py, InputError::new_err(text), |value| {
        let faults = faults.map_or(&[][..], |faults| &faults.0);
        let faults = faults.iter().map(|fault| -> PyResult<_> {
            let all = PyDict::new(py);
            all.set_item("path", &fault.path)?;
            all.set_item("line", fault.line)?;
            all.set_item("column", fault.column)?;
            all.set_item("message", &fault.message)?;
            all.set_item("hint", &fault.hint)?;
            Ok(all)
        });
        value.setattr("hint", hint)?;
        value.setattr("faults", faults.collect::<PyResult<Vec<_>>>()?)
    })
}

/// The exception with attributes; if these cannot be set, that error.
fn with(py: Python<'_>, error: PyErr, set: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<()>) -> PyErr {
    match set(error.value(py).as_any()) {
        Ok(()) => error,
        Err(failed) => failed,
    }
}
