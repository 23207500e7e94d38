//! What a run shows beside its states: indicators of chaos, and the drift of the modified energy.

use pyo3::prelude::*;
use serde_json::json;
use shadowstep_scenes::Error;
use shadowstep_scenes::chaos::{ChaosRequest, conclusion};
use shadowstep_scenes::drift::{Controls, DriftRequest, Follower, Wanted};
use shadowstep_scenes::library::EXACT_FLOW;
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::Run;
use shadowstep_scenes::tangent::Vectors;

use crate::errors::Fallible;
use crate::given_run::{GivenRun, Options};
use crate::values::Json;
use crate::waiting::{Watching, waiting_for};

/// The records of runs at h and, if `half` is true, h/2, with what both say.
#[pyfunction]
pub(crate) fn chaos(
    py: Python<'_>,
    run: GivenRun,
    vectors: usize,
    exponents: Option<usize>,
    half: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> Fallible<Json> {
    let problem = run.problem.get().clone();
    waiting_for(py, progress, Some(&problem), move |watched| {
        let run = run.read()?;
        let vectors = exponents.map_or(Vectors::Free(vectors), Vectors::Orthonormal);
        let request = ChaosRequest { posed: run.posed(None)?, vectors, every: run.every };
        let mut records = Vec::new();
        for parts in if half { 1..=2 } else { 1..=1 } {
            records.push(request.run(parts, &mut watched.observer())?);
        }
        let conclusion = match &records[..] {
            [whole, half] => conclusion(whole, half),
            _ => records[0].motion.to_string(),
        };
        Ok(Json::of(&json!({ "records": records, "conclusion": conclusion }))?)
    })
}

/// The drift of one run, with its control on the exact flow where that is wanted. Without a scheme it is the drift on
/// the exact flow.
#[pyfunction]
pub(crate) fn drift(
    py: Python<'_>,
    run: GivenRun,
    name: String,
    options: Options,
    control: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> Fallible<Json> {
    let problem = run.problem.get().clone();
    waiting_for(py, progress, Some(&problem), move |watched| {
        let (run, estimator) = (run.read()?, options.settings()?);
        let system = &run.problem.system;
        let propagator = match &run.scheme {
            Some(scheme) => Propagator::Scheme(Box::new(scheme.clone())),
            None => Propagator::of_system(EXACT_FLOW, system)?,
        };
        let (until, arithmetic) = (&run.until, run.arithmetic);
        let (problem, estimator) = (&*name, &estimator);
        let request = DriftRequest { problem, system, until, arithmetic, estimator, summarised: true };
        let mut controls = Controls::new(if control { Wanted::Always } else { Wanted::Never });
        let steps = run.run(Some(estimator));
        Ok(Json::of(&request.run(&propagator, steps, &mut controls, &mut watched.observer())?)?)
    })
}

impl Follower for Watching<'_> {
    fn reaches(&mut self, run: Run<'_>, n: i64) -> Result<(), Error> {
        match self.watched.reaches(n) {
            true => Ok(()),
            false => Err(Error::run(format!("{}: interrupted at n = {n}", run.name()), "run it again")),
        }
    }
}
