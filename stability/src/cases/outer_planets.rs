//! The outer planets for 10⁸ days in double precision.

use shadowstep::number::Rounded;
use shadowstep::{Rational, Scheme};
use shadowstep_report::verdict::Verdict;
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;

use crate::bounded::{LongRun, Stayed, envelopes};
use crate::case::{Case, Continues};
use crate::finding::Finding;
use crate::suite::{Examined, Suite};

/// The case.
pub(super) struct OuterPlanets;

/// The planets stay within this many times the largest coordinate at the start: the aphelion of Pluto is at 49.3 AU, and it starts at 30.
const STAYS: f64 = 2.0;
/// How much the error of H may differ between the first and the last fourth.
const BOUNDED: f64 = 1.5;
const SCHEMES: [&str; 4] = ["stormer-verlet", "yoshida4", "blanes-moan-srkn6b", "kahan-li8"];

impl Case for OuterPlanets {
    const NAME: &'static str = "outer-planets";
    const TITLE: &'static str = "The Sun and the outer planets for 10⁸ days";
    const THEORY: &'static str = "Over 274 000 years no planet leaves. The error of H oscillates with the planets and does not grow, until round-off is \
        as large: that wanders like √t.";
    const REVISION: u32 = 3;

    type Trial = LongRun;
    type Measured = Stayed;

    fn trials(suite: &Suite) -> Vec<LongRun> {
        let until = suite.thorough(1e8, 1e6);
        let h = Rational::from_integer(50.into());
        let run = |scheme: &&Examined| {
            let evaluations = scheme.scheme.scheme.summary().evaluations;
            LongRun::at_equal_cost((&scheme.identity, evaluations), "outer-solar-system", &h, until)
        };
        suite.schemes_or(&SCHEMES).iter().map(run).collect()
    }

    fn arithmetic(_: &Suite) -> Arithmetic {
        Arithmetic::Double
    }

    fn seconds(suite: &Suite, trial: &LongRun) -> f64 {
        trial.seconds(suite, 200e-9)
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
                "{} steps of {} days: no coordinate beyond {:.2} of the largest initial one; {}; the monitor: {}",
                trial.steps,
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
            envelopes("The error of H of the outer planets", "days", runs),
            "Each point is the largest error in a 60th of the run.",
        );
        finding
    }
}
