//! A run from the initial state of a problem, and the estimator of its modified energy, as Python gives them.

use std::str::FromStr;
use std::sync::Arc;

use pyo3::prelude::*;
use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, SelectionRule, StoppingRule, check_accuracy};
use shadowstep::{MotionError, Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::estimator::{ACCURACY_HINT, conflict, order_setting};
use shadowstep_scenes::library::{EXACT_FLOW, NamedScheme, check_displaced};
use shadowstep_scenes::posed::Posed;
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::run::{OrderSetting, Run};
use shadowstep_scenes::stability::note_of_steps;
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};
use shadowstep_scenes::steps::{self, StepsError};
use shadowstep_scenes::{Error, Note, System};
use shadowstep_schemes::First;

use crate::errors::{Fallible, usage};
use crate::given::{Given, Read, arithmetic, number, step_size, word};
use crate::scheme::Table;

/// A run as Python gives it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct GivenRun {
    pub(crate) problem: Py<Given>,
    /// `None` for the exact flow.
    scheme: Option<Py<Table>>,
    h: String,
    steps: Option<u64>,
    until: Option<String>,
    /// The number of steps after which something else ends it.
    last: Option<u64>,
    first: Option<String>,
    gradient_kicks: String,
    every: u64,
    digits: String,
    mpfr: bool,
}

impl GivenRun {
    /// What it means.
    pub(crate) fn read(&self) -> Fallible<ReadRun> {
        let arithmetic = arithmetic(&self.digits, self.mpfr)?;
        let first = self.first.as_deref().map(first_map).transpose()?;
        let scheme = self.scheme.as_ref().map(|table| beginning_with(&table.get().0, first)).transpose()?;
        let displaced = word("gradient_kicks", &self.gradient_kicks, &[("exact", false), ("displaced", true)])?;
        let problem = self.problem.get().read(arithmetic)?;
        let h = step_size(&self.h)?;
        let (until, end) = match (self.steps, &self.until) {
            // the same checks, by the time at which they end
            (Some(count), None) => (h.exact() * Rational::from_integer(count.into()), format!("{count} h")),
            (None, Some(text)) => (number("until", text)?, text.clone()),
            (Some(_), Some(_)) => return Err(usage("`until` and `steps` are both given", "remove one of the two")),
            (None, None) => {
                return Err(usage("give either `until` or `steps`", "until = 100, the time, or steps = 1000"));
            }
        };
        let (size, time) = ((&h, &*self.h), (&until, &*end));
        let refused = |error: StepsError| usage(format!("h = {}, until = {end}: {error}", self.h), error.hint());
        let is_open = self.steps.is_none() && problem.system.transformed_time().is_some();
        let steps = if is_open {
            steps::check_physical_end(size, time, problem.system.rate_at_start()).map_err(refused)?;
            steps::MOST_STEPS
        } else {
            steps::count(size, time).map_err(refused)?
        };
        let fitted = scheme.map(|scheme| fitted(&scheme, &problem.system, arithmetic)).transpose()?;
        let (scheme, note) = fitted.map_or((None, None), |(scheme, note)| (Some(scheme), note));
        if let Some(scheme) = scheme.as_ref().filter(|_| displaced) {
            check_displaced(scheme).map_err(Error::from)?;
        }
        let steps = self.last.unwrap_or(steps);
        let of_end = if is_open { None } else { Note::of_end(h.exact(), steps, &until) };
        let (every, notes) = (self.every, [note, of_end]);
        Ok(ReadRun { problem, scheme, notes, h, steps, until, is_open, arithmetic, displaced, every })
    }
}

/// A run from the initial state of a problem.
pub(crate) struct ReadRun {
    pub(crate) problem: Arc<Read>,
    /// It is valid for the system; `None` for the exact flow.
    pub(crate) scheme: Option<NamedScheme>,
    /// What should be known of the scheme, and of the end.
    pub(crate) notes: [Option<Note>; 2],
    pub(crate) h: StepSize,
    pub(crate) steps: u64,
    /// When it ends at the latest.
    pub(crate) until: Rational,
    /// Whether that is a physical time, where time is transformed: how many steps there are is found by making them.
    is_open: bool,
    pub(crate) arithmetic: Arithmetic,
    displaced: bool,
    pub(crate) every: u64,
}

