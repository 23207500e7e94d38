//! Forces that a C function or a Python function computes.
//!
//! Both get q and give U and its gradient. A C function is `double f(const double *q, double *gradient)`.

// a C function is known by its address only
#![allow(unsafe_code)]

use std::ffi::c_void;
use std::fmt;
use std::ptr;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use shadowstep::Potential;
use shadowstep::systems::potential::from_fn;
use shadowstep_scenes::OwnPotential;

/// A function that computes forces.
#[derive(Clone)]
pub(crate) struct Forces {
    function: Function,
    dimension: usize,
}

#[derive(Clone)]
enum Function {
    C(CFunction),
    Python(PythonFunction),
}

/// Of so few components each is read alone: a vector that is read from where its components were just written waits for
/// these to be in the cache, which made a step of Kepler's problem a fifth longer.
const ALONE: usize = 3;

/// `double f(const double *q, double *gradient)`
type CFunction = unsafe extern "C" fn(*const f64, *mut f64) -> f64;

/// A function, and what it has raised.
#[derive(Clone)]
struct PythonFunction {
    function: Arc<Py<PyAny>>,
    raised: Arc<Mutex<Option<PyErr>>>,
}

impl Forces {
    /// A number is the address of a C function; anything else is a Python function that gives (U, gradient).
    pub(crate) fn of(function: &Bound<'_, PyAny>, dimension: usize) -> PyResult<Self> {
        let function = match function.extract::<usize>() {
            Ok(0) => return Err(PyValueError::new_err("the address of the C function is 0")),
            Ok(address) => {
                let address = address as *const c_void;
                // SAFETY: the caller promises that this is the address of a function of this type, as the documentation
                // asks
                Function::C(unsafe { std::mem::transmute::<*const c_void, CFunction>(address) })
            }
            Err(_) if function.is_callable() => Function::Python(PythonFunction {
                function: Arc::new(function.clone().unbind()),
                raised: Arc::default(),
            }),
            Err(_) => {
                let message = "forces are a function of q that returns (U, gradient), or the address of a C function";
                return Err(PyTypeError::new_err(message));
            }
        };
        Ok(Forces { function, dimension })
    }

    /// Whether the Python function has raised something that was not taken.
    pub(crate) fn has_raised(&self, py: Python<'_>) -> bool {
        let Function::Python(PythonFunction { raised, .. }) = &self.function else { return false };
        py.detach(|| raised.lock().unwrap_or_else(PoisonError::into_inner).is_some())
    }

    /// What the Python function has raised since this was asked last.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyResult<()> {
        let Function::Python(PythonFunction { raised, .. }) = &self.function else { return Ok(()) };
        match py.detach(|| raised.lock().unwrap_or_else(PoisonError::into_inner).take()) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }
}

impl PythonFunction {
    /// U; an exception is kept, and NaN ends the run.
    fn call(&self, q: &[f64], gradient: &mut [f64]) -> f64 {
        Python::attach(|py| {
            self.called(py, q, gradient).unwrap_or_else(|error| {
                gradient.fill(f64::NAN);
                self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                f64::NAN
            })
        })
    }

    fn called(&self, py: Python<'_>, q: &[f64], gradient: &mut [f64]) -> PyResult<f64> {
        let found = self.function.bind(py).call1((PyArray1::from_slice(py, q),))?;
        let (energy, found): (f64, Bound<'_, PyAny>) = found.extract().map_err(|error| {
            let wrong = PyTypeError::new_err("the function for the forces must return (U, gradient)");
            wrong.set_cause(py, Some(error));
            wrong
        })?;
        let found = found.extract::<PyReadonlyArray1<'_, f64>>().map(|array| array.as_array().to_vec());
        let found: Vec<f64> = match found {
            Ok(array) => array,
            Err(_) => return Err(PyTypeError::new_err("the gradient must be an array of float64 as long as q")),
        };
        if found.len() != gradient.len() {
            let message = format!("the gradient has {} numbers, and q has {}", found.len(), gradient.len());
            return Err(PyValueError::new_err(message));
        }
        gradient.copy_from_slice(&found);
        Ok(energy)
    }
}

impl fmt::Debug for Forces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Forces").field("name", &self.name()).field("dimension", &self.dimension).finish()
    }
}

impl OwnPotential for Forces {
    fn name(&self) -> String {
        match self.function {
            Function::C(_) => "a C function".to_owned(),
            Function::Python(_) => "a Python function".to_owned(),
        }
    }

    fn potential(&self) -> Box<dyn Potential<f64>> {
        match &self.function {
            Function::C(function) => {
                let (function, dimension) = (*function, self.dimension);
                Box::new(from_fn(dimension, move |q, gradient| {
                    debug_assert_eq!((q.len(), gradient.len()), (dimension, dimension));
                    // SAFETY: both have as many numbers as the problem has coordinates; the function has this type
                    let energy = unsafe { function(q.as_ptr(), gradient.as_mut_ptr()) };
                    if gradient.len() <= ALONE {
                        for component in gradient {
                            // SAFETY: it is a reference
                            *component = unsafe { ptr::read_volatile(component) };
                        }
                    }
                    energy
                }))
            }
            Function::Python(function) => {
                let function = function.clone();
                Box::new(from_fn(self.dimension, move |q, gradient| function.call(q, gradient)))
            }
        }
    }
}
