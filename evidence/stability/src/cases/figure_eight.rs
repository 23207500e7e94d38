//! Three bodies on a figure eight for 1000 periods.

use shadowstep::Rational;
use shadowstep_studies::finding::Finding;

use crate::long_run::{LongCase, LongRun, LongRunResult, staying};
use crate::suite::Suite;

/// The case.
pub(super) struct FigureEight;

const PERIOD: f64 = 6.325_913_98;
/// The orbit reaches 1.11 of the largest initial coordinate.
const STAYS: f64 = 1.2;
const SCHEMES: [&str; 5] = ["stormer-verlet", "yoshida4", "blanes-moan-s6", "blanes-moan-srkn6b", "kahan-li8"];

impl LongCase for FigureEight {
    const NAME: &'static str = "figure-eight";
    const TITLE: &'static str = "Three bodies on a figure eight";
    const THEORY: &'static str = "The orbit is stable, so that the three bodies stay near it with every symplectic \
        scheme whose steps resolve it, and the error of H is bounded.";
    const REVISION: u32 = 3;
    const EVALUATION: f64 = 60e-9;

    fn runs(suite: &Suite) -> Vec<LongRun> {
        let until = PERIOD * suite.full_or_quick(1000.0, 50.0);
        let h = Rational::new(1.into(), 200.into());
        LongRun::at_equal_cost(&suite.schemes_or(&SCHEMES), "figure-eight", &h, until)
    }

    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding {
        staying((suite, measured), STAYS, "The error of H on the figure eight", "time units")
    }
}
