//! Forces that a C function or a Python function computes.
//!
//! Both get q and give U and its gradient. A C function is `double f(const double *q, double *gradient)`.

// a C function is known by its address only
#![allow(unsafe_code)]

use std::ffi::c_void;
use std::ptr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use shadowstep::Potential;
use shadowstep::systems::potential::from_fn;
use shadowstep_scenes::OwnPotential;

/// A function that computes forces, and what it has raised.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    function: Function,
    raised: Arc<Mutex<Option<PyErr>>>,
    dimension: usize,
}

#[derive(Clone, Debug)]
enum Function {
    C(CFunction),
    Python(Arc<Py<PyAny>>),
}

/// Of so few components each is read alone: a vector that is read from where its components were just written waits for
/// these to be in the cache, which made a step of Kepler's problem a fifth longer.
const ALONE: usize = 3;

/// `double f(const double *q, double *gradient)`
type CFunction = unsafe extern "C" fn(*const f64, *mut f64) -> f64;

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
            Err(_) if function.is_callable() => Function::Python(Arc::new(function.clone().unbind())),
            Err(_) => {
                let message = "forces are a function of q that returns (U, gradient), or the address of a C function";
                return Err(PyTypeError::new_err(message));
            }
        };
        Ok(Forces { function, raised: Arc::default(), dimension })
    }

    /// Whether the Python function has raised something that was not taken.
    pub(crate) fn has_raised(&self, py: Python<'_>) -> bool {
        py.detach(|| self.known().is_some())
    }

    /// What the Python function has raised since this was asked last.
    pub(crate) fn raised(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.known().take()).map_or(Ok(()), Err)
    }

    fn known(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// U of a Python function; an exception is kept, and NaN ends the run.
    fn call(&self, function: &Py<PyAny>, q: &[f64], gradient: &mut [f64]) -> f64 {
        Python::attach(|py| {
            called(function.bind(py), q, gradient).unwrap_or_else(|error| {
                gradient.fill(f64::NAN);
                self.known().get_or_insert(error);
                f64::NAN
            })
        })
    }
}

fn called(function: &Bound<'_, PyAny>, q: &[f64], gradient: &mut [f64]) -> PyResult<f64> {
    let py = function.py();
    let gradient_given = function.call1((PyArray1::from_slice(py, q),))?;
    let (energy, gradient_given): (f64, Bound<'_, PyAny>) = gradient_given.extract().map_err(|error| {
        let wrong = PyTypeError::new_err("the function for the forces must return (U, gradient)");
        wrong.set_cause(py, Some(error));
        wrong
    })?;
    let Ok(gradient_given) = gradient_given.extract::<PyReadonlyArray1<'_, f64>>() else {
        return Err(PyTypeError::new_err("the gradient must be an array of float64 as long as q"));
    };
    let gradient_given = gradient_given.as_array();
    if gradient_given.len() != gradient.len() {
        let message = format!("the gradient has {} numbers, and q has {}", gradient_given.len(), gradient.len());
        return Err(PyValueError::new_err(message));
    }
    gradient.iter_mut().zip(gradient_given).for_each(|(own, component)| *own = *component);
    Ok(energy)
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
                let (forces, function) = (self.clone(), Arc::clone(function));
                Box::new(from_fn(self.dimension, move |q, gradient| forces.call(&function, q, gradient)))
            }
        }
    }
}
