//! The drift of the modified energy of a run, beside the error of H; and on the exact flow the drift that is the
//! estimator's own.
//!
//! ```
//! use shadowstep::{StepSize, exact};
//! use shadowstep::shadow::Bilinear;
//! use shadowstep::tables::Source;
//! use shadowstep_scenes::System;
//! use shadowstep_scenes::arithmetic::Arithmetic;
//! use shadowstep_scenes::drift::{Controls, DriftRequest, Wanted};
//! use shadowstep_scenes::propagator::Propagator;
//! use shadowstep_scenes::run::Run;
//!
//! let text = "[problem]\nname = \"kepler\"".to_owned();
//! let (system, _) = System::read(&Source { path: "kepler".to_owned(), text }, Arithmetic::DOUBLE)?;
//! let (h, until) = (StepSize::try_from("1/20").unwrap(), exact("50").unwrap());
//! let estimator = Bilinear::new(8).into();
//! let (arithmetic, summarised) = (Arithmetic::DOUBLE, true);
//! let request = DriftRequest { problem: "kepler", system: &system, until: &until, arithmetic, estimator: &estimator, summarised };
//! let propagator = Propagator::of_system("yoshida4", &system)?;
//! let run = Run { propagator: propagator.name(), h: &h, steps: 1000, order: None, windows: Run::WINDOWS };
//! let record = request.run(&propagator, run, &mut Controls::new(Wanted::Never), &mut ())?;
//! assert!(record.drift.parse::<f64>().unwrap() < 1e-4);
//! # Ok::<(), shadowstep_scenes::Error>(())
//! ```

mod control;
mod follower;
mod measure;
mod record;

use shadowstep::Rational;
use shadowstep::number::CorrectlyRounded;
use shadowstep::shadow::run::EnergyDrift;
use shadowstep::shadow::{EstimatorSettings, SelectionRule, StoppingRule};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::analyses::estimates::{Estimates, Finished};
use crate::execution::computation::{Computation, RunNumber};
use crate::motion::propagator::Propagator;
use crate::run::Run;
use crate::run::arithmetic::Arithmetic;
use crate::run::cpu_time::CpuTime;
use crate::run::steps::StepsError;
use crate::scene::System;
use crate::texts::error::Error;
use crate::texts::readable::{LONGEST_NUMBER, shortened};
use control::KnownControl;
use measure::measure;

pub use control::{Controls, Wanted};
pub use follower::Follower;
pub use record::{Control, Cost, NOT_SEEN, OrderLabel, Permanent, Record};

/// What is the same in several runs.
#[derive(Clone, Copy)]
pub struct DriftRequest<'a> {
    /// The name of the problem in records.
    pub problem: &'a str,
    /// H and the initial state.
    pub system: &'a System,
    /// The time at which runs end at the latest.
    pub until: &'a Rational,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// The estimator.
    pub estimator: &'a EstimatorSettings,
    /// Whether summaries are made.
    pub summarised: bool,
}

impl DriftRequest<'_> {
    /// Makes a run, and its control.
    ///
    /// # Errors
    /// A run without steps; a state or a modified energy that is not finite; a follower that stops the run.
    pub fn run(
        &self,
        propagator: &Propagator,
        run: Run<'_>,
        controls: &mut Controls,
        follower: &mut dyn Follower,
    ) -> Result<Record, Error> {
        self.arithmetic.compute(Measurement { request: self, propagator, run, controls, follower })
    }

    /// Every parameter and initial value with its exact text, or the digits of what is irrational.
    fn values(&self) -> Vec<(String, String)> {
        self.system.named().map(|(name, exact)| (name.clone(), self.arithmetic.text(exact))).collect()
    }
}

/// The measurement of one run, in any number type.
struct Measurement<'a> {
    request: &'a DriftRequest<'a>,
    propagator: &'a Propagator,
    run: Run<'a>,
    controls: &'a mut Controls,
    follower: &'a mut dyn Follower,
}

impl Computation for Measurement<'_> {
    type Output = Result<Record, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Measurement { request, propagator, run, controls, follower } = self;
        let DriftRequest { system, summarised, arithmetic, .. } = *request;
        let settings = request.estimator.clone().with_errors(true);
        let until = Some(request.until).filter(|_| system.transformed_time().is_some());
        let begin = CpuTime::begin();
        let estimates = Estimates { system, propagator, run, arithmetic, settings: &settings, summarised, until };
        let (found, finished) = measure::<N>(estimates, context, |n| follower.reaches(run, n))?;
        if finished.steps == 0 {
            let [h, until] = [run.h.exact(), request.until].map(|time| shortened(time, LONGEST_NUMBER));
            let none = StepsError::LongerThanRun { h, until };
            return Err(Error::usage(none.to_string(), none.hint()));
        }
        let run = Run { steps: finished.steps, ..run };
        let seconds = begin.elapsed();
        let control = match propagator.scheme() {
            Some(_) => controls.of::<N>(estimates, context, seconds, follower),
            None => KnownControl::Nothing,
        };
        let per_step = propagator.scheme().map(|named| named.scheme.proved().plan.evaluations);
        let cost = Cost {
            forces_per_step: per_step,
            own_force_evaluations: finished.own_evaluations,
            force_evaluations: finished.evaluations,
            seconds: seconds.as_secs_f64(),
        };
        Ok(record(request, run, &found, finished, control, cost))
    }
}

fn record<N: CorrectlyRounded>(
    request: &DriftRequest<'_>,
    run: Run<'_>,
    found: &EnergyDrift<N>,
    finished: Finished<N>,
    control: KnownControl,
    cost: Cost,
) -> Record {
    let options = request.estimator.options();
    let (control, control_left_out) = control.parts();
    Record {
        shadowstep: env!("CARGO_PKG_VERSION"),
        problem: request.problem.to_owned(),
        parameters: request.values(),
        scheme: run.propagator.to_owned(),
        step: to_text(run.h.exact()),
        until: to_text(request.until),
        end: finished.end.map_or_else(|| to_text(&run.time_of_last()), |end| end.to_text()),
        digits: request.arithmetic.label(),
        estimator: request.estimator.name(),
        order: options.order.map_or(OrderLabel::Word("auto"), OrderLabel::Fixed),
        max_order: options.max_order,
        stop: options.stop.map(StoppingRule::name),
        rule: options.rule.map(SelectionRule::name),
        accuracy: options.accuracy.as_ref().map(to_text),
        energy_error: finished.energy,
        drift: found.drift.to_text(),
        minimum: found.minimum.to_text(),
        maximum: found.maximum.to_text(),
        at_minimum: found.at_minimum,
        at_maximum: found.at_maximum,
        first: found.first.to_text(),
        last: found.last.to_text(),
        permanent_change: Permanent::of(found),
        control,
        control_left_out,
        order_least: found.orders.0,
        order_most: found.orders.1,
        steps: run.steps,
        cost,
        summary: finished.summary,
    }
}
