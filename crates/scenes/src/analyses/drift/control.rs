//! The control: the same estimates on the exact flow, whose energy does not change.
//!
//! A state of it may cost far more than a step: on Kepler's problem a sine and a cosine of all digits. So the control
//! is made where these states take no longer than the run itself, or than a second, as the first of them show; and it
//! is given up where it takes twice that time.

use std::collections::BTreeMap;
use std::time::Duration;

use shadowstep::Rational;
use shadowstep::number::CorrectlyRounded;
use shadowstep::problems::Setup;
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::States;

use super::follower::Follower;
use super::measure::measure;
use super::record::{Control, Permanent};
use crate::analyses::estimates::Estimates;
use crate::document::library::EXACT_FLOW;
use crate::execution::computation::RunNumber;
use crate::motion::propagator::{Propagator, with_exact_flow};
use crate::run::Run;
use crate::run::cpu_time::CpuTime;
use crate::texts::error::Error;

/// It is made in any case if it takes no longer than this.
const SHORT: Duration = Duration::from_secs(1);

/// Whether controls are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// However long they take.
    Always,
    /// Where they take no longer than the run, or than a second.
    IfFast,
    /// None.
    Never,
}

/// What is known of the control of a step size.
#[derive(Clone, Debug)]
pub(super) enum KnownControl {
    /// The exact flow is not known, or the control is not wanted.
    Nothing,
    Estimates(Control),
    /// Why it is left out.
    LeftOut(String),
}

impl KnownControl {
    pub(super) fn parts(self) -> (Option<Control>, Option<String>) {
        match self {
            KnownControl::Nothing => (None, None),
            KnownControl::Estimates(control) => (Some(control), None),
            KnownControl::LeftOut(why) => (None, Some(why)),
        }
    }
}

/// The controls by step size.
#[derive(Debug)]
pub struct Controls {
    wanted: Wanted,
    known: BTreeMap<Rational, KnownControl>,
}

impl Controls {
    /// None so far.
    pub fn new(wanted: Wanted) -> Self {
        Controls { wanted, known: BTreeMap::new() }
    }

    /// The control of a run that took `seconds`.
    pub(super) fn of<N: RunNumber>(
        &mut self,
        estimates: Estimates<'_>,
        context: &N::Context,
        seconds: Duration,
        follower: &mut dyn Follower,
    ) -> KnownControl {
        let setup = with_exact_flow(estimates.system);
        let Some(setup) = setup.filter(|_| self.wanted != Wanted::Never) else { return KnownControl::Nothing };
        let limit = (self.wanted == Wanted::IfFast).then(|| seconds.max(SHORT));
        // a slower scheme may allow what a faster one did not
        if let Some(known) =
            self.known.get(estimates.run.h.exact()).filter(|known| !matches!(known, KnownControl::LeftOut(_)))
        {
            return known.clone();
        }
        let run = Run { propagator: EXACT_FLOW, ..estimates.run };
        let estimates = Estimates { propagator: &Propagator::ExactFlow, run, ..estimates };
        let found = match expected::<N>(&setup, run, context) {
            Some(expected) if limit.is_some_and(|limit| expected > limit) => left_out(expected, seconds),
            _ => control::<N>(estimates, context, limit, seconds, follower),
        };
        self.known.insert(run.h.exact().clone(), found.clone());
        found
    }
}

/// How long the states of the exact flow will take, measured on the first ones; `None` if that is too short to matter,
/// or if the flow cannot be followed, which the control reports.
fn expected<N: CorrectlyRounded>(setup: &Setup, run: Run<'_>, context: &N::Context) -> Option<Duration> {
    const SAMPLE: u32 = 3;
    let mut flow = ExactFlow::<N>::new(setup, run.h, run.steps, 0, context).ok()?;
    flow.advance().ok()?;
    let begin = CpuTime::begin();
    for _ in 0..SAMPLE {
        flow.advance().ok()?;
    }
    let all = begin.elapsed().as_secs_f64() / f64::from(SAMPLE) * run.steps as f64;
    Duration::try_from_secs_f64(all).ok()
}

fn control<N: RunNumber>(
    estimates: Estimates<'_>,
    context: &N::Context,
    limit: Option<Duration>,
    seconds: Duration,
    follower: &mut dyn Follower,
) -> KnownControl {
    follower.begins_control(estimates.run);
    let begin = CpuTime::begin();
    let (steps, mut expected) = (estimates.run.steps as f64, None);
    let found = measure::<N>(estimates, context, |n| {
        if limit.is_some_and(|limit| begin.elapsed() > 2 * limit) {
            let all = begin.elapsed().mul_f64(steps / (n as f64).max(1.0));
            expected = Some(all.max(begin.elapsed()));
            return Err(Error::run("the control takes too long", "require the control"));
        }
        follower.reaches(estimates.run, n)
    });
    match (found, expected) {
        (Ok((found, _)), _) => {
            let (drift, permanent_change) = (found.drift.to_text(), Permanent::of(&found));
            KnownControl::Estimates(Control { drift, permanent_change, seconds: begin.elapsed().as_secs_f64() })
        }
        (Err(_), Some(expected)) => left_out(expected, seconds),
        (Err(error), None) => {
            follower.no_control(&error);
            KnownControl::Nothing
        }
    }
}

fn left_out(expected: Duration, seconds: Duration) -> KnownControl {
    let times = (expected.as_secs_f64() / seconds.as_secs_f64()).max(1.0);
    let times = if times < 9.5 { format!("{times:.1}") } else { format!("{times:.0}") };
    KnownControl::LeftOut(format!("it would take about {times} times as long as the run; `control` makes it"))
}
