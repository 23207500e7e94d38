//! Derivatives of the states of a run, forwards and backwards.

use numpy::PyArray1;
use pyo3::prelude::*;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::derivatives::{Differentiation, Parameter, Variable, distance, precise};
use shadowstep_scenes::posed::Posed;

use crate::errors::Fallible;
use crate::given::{Given, arithmetic, number};
use crate::given_run::{GivenRun, ReadRun};
use crate::values::{Rows, array, arrays};
use crate::waiting::waiting_for;

/// A variable.
#[derive(FromPyObject)]
pub(crate) enum By {
    /// `q` or `p` with an index, `h`, or another name with the problems in which it is larger by the [distance], and by
    /// twice that.
    Named(String, usize, Option<[Py<Given>; 2]>),
    /// A vector (δq, δp).
    Direction(Vec<String>),
}

/// The states, and their derivatives by each variable, as flat arrays.
type States<'py> = (Bound<'py, PyAny>, Vec<Bound<'py, PyAny>>);

/// By how much numbers are larger in problems at nearby values, as a text.
#[pyfunction]
pub(crate) fn distance_of(digits: &str, mpfr: bool) -> Fallible<String> {
    Ok(distance(arithmetic(digits, mpfr)?).to_string())
}

/// The numbers of the states, the states, and their derivatives by each variable.
#[pyfunction]
pub(crate) fn derivatives<'py>(
    py: Python<'py>,
    run: GivenRun,
    by: Vec<By>,
    progress: Option<&Bound<'py, PyAny>>,
) -> Fallible<(Bound<'py, PyArray1<i64>>, States<'py>)> {
    let derivatives = waiting_for(py, progress, None, move |watched| {
        differentiate(&run, &by, |request| request.forward(&mut watched.observer()))
    })?;
    let n = derivatives.n.iter().map(|n| i64::try_from(*n).unwrap_or(i64::MAX)).collect();
    Ok((PyArray1::from_vec(py, n), (array(py, derivatives.states), arrays(py, derivatives.by))))
}

/// The gradient of a function by each variable, and the error of the steps back. The covectors are the derivatives of
/// the function by q and p of each state.
#[pyfunction]
pub(crate) fn gradient<'py>(
    py: Python<'py>,
    run: GivenRun,
    by: Vec<By>,
    covectors: Rows,
    progress: Option<&Bound<'py, PyAny>>,
) -> Fallible<(Bound<'py, PyAny>, f64)> {
    let gradient = waiting_for(py, progress, None, move |watched| {
        differentiate(&run, &by, |request| request.backward(&covectors.numbers, &mut watched.observer()))
    })?;
    Ok((array(py, gradient.by), gradient.reversal_error))
}

fn differentiate<T>(
    given: &GivenRun,
    by: &[By],
    work: impl FnOnce(Differentiation<'_>) -> Result<T, Error>,
) -> Fallible<T> {
    let (problem, read) = (given.problem.get(), given.read()?);
    if !by.is_empty() {
        read.check_steps()?;
    }
    let Posed { system, scheme, run, arithmetic, displaced, .. } = read.posed(None)?;
    // more digits are needed by parameters only
    let is_parameter = |by: &By| matches!(by, By::Named(name, ..) if !matches!(name.as_str(), "q" | "p"));
    let precisely = if by.iter().any(is_parameter) { precise(arithmetic)? } else { arithmetic };
    let by = by.iter().map(|by| by.variable(problem, (&read, precisely))).collect::<Fallible<Vec<_>>>()?;
    let (precise, by, every) = (&problem.read(precisely)?.system, &by[..], read.every);
    Ok(work(Differentiation { system, precise, scheme, run, arithmetic, displaced, every, by })?)
}

impl By {
    fn variable(&self, problem: &Given, (run, precise): (&ReadRun, Arithmetic)) -> Fallible<Variable> {
        let system = |given: &Given| given.read_anew(precise).map(|read| Box::new(read.system));
        let (name, nearby) = match self {
            By::Direction(components) => {
                let components = components.iter().map(|component| number("tangent", component));
                return Ok(Variable::Direction(components.collect::<Fallible<_>>()?));
            }
            By::Named(name, index, None) if name == "q" => return Ok(Variable::Position(*index)),
            By::Named(name, index, None) if name == "p" => return Ok(Variable::Momentum(*index)),
            By::Named(name, _, None) => {
                let distance = distance(run.arithmetic);
                let nearby = |times: i32| {
                    let h = run.h.exact() + &distance * Rational::from_integer(times.into());
                    StepSize::try_from(h).expect("a step size is larger than the distance")
                };
                (name, [(system(problem)?, nearby(1)), (system(problem)?, nearby(2))])
            }
            By::Named(name, _, Some([near, further])) => {
                (name, [(system(near.get())?, run.h.clone()), (system(further.get())?, run.h.clone())])
            }
        };
        Ok(Variable::Parameter(Parameter { name: name.clone(), nearby }))
    }
}
