//! Three bodies whose encounters no fixed step resolves.

use serde::Serialize;
use shadowstep::Scheme;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_studies::Continues;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

use crate::case::Case;
use crate::scene_run::{Ended, RunResult, digits, run_scene};
use crate::suite::{Examined, Suite};

/// The case.
pub(super) struct Pythagorean;

/// A run with a step of this number of evaluations, each 1/`inverse`.
#[derive(Serialize)]
pub(super) struct Trial {
    scheme: String,
    inverse: u64,
}

const UNTIL: u64 = 10;
const SCHEMES: [&str; 3] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b"];
/// An energy that has changed by this part is lost.
const LOST: f64 = 0.1;

impl Case for Pythagorean {
    const NAME: &'static str = "pythagorean";
    const TITLE: &'static str = "The Pythagorean problem of three bodies";
    const THEORY: &'static str = "Bodies of masses 3, 4, 5 fall from rest into close encounters, which no fixed step \
        of practical size resolves: the energy is lost in one of them. A run as users make it says so at its end, and \
        names the encounter.";
    const REVISION: u32 = 2;

    type Trial = Trial;
    type Measured = RunResult;

    fn trials(suite: &Suite) -> Vec<Trial> {
        let inverses = suite.full_or_quick(&[100, 1000, 10_000][..], &[100, 1000][..]);
        let of = |scheme: &&Examined| {
            let identity = scheme.identity.clone();
            inverses.iter().map(move |&inverse| Trial { scheme: identity.clone(), inverse })
        };
        suite.schemes_or(&SCHEMES).iter().flat_map(of).collect()
    }

    fn seconds(_: &Suite, trial: &Trial) -> f64 {
        (UNTIL * trial.inverse) as f64 * 200e-9
    }

    fn measure(
        suite: &Suite,
        trial: &Trial,
        arithmetic: Arithmetic,
        continues: Continues<'_>,
    ) -> Result<RunResult, Error> {
        let scheme = suite.scheme(&trial.scheme);
        let evaluations = scheme.scheme.summary().evaluations as u64;
        let text = format!(
            "problem.name = \"pythagorean\"\n\
             run = {{ scheme = \"{}\", step = \"{evaluations}/{}\", steps = {}, digits = {} }}\n\
             output.energy = {{ every = 1000 }}\n",
            scheme.name,
            trial.inverse,
            UNTIL * trial.inverse / evaluations,
            digits(arithmetic)
        );
        run_scene(text, continues)
    }

    fn judge(suite: &Suite, measured: &[(Trial, RunResult)]) -> Finding {
        let mut finding = Finding::default();
        for (trial, said) in measured {
            let evaluations = suite.scheme(&trial.scheme).scheme.summary().evaluations;
            let (what, verdict) = match said {
                RunResult::Failed(message) => (message.clone(), Verdict::Agrees),
                RunResult::Ended(Ended { energy, verdict, fine, encounters, closest, .. }) => {
                    let lost = *energy > LOST;
                    let named = *encounters > 0;
                    let what = format!("energy off by {energy:.1e} of it; {verdict}; close encounters {closest}");
                    (what, Verdict::from(!lost || (!fine && named)))
                }
            };
            finding.check(
                &suite.scheme(&trial.scheme).name,
                format!("h = {evaluations}/{}: {what}", trial.inverse),
                verdict,
            );
        }
        let curve = |(i, all): (usize, &[(Trial, RunResult)])| {
            let point = |(trial, said): &(Trial, RunResult)| match said {
                RunResult::Ended(Ended { energy, .. }) => Some(((trial.inverse as f64).log10(), energy.log10())),
                RunResult::Failed(_) => None,
            };
            Curve::marked(suite.scheme(&all[0].0.scheme).name.clone(), all.iter().filter_map(point).collect(), i)
        };
        let by_scheme = measured.chunk_by(|(one, _), (other, _)| one.scheme == other.scheme);
        let (x, y) = (Axis::log10("evaluations a unit of time"), Axis::log10("largest error of H, as a part of H(0)"));
        let chart = Chart::new("The energy after the encounters", x, y, by_scheme.enumerate().map(curve).collect());
        finding.chart(chart, "An error of 1 is the whole energy.");
        finding
    }
}
