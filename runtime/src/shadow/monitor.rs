//! A monitor of the modified energy in a loop.
//!
//! | file | what it is |
//! | --- | --- |
//! | `schedule` | which states belong to windows |
//! | `energies` | H and T at the middles of windows |
//! | `blocks` | the most accurate estimates and the means of the parts of a run, in fixed memory |
//! | `change`, `trend` | what these show: a permanent change and its uncertainty; constant, random walk or line |
//! | `statistics` | extremes and sums over the windows |
//! | `recent` | round-off, turning and consistency, from the newest states of a window |
//! | `turning` | the angle of a step, from differences of momenta |
//! | `fastest` | the coordinate that turns fastest, each by itself |
//! | `rate` | whether the rate is qᵀU_q − 2U |
//! | `roughness` | whether the forces are smooth |
//! | `report`, `verdict`, `text` | the result in numbers, as a verdict, and as text |

mod arithmetic;
mod blocks;
mod change;
mod energies;
mod estimated;
mod fastest;
mod rate;
mod recent;
mod report;
mod roughness;
mod schedule;
mod statistics;
mod text;
mod trend;
mod turning;
mod verdict;

pub use report::Report;
pub use roughness::Rough;
pub use trend::Trend;
pub use verdict::{Advice, Criterion, KINETIC_LIMIT, Missing, Verdict};

use self::blocks::Blocks;
use self::energies::Energies;
use self::estimated::Estimated;
use self::fastest::Fastest;
use self::rate::RateCheck;
use self::recent::Recent;
use self::schedule::Schedule;
use self::statistics::Statistics;
use crate::increments::Increments;
use crate::number::Ordered;
use crate::run::{Quantity, RunError, TrajectoryState, check_energy, check_stepper, check_value};
use crate::scheme::{Scheme, ValidFor};
use crate::shadow::estimator::{BuildEstimator, Estimator};
use crate::stepper::Stepper;
use crate::system::System;

/// Follows the modified energy H̄ of the trajectory that a loop computes.
///
/// It takes all states, and keeps the states of *windows*: as many as the estimator needs, at every step or
/// [every n steps](ShadowEnergy::every). Only the steps within windows are augmented; the others are plain steps, with the same
/// bits and cost. From the windows it keeps extremes, sums and 64 estimates, however
/// long the run: nothing is allocated after the beginning.
///
/// The [`Report`] splits the energy error into the method's part H − H̄, the range of H̄ beside the expected effect of round-off,
/// and its permanent change; and it has a [verdict](Verdict) on the step size.
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
/// assert_eq!(report.verdict, Verdict::Fine);
/// assert!(report.energy_error > 5e-3 && report.moved < 1e-12);
/// # assert!((farthest - 1.6).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// prints
///
/// ```text
/// the step size is fine (20000 steps, 200 windows)
///   energy error         9.38e-3  max − min of H; 1.9e-2 of T
///   the method's part    1.58e-3  rms of H − H̄, which is from -8.68e-3 to 3.27e-4
///   H̄ ranges over       2.40e-14  2.6e-12 of the energy error, a random walk
///   it changed by      -1.23e-14  it moved by 3.73e-14 beyond its errors
///   it is known to      2.22e-16  2.4e-14 of the energy error
///   round-off           1.02e-14  1.1e-12 of the energy error, expected by Brouwer's law
///   permanently         2.46e-14  2.6e-12 of the energy error, at most
///   fastest motion          17.0  steps a turn
///   the energy error is 1.9e-2 of T; in 20000 steps a permanent change above 4.99e-14 of T, 4.99e-17 of T per unit time is excluded
/// ```
///
/// Where a loop does more than steps, it can make them itself: with increments where
/// [`needs_increments`](ShadowEnergy::needs_increments) is true, and with [`observe`](ShadowEnergy::observe) after each.
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
/// Only the stepper may change the state, and the system must stay the same. Where increments were not computed or the state was
/// changed otherwise, the verdict is [`Verdict::Inconsistent`] as far as that can be detected.
///
/// # Cost
///
/// For a hundred bodies, with a window in 100 steps, a monitor costs a few per cent of the loop; `docs/monitor.md` has the
/// measurements, and `cargo bench -p shadowstep --bench monitor` repeats them.
#[derive(Clone, Debug)]
pub struct ShadowEnergy<S: Scheme, N: Ordered, E> {
    stepper: Stepper<S, N>,
    estimator: E,
    schedule: Schedule,
    energies: Energies<N>,
    /// The number of the present state.
    n: u64,
    /// The result of the newest window.
    newest: Newest<N>,
    statistics: Statistics<N>,
    blocks: Blocks<N>,
    recent: Recent<N>,
    fastest: Fastest<N>,
    /// In place of the unknown increment of β of the first state of a window.
    unknown: N,
    /// H − H̄
    method: N,
    rate: RateCheck<N>,
    /// The first state that was not finite, or whose energy was not.
    not_finite: Option<u64>,
}

