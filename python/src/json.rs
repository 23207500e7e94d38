//! Values as Python's dictionaries, lists and numbers.

use pyo3::prelude::*;
use serde::Serialize;
use shadowstep_scenes::Error;

/// The text of a value, which Python gets as its `json` reads it: what is not finite is None.
pub(crate) struct Json(String);

impl Json {
    pub(crate) fn of(value: &impl Serialize) -> Result<Self, Error> {
        Ok(Json(serde_json::to_string(value)?))
    }
}

impl<'py> IntoPyObject<'py> for Json {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        py.import("json")?.call_method1("loads", (self.0,))
    }
}
