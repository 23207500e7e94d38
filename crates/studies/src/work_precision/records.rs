//! The results as rows: CSV, and JSON lines with the same keys.

use serde::Serialize;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::Error;
use crate::files;
use crate::work_precision::run::{Measurement, PositionError};
use crate::work_precision::size::Size;
use crate::work_precision::study::{Studied, Study};

/// A run of a scheme. Errors are texts, as they may be beyond the range of `f64`; what is not known is empty.
#[derive(Serialize)]
struct Record<'a> {
    scheme: &'a str,
    /// The proved order for the kinetic energy of the problem.
    order: u32,
    /// The exact step size.
    step: String,
    steps: u64,
    evaluations: u64,
    /// The time of the bare steps: median, least and most of the repeats.
    seconds: f64,
    seconds_least: f64,
    seconds_most: f64,
    /// |q − q_ref| at the end and the largest at the samples.
    position_error: Option<String>,
    position_error_largest: Option<String>,
    /// What it is below where the reference does not resolve it.
    position_error_below: Option<String>,
    /// The largest |H − H(0)| and that at the end, as parts of |H(0)| unless that is 0.
    energy_error: Option<String>,
    energy_error_at_end: Option<String>,
    /// The same of the modified energy.
    modified_energy_drift: Option<String>,
    modified_energy_change: Option<String>,
    permanent_change_excluded_above: Option<String>,
    verdict: &'a str,
    /// The part of the run after which a state was not finite.
    failed_after: Option<f64>,
}

impl Study<'_> {
    /// All runs as CSV, after lines with # that give the command and the reference.
    ///
    /// # Errors
    /// None but those of the CSV writer, which does not fail on texts.
    pub fn csv(&self, head: &[String]) -> Result<String, Error> {
        files::csv(head, self.records())
    }

    /// All runs as JSON objects, a line each.
    pub(crate) fn json_lines(&self) -> Result<String, Error> {
        self.records().map(|record| Ok(serde_json::to_string(&record)? + "\n")).collect()
    }

    fn records(&self) -> impl Iterator<Item = Record<'_>> {
        self.schemes
            .iter()
            .flat_map(move |studied| studied.series.runs.iter().map(move |run| self.record(studied, run)))
    }

    fn record<'a>(&self, studied: &'a Studied<'_>, run: &'a Measurement) -> Record<'a> {
        let finite = run.failed.is_none();
        let size = |size: Size| finite.then(|| size.to_string());
        let known = |error: PositionError| error.known().map(|size| size.to_string());
        let below = match run.position {
            PositionError::Below(size) => Some(size.to_string()),
            PositionError::Known(_) | PositionError::None => None,
        };
        let steps = run.steps as f64;
        Record {
            scheme: &studied.scheme.name,
            order: studied.proved_order(self.problem),
            step: to_text(&self.problem.step_size(run.steps)),
            steps: run.steps,
            evaluations: run.evaluations,
            seconds: steps * studied.time.median,
            seconds_least: steps * studied.time.least,
            seconds_most: steps * studied.time.most,
            position_error: known(run.position),
            position_error_largest: known(run.largest_position),
            position_error_below: below,
            energy_error: size(run.energy),
            energy_error_at_end: size(run.energy_at_end),
            modified_energy_drift: run.modified.map(|modified| modified.drift.to_string()),
            modified_energy_change: run.modified.map(|modified| modified.change.to_string()),
            permanent_change_excluded_above: run.modified.and_then(|modified| modified.bound).map(|b| b.to_string()),
            verdict: &run.verdict,
            failed_after: run.failed,
        }
    }
}
