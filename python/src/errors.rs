//! Python's exceptions for the errors of scenes, with the same sentences and places as on the command line.

use pyo3::create_exception;
use pyo3::exceptions::{PyArithmeticError, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use shadowstep::tables::Fault;
use shadowstep_scenes::Error;

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

/// Why a function fails; it becomes an exception of Python.
pub(crate) enum Failure {
    Scene(Error),
    Python(PyErr),
}

pub(crate) type Fallible<T> = Result<T, Failure>;

/// A wrong request, and what would be right.
pub(crate) fn usage(message: impl Into<String>, hint: impl Into<String>) -> Failure {
    Failure::Scene(Error::usage(message, hint))
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Scene(error)
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Failure::Python(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Python(error) => error,
            Failure::Scene(error) => Python::attach(|py| exception(py, error)).unwrap_or_else(|failed| failed),
        }
    }
}

/// The exception of an error, with its attributes.
fn exception(py: Python<'_>, error: Error) -> PyResult<PyErr> {
    let text = error.to_string();
    let (raised, hint, faults) = match error {
        Error::Usage { hint, .. } => (InputError::new_err(text), Some(hint), Some(Vec::new())),
        Error::Faults(faults) => (InputError::new_err(text), None, Some(faults.0)),
        Error::Run { hint, .. } => (RunError::new_err(text), Some(hint), None),
        Error::File(_) | Error::Output(_) => return Ok(PyOSError::new_err(text)),
    };
    raised.value(py).setattr("hint", hint)?;
    if let Some(faults) = faults {
        let all = PyList::empty(py);
        for Fault { path, line, column, message, hint, .. } in faults {
            let of_fault = PyDict::new(py);
            of_fault.set_item("path", path)?;
            of_fault.set_item("line", line)?;
            of_fault.set_item("column", column)?;
            of_fault.set_item("message", message)?;
            of_fault.set_item("hint", hint)?;
            all.append(of_fault)?;
        }
        raised.value(py).setattr("faults", all)?;
    }
    Ok(raised)
}
