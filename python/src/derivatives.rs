//! Derivatives of the states of a run, forwards and backwards.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::derivatives::{Array, Differentiation, Parameter, Variable, distance, precise};
use shadowstep_scenes::library::{NamedScheme, check_displaced};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{Error, Observer, System};

use crate::errors::{exception, usage};
use crate::given::{Given, arithmetic, word};
use crate::integrate::{SystemWithScheme, Times, beginning_with, first_map};
use crate::scheme::Table;
use crate::waiting::waiting;

/// A variable: `q` or `p` with an index, `h`, or another name with the problem in which it is larger by the [distance].
type By = (String, usize, Option<Py<Given>>);

/// What is to be differentiated, as it was given.
struct Request {
    problem: Given,
    by: Vec<(String, usize, Option<Given>)>,
    scheme: NamedScheme,
    times: Times,
    arithmetic: Arithmetic,
    displaced: bool,
    every: u64,
}

/// By how much numbers are larger in problems at nearby values, as a text.
#[pyfunction]
pub(crate) fn distance_of(py: Python<'_>, digits: &str, mpfr: bool) -> PyResult<String> {
    Ok(distance(arithmetic(py, digits, mpfr)?).to_string())
}

/// The states and their derivatives by each variable, as flat arrays.
#[pyfunction]
#[pyo3(signature = (problem, scheme, h, *, steps, until, first, gradient_kicks, every, by, digits, mpfr, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn derivatives<'py>(
    py: Python<'py>,
    problem: &Given,
    scheme: &Table,
    h: &str,
    steps: Option<u64>,
    until: Option<&str>,
    first: Option<&str>,
    gradient_kicks: &str,
    every: u64,
    by: Vec<By>,
    digits: &str,
    mpfr: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let request = Request::of(
        py,
        (problem, by),
        (scheme, first, gradient_kicks),
        (h, steps, until, every),
        arithmetic(py, digits, mpfr)?,
    )?;
    let found = waiting(py, progress, move |watched| {
        request.differentiate(&mut watched.observer(), |request, observer| request.forward(observer))
    });
    let found = found?.map_err(|error| exception(py, error))?;
    let all = PyDict::new(py);
    let n = found.n.iter().map(|n| i64::try_from(*n).unwrap_or(i64::MAX));
    all.set_item("n", PyArray1::from_vec(py, n.collect()))?;
    all.set_item("states", array(py, found.states)?)?;
    let by: Vec<_> = found.by.into_iter().map(|by| array(py, by)).collect::<PyResult<_>>()?;
    all.set_item("by", PyList::new(py, by)?)?;
    Ok(all)
}

/// The gradient of a function by each variable, and the error of the steps back. The covectors are the derivatives of the function by q and p of each state.
#[pyfunction]
#[pyo3(signature = (problem, scheme, h, covectors, *, steps, until, first, gradient_kicks, every, by, digits, mpfr, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn gradient<'py>(
    py: Python<'py>,
    problem: &Given,
    scheme: &Table,
    h: &str,
    covectors: PyReadonlyArray1<'py, f64>,
    steps: Option<u64>,
    until: Option<&str>,
    first: Option<&str>,
    gradient_kicks: &str,
    every: u64,
    by: Vec<By>,
    digits: &str,
    mpfr: bool,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, f64)> {
    let request = Request::of(
        py,
        (problem, by),
        (scheme, first, gradient_kicks),
        (h, steps, until, every),
        arithmetic(py, digits, mpfr)?,
    )?;
    let covectors = covectors.as_array().to_vec();
    let found = waiting(py, progress, move |watched| {
        request.differentiate(&mut watched.observer(), |request, observer| request.backward(&covectors, observer))
    });
    let found = found?.map_err(|error| exception(py, error))?;
    Ok((array(py, found.by)?, found.reversal_error))
}

fn array(py: Python<'_>, numbers: Array) -> PyResult<Bound<'_, PyAny>> {
    match numbers {
        Array::Doubles(numbers) => Ok(PyArray1::from_vec(py, numbers).into_any()),
        Array::Texts(texts) => Ok(PyList::new(py, texts)?.into_any()),
    }
}

impl Request {
    fn of(
        py: Python<'_>,
        (problem, by): (&Given, Vec<By>),
        (scheme, first, gradient_kicks): (&Table, Option<&str>, &str),
        (h, steps, until, every): (&str, Option<u64>, Option<&str>, u64),
        arithmetic: Arithmetic,
    ) -> PyResult<Self> {
        let first = first.map(|given| first_map(py, given)).transpose()?;
        let scheme = beginning_with(py, &scheme.0, first)?;
        let displaced = word(py, "gradient_kicks", gradient_kicks, &[("exact", false), ("displaced", true)])?;
        let system = problem.system(arithmetic).map_err(|error| exception(py, error))?;
        if until.is_some() && system.transformed_time().is_some() {
            let hint = "steps = 1000; the derivatives are those at a fixed number of steps";
            return Err(usage(py, "in transformed time the derivatives need the number of steps", hint));
        }
        let times = Times::of(py, h, steps, until)?;
        let by = by.into_iter().map(|(name, i, given)| (name, i, given.map(|given| given.get().clone()))).collect();
        Ok(Request { problem: problem.clone(), by, scheme, times, arithmetic, displaced, every })
    }

    fn differentiate<T>(
        &self,
        observer: &mut dyn Observer,
        work: impl FnOnce(Differentiation<'_>, &mut dyn Observer) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let Request { arithmetic, displaced, every, .. } = *self;
        let posed = SystemWithScheme::of(&self.problem, &self.scheme, arithmetic)?;
        if displaced {
            check_displaced(&posed.scheme)?;
        }
        // more digits are needed by parameters only
        let has_parameters = self.by.iter().any(|(name, _, _)| !matches!(name.as_str(), "q" | "p"));
        let precisely = if has_parameters { precise(arithmetic)? } else { arithmetic };
        let by = self.by.iter().map(|by| self.variable(by, precisely)).collect::<Result<Vec<_>, _>>()?;
        let precise: System = self.problem.system(precisely)?;
        let run = Run { propagator: &posed.scheme.name, h: &self.times.h, steps: self.times.steps, order: None };
        let (system, scheme) = (&posed.system, &posed.scheme.scheme);
        let (precise, by) = (&precise, &by[..]);
        work(Differentiation { system, precise, scheme, run, arithmetic, displaced, every, by }, observer)
    }

    fn variable(
        &self,
        (name, index, given): &(String, usize, Option<Given>),
        precise: Arithmetic,
    ) -> Result<Variable, Error> {
        let h = &self.times.h;
        let moved = |given: &Given, h: StepSize| -> Result<Variable, Error> {
            let system = Box::new(given.system(precise)?);
            Ok(Variable::Parameter(Parameter { name: name.clone(), system, h }))
        };
        match (name.as_str(), given) {
            ("q", None) => Ok(Variable::Position(*index)),
            ("p", None) => Ok(Variable::Momentum(*index)),
            (_, None) => {
                let nearby: Rational = h.exact() + distance(self.arithmetic);
                moved(&self.problem, StepSize::try_from(nearby).expect("a step size is larger than the distance"))
            }
            (_, Some(given)) => moved(given, h.clone()),
        }
    }
}
