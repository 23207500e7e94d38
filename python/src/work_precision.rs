//! Speed against error, and advice on a scheme and a step size.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use pyo3::prelude::*;
use serde_json::{Value, json};
use shadowstep::Rational;
use shadowstep_scenes::System;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_studies::work_precision::advise::{Advice, AdviceRequest, Choice, Verified};
use shadowstep_studies::work_precision::length::{counts, length_of};
use shadowstep_studies::work_precision::of::Of;
use shadowstep_studies::work_precision::problem::Problem;
use shadowstep_studies::work_precision::run::{Measurement, PositionError};
use shadowstep_studies::work_precision::schemes::Group;
use shadowstep_studies::work_precision::series::StepRange;
use shadowstep_studies::work_precision::size::Size;
use shadowstep_studies::work_precision::study::{Cost, Request, Studied, Study};

use crate::errors::{Fallible, usage};
use crate::given::{Given, Read, arithmetic, number, step_size, word};
use crate::given_run::{beginning_with, first_map, fitted};
use crate::scheme::Table;
use crate::values::Json;
use crate::waiting::waiting_for;

/// What schemes are compared on, the schemes, or the group that they are of, and the time of the comparison, as Python
/// gives them. Without schemes and a group there are a dozen.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Comparison {
    problem: Py<Given>,
    until: String,
    schemes: Vec<Py<Table>>,
    group: Option<String>,
    /// The map that steps begin with, in place of what the tables have.
    first: Option<String>,
    digits: String,
    seconds: f64,
    folder: PathBuf,
}

/// What it means, with schemes that are valid for the system.
struct Compared {
    read: Arc<Read>,
    until: Rational,
    /// About the length of the runs in s, where time is transformed.
    length: Option<Rational>,
    arithmetic: Arithmetic,
    schemes: Vec<NamedScheme>,
}

impl Comparison {
    fn read(&self) -> Fallible<Compared> {
        let group = self.group.as_ref().map_or(Ok(Group::Default), |given| word("schemes", given, &Group::NAMED))?;
        let (arithmetic, until) = (arithmetic(&self.digits, false)?, number("until", &self.until)?);
        if until == Rational::from_integer(0.into()) {
            return Err(usage("until = 0: the runs must have a length", "until = 100"));
        }
        let first = self.first.as_deref().map(first_map).transpose()?;
        let read = self.problem.get().read(arithmetic)?;
        let valid = |table: &Py<Table>| -> Fallible<_> {
            Ok(fitted(&beginning_with(&table.get().0, first)?, &read.system, arithmetic)?.0)
        };
        let schemes = match &self.schemes[..] {
            [] => group.schemes(&read.system, arithmetic, first)?,
            given => given.iter().map(valid).collect::<Fallible<_>>()?,
        };
        let length = length_of(&read.system, &until)?;
        Ok(Compared { read, until, length, arithmetic, schemes })
    }
}

impl Compared {
    fn problem(&self) -> Problem<'_> {
        let Compared { read, until, length, arithmetic, .. } = self;
        Problem { system: &read.system, until, arithmetic: *arithmetic, length: length.as_ref() }
    }
}

/// The errors of several schemes on a problem beside a reference, and their cost.
#[pyfunction]
pub(crate) fn work_precision(
    py: Python<'_>,
    comparison: Comparison,
    steps: Option<Vec<u64>>,
    h: Option<Vec<String>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> Fallible<Json> {
    /// The reference may take this multiple of the time of a scheme.
    const REFERENCE: f64 = 10.0;
    let problem = comparison.problem.get().clone();
    waiting_for(py, progress, Some(&problem), move |watched| {
        let mut compared = comparison.read()?;
        let Comparison { seconds, folder, .. } = comparison;
        let range = match (h, steps) {
            (Some(sizes), _) => {
                let sizes = sizes.iter().map(|h| step_size(h)).collect::<Fallible<Vec<_>>>()?;
                StepRange::Given(counts(&sizes, &compared.until, compared.length.as_mut())?)
            }
            (None, Some(steps)) => StepRange::Given(steps),
            (None, None) => StepRange::Automatic { seconds, target: None },
        };
        let reference_time = Duration::from_secs_f64(REFERENCE * seconds);
        let request = Request::new(compared.problem(), &compared.schemes, range, reference_time, &folder);
        Ok(Json::of(&of_study(&request.study(&mut watched.observer())?))?)
    })
}

fn of_study(study: &Study<'_>) -> Value {
    let of_scheme = |studied: &Studied<'_>| {
        let run = |run: &Measurement| of_run(study, studied, run);
        json!({
            "scheme": studied.scheme.name,
            "order": studied.proved_order(study.problem),
            "evaluations_per_step": studied.evaluations_per_step(),
            "seconds_per_step": studied.time.median,
            "runs": studied.series.runs.iter().map(run).collect::<Vec<_>>(),
        })
    };
    json!(study.schemes.iter().map(of_scheme).collect::<Vec<_>>())
}

