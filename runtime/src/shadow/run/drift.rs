//! The drift of the modified energy over a run: the paper's max − min, and the permanent change.

use crate::number::Real;
use crate::shadow::run::error::RunError;
use crate::shadow::run::permanent::{LowErrorStates, PermanentChange};
use crate::shadow::run::shadow_run::ShadowRun;
use crate::shadow::run::state::States;
use crate::shadow::{BuildEstimator, Estimate, Estimator};
use crate::steps::integrator::Integrator;
use crate::steps::step_size::StepSize;

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
pub fn energy_drift<I: Integrator<Number: Real>>(
    integrator: I,
    steps: u64,
    settings: &impl BuildEstimator<I::Number>,
) -> Result<EnergyDrift<I::Number>, RunError> {
    let mut run = ShadowRun::new(integrator, steps, settings)?;
    let mut found = run.drift()?;
    found.evaluations = run.integrator().state().evaluations();
    Ok(found)
}

impl<T: States, E: Estimator<T::Number>> ShadowRun<T, E> {
    /// Runs to the end and keeps the extremes of the modified energy. The evaluations are left 0; [`energy_drift`]
    /// counts them.
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
        let mut extremes = DriftRecorder::new(self.step_size().clone()).compensated_if(self.is_compensated());
        while let Some((n, estimate)) = self.advance()? {
            extremes.include(n, &estimate);
            progress(n);
        }
        Ok(extremes.drift().expect("a run has the state 0"))
    }
}

/// Finds the energy drift of estimates that a caller takes from a [`ShadowRun`] one by one.
///
/// ```
/// use shadowstep::shadow::run::{DriftRecorder, ShadowRun};
/// use shadowstep::shadow::Bilinear;
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Pendulum, tables::shipped};
///
/// let motion = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0])?;
/// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10")?;
/// let mut run = ShadowRun::new(stepper.with(motion), 500, &Bilinear::with_error(12))?;
/// let mut drift = DriftRecorder::new(run.step_size().clone());
/// while let Some((n, estimate)) = run.advance()? {
///     drift.include(n, &estimate);
/// }
/// assert!(drift.drift().unwrap().drift < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct DriftRecorder<N> {
    h: StepSize,
    compensated: bool,
    found: Option<(EnergyDrift<N>, LowErrorStates<N>)>,
}

impl<N: Real> DriftRecorder<N> {
    /// For steps of size h.
    pub fn new(h: StepSize) -> Self {
        DriftRecorder { h, compensated: false, found: None }
    }

    /// Whether the steps are made by a [compensated](crate::State::is_compensated) system, whose round-off is smaller.
    #[must_use]
    pub fn compensated_if(mut self, compensated: bool) -> Self {
        self.compensated = compensated;
        self
    }

    /// Takes the estimate of n.
    pub fn include(&mut self, n: i64, estimate: &Estimate<'_, N>) {
        let DriftRecorder { h, compensated, found } = self;
        let (drift, low_error) = found.get_or_insert_with(|| {
            let low_error = LowErrorStates::new(h, &estimate.value.context()).compensated_if(*compensated);
            (EnergyDrift::begin(estimate), low_error)
        });
        drift.include(n, estimate);
        low_error.include(n, estimate);
    }

    /// The drift so far; `None` without an estimate. The evaluations are left 0.
    pub fn drift(self) -> Option<EnergyDrift<N>> {
        let (mut drift, low_error) = self.found?;
        drift.drift.assign_difference(&drift.maximum, &drift.minimum);
        drift.permanent = low_error.change();
        Some(drift)
    }
}

impl<N: Real> EnergyDrift<N> {
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
