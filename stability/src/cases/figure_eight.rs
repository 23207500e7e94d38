//! Three bodies on a figure eight for 1000 periods.

use shadowstep::number::Rounded;
use shadowstep::{Rational, Scheme};
use shadowstep_report::verdict::Verdict;
use shadowstep_scenes::Error;

use crate::bounded::{LongRun, Stayed, envelopes};
use crate::case::{Case, Continues};
use crate::finding::Finding;
use crate::suite::Suite;

/// The case.
pub(super) struct FigureEight;

const PERIOD: f64 = 6.325_913_98;
/// The bodies stay within this many times their largest coordinate at the start; the orbit itself reaches 1.11.
const STAYS: f64 = 1.2;
/// How much the error of H may differ between the first and the last fourth: it is the same oscillation.
const BOUNDED: f64 = 1.5;
const SCHEMES: [&str; 5] = ["stormer-verlet", "yoshida4", "blanes-moan-s6", "blanes-moan-srkn6b", "kahan-li8"];

impl Case for FigureEight {
    const NAME: &'static str = "figure-eight";
    const TITLE: &'static str = "Three bodies on a figure eight";
    const THEORY: &'static str = "The orbit is stable, so that the three bodies stay near it with every symplectic scheme whose steps resolve it, and \
        the error of H is bounded.";
    const REVISION: u32 = 3;

    type Trial = LongRun;
    type Measured = Stayed;

    fn trials(suite: &Suite) -> Vec<LongRun> {
        let until = PERIOD * suite.thorough(1000.0, 50.0);
        let h = Rational::new(1.into(), 200.into());
        let run = |scheme: &&crate::suite::Examined| {
            let evaluations = scheme.scheme.scheme.summary().evaluations;
            LongRun::at_equal_cost((&scheme.identity, evaluations), "figure-eight", &h, until)
        };
        suite.schemes_or(&SCHEMES).iter().map(run).collect()
    }

    fn seconds(suite: &Suite, trial: &LongRun) -> f64 {
        trial.seconds(suite, 60e-9)
    }

    fn measure<N: Rounded + 'static>(
        suite: &Suite,
        trial: &LongRun,
        context: &N::Context,
        continues: Continues<'_>,
    ) -> Result<Stayed, Error> {
        trial.make::<N>(suite, context, continues)
    }

    fn judge(suite: &Suite, measured: &[(LongRun, Stayed)]) -> Finding {
        let mut finding = Finding::default();
        for (trial, stayed) in measured {
            let found = format!(
                "h = {}: bodies within {:.3} of the largest initial coordinate; {}; the monitor: {}",
                trial.h,
                stayed.farthest,
                stayed.errors(),
                stayed.watched.verdict
            );
            let stays = Verdict::from(stayed.is_bounded(BOUNDED) && stayed.farthest <= STAYS);
            let verdict = Verdict::of_all([stays, stayed.watched.is_fine()]);
            finding.row(&suite.scheme(&trial.scheme).name, found, verdict);
        }
        let runs = measured.iter().map(|(trial, stayed)| (suite.scheme(&trial.scheme).name.clone(), stayed));
        finding.chart(
            envelopes("The error of H on the figure eight", "t", runs),
            "Each point is the largest error in a 60th of the run.",
        );
        finding
    }
}
