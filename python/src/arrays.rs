//! Numbers as arrays of NumPy.

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyString;
use shadowstep_scenes::derivatives::Array;

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

impl<'py> IntoPyObject<'py> for Rows {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let Rows { dimension, numbers } = self;
        let rows = numbers.len().checked_div(dimension).unwrap_or(0);
        Ok(PyArray1::from_vec(py, numbers).reshape([rows, dimension])?.into_any())
    }
}
