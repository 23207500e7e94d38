//! A run of a scheme with a monitor: what it says, and when.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use shadowstep::shadow::Verdict;

use crate::Continues;
use crate::stability::integrator::AnyIntegrator;
use crate::verdict::Verdict as Agreement;

/// The monitor's estimator is E_8 with its error: 9 states a window.
pub(crate) const MONITOR_ORDER: u32 = 8;
/// The verdict is asked for again when the number of steps has grown by this part.
const REPORTS: u64 = 50;
/// Whether to continue is asked so often at most.
const QUESTIONS: u64 = 64;
const UNDECIDED: &str = "The monitor is undecided; more states, or a higher order of its estimator, may decide.";

/// What a monitor reported of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Watched {
    /// The steps that were made: less than requested if a state was not finite, or the run was ended.
    pub(crate) steps: u64,
    /// Whether all states were finite.
    pub(crate) finite: bool,
    /// max − min of H as a part of the mean kinetic energy; `None` if there is none.
    pub(crate) energy_error: Option<f64>,
    /// The verdict in a line.
    pub(crate) verdict: String,
    pub(crate) fine: bool,
    pub(crate) undecided: bool,
    /// The first state at which the verdict was that the step size is too large or that nothing is conserved.
    pub(crate) alarm: Option<u64>,
    /// The verdict then.
    pub(crate) alarmed: Option<String>,
}

impl Watched {
    /// Whether the monitor calls the step fine, where theory says that it is.
    pub(crate) fn is_fine(&self) -> Agreement {
        match (self.fine, self.undecided) {
            (true, _) => Agreement::Agrees,
            (false, true) => Agreement::NotDecided(UNDECIDED),
            (false, false) => Agreement::Differs,
        }
    }
}

/// Whether a verdict says that the steps do not conserve the energy.
fn is_alarm(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::TooLarge(_) | Verdict::NotConserved | Verdict::NearResonance { .. })
}

/// Makes `steps` steps, with a window of the monitor every `every` steps; `each` gets every state with its number from
/// 1 on.
pub(crate) fn watched(
    run: &mut dyn AnyIntegrator,
    every: u64,
    steps: u64,
    continues: Continues<'_>,
    each: &mut dyn FnMut(u64, &mut dyn AnyIntegrator) -> ControlFlow<()>,
) -> Watched {
    run.watch(MONITOR_ORDER, every);
    let (mut finite, mut alarm, mut alarmed, mut next_report) = (true, None, None, 0);
    for n in 1..=steps {
        let ended = match run.watched_step() {
            Ok(ended) => ended,
            Err(_) => {
                finite = false;
                alarm = alarm.or(Some(n));
                break;
            }
        };
        if ended && alarm.is_none() && n >= next_report {
            next_report = n + n / REPORTS;
            let verdict = run.monitor_outcome().verdict;
            if is_alarm(verdict) {
                (alarm, alarmed) = (Some(n), Some(verdict.to_string()));
            }
        }
        let asks = n % (steps / QUESTIONS).max(1) == 0;
        if each(n, run).is_break() || (asks && !continues(n as f64 / steps as f64)) {
            break;
        }
    }
    let said = run.monitor_outcome();
    let energy_error = said.energy_error / said.kinetic;
    Watched {
        steps: said.steps,
        finite,
        energy_error: energy_error.is_finite().then_some(energy_error),
        verdict: said.verdict.to_string(),
        fine: said.verdict.is_bounded(),
        undecided: matches!(said.verdict, Verdict::Undecided(_)),
        alarm,
        alarmed,
    }
}
