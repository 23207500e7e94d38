//! A run from the initial state of a problem, as Python gives it.

use pyo3::prelude::*;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::{NamedScheme, check_displaced};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::{Error, Note, steps};
use shadowstep_schemes::First;

use crate::errors::{exception, of_library, usage};
use crate::given::{Given, GivenSystem, arithmetic, number, step_size, word};
use crate::scheme::Table;

/// A run as Python gives it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct GivenRun {
    problem: Py<Given>,
    scheme: Py<Table>,
    h: String,
    steps: Option<u64>,
    until: Option<String>,
    first: Option<String>,
    gradient_kicks: String,
    every: u64,
    digits: String,
    mpfr: bool,
}

impl GivenRun {
    /// What it means.
    pub(crate) fn read(self, py: Python<'_>) -> PyResult<ReadRun> {
        let arithmetic = arithmetic(py, &self.digits, self.mpfr)?;
        let first = self.first.map(|given| first_map(py, &given)).transpose()?;
        let scheme = beginning_with(py, &self.scheme.get().0, first)?;
        let displaced = word(py, "gradient_kicks", &self.gradient_kicks, &[("exact", false), ("displaced", true)])?;
        let problem = self.problem.get().clone();
        let times = times(py, &problem, arithmetic, (&self.h, self.steps, self.until.as_deref()))?;
        Ok(ReadRun { problem, scheme, times, arithmetic, displaced, every: self.every })
    }
}

/// A run from the initial state of a problem.
pub(crate) struct ReadRun {
    pub(crate) problem: Given,
    pub(crate) scheme: NamedScheme,
    pub(crate) times: Times,
    pub(crate) arithmetic: Arithmetic,
    pub(crate) displaced: bool,
    pub(crate) every: u64,
}

impl ReadRun {
    /// The system with the scheme.
    pub(crate) fn posed(&self) -> Result<SystemWithScheme, Error> {
        let posed = SystemWithScheme::of(&self.problem, &self.scheme, self.arithmetic)?;
        if self.displaced {
            check_displaced(&posed.scheme)?;
        }
        Ok(posed)
    }
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
                Some(_) => Times::physical(py, h, until, system.rate_at_start()),
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
    pub(crate) note: Option<Note>,
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
            (None, Some(text)) => Times::until(py, (size, h), (number(py, "until", text)?, text)),
            (Some(_), Some(_)) => Err(usage(py, "`until` and `steps` are both given", "remove one of the two")),
            (None, None) => Err(usage(py, "give either `until` or `steps`", "until = 100, the time, or steps = 1000")),
        }
    }

    fn until(py: Python<'_>, (h, step): (StepSize, &str), (until, end): (Rational, &str)) -> PyResult<Self> {
        let steps = steps::count((&h, step), (&until, end));
        let steps = steps.map_err(|error| usage(py, format!("h = {step}, until = {end}: {error}"), error.hint()))?;
        Ok(Times { note: Note::of_end(h.exact(), steps, &until), h, steps, physical_end: None })
    }

    /// The end is a physical time, where time is transformed: how many steps there are is found by making them.
    fn physical(py: Python<'_>, step: &str, end: &str, rate: Option<f64>) -> PyResult<Self> {
        let (h, until) = (step_size(py, step)?, number(py, "until", end)?);
        let checked = steps::check_physical_end((&h, step), (&until, end), rate);
        checked.map_err(|error| usage(py, format!("h = {step}, until = {end}: {error}"), error.hint()))?;
        Ok(Times { h, steps: steps::MOST_STEPS, physical_end: Some(until), note: None })
    }
}

/// A system with a scheme that is valid for it.
pub(crate) struct SystemWithScheme {
    pub(crate) system: GivenSystem,
    pub(crate) scheme: NamedScheme,
    pub(crate) note: Option<Note>,
}

impl SystemWithScheme {
    pub(crate) fn of(problem: &Given, scheme: &NamedScheme, arithmetic: Arithmetic) -> Result<Self, Error> {
        let system = problem.system(arithmetic)?;
        let scheme = for_system(scheme.clone(), &system)?;
        let (scheme, note) = scheme.fitted(arithmetic)?;
        Ok(SystemWithScheme { system, scheme, note })
    }
}
