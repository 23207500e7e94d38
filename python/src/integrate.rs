//! Runs into arrays.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde_json::json;
use shadowstep::shadow::EstimatorSettings;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::integrate::{Integration, Samples};
use shadowstep_scenes::library::{NamedScheme, check_displaced};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::run::{OrderSetting, Run};
use shadowstep_scenes::stability::{few_kicks, unstable};
use shadowstep_scenes::{Error, Note, Observer, System, estimator, steps};
use shadowstep_schemes::First;

use crate::errors::{exception, of_library, usage};
use crate::estimator::Options;
use crate::given::{Given, arithmetic, number, step_size, word};
use crate::scheme::Table;
use crate::waiting::waiting;

/// Makes a run, and gives a dictionary of its states: arrays in double precision, else lists of decimal texts.
#[pyfunction]
#[pyo3(signature = (problem, scheme, h, *, steps, until, first, gradient_kicks, every, digits, mpfr, options, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn integrate<'py>(
    py: Python<'py>,
    problem: &Given,
    scheme: &Table,
    h: &str,
    steps: Option<u64>,
    until: Option<&str>,
    first: Option<&str>,
    gradient_kicks: &str,
    every: u64,
    digits: &str,
    mpfr: bool,
    options: Option<Options>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let arithmetic = arithmetic(py, digits, mpfr)?;
    let estimator = options.map(|options| options.settings(py)).transpose()?;
    let is_between = estimator.as_ref().is_some_and(EstimatorSettings::is_between);
    let first = first.map(|given| first_map(py, given)).transpose()?;
    let scheme = beginning_with(py, &scheme.0, first)?;
    let displaced = word(py, "gradient_kicks", gradient_kicks, &[("exact", false), ("displaced", true)])?;
    let failed = |error| exception(py, error);
    let times = times(py, problem, arithmetic, (h, steps, until))?;
    let given = problem.clone();
    let found = waiting(py, progress, move |watched| {
        let posed = SystemWithScheme::of(&given, &scheme, arithmetic)?;
        if displaced {
            check_displaced(&posed.scheme)?;
        }
        let runs = (&times, displaced);
        let (found, mut notes) = posed.run(runs, every, estimator.as_ref(), arithmetic, &mut watched.observer())?;
        notes.extend(times.note);
        Ok((found, notes, posed.system.problem))
    });
    problem.raised(py)?;
    let (found, notes, problem) = found?.map_err(failed)?;
    let dictionary = found.into_dictionary(py)?;
    dictionary.set_item("notes", PyList::new(py, notes.iter().map(Note::to_string))?)?;
    dictionary.set_item("coordinates", &problem.coordinates)?;
    dictionary.set_item("momenta", &problem.momenta)?;
    dictionary.set_item("is_between", is_between)?;
    Ok(dictionary)
}

/// The map that a word means.
pub(crate) fn first_map(py: Python<'_>, given: &str) -> PyResult<First> {
    word(py, "first", given, &[("kick", First::Kick), ("drift", First::Drift)])
}

/// The scheme with steps that begin with a map, where one is given.
pub(crate) fn beginning_with(py: Python<'_>, scheme: &NamedScheme, first: Option<First>) -> PyResult<NamedScheme> {
    match first {
        Some(first) => scheme.beginning_with(first).map_err(|error| of_library(py, error)),
        None => Ok(scheme.clone()),
    }
}

/// The steps of a run of a problem; where its time is transformed, `until` is a physical time.
pub(crate) fn times(
    py: Python<'_>,
    problem: &Given,
    arithmetic: Arithmetic,
    (h, steps, until): (&str, Option<u64>, Option<&str>),
) -> PyResult<Times> {
    match (until, steps) {
        (Some(until), None) => {
            let system = problem.system(arithmetic).map_err(|error| exception(py, error))?;
            match system.transformed_time() {
                Some(_) => Times::physical(py, h, until),
                None => Times::of(py, h, None, Some(until)),
            }
        }
        _ => Times::of(py, h, steps, until),
    }
}

/// The steps of a run.
pub(crate) struct Times {
    pub(crate) h: StepSize,
    pub(crate) steps: u64,
    /// The physical time at which the run ends, where time is transformed.
    pub(crate) physical_end: Option<Rational>,
    note: Option<Note>,
}

impl Times {
    /// Of two values one is given: the number of steps, or the time at which they end.
    pub(crate) fn of(py: Python<'_>, h: &str, count: Option<u64>, until: Option<&str>) -> PyResult<Self> {
        let size = step_size(py, h)?;
        match (count, until) {
            (Some(count), None) => {
                // the same checks, by the time at which they end
                let until = size.exact() * Rational::from_integer(count.into());
                Times::until(py, (size, h), (until, &format!("{count} h")))
            }
            (None, Some(text)) => Times::until(py, (size, h), (number(py, text)?, text)),
            _ => Err(usage(py, "give either `until` or `steps`", "until = 100, the time, or steps = 1000")),
        }
    }

