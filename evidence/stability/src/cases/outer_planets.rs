//! The outer planets for 10⁸ days in double precision.

use shadowstep::Rational;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_studies::finding::Finding;

use crate::long_run::{LongCase, LongRun, LongRunResult, staying};
use crate::suite::{OF_ORDERS_2_TO_8, Suite};

/// The case.
pub(super) struct OuterPlanets;

/// The aphelion of Pluto is at 49.3 AU from the Sun; the largest coordinate at the start is Neptune's 25.7.
const STAYS: f64 = 2.0;

impl LongCase for OuterPlanets {
    const NAME: &'static str = "outer-planets";
    const TITLE: &'static str = "The Sun and the outer planets for 10⁸ days";
    const THEORY: &'static str = "Over 274 000 years no planet leaves. The error of H oscillates with the planets and \
        does not grow, until round-off is as large: that wanders like √t.";
    const REVISION: u32 = 4;
    const EVALUATION: f64 = 200e-9;

    fn runs(suite: &Suite) -> Vec<LongRun> {
        let until = suite.full_or_quick(1e8, 1e6);
        let h = Rational::from_integer(50.into());
        let runs = LongRun::at_equal_cost(&suite.schemes_or(&OF_ORDERS_2_TO_8), "outer-solar-system", &h, until);
        // the published data have a barycentre that moves
        runs.into_iter().map(|run| LongRun { about: 3, ..run }).collect()
    }

    /// Round-off is a part of the case.
    fn arithmetic(_: &Suite) -> Arithmetic {
        Arithmetic::DOUBLE
    }

    fn judge(suite: &Suite, measured: &[(LongRun, LongRunResult)]) -> Finding {
        staying((suite, measured), STAYS, "The error of H of the outer planets", "days")
    }
}
