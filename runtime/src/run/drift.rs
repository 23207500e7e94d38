//! The drift of the modified energy over a run: the paper's max − min, and the permanent change.

use crate::number::Number;
use crate::run::error::RunError;
use crate::run::permanent::{LowErrorStates, PermanentChange};
use crate::run::shadow_run::ShadowRun;
use crate::run::state::States;
use crate::scheme::{Scheme, ValidFor};
use crate::shadow::{BuildEstimator, Estimate, Estimator};
use crate::stepper::Stepper;
use crate::system::System;

/// The modified energy over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyDrift<N> {
    /// maximum − minimum over n = 0..=steps: the paper's drift, which includes the error of the estimator.
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
    /// Its permanent change, if the estimator gives errors.
    pub permanent: Option<PermanentChange<N>>,
    /// The least and the largest m used.
    pub orders: (u32, u32),
    /// Evaluations of the gradient, those for the states on both sides included.
    pub evaluations: u64,
}

/// The energy drift over n = 0..=steps from the system's present state.
///
/// [`ShadowRun::drift_with_progress`] reports each n on the way.
///
/// # Errors
/// A state or a modified energy that is not finite; settings of the estimator that are not valid.
pub fn energy_drift<S, M>(
    stepper: &Stepper<S, M::Number>,
    system: M,
    steps: u64,
    settings: &impl BuildEstimator<M::Number>,
) -> Result<EnergyDrift<M::Number>, RunError>
where
    S: Scheme + ValidFor<M::Class>,
    M: System,
{
    let mut run = ShadowRun::new(stepper, system, steps, settings)?;
    let mut found = run.drift()?;
    found.evaluations = run.system().evaluations();
    Ok(found)
}

impl<T: States, E: Estimator<T::Number>> ShadowRun<T, E> {
    /// Runs to the end and keeps the extremes of the modified energy. The evaluations are left 0; [`energy_drift`] counts them.
    ///
    /// # Errors
    /// As [`advance`](ShadowRun::advance).
    ///
    /// # Panics
    /// If there is no estimate, as after the last one.
    pub fn drift(&mut self) -> Result<EnergyDrift<T::Number>, RunError> {
        self.drift_with_progress(|_| ())
    }

    /// As [`drift`](ShadowRun::drift), and calls `progress` with each n.
    ///
    /// # Errors
    /// As [`advance`](ShadowRun::advance).
    ///
    /// # Panics
    /// If there is no estimate, as after the last one.
    pub fn drift_with_progress(&mut self, mut progress: impl FnMut(i64)) -> Result<EnergyDrift<T::Number>, RunError> {
        let mut found: Option<EnergyDrift<T::Number>> = None;
        let h = self.step_size().clone();
        let mut low_error = None;
        while let Some((n, estimate)) = self.advance()? {
            match &mut found {
                None => found = Some(EnergyDrift::begin(&estimate)),
                Some(found) => found.include(n, &estimate),
            }
            let states = low_error.get_or_insert_with(|| LowErrorStates::new(&h, &estimate.value.context()));
            states.include(n, &estimate);
            progress(n);
        }
        let mut found = found.expect("a run has the state 0");
        found.drift.assign_difference(&found.maximum, &found.minimum);
        found.permanent = low_error.and_then(|states| states.change());
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