    fn until(py: Python<'_>, (h, step): (StepSize, &str), (until, end): (Rational, &str)) -> PyResult<Self> {
        let steps = steps::count((&h, step), (&until, end));
        let steps = steps.map_err(|error| usage(py, error.to_string(), error.hint()))?;
        Ok(Times { note: Note::of_end(h.exact(), steps, &until), h, steps, physical_end: None })
    }

    /// The end is a physical time, where time is transformed: how many steps there are is found by making them.
    fn physical(py: Python<'_>, step: &str, end: &str) -> PyResult<Self> {
        let (h, until) = (step_size(py, step)?, number(py, end)?);
        let checked = steps::check_physical_end((&h, step), (&until, end));
        checked.map_err(|error| usage(py, error.to_string(), error.hint()))?;
        Ok(Times { h, steps: 0, physical_end: Some(until), note: None })
    }
}

/// A system with a scheme that is valid for it.
pub(crate) struct SystemWithScheme {
    pub(crate) system: System,
    pub(crate) scheme: NamedScheme,
    note: Option<Note>,
}

impl SystemWithScheme {
    pub(crate) fn of(problem: &Given, scheme: &NamedScheme, arithmetic: Arithmetic) -> Result<Self, Error> {
        let system = problem.system(arithmetic)?;
        let scheme = for_system(scheme.clone(), &system)?;
        let (scheme, note) = scheme.fitted(arithmetic).map_err(|error| {
            Error::usage(
                error.to_string(),
                format!("use {} digits or fewer, or a scheme whose weights are fractions", error.most),
            )
        })?;
        Ok(SystemWithScheme { system, scheme, note })
    }

    fn run(
        &self,
        (times, displaced): (&Times, bool),
        every: u64,
        estimator: Option<&EstimatorSettings>,
        arithmetic: Arithmetic,
        observer: &mut dyn Observer,
    ) -> Result<(Integrated, Vec<Note>), Error> {
        let setting = estimator.and_then(estimator::order_setting);
        let order = setting.map(|(name, value)| OrderSetting { name, value });
        let run = Run { propagator: &self.scheme.name, h: &times.h, steps: times.steps, order };
        let compensated = arithmetic.is_compensated();
        let (system, scheme) = (&self.system, &self.scheme.scheme);
        let until = times.physical_end.as_ref();
        let integration = Integration { system, scheme, run, compensated, displaced, until, every, estimator };
        let found = match arithmetic.is_longer_than_double() {
            false => Integrated::Doubles(integration.run::<f64>(&(), observer)?),
            true => Integrated::Texts(arithmetic.compute(InTexts { integration, observer })?),
        };
        let frequency = system.fastest_frequency();
        let unstable = frequency.and_then(|frequency| unstable(frequency, &self.scheme, times.h.exact()));
        let few_kicks = few_kicks(system, &self.scheme, times.h.exact());
        Ok((found, self.note.iter().cloned().chain(unstable).chain(few_kicks).collect()))
    }
}

struct InTexts<'a> {
    integration: Integration<'a>,
    observer: &'a mut dyn Observer,
}

impl Computation for InTexts<'_> {
    type Output = Result<Samples<String>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        Ok(self.integration.run::<N>(context, self.observer)?.map(N::to_text))
    }
}

/// The states of a run, in what Python has for its number type.
enum Integrated {
    Doubles(Samples<f64>),
    Texts(Samples<String>),
}

impl Integrated {
    fn into_dictionary(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        match self {
            Integrated::Doubles(samples) => {
                dictionary(py, samples, |numbers| Ok(PyArray1::from_vec(py, numbers).into_any()), f64::NAN)
            }
            Integrated::Texts(samples) => {
                dictionary(py, samples, |texts| Ok(PyList::new(py, texts)?.into_any()), "nan".to_owned())
            }
        }
    }
}

/// The states as a dictionary; q and p are flat.
fn dictionary<'py, T: Clone>(
    py: Python<'py>,
    samples: Samples<T>,
    column: impl Fn(Vec<T>) -> PyResult<Bound<'py, PyAny>>,
    missing: T,
) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let rows = samples.n.len();
    all.set_item("n", PyArray1::from_vec(py, samples.n))?;
    let columns = [("t", samples.t), ("q", samples.q), ("p", samples.p), ("energy", samples.energy)];
    for (name, numbers) in columns {
        all.set_item(name, column(numbers)?)?;
    }
    if !samples.modified.is_empty() {
        let mut modified = samples.modified;
        let orders: Vec<i64> = modified.iter().map(|found| found.order.into()).collect();
        let errors = modified.iter().map(|found| found.error.clone().unwrap_or_else(|| missing.clone()));
        let mut errors: Vec<T> = errors.collect();
        let mut values: Vec<T> = modified.drain(..).map(|found| found.value).collect();
        values.resize(rows, missing.clone());
        errors.resize(rows, missing);
        all.set_item("modified_energy", column(values)?)?;
        all.set_item("modified_energy_error", column(errors)?)?;
        all.set_item("order", PyArray1::from_vec(py, orders))?;
    }
    all.set_item("force_evaluations", samples.evaluations)?;
    all.set_item("planets", samples.interactions.as_ref().map(|found| json!(found).to_string()))?;
    Ok(all)
}
