//! Three bodies whose encounters no fixed step resolves.

use crate::chart::{Axis, Chart, Curve};
use crate::stability::prelude::*;
use crate::stability::scene_run::{Ended, RunResult, digits, run_scene};

/// The case.
pub(super) struct Pythagorean;

const UNTIL: u64 = 10;
/// An energy that has changed by this part is lost.
const LOST: f64 = 0.1;

impl Case for Pythagorean {
    type Measured = RunResult;

    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<RunResult, Error> {
        let (evaluations, inverse) = (trial.evaluations(), trial.get::<u64>("inverse"));
        let text = format!(
            "problem.name = \"pythagorean\"\n\
             run = {{ scheme = \"{}\", step = \"{evaluations}/{inverse}\", steps = {}, digits = {} }}\n\
             output.energy = {{ every = 1000 }}\n",
            trial.name(),
            UNTIL * inverse / evaluations,
            digits(trial.arithmetic)
        );
        run_scene(text, continues)
    }

    fn judge(all: &[&Done<'_, RunResult>]) -> Vec<Row> {
        let row = |Done { trial, found }: &&Done<'_, RunResult>| {
            let (what, verdict) = match found {
                RunResult::Failed(message) => (message.clone(), Verdict::Agrees),
                RunResult::Ended(Ended { energy, verdict, fine, encounters, closest, .. }) => {
                    let what = format!("energy off by {energy:.1e} of it; {verdict}; close encounters {closest}");
                    (what, Verdict::from(*energy <= LOST || (!fine && *encounters > 0)))
                }
            };
            let h = format!("h = {}/{}", trial.evaluations(), trial.get::<u64>("inverse"));
            Row::of(trial, format!("{h}: {what}"), verdict)
        };
        all.iter().map(row).collect()
    }

    fn finish(finding: &mut Finding, all: &[Done<'_, RunResult>]) {
        let point = |Done { trial, found }: &Done<'_, RunResult>| match found {
            RunResult::Ended(Ended { energy, .. }) => Some((trial.get::<f64>("inverse").log10(), energy.log10())),
            RunResult::Failed(_) => None,
        };
        let by_scheme = all.chunk_by(|one, other| one.trial.name() == other.trial.name()).enumerate();
        let curves =
            by_scheme.map(|(i, own)| Curve::marked(own[0].trial.name(), own.iter().filter_map(point).collect(), i));
        let (x, y) = (Axis::log10("evaluations a unit of time"), Axis::log10("largest error of H, as a part of H(0)"));
        let chart = Chart::new("The energy after the encounters", x, y, curves.collect());
        finding.chart(chart, "An error of 1 is the whole energy.");
    }
}
