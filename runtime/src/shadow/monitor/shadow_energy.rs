//! The monitor with a stepper of its own: for loops.

use std::ops::Deref;

use super::{Monitor, Sample};
use crate::number::Real;
use crate::shadow::estimator::{BuildEstimator, Estimator};
use crate::shadow::run::RunError;
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::stepper::Stepper;
use crate::systems::system::System;

/// Follows the modified energy H̄ of the trajectory that a loop computes.
///
/// It takes all states, and keeps the states of *windows*: as many as the estimator needs, at every step or
/// [every n steps](Monitor::every). Only the steps within windows are augmented; the others are plain steps, with the
/// same bits and cost. From the windows it keeps extremes, sums and 64 estimates, however long the run: nothing is
/// allocated after the beginning.
///
/// The [`Report`](super::Report) splits the energy error into the method's part H − H̄, the range of H̄ beside the
/// expected effect of round-off, and its permanent change; and it has a [verdict](super::Verdict) on the step size.
///
/// ```
/// use shadowstep::shadow::{Bilinear, ShadowEnergy, Verdict};
/// use shadowstep::{Motion, Stepper, UnitMasses, problems::Kepler, splitting_scheme};
///
/// #[splitting_scheme("stormer-verlet.toml")]
/// pub struct StormerVerlet;
///
/// let stepper = Stepper::new(StormerVerlet, "1/20")?;
/// let mut comet = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0])?; // eccentricity 0.6
/// let mut monitor = ShadowEnergy::new(stepper, &mut comet, &Bilinear::with_error(8))?.every(100);
///
/// let mut farthest = 0.0_f64;
/// for _ in 0..20_000 {
///     monitor.step(&mut comet)?;
///     farthest = farthest.max(comet.q()[0].hypot(comet.q()[1]));
/// }
///
/// let report = monitor.report();
/// println!("{report}");
/// assert_eq!(report.verdict, Verdict::Bounded);
/// assert!(report.energy_error > 5e-3 && report.moved < 1e-12);
/// # assert!((farthest - 1.6).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// prints
///
/// ```text
/// bounded: the energy error is 1.9 % of T (20000 steps, 199 windows)
///   energy error         9.39e-3  max − min of H; 1.9e-2 of T
///   the method's part    1.63e-3  rms of H − H̄, which is from -9.04e-3 to 3.31e-4
///   permanent change    3.60e-14  max − min of H̄; 3.8e-12 of the energy error, a random walk
///   H̄ changed by       -1.15e-14  from the beginning to the end; it moved by 3.70e-14 beyond its errors
///   H̄ is known to       2.22e-16  2.4e-14 of the energy error
///   round-off           1.02e-14  1.1e-12 of the energy error, expected by Brouwer's law
///   net change          3.68e-14  3.9e-12 of the energy error, at most
///   fastest motion          16.7  steps a turn
///   the energy error is 1.9 % of T; in 20000 steps a net change above 7.41e-14 of T, or 7.41e-17 of T per unit time, is excluded
/// ```
///
/// A loop that does nothing else is `monitor.steps(&mut comet, 20_000)?`. Where a loop does more than steps, it can
/// make them itself: with increments where [`needs_increments`](Monitor::needs_increments) is true, and with
/// [`observe`](Monitor::observe) after each.
///
/// ```
/// # use shadowstep::shadow::{Bilinear, ShadowEnergy};
/// # use shadowstep::{Motion, Stepper, UnitMasses, problems::Pendulum, tables::shipped};
/// # let mut motion = Motion::new(Pendulum, UnitMasses, vec![0.0], vec![1.0])?;
/// let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10")?;
/// let mut monitor = ShadowEnergy::new(stepper, &mut motion, &Bilinear::with_error(6))?.every(50);
/// for _ in 0..5000 {
///     if monitor.needs_increments() {
///         monitor.stepper().step_augmented(&mut motion);
///     } else {
///         monitor.stepper().step(&mut motion);
///     }
///     if let Some(sample) = monitor.observe(&mut motion)? {
///         assert!((sample.modified - sample.energy).abs() < 1e-5); // one of a hundred
///     }
/// }
/// # assert_eq!(monitor.report().windows, 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Only the stepper may change the state, and the system must stay the same. Where increments were not computed or the
/// state was changed otherwise, the verdict is [`Verdict::Inconsistent`](super::Verdict::Inconsistent) as far as that
/// can be detected.
///
/// # Cost
///
/// For a hundred bodies, with a window in 100 steps, a monitor costs a few per cent of the loop; `docs/monitor.md` has
/// the measurements, and `cargo bench -p shadowstep --bench monitor` repeats them.
#[derive(Clone, Debug)]
pub struct ShadowEnergy<S: Scheme, N: Real, E> {
    stepper: Stepper<S, N>,
    monitor: Monitor<N, E>,
}

/// What it has found so far.
impl<S: Scheme, N: Real, E> Deref for ShadowEnergy<S, N, E> {
    type Target = Monitor<N, E>;

    fn deref(&self) -> &Monitor<N, E> {
        &self.monitor
    }
}

impl<S: Scheme, N: Real, E: Estimator<N>> ShadowEnergy<S, N, E> {
    /// Begins at the system's present state, which is number 0. There is a window at every step.
    ///
    /// # Errors
    /// A state or an energy that is not finite; settings of the estimator that are not valid; a stepper whose weights
    /// have another precision than the system.
    pub fn new<M: System<Number = N>>(
        stepper: Stepper<S, N>,
        system: &mut M,
        settings: &impl BuildEstimator<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        stepper.check(system)?;
        let stages = stepper.is_processed().then(|| stepper.scheme().summary().evaluations as u64);
        Ok(ShadowEnergy { monitor: Monitor::begin(stepper.step_size(), stages, system, settings)?, stepper })
    }

    /// The stepper, for loops that make the steps themselves.
    pub fn stepper(&self) -> &Stepper<S, N> {
        &self.stepper
    }

    /// As [`Monitor::every`].
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.monitor = self.monitor.every(steps);
        self
    }

    /// One step, augmented where that is needed; gives the estimate that it completes.
    ///
    /// # Errors
    /// As [`observe`](Monitor::observe).
    #[inline]
    pub fn step<M: System<Number = N>>(&mut self, system: &mut M) -> Result<Option<Sample<'_, N>>, RunError>
    where
        S: ValidFor<M::Class>,
    {
        self.stepper.step_carrying(system, self.monitor.carried());
        self.monitor.observe(system)
    }

    /// `count` steps with the bits and the report that [`step`](ShadowEnergy::step) gives, those between the windows as
    /// [`Stepper::steps`]: less time where forces cost little and windows are rare, for loops that do not look at each
    /// state.
    ///
    /// # Errors
    /// As [`observe`](Monitor::observe).
    pub fn steps<M: System<Number = N>>(&mut self, system: &mut M, count: u64) -> Result<(), RunError>
    where
        S: ValidFor<M::Class>,
    {
        let end = self.monitor.n() + count;
        while self.monitor.n() < end {
            let idle = self.monitor.idle().min(end - self.monitor.n());
            if idle > 0 {
                self.stepper.steps(std::slice::from_mut(system), idle);
                self.monitor.pass(idle);
            } else {
                self.step(system)?;
            }
        }
        Ok(())
    }

    /// As [`Monitor::observe`].
    ///
    /// # Errors
    /// As there.
    #[inline]
    pub fn observe<M: System<Number = N>>(&mut self, system: &mut M) -> Result<Option<Sample<'_, N>>, RunError> {
        self.monitor.observe(system)
    }
}