impl ReadRun {
    /// Its steps, with modified energies by an estimator, if there is one.
    pub(crate) fn run(&self, estimator: Option<&EstimatorSettings>) -> Run<'_> {
        let order = estimator.and_then(order_setting).map(|(name, value)| OrderSetting { name, value });
        let propagator = self.scheme.as_ref().map_or(EXACT_FLOW, |scheme| &scheme.name);
        Run { propagator, h: &self.h, steps: self.steps, order, windows: Run::WINDOWS }
    }

    /// Refuses a run with derivatives whose number of steps is not known.
    pub(crate) fn check_steps(&self) -> Fallible<()> {
        let hint = "steps = 1000; the derivatives are those at a fixed number of steps";
        match self.is_open {
            true => Err(usage("in transformed time derivatives need the number of steps", hint)),
            false => Ok(()),
        }
    }

    /// What is to be noted of steps of this size.
    pub(crate) fn note_of_steps(&self) -> Option<Note> {
        let system = &self.problem.system;
        note_of_steps((system, system.fastest_frequency()), self.scheme.as_ref()?, self.h.exact())
    }

    /// The run of a scheme.
    pub(crate) fn posed<'a>(&'a self, estimator: Option<&'a EstimatorSettings>) -> Fallible<Posed<'a>> {
        let scheme = self.scheme.as_ref().ok_or_else(|| usage("the exact flow makes no steps", "give a scheme"))?;
        let numbers = (self.arithmetic, self.displaced);
        let posed = Posed::new(&self.problem.system, &scheme.scheme, self.run(estimator), numbers);
        Ok(Posed { until: self.is_open.then_some(&self.until), estimator, ..posed })
    }
}

/// The map that a word means.
pub(crate) fn first_map(given: &str) -> Fallible<First> {
    word("first", given, &[("kick", First::Kick), ("drift", First::Drift)])
}

/// The scheme with steps that begin with a map, where one is given.
pub(crate) fn beginning_with(scheme: &NamedScheme, first: Option<First>) -> Result<NamedScheme, Error> {
    match first {
        Some(first) => Ok(scheme.beginning_with(first)?),
        None => Ok(scheme.clone()),
    }
}

/// The scheme, which must be valid for a system, with the digits of a run.
pub(crate) fn fitted(
    scheme: &NamedScheme,
    system: &System,
    arithmetic: Arithmetic,
) -> Result<(NamedScheme, Option<Note>), Error> {
    Ok(for_system(scheme.clone(), system)?.fitted(arithmetic)?)
}

/// The system in double precision with its steps, at its initial state.
pub(crate) fn integrator(
    system: &System,
    scheme: &NamedScheme,
    (h, compensated): (&StepSize, bool),
) -> Result<SceneIntegrator<f64>, MotionError> {
    let steps = Steps { scheme: &scheme.scheme, h, compensated, displaced: false, begin: Begin::InitialState };
    system.integrator(steps, system.start::<f64>(&()), &())
}

/// The options of an estimator; what is not given has its default.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    name: String,
    order: Option<u32>,
    max_order: Option<u32>,
    stop: Option<String>,
    rule: Option<String>,
    accuracy: Option<String>,
}

impl Options {
    pub(crate) fn settings(&self) -> Fallible<EstimatorSettings> {
        let Options { name, order, max_order, stop, rule, accuracy } = self;
        let (order, max_order) = (*order, *max_order);
        for (option, value) in [("order", order), ("max_order", max_order)] {
            let highest = EstimatorSettings::highest_order(name);
            if let Some((value, highest)) = value.zip(highest).filter(|(value, highest)| value > highest) {
                let message = format!("{option} = {value} is above {highest}, the largest order of {name}");
                return Err(usage(message, format!("give {highest} or less")));
            }
        }
        let stop = parsed::<StoppingRule>("stop", stop.as_ref(), StoppingRule::NAMES)?;
        let rule = parsed::<SelectionRule>("rule", rule.as_ref(), SelectionRule::NAMES)?;
        let accuracy = accuracy.as_ref().map(|text| -> Fallible<_> {
            let accuracy = number("accuracy", text)?;
            check_accuracy(&accuracy).map_err(|error| usage(format!("accuracy = {text} {error}"), ACCURACY_HINT))?;
            Ok(accuracy)
        });
        let options = EstimatorOptions { order, max_order, stop, rule, accuracy: accuracy.transpose()? };
        match EstimatorSettings::from_options(name, options) {
            Ok(Some(settings)) => Ok(settings),
            Ok(None) => {
                let names = EstimatorSettings::NAMES.join(", ");
                Err(usage(format!("there is no estimator `{name}`"), format!("it is one of {names}")))
            }
            Err(error) => {
                let (message, hint) = conflict(&error, error.option, |name, value| format!("{name} = {value}"));
                Err(usage(message, hint))
            }
        }
    }
}

fn parsed<T: FromStr>(option: &str, text: Option<&String>, names: &[&str]) -> Fallible<Option<T>> {
    let unknown = |text| usage(format!("{option} = {text} is not known"), format!("it is one of {}", names.join(", ")));
    text.map(|text| text.parse().map_err(|_| unknown(text))).transpose()
}
