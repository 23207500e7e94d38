//! The drift of the modified energy over a run: the paper's max − min, and the permanent change.

use super::{PermanentChange, Quiet, RunError, ShadowRun, States};
use crate::Rational;
use crate::kinetic::Kinetic;
use crate::motion::{Coordinates, Motion};
use crate::number::Number;
use crate::potential::Potential;
use crate::scheme::{Moves, Scheme};
use crate::shadow::{Estimate, Estimator, Method};

/// The modified energy over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyDrift<N> {
    /// maximum − minimum over n = 0..=steps: the paper's drift, in which is the estimator's own error.
    pub drift: N,
    /// The least modified energy.
    pub minimum: N,
    /// The largest.
    pub maximum: N,
    /// The first n with the least.
    pub at_minimum: i64,
    /// The first n with the largest.
    pub at_maximum: i64,
    /// At n = 0.
    pub first: N,
    /// At n = steps.
    pub last: N,
    /// By how much it changed for good, if the estimator tells errors.
    pub permanent: Option<PermanentChange<N>>,
    /// The least and the largest m used.
    pub orders: (u32, u32),
    /// Evaluations of the gradient, those for the states on both sides included.
    pub evaluations: u64,
}

/// Runs over n = 0..=steps and keeps the extremes of the modified energy; `progress` hears of each n.
///
/// # Errors
/// A step of size 0, a state or a modified energy that is not finite.
pub fn energy_drift<S, N, V, P, K>(
    scheme: &S,
    motion: Motion<N, V, P, K>,
    h: &Rational,
    steps: u64,
    method: &impl Method<N>,
    progress: impl FnMut(i64),
) -> Result<EnergyDrift<N>, RunError>
where
    S: Scheme + Moves<K::Class>,
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
{
    let mut run = ShadowRun::new(scheme, motion, h, steps, method)?;
    let mut found = run.drift(progress)?;
    found.evaluations = run.motion().evaluations();
    Ok(found)
}

impl<T: States, E: Estimator<T::Number>> ShadowRun<T, E> {
    /// Runs to the end and keeps the extremes of the modified energy; `progress` hears of each n. Evaluations are not counted
    /// here: [`energy_drift`] does.
    ///
    /// # Errors
    /// As [`advance`](ShadowRun::advance).
    ///
    /// # Panics
    /// If there is no estimate, as after the last one.
    pub fn drift(&mut self, mut progress: impl FnMut(i64)) -> Result<EnergyDrift<T::Number>, RunError> {
        let mut found: Option<EnergyDrift<T::Number>> = None;
        let h = self.h.clone();
        let mut quiet = None;
        while let Some((n, estimate)) = self.advance()? {
            match &mut found {
                None => found = Some(EnergyDrift::begin(&estimate)),
                Some(found) => found.include(n, &estimate),
            }
            let quiet = quiet.get_or_insert_with(|| Quiet::new(&h, &estimate.value.context()));
            quiet.include(n, &estimate);
            progress(n);
        }
        let mut found = found.expect("a run has the state 0");
        found.drift.assign_difference(&found.maximum, &found.minimum);
        found.permanent = quiet.and_then(|quiet| quiet.change());
        Ok(found)
    }
}

impl<N: Number> EnergyDrift<N> {
    fn begin(estimate: &Estimate<'_, N>) -> Self {
        let value = || estimate.value.clone();
        EnergyDrift {
            drift: N::zero(&estimate.value.context()),
            minimum: value(),
            maximum: value(),
            at_minimum: 0,
            at_maximum: 0,
            first: value(),
            last: value(),
            permanent: None,
            orders: (estimate.order, estimate.order),
            evaluations: 0,
        }
    }

    fn include(&mut self, n: i64, estimate: &Estimate<'_, N>) {
        if *estimate.value < self.minimum {
            self.minimum.assign(estimate.value);
            self.at_minimum = n;
        }
        if *estimate.value > self.maximum {
            self.maximum.assign(estimate.value);
            self.at_maximum = n;
        }
        self.last.assign(estimate.value);
        self.orders = (self.orders.0.min(estimate.order), self.orders.1.max(estimate.order));
    }
}