/// The post-map of a processed scheme evaluates the forces too, between two steps of the kernel.
fn most_stages<S: Scheme, N: Ordered>(stepper: &Stepper<S, N>) -> u64 {
    if stepper.is_processed() { stepper.scheme().summary().evaluations as u64 } else { u64::MAX }
}

#[derive(Clone, Debug)]
struct Newest<N> {
    n: u64,
    modified: Estimated<N>,
    has_error: bool,
    /// k or m
    order: u32,
    energy: N,
    kinetic: N,
}

/// The result of a window.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a, N> {
    /// The state in the middle of the window, or the one just before that.
    pub n: u64,
    /// The modified energy H̄.
    pub modified: &'a N,
    /// Its error, if the estimator gives one.
    pub error: Option<&'a N>,
    /// The energy H of the state n.
    pub energy: &'a N,
}

impl<S: Scheme, N: Ordered, E: Estimator<N>> ShadowEnergy<S, N, E> {
    /// Begins at the system's present state, which is number 0. There is a window at every step.
    ///
    /// # Errors
    /// A state or an energy that is not finite; settings of the estimator that are not valid; a stepper whose weights have another
    /// precision than the system.
    pub fn new<M: System<Number = N>>(
        stepper: Stepper<S, N>,
        system: &mut M,
        settings: &impl BuildEstimator<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        let (dimension, context) = (system.q().len(), system.state().context());
        check_stepper(&stepper, system)?;
        let estimator = settings.build(stepper.step_size(), dimension, &context)?;
        let states = estimator.states();
        let [mut energy, mut kinetic] = [N::zero(&context), N::zero(&context)];
        system.assign_energies(None, &mut energy, &mut kinetic);
        check_energy(&energy, system.q(), 0)?;
        let schedule = Schedule::new(states, 1);
        let mut monitor = ShadowEnergy {
            schedule,
            energies: Energies::new(schedule, states, &context),
            estimator,
            n: 0,
            statistics: Statistics::new(&energy),
            blocks: Blocks::new(&energy),
            newest: Newest { n: 0, modified: Estimated::zero(&context), has_error: false, order: 0, energy, kinetic },
            recent: Recent::new(states, stepper.step_size(), dimension, &context)?
                .with_most_stages(most_stages(&stepper)),
            fastest: Fastest::new(dimension, &context),
            unknown: N::zero(&context),
            method: N::zero(&context),
            rate: RateCheck::new(dimension, &context),
            not_finite: None,
            stepper,
        };
        monitor.fastest.begin(0, system.p());
        monitor.take(system)?;
        Ok(monitor)
    }

    /// The stepper, for loops that make the steps themselves.
    pub fn stepper(&self) -> &Stepper<S, N> {
        &self.stepper
    }