fn of_run(study: &Study<'_>, studied: &Studied<'_>, run: &Measurement) -> Value {
    let h = study.problem.step_size(run.steps);
    let below = if let PositionError::Below(size) = run.position { number_of(size) } else { None };
    json!({
        "steps": run.steps,
        "h": <f64 as shadowstep::Number>::from_rational(&h, &()),
        "evaluations": run.evaluations,
        "seconds": studied.seconds(run),
        "position_error": run.position.known().and_then(number_of),
        "position_error_below": below,
        "energy_error": number_of(run.energy),
        "permanent_bound": run.modified.and_then(|modified| modified.bound).and_then(number_of),
        "verdict": run.verdict,
        "failed": run.failed,
    })
}

/// The size as a double; `None` where it is not finite. Sizes below 1e-308 become 0.
fn number_of(size: Size) -> Option<f64> {
    size.is_finite().then(|| 10_f64.powf(size.log10()))
}

/// A scheme and a step size for a tolerance.
#[pyfunction]
pub(crate) fn advise(
    py: Python<'_>,
    comparison: Comparison,
    tolerance: f64,
    of: &str,
    cost: &str,
    progress: Option<&Bound<'_, PyAny>>,
) -> Fallible<Json> {
    let of = word("of", of, &[("position", Of::Position), ("energy", Of::Energy), ("permanent", Of::Permanent)])?;
    let cost = word("cost", cost, &[("forces", Cost::Evaluations), ("time", Cost::Seconds)])?;
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(usage(format!("tolerance = {tolerance}: the tolerance must be positive"), "tolerance = 1e-8"));
    }
    let problem = comparison.problem.get().clone();
    waiting_for(py, progress, Some(&problem), move |watched| {
        let compared = comparison.read()?;
        let Comparison { seconds, folder, .. } = comparison;
        let (problem, schemes, tolerance) = (compared.problem(), &compared.schemes[..], Size::of(&tolerance));
        let request = AdviceRequest { problem, schemes, of, tolerance, cost, seconds, folder };
        Ok(Json::of(&of_advice(&request.run(&mut watched.observer())?, &request))?)
    })
}

fn of_advice(advice: &Advice<'_>, request: &AdviceRequest<'_>) -> Value {
    let (choices, verified, least, unfinished) = match advice {
        Advice::Found { choices, verified, unfinished, .. } => (&choices[..], Some(verified), None, unfinished),
        Advice::OutOfReach { least, unfinished, .. } => (&[][..], None, least.as_ref(), unfinished),
    };
    json!({
        "choices": choices.iter().map(|choice| of_choice(choice, request.problem.system)).collect::<Vec<_>>(),
        "verified": verified.and_then(|verified| number_of(verified.size())),
        "at_most": verified.is_some_and(|verified| !matches!(verified, Verified::Error(_))),
        "least": least.and_then(|(error, _)| number_of(*error)),
        "reason": advice.reason(request),
        "untried": unfinished.untried,
        "extrapolated": unfinished.extrapolated,
    })
}

fn of_choice(choice: &Choice<'_>, system: &System) -> Value {
    let work = choice.work(system);
    json!({
        "scheme": choice.scheme.name,
        "h": to_text(&choice.step),
        "steps": choice.steps,
        "predicted": number_of(choice.error),
        "evaluations": choice.evaluations(),
        "hessian_products": work.products,
        "flows": work.flows,
        "seconds": choice.seconds(),
        "stable_step": choice.stable_step,
        "conserved_up_to": choice.conserved_up_to,
        "lost_from": choice.lost_from,
    })
}
