//! A scheme and a step size with what is expected of them, from the errors of the runs of the scheme.

use shadowstep::{Number, Rational, Scheme};
use shadowstep_scenes::System;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::work_precision::best::{Curve, cost_of};
use crate::work_precision::size::Size;
use crate::work_precision::work::Work;

/// The longest text of a step size.
const LONGEST: usize = 40;
/// The highest order by which errors are extrapolated, where the proved one is lower.
const MOST_ORDER: f64 = 10.0;
/// An error above the prediction by more than this is a resonance of the step, not the growth of errors in time, log₁₀.
const RESONANCE: f64 = 1.0;

/// A scheme and a step size with what is expected of them.
#[derive(Clone, Debug)]
pub struct Choice<'a> {
    /// The scheme.
    pub scheme: &'a NamedScheme,
    /// The exact step size.
    pub step: Rational,
    /// The number of steps.
    pub steps: u64,
    /// The predicted error at the end.
    pub error: Size,
    /// Seconds for a step alone.
    pub seconds_per_step: f64,
    /// The largest stable step for the fastest oscillation, linearised at the start; `None` where nothing oscillates.
    pub stable_step: Option<f64>,
    /// The largest step of the scheme up to which the monitor's verdict was bounded or round-off; `None` if it was at
    /// no step.
    pub conserved_up_to: Option<f64>,
    /// The smallest step whose verdict was none of bounded, round-off and undecided.
    pub lost_from: Option<f64>,
    /// Whether the runs were over a part of the time.
    pub(crate) over_part: bool,
    /// Whether a larger step of the scheme missed the tolerance.
    pub(crate) missed: bool,
    /// Numbers of steps and predicted errors, log₁₀.
    pub(crate) curve: Curve,
    /// What the steps of the curve divide.
    pub(crate) length: f64,
    /// The proved order.
    pub(crate) order: f64,
}

impl Choice<'_> {
    /// The step size; the time divided by the number of steps, where the time is irrational and the fraction long.
    pub fn step_text(&self) -> String {
        let exact = to_text(&self.step);
        if exact.len() <= LONGEST { exact } else { format!("until/{}", self.steps) }
    }

    /// What the run costs beside its time.
    pub fn work(&self, system: &System) -> Work {
        Work::of_step(self.scheme, system).times(self.steps)
    }

    /// Evaluations of the gradient in the run.
    pub fn evaluations(&self) -> f64 {
        self.steps as f64 * self.scheme.scheme.summary().evaluations as f64
    }

    /// Seconds of the run, for its steps alone.
    pub fn seconds(&self) -> f64 {
        self.steps as f64 * self.seconds_per_step
    }

    /// |h|
    pub fn size(&self) -> f64 {
        <f64 as Number>::from_rational(&self.step, &()).abs()
    }

    /// The predicted error of steps of this size, log₁₀: between two runs that are powers of each other, beyond them by
    /// the order.
    pub(crate) fn predicted(&self, h: f64) -> f64 {
        let steps = self.length / h;
        match self.curve.iter().position(|(known, _)| *known >= steps) {
            Some(0) => by_order(self.curve[0], self.order, steps),
            Some(next) => {
                let ((a, above), (b, below)) = (self.curve[next - 1], self.curve[next]);
                above + (below - above) * (steps / a).ln() / (b / a).ln()
            }
            None => {
                let last = self.curve.last().copied().unwrap_or((1.0, f64::INFINITY));
                by_order(last, last_order(&self.curve, self.order), steps)
            }
        }
    }

    /// The largest step that is expected to have at most this error; `None` where no run has it.
    pub(crate) fn largest_step(&self, error: Size) -> Option<f64> {
        cost_of(&self.curve, error).map(|steps| self.length / steps)
    }

    /// With the error that the run of its steps had. Runs over a part of the time say how errors depend on the step:
    /// all are multiplied, so that the prediction is this error. Those over all of the time are what they are beside
    /// one more: near a resonance of the step its error says nothing of theirs. A part of the time may not show a
    /// resonance: an error far above the prediction is one, if it is the first.
    pub(crate) fn corrected(&self, found: Size) -> Choice<'_> {
        let shift = found.log10() - self.predicted(self.size());
        let is_resonance = shift > RESONANCE && !self.missed;
        let mut curve = self.curve.clone();
        if self.over_part && !is_resonance {
            curve.iter_mut().for_each(|(_, error)| *error += shift);
        } else {
            let steps = self.length / self.size();
            curve.retain(|(known, _)| *known != steps);
            curve.insert(curve.partition_point(|(known, _)| *known < steps), (steps, found.log10()));
        }
        Choice { curve, ..self.clone() }
    }
}

/// log₁₀ of the error with other steps, by an order.
fn by_order((steps, error): (f64, f64), order: f64, others: f64) -> f64 {
    error - order * (others / steps).log10()
}

/// The order of the last two runs, at least the proved one: errors of a dominant part's perturbation fall with a higher
/// one at first.
pub(crate) fn last_order(curve: &Curve, proved: f64) -> f64 {
    match curve[..] {
        [.., (a, above), (b, below)] => ((above - below) / (b / a).log10()).clamp(proved, MOST_ORDER.max(proved)),
        _ => proved,
    }
}