    /// One window every `steps` steps, of as many states as the estimator needs, at a place among these steps that changes from
    /// window to window. If the windows leave no plain steps between them, all steps are augmented.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        let states = self.schedule.states();
        self.schedule = Schedule::new(states, steps);
        self.energies = Energies::new(self.schedule, states, &self.method.context());
        // the state 0 has come already
        if let Some(([energy, kinetic], _)) = self.energies.at_middle(0) {
            energy.assign(&self.newest.energy);
            kinetic.assign(&self.newest.kinetic);
        }
        self
    }

    /// The number of the present state.
    pub fn n(&self) -> u64 {
        self.n
    }

    /// Whether the next step must be an augmented one, which gives increments.
    pub fn needs_increments(&self) -> bool {
        self.schedule.needs_increments(self.n + 1)
    }

    /// One step, augmented where that is needed; gives the estimate that it completes.
    ///
    /// # Errors
    /// As [`observe`](ShadowEnergy::observe).
    #[inline]
    pub fn step<M: System<Number = N>>(&mut self, system: &mut M) -> Result<Option<Sample<'_, N>>, RunError>
    where
        S: ValidFor<M::Class>,
    {
        if self.needs_increments() {
            self.stepper.step_augmented(system);
        } else if self.schedule.begins(self.n + 1) {
            // the gradient at the first state of a window is the first one of an augmented step, too
            self.stepper.step_before_augmented(system);
        } else {
            self.stepper.step(system);
        }
        self.observe(system)
    }

    /// Takes the state that a step has made, an augmented one where [`needs_increments`](ShadowEnergy::needs_increments) was true;
    /// gives the estimate that it completes.
    ///
    /// # Errors
    /// A state of a window, or its energy or modified energy, that is not finite. What is not finite stays so: between the
    /// windows it is found by the next one. A system of another dimension than at the start.
    #[inline]
    pub fn observe<M: System<Number = N>>(&mut self, system: &mut M) -> Result<Option<Sample<'_, N>>, RunError> {
        self.n += 1;
        self.fastest.begin(self.n, system.p());
        if !self.schedule.takes(self.n) {
            return Ok(None);
        }
        match self.take(system) {
            Ok(ends) => Ok(ends.then(|| self.sample())),
            Err(error) => {
                if let RunError::NotFinite { step, .. } = error {
                    self.not_finite.get_or_insert(step.unsigned_abs());
                }
                Err(error)
            }
        }
    }

    /// Takes a state of a window; returns whether it ends one.
    #[inline(always)]
    fn take<M: System<Number = N>>(&mut self, system: &mut M) -> Result<bool, RunError> {
        let (coordinates, begun) = (system.q().len(), self.fastest.dimension());
        if coordinates != begun {
            return Err(RunError::Dimension { coordinates, begun });
        }
        if let Some(([energy, kinetic], is_checked)) = self.energies.at_middle(self.n) {
            // while the gradient is kept from which the energy follows
            system.assign_energies(None, energy, kinetic);
            if is_checked {
                self.rate.compare(system, energy);
            }
        }
        let begins = self.schedule.begins(self.n);
        let increments = if begins { Increments::of_beta(&self.unknown) } else { system.state().increments() };
        let (q, p) = (system.q(), system.p());
        TrajectoryState { n: number(self.n), q, p, increments }.check()?;
        self.recent.push(system, !begins && self.n > 0);
        let states = self.schedule.states();
        let estimate = self.estimator.push(q, p, increments);
        // the first states of a window complete estimates with the last ones of another, which are not valid
        if !self.schedule.ends(self.n) {
            return Ok(false);
        }
        let Some(estimate) = estimate else { return Ok(false) };
        let Newest { n, modified, has_error, order, energy, kinetic } = &mut self.newest;
        *n = self.n - (states as u64 / 2);
        modified.value.assign(estimate.value);
        *has_error = estimate.error.is_some();
        *order = estimate.order;
        match estimate.error {
            Some(error) => modified.error.assign(error),
            None => modified.error.assign_zero(),
        }
        let [of_middle, kinetic_of_middle] = self.energies.at_end();
        energy.assign(of_middle);
        kinetic.assign(kinetic_of_middle);
        self.schedule.advance();
        self.end_window()?;
        Ok(true)
    }

    #[inline(always)]
    fn end_window(&mut self) -> Result<(), RunError> {
        let Newest { n, modified, energy, kinetic, .. } = &self.newest;
        check_value(energy, Quantity::Energy, number(*n))?;
        check_value(&modified.value, Quantity::ModifiedEnergy, number(*n))?;
        check_value(&modified.error, Quantity::ModifiedEnergyError, number(*n))?;
        self.recent.end(&self.schedule, kinetic, &mut self.fastest);
        let best = self.blocks.push(energy, modified);
        self.method.assign_difference(energy, &best.value);
        self.statistics.add(energy, kinetic, &self.method, modified);
        Ok(())
    }

    fn sample(&self) -> Sample<'_, N> {
        let Newest { n, modified, has_error, energy, .. } = &self.newest;
        Sample { n: *n, modified: &modified.value, error: has_error.then_some(&modified.error), energy }
    }
}

/// The number of a state as trajectories count them.
fn number(n: u64) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX)
}
