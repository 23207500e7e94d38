//! Results as values of Python: arrays of NumPy, dictionaries and lists.

use numpy::{PyArray1, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyString;
use serde::Serialize;
use shadowstep_scenes::Error;
use shadowstep_scenes::derivatives::Array;

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

/// An array of doubles, or of decimal texts.
pub(crate) fn array(py: Python<'_>, numbers: Array) -> Bound<'_, PyAny> {
    match numbers {
        Array::Doubles(numbers) => PyArray1::from_vec(py, numbers).into_any(),
        Array::Texts(texts) => {
            let object = |text: String| PyString::new(py, &text).into_any().unbind();
            PyArray1::from_vec(py, texts.into_iter().map(object).collect()).into_any()
        }
    }
}

pub(crate) fn arrays(py: Python<'_>, all: Vec<Array>) -> Vec<Bound<'_, PyAny>> {
    all.into_iter().map(|numbers| array(py, numbers)).collect()
}

/// An array of doubles, row by row.
pub(crate) struct Rows {
    /// How many numbers a row has; of an array with one axis all.
    pub(crate) dimension: usize,
    pub(crate) numbers: Vec<f64>,
}

impl<'py> FromPyObject<'_, 'py> for Rows {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let array: PyReadonlyArrayDyn<'py, f64> = given.extract()?;
        let numbers = array.as_array().iter().copied().collect();
        Ok(Rows { dimension: array.shape().last().copied().unwrap_or(1), numbers })
    }
}
