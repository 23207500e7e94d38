//! Speed against error, and advice on a scheme and a step size.

use std::path::PathBuf;
use std::time::Duration;

use pyo3::prelude::*;
use serde_json::{Value, json};
use shadowstep::Rational;
use shadowstep::tables::First;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::{Error, System};
use shadowstep_symbolic::decimal::to_text;
use shadowstep_work_precision::advise::{Advice, AdviceRequest, Choice, Verified};
use shadowstep_work_precision::length::{counts, length_of};
use shadowstep_work_precision::of::Of;
use shadowstep_work_precision::problem::Problem;
use shadowstep_work_precision::run::{Measurement, PositionError};
use shadowstep_work_precision::schemes::Group;
use shadowstep_work_precision::series::StepRange;
use shadowstep_work_precision::size::Size;
use shadowstep_work_precision::study::{Cost, Request, Studied, Study};

use crate::errors::{exception, usage};
use crate::given::{Given, GivenSystem, arithmetic, number, step_size, word};
use crate::given_run::{SystemWithScheme, beginning_with, first_map};
use crate::scheme::Table;
use crate::waiting::waiting_for;

/// What schemes are compared on, and the schemes.
struct Compared {
    system: GivenSystem,
    until: Rational,
    /// About the length of the runs in s, where time is transformed.
    length: Option<Rational>,
    arithmetic: Arithmetic,
    schemes: Vec<NamedScheme>,
}

/// What is asked for: the problem, the end of the runs, the number type, and the schemes, or the group that they are
/// of.
struct Asked {
    problem: Given,
    until: Rational,
    arithmetic: Arithmetic,
    schemes: Vec<NamedScheme>,
    group: Group,
    /// The map that steps begin with, in place of what the tables have.
    first: Option<First>,
}

