//! Derivatives of the states of a run, forwards and backwards.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::derivatives::{Array, Derivatives, Differentiation, Parameter, Variable, distance, precise};
use shadowstep_scenes::run::Run;
use shadowstep_scenes::{Error, Observer};

use crate::errors::{exception, usage};
use crate::given::{Given, arithmetic, number};
use crate::given_run::{GivenRun, ReadRun};
use crate::waiting::waiting;

/// A variable as Python names it: `q` or `p` with an index, `h`, or another name with the problems in which it is
/// larger by the [distance], and by twice that.
type Named = (String, usize, Option<(Py<Given>, Py<Given>)>);

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
    by: Vec<Named>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let request = Request::of(py, run.read(py)?, By::named(by))?;
    let found = waiting(py, progress, move |watched| request.forward(&mut watched.observer()));
    let found = found?.map_err(|error| exception(py, error))?;
    let all = PyDict::new(py);
    let n = found.n.iter().map(|n| i64::try_from(*n).unwrap_or(i64::MAX));
    all.set_item("n", PyArray1::from_vec(py, n.collect()))?;
    all.set_item("states", array(py, found.states)?)?;
    all.set_item("by", columns(py, found.by)?)?;
    Ok(all)
}

/// The derivatives by each variable.
pub(crate) fn columns(py: Python<'_>, by: Vec<Array>) -> PyResult<Bound<'_, PyList>> {
    let by: Vec<_> = by.into_iter().map(|by| array(py, by)).collect::<PyResult<_>>()?;
    PyList::new(py, by)
}

/// The gradient of a function by each variable, and the error of the steps back. The covectors are the derivatives of
/// the function by q and p of each state.
#[pyfunction]
#[pyo3(signature = (run, by, covectors, *, progress))]
pub(crate) fn gradient<'py>(
    py: Python<'py>,
    run: GivenRun,
    by: Vec<Named>,
    covectors: PyReadonlyArray1<'py, f64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, f64)> {
    let request = Request::of(py, run.read(py)?, By::named(by))?;
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

/// A variable.
pub(crate) enum By {
    Named(String, usize, Option<[Given; 2]>),
    Direction(Vec<Rational>),
}

impl By {
    fn named(all: Vec<Named>) -> Vec<Self> {
        let named = |(name, i, given): Named| {
            By::Named(name, i, given.map(|(near, further)| [near, further].map(|given| given.get().clone())))
        };
        all.into_iter().map(named).collect()
    }

    /// Vectors (δq, δp).
    pub(crate) fn directions(py: Python<'_>, vectors: &[Vec<String>]) -> PyResult<Vec<Self>> {
        let direction = |vector: &Vec<String>| -> PyResult<By> {
            let components = vector.iter().map(|component| number(py, "tangent", component));
            Ok(By::Direction(components.collect::<PyResult<_>>()?))
        };
        vectors.iter().map(direction).collect()
    }
}

/// What is to be differentiated.
pub(crate) struct Request {
    pub(crate) run: ReadRun,
    by: Vec<By>,
}

impl Request {
    pub(crate) fn of(py: Python<'_>, run: ReadRun, by: Vec<By>) -> PyResult<Self> {
        if !by.is_empty() && run.times.physical_end.is_some() {
            let hint = "steps = 1000; the derivatives are those at a fixed number of steps";
            return Err(usage(py, "in transformed time derivatives need the number of steps", hint));
        }
        Ok(Request { run, by })
    }

    pub(crate) fn has_variables(&self) -> bool {
        !self.by.is_empty()
    }

    pub(crate) fn forward(&self, observer: &mut dyn Observer) -> Result<Derivatives, Error> {
        self.differentiate(observer, |request, observer| request.forward(observer))
    }

    fn differentiate<T>(
        &self,
        observer: &mut dyn Observer,
        work: impl FnOnce(Differentiation<'_>, &mut dyn Observer) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let ReadRun { ref problem, ref times, arithmetic, displaced, every, .. } = self.run;
        let posed = self.run.posed()?;
        // more digits are needed by parameters only
        let is_parameter = |by: &By| matches!(by, By::Named(name, _, _) if !matches!(name.as_str(), "q" | "p"));
        let has_parameters = self.by.iter().any(is_parameter);
        let precisely = if has_parameters { precise(arithmetic)? } else { arithmetic };
        let by = self.by.iter().map(|by| self.variable(by, precisely)).collect::<Result<Vec<_>, _>>()?;
        let precise = problem.system(precisely)?;
        let run =
            Run { propagator: &posed.scheme.name, h: &times.h, steps: times.steps, order: None, windows: Run::WINDOWS };
        let (system, scheme) = (&posed.system, &posed.scheme.scheme);
        let (precise, by) = (&precise, &by[..]);
        work(Differentiation { system, precise, scheme, run, arithmetic, displaced, every, by }, observer)
    }

    fn variable(&self, by: &By, precise: Arithmetic) -> Result<Variable, Error> {
        let (name, index, given) = match by {
            By::Named(name, index, given) => (name, index, given),
            By::Direction(components) => return Ok(Variable::Direction(components.clone())),
        };
        let system = |given: &Given| given.read_anew(precise).map(|(system, _)| Box::new(system));
        let h = &self.run.times.h;
        let nearby = match (name.as_str(), given) {
            ("q", None) => return Ok(Variable::Position(*index)),
            ("p", None) => return Ok(Variable::Momentum(*index)),
            (_, None) => {
                let distance = distance(self.run.arithmetic);
                let nearby = |times: i32| {
                    let h = h.exact() + &distance * Rational::from_integer(times.into());
                    StepSize::try_from(h).expect("a step size is larger than the distance")
                };
                let of_h = |times| -> Result<_, Error> { Ok((system(&self.run.problem)?, nearby(times))) };
                [of_h(1)?, of_h(2)?]
            }
            (_, Some([near, further])) => [(system(near)?, h.clone()), (system(further)?, h.clone())],
        };
        Ok(Variable::Parameter(Parameter { name: name.clone(), nearby }))
    }
}
