//! Derivatives of the states of a run, forwards and backwards.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::derivatives::{Array, Differentiation, Parameter, Variable, distance, precise};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{Error, Observer};

use crate::errors::{exception, usage};
use crate::given::{Given, arithmetic};
use crate::given_run::{GivenRun, ReadRun};
use crate::waiting::waiting;

/// A variable: `q` or `p` with an index, `h`, or another name with the problem in which it is larger by the [distance].
type By = (String, usize, Option<Py<Given>>);

/// By how much numbers are larger in problems at nearby values, as a text.
#[pyfunction]
pub(crate) fn distance_of(py: Python<'_>, digits: &str, mpfr: bool) -> PyResult<String> {
    Ok(distance(arithmetic(py, digits, mpfr)?).to_string())
}

/// The states and their derivatives by each variable, as flat arrays.
#[pyfunction]
#[pyo3(signature = (run, by, *, progress))]
pub(crate) fn derivatives<'py>(
    py: Python<'py>,
    run: GivenRun,
    by: Vec<By>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let request = Request::of(py, run, by)?;
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
#[pyo3(signature = (run, by, covectors, *, progress))]
pub(crate) fn gradient<'py>(
    py: Python<'py>,
    run: GivenRun,
    by: Vec<By>,
    covectors: PyReadonlyArray1<'py, f64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, f64)> {
    let request = Request::of(py, run, by)?;
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

/// What is to be differentiated.
struct Request {
    run: ReadRun,
    by: Vec<(String, usize, Option<Given>)>,
}

impl Request {
    fn of(py: Python<'_>, run: GivenRun, by: Vec<By>) -> PyResult<Self> {
        let run = run.read(py)?;
        if run.times.physical_end.is_some() {
            let hint = "steps = 1000; the derivatives are those at a fixed number of steps";
            return Err(usage(py, "in transformed time derivatives need the number of steps", hint));
        }
        let by = by.into_iter().map(|(name, i, given)| (name, i, given.map(|given| given.get().clone()))).collect();
        Ok(Request { run, by })
    }

    fn differentiate<T>(
        &self,
        observer: &mut dyn Observer,
        work: impl FnOnce(Differentiation<'_>, &mut dyn Observer) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let ReadRun { ref problem, ref times, arithmetic, displaced, every, .. } = self.run;
        let posed = self.run.posed()?;
        // more digits are needed by parameters only
        let has_parameters = self.by.iter().any(|(name, _, _)| !matches!(name.as_str(), "q" | "p"));
        let precisely = if has_parameters { precise(arithmetic)? } else { arithmetic };
        let by = self.by.iter().map(|by| self.variable(by, precisely)).collect::<Result<Vec<_>, _>>()?;
        let precise = problem.system(precisely)?;
        let run = Run { propagator: &posed.scheme.name, h: &times.h, steps: times.steps, order: None };
        let (system, scheme) = (&posed.system, &posed.scheme.scheme);
        let (precise, by) = (&precise, &by[..]);
        work(Differentiation { system, precise, scheme, run, arithmetic, displaced, every, by }, observer)
    }

    fn variable(
        &self,
        (name, index, given): &(String, usize, Option<Given>),
        precise: Arithmetic,
    ) -> Result<Variable, Error> {
        let h = &self.run.times.h;
        let moved = |given: &Given, h: StepSize| -> Result<Variable, Error> {
            let system = Box::new(given.system(precise)?);
            Ok(Variable::Parameter(Parameter { name: name.clone(), system, h }))
        };
        match (name.as_str(), given) {
            ("q", None) => Ok(Variable::Position(*index)),
            ("p", None) => Ok(Variable::Momentum(*index)),
            (_, None) => {
                let nearby: Rational = h.exact() + distance(self.run.arithmetic);
                moved(&self.run.problem, StepSize::try_from(nearby).expect("a step size is larger than the distance"))
            }
            (_, Some(given)) => moved(given, h.clone()),
        }
    }
}