impl Asked {
    /// Without schemes, those of the group, or a dozen, that are valid for the system.
    fn of(
        py: Python<'_>,
        problem: &Given,
        until: &str,
        (schemes, group): (&[PyRef<'_, Table>], Option<&str>),
        first: Option<&str>,
        digits: &str,
    ) -> PyResult<Self> {
        let group = group.map(|given| word(py, "schemes", given, &Group::NAMED)).transpose()?;
        let (arithmetic, until) = (arithmetic(py, digits, false)?, number(py, "until", until)?);
        if until == Rational::from_integer(0.into()) {
            return Err(usage(py, "until = 0: the runs must have a length", "until = 100"));
        }
        let first = first.map(|given| first_map(py, given)).transpose()?;
        let schemes = schemes.iter().map(|table| beginning_with(py, &table.0, first)).collect::<PyResult<_>>()?;
        let group = group.unwrap_or(Group::Default);
        Ok(Asked { problem: problem.clone(), until, arithmetic, schemes, group, first })
    }
}

impl Compared {
    fn of(asked: Asked) -> Result<Self, Error> {
        let Asked { problem, until, arithmetic, schemes, group, first } = asked;
        let system = problem.system(arithmetic)?;
        let valid = |scheme| SystemWithScheme::of(&problem, scheme, arithmetic).map(|posed| posed.scheme);
        let schemes = match &schemes[..] {
            [] => group.schemes(&system, arithmetic, first)?,
            given => given.iter().map(valid).collect::<Result<_, _>>()?,
        };
        let length = length_of(&system, &until)?;
        Ok(Compared { system, until, length, arithmetic, schemes })
    }

    fn problem(&self) -> Problem<'_> {
        let Compared { system, until, length, arithmetic, .. } = self;
        Problem { system, until, arithmetic: *arithmetic, length: length.as_ref() }
    }
}

/// The errors of several schemes on a problem beside a reference, and their cost, as JSON.
#[pyfunction]
#[pyo3(signature = (problem, until, schemes, group, *, first, steps, h, digits, seconds, folder, progress))]
#[allow(clippy::too_many_arguments)] // the package's own function has the defaults
pub(crate) fn work_precision(
    py: Python<'_>,
    problem: &Given,
    until: &str,
    schemes: Vec<PyRef<'_, Table>>,
    group: Option<&str>,
    first: Option<&str>,
    steps: Option<Vec<u64>>,
    h: Option<Vec<String>>,
    digits: &str,
    seconds: f64,
    folder: PathBuf,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    /// The reference may take this multiple of the time of a scheme.
    const REFERENCE: f64 = 10.0;
    let asked = Asked::of(py, problem, until, (&schemes, group), first, digits)?;
    let sizes = h.map(|sizes| sizes.iter().map(|h| step_size(py, h)).collect::<PyResult<Vec<_>>>()).transpose()?;
    let reference_time = Duration::from_secs_f64(REFERENCE * seconds);
    let found = waiting_for(py, progress, Some(problem), move |watched| {
        let mut compared = Compared::of(asked)?;
        let range = match (sizes, steps) {
            (Some(sizes), _) => StepRange::Given(counts(&sizes, &compared.until, compared.length.as_mut())?),
            (None, Some(steps)) => StepRange::Given(steps),
            (None, None) => StepRange::Automatic { seconds, target: None },
        };
        let request = Request::new(compared.problem(), &compared.schemes, range, reference_time, &folder);
        request.study(&mut watched.observer_of_tasks()).map(|study| of_study(&study))
    });
    Ok(found?.map_err(|error| exception(py, error))?.to_string())
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
    let (position, below) = match run.position {
        PositionError::Known(size) => (number_of(size), None),
        PositionError::Below(size) => (None, number_of(size)),
        PositionError::None => (None, None),
    };
    json!({
        "steps": run.steps,
        "h": <f64 as shadowstep::Number>::from_rational(&h, &()),
        "evaluations": run.evaluations,
        "seconds": studied.seconds(run),
        "position_error": position,
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

/// A scheme and a step size for a tolerance, as JSON.
#[pyfunction]
#[pyo3(signature = (problem, until, tolerance, *, of, cost, schemes, group, first, digits, seconds, folder, progress))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn advise(
    py: Python<'_>,
    problem: &Given,
    until: &str,
    tolerance: f64,
    of: &str,
    cost: &str,
    schemes: Vec<PyRef<'_, Table>>,
    group: Option<&str>,
    first: Option<&str>,
    digits: &str,
    seconds: f64,
    folder: PathBuf,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let of = word(py, "of", of, &[("position", Of::Position), ("energy", Of::Energy), ("permanent", Of::Permanent)])?;
    let cost = word(py, "cost", cost, &[("forces", Cost::Evaluations), ("time", Cost::Seconds)])?;
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(usage(py, format!("tolerance = {tolerance}: the tolerance must be positive"), "tolerance = 1e-8"));
    }
    let asked = Asked::of(py, problem, until, (&schemes, group), first, digits)?;
    let found = waiting_for(py, progress, Some(problem), move |watched| {
        let compared = Compared::of(asked)?;
        let request = AdviceRequest {
            problem: compared.problem(),
            schemes: &compared.schemes,
            of,
            tolerance: Size::of(&tolerance),
            cost,
            seconds,
            folder,
        };
        request.run(&mut watched.observer_of_tasks()).map(|advice| of_advice(&advice, &request))
    });
    Ok(found?.map_err(|error| exception(py, error))?.to_string())
}

fn of_advice(advice: &Advice<'_>, request: &AdviceRequest<'_>) -> Value {
    let system = request.problem.system;
    match advice {
        Advice::Found { choices, verified, part, unfinished } => {
            let choices: Vec<Value> = choices.iter().map(|choice| of_choice(choice, system)).collect();
            let at_most = !matches!(verified, Verified::Error(_));
            json!({ "found": true, "choices": choices, "verified": number_of(verified.size()), "at_most": at_most, "part": part,
                "untried": unfinished.untried, "extrapolated": unfinished.extrapolated })
        }
        Advice::OutOfReach { least, part, in_time, unfinished, .. } => json!({
            "found": false,
            "reason": advice.reason(request),
            "least": least.map(|(error, _)| number_of(error)),
            "scheme": least.map(|(_, name)| name),
            "part": part,
            "in_time": in_time,
            "untried": unfinished.untried,
            "extrapolated": unfinished.extrapolated,
        }),
    }
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
