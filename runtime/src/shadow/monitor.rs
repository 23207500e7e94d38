//! A monitor of the modified energy in a loop.
//!
//! | module | what it is |
//! | --- | --- |
//! | `schedule` | which states belong to windows |
//! | `energies` | H at the middles of windows |
//! | `kinetic` | the mean of T |
//! | `blocks` | the most accurate estimates and the means of the parts of a run, in fixed memory |
//! | `change`, `trend` | what these show: a permanent change and its uncertainty; constant, random walk or line |
//! | `statistics` | extremes and sums over the windows |
//! | `newest_states` | the newest states of a window |
//! | `kicks`, `turning_sums`, `consistency` | round-off, turning and consistency, from these states |
//! | `turning` | the angle of a step, from differences of momenta |
//! | `fastest` | the coordinate that turns fastest, each by itself |
//! | `rate` | whether the rate is qᵀU_q − 2U |
//! | `roughness` | whether the forces are smooth |
//! | `shadow_energy` | the monitor with a stepper of its own: for loops |
//! | `thresholds`, `evidence`, `whole_run`, `rules` | from numbers to verdicts |
//! | `report`, `verdict`, `judge`, `text` | the result in numbers, as a verdict, and as text |

mod arithmetic;
mod blocks;
mod change;
mod consistency;
mod energies;
mod estimated;
mod evidence;
mod fastest;
mod judge;
mod kicks;
mod kinetic;
mod newest_states;
mod rate;
mod report;
mod roughness;
mod rules;
mod schedule;
mod shadow_energy;
mod state_view;
mod statistics;
mod text;
mod thresholds;
mod trend;
mod turning;
mod turning_sums;
mod verdict;
mod whole_run;

pub use report::Report;
pub use roughness::Rough;
pub use shadow_energy::ShadowEnergy;
pub use trend::Trend;
pub use verdict::{Advice, Criterion, Missing, Verdict};
pub use whole_run::WholeRun;

use self::blocks::Blocks;
use self::energies::Energies;
use self::estimated::Estimated;
use self::fastest::Fastest;
use self::kinetic::MeanKinetic;
use self::newest_states::NewestStates;
use self::rate::RateCheck;
use self::schedule::Schedule;
use self::statistics::Statistics;
use crate::number::Real;
use crate::number::saved::{Fields, Saved, optional};
use crate::shadow::estimator::{BuildEstimator, Estimator};
use crate::shadow::run::{Quantity, RunError, TrajectoryState, check_energy, check_value};
use crate::steps::integrator::Integrator;
use crate::steps::step_size::StepSize;
use crate::systems::increments::{Carried, Increments};
use crate::systems::system::System;

/// Follows the modified energy H̄ of the states that an [integrator](crate::Integrator) makes: [`ShadowEnergy`] without
/// a stepper.
///
/// It takes every state with [`observe`](Monitor::observe), after a step that carries along what
/// [`carried`](Monitor::carried) says.
#[derive(Clone, Debug)]
pub struct Monitor<N: Real, E> {
    h: StepSize,
    estimator: E,
    schedule: Schedule,
    energies: Energies<N>,
    kinetic: MeanKinetic<N>,
    /// The number of the present state.
    n: u64,
    /// The result of the newest window.
    newest: Newest<N>,
    statistics: Statistics<N>,
    blocks: Blocks<N>,
    newest_states: NewestStates<N>,
    fastest: Fastest<N>,
    /// In place of the unknown increment of β of the first state of a window.
    unknown: N,
    /// H − H̄
    method: N,
    rate: RateCheck<N>,
    /// The first state that was not finite, or whose energy was not.
    not_finite: Option<u64>,
}

#[derive(Clone, Debug)]
struct Newest<N> {
    n: u64,
    modified: Estimated<N>,
    has_error: bool,
    /// k or m
    order: u32,
    energy: N,
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

impl<N: Real, E: Estimator<N>> Monitor<N, E> {
    /// Begins at the present state of an integrator, which is number 0. There is a window at every step.
    ///
    /// # Errors
    /// As [`ShadowEnergy::new`].
    pub fn new<I: Integrator<Number = N> + ?Sized>(
        integrator: &mut I,
        settings: &impl BuildEstimator<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        integrator.check()?;
        let stages = integrator.is_processed().then(|| integrator.scheme().evaluations as u64);
        let h = integrator.step_size().clone();
        Self::begin(&h, stages, integrator.system(), settings)
    }

    /// `stages` are the evaluations in a step of a processed scheme, whose post-map evaluates the forces too, between
    /// two steps of the kernel.
    fn begin<M: System<Number = N> + ?Sized>(
        h: &StepSize,
        stages: Option<u64>,
        system: &mut M,
        settings: &impl BuildEstimator<N, Estimator = E>,
    ) -> Result<Self, RunError> {
        let (dimension, context) = (system.massive_coordinates(), system.state().context());
        let estimator = settings.build(h, dimension, &context)?;
        let states = estimator.states();
        let [mut energy, mut kinetic] = [N::zero(&context), N::zero(&context)];
        system.assign_energy(None, &mut energy);
        system.assign_kinetic_energy(None, &mut kinetic);
        check_energy(&energy, system.state().q(), 0)?;
        let schedule = Schedule::new(states, 1);
        let mut monitor = Monitor {
            schedule,
            energies: Energies::new(schedule, states, &context),
            kinetic: MeanKinetic::new(1, &kinetic),
            estimator,
            n: 0,
            statistics: Statistics::new(&energy),
            blocks: Blocks::new(&energy),
            newest: Newest { n: 0, modified: Estimated::zero(&context), has_error: false, order: 0, energy },
            newest_states: NewestStates::new(states, h, dimension, &context)?
                .with_most_stages(stages.unwrap_or(u64::MAX)),
            fastest: Fastest::new(dimension, &context),
            unknown: N::zero(&context),
            method: N::zero(&context),
            rate: RateCheck::new(dimension, &context),
            not_finite: None,
            h: h.clone(),
        };
        monitor.fastest.begin(0, system.state().p());
        monitor.take(system)?;
        Ok(monitor)
    }

    /// One window every `steps` steps, of as many states as the estimator needs, at a place among these steps that
    /// changes from window to window. If the windows leave no plain steps between them, as with 0, all steps are
    /// augmented.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        let states = self.schedule.states();
        self.schedule = Schedule::new(states, steps);
        self.energies = Energies::new(self.schedule, states, &self.method.context());
        self.kinetic = self.kinetic.every(steps);
        // the state 0 has come already
        if let Some((energy, _)) = self.energies.at_middle(0) {
            energy.assign(&self.newest.energy);
        }
        self
    }

    /// The number of the present state.
    pub fn n(&self) -> u64 {
        self.n
    }

    /// How many of the following states it takes nothing of: they may [`pass`](Monitor::pass) by plain steps, and need
    /// not be observed.
    pub fn idle(&self) -> u64 {
        let next = self.n + 1;
        if self.fastest.begins(next) { 0 } else { self.schedule.idle(next).min(self.kinetic.idle(next)) }
    }

    /// Whether the state n is one of those over which [T](Report::kinetic) is a mean.
    pub fn takes_kinetic(&self, n: u64) -> bool {
        self.kinetic.takes(n)
    }

    /// This number of states passes unobserved, [`idle`](Monitor::idle) at most.
    pub fn pass(&mut self, states: u64) {
        self.n += states;
    }

    /// The system is at its present state again, after evaluations elsewhere, which are not of the next step.
    pub fn state_restored(&mut self) {
        self.newest_states.restored();
    }

    /// Whether the next step must be an augmented one, which gives increments.
    pub fn needs_increments(&self) -> bool {
        self.schedule.needs_increments(self.n + 1)
    }

    /// What the next step is to carry along: increments within windows, [`Carried::Rate`] just before one, which saves
    /// an evaluation.
    #[inline]
    pub fn carried(&self) -> Carried {
        match self.n + 1 {
            next if self.schedule.needs_increments(next) => Carried::Increments,
            next if self.schedule.begins(next) => Carried::Rate,
            _ => Carried::Nothing,
        }
    }

    /// One step of the integrator with which the monitor began, and [`observe`](Monitor::observe).
    ///
    /// # Errors
    /// As `observe`.
    #[inline]
    pub fn step<I: Integrator<Number = N> + ?Sized>(
        &mut self,
        integrator: &mut I,
    ) -> Result<Option<Sample<'_, N>>, RunError> {
        integrator.step(self.carried());
        self.observe(integrator.system())
    }

    /// Takes the state that a step has made, an augmented one where [`needs_increments`](Monitor::needs_increments) was
    /// true; gives the estimate that it completes.
    ///
    /// # Errors
    /// A state of a window, or its energy or modified energy, that is not finite. What is not finite stays so: between
    /// the windows it is found by the next one. A system of another dimension than at the start.
    #[inline]
    pub fn observe<M: System<Number = N> + ?Sized>(
        &mut self,
        system: &mut M,
    ) -> Result<Option<Sample<'_, N>>, RunError> {
        self.n += 1;
        self.fastest.begin(self.n, system.state().p());
        self.kinetic.observe(self.n, system);
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
    fn take<M: System<Number = N> + ?Sized>(&mut self, system: &mut M) -> Result<bool, RunError> {
        let (coordinates, begun) = (system.massive_coordinates(), self.fastest.dimension());
        if coordinates != begun {
            return Err(RunError::Dimension { coordinates, begun });
        }
        if let Some((energy, is_checked)) = self.energies.at_middle(self.n) {
            // while the gradient is kept from which the energy follows
            system.assign_energy(None, energy);
            if is_checked {
                self.rate.compare(system, energy);
            }
        }
        let begins = self.schedule.begins(self.n);
        let state = TrajectoryState::massive(system, number(self.n));
        let increments = if begins { Increments::of_beta(&self.unknown) } else { state.increments };
        let TrajectoryState { q, p, .. } = state;
        if !(self.newest_states.push(system, !begins && self.n > 0) && increments.beta.is_finite()) {
            TrajectoryState { increments, ..state }.check()?;
        }
        let states = self.schedule.states();
        let estimate = self.estimator.push_for_value(q, p, increments);
        // the first states of a window complete estimates with the last ones of another, which are not valid
        if !self.schedule.ends(self.n) {
            return Ok(false);
        }
        let Some(estimate) = estimate else { return Ok(false) };
        let Newest { n, modified, has_error, order, energy } = &mut self.newest;
        *n = self.n - (states as u64 / 2);
        modified.value.assign(estimate.value);
        *has_error = estimate.error.is_some();
        *order = estimate.order;
        match estimate.error {
            Some(error) => modified.error.assign(error),
            None => modified.error.assign_zero(),
        }
        energy.assign(self.energies.at_end());
        self.schedule.advance();
        self.end_window(system)?;
        Ok(true)
    }

    #[inline(always)]
    fn end_window<M: System<Number = N> + ?Sized>(&mut self, system: &mut M) -> Result<(), RunError> {
        let Newest { n, modified, energy, .. } = &self.newest;
        check_value(energy, Quantity::Energy, number(*n))?;
        check_value(&modified.value, Quantity::ModifiedEnergy, number(*n))?;
        check_value(&modified.error, Quantity::ModifiedEnergyError, number(*n))?;
        self.newest_states.end(&self.schedule, system, &mut self.fastest);
        let best = self.blocks.push(energy, modified);
        self.method.assign_difference(energy, &best.value);
        self.statistics.add(energy, (&self.method, &best.error), modified);
        Ok(())
    }

    fn sample(&self) -> Sample<'_, N> {
        let Newest { n, modified, has_error, energy, .. } = &self.newest;
        Sample { n: *n, modified: &modified.value, error: has_error.then_some(&modified.error), energy }
    }
}

/// All that the states so far have left, at any of them: a monitor that was begun anew, with the same estimator and an
/// integrator of the same kind, goes on from it with the same bits, also with windows at other distances.
impl<N: Real, E: Estimator<N> + Saved<N>> Saved<N> for Monitor<N, E> {
    fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Monitor { estimator, schedule, energies, kinetic, n, newest, statistics, blocks, .. } = self;
        to.count(n);
        schedule.fields(to);
        energies.fields(to);
        kinetic.fields(to);
        newest.fields(to);
        statistics.fields(to);
        blocks.fields(to);
        estimator.fields(to);
        self.newest_states.fields(to);
        self.fastest.fields(to);
        to.count(&mut self.rate.wrong);
        optional(to, &mut self.not_finite, &0, |to, n| to.count(n));
    }
}

impl<N: Real> Saved<N> for Newest<N> {
    fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Newest { n, modified, has_error, order, energy } = self;
        to.count(n);
        modified.fields(to);
        to.flag(has_error);
        let mut k = u64::from(*order);
        to.count(&mut k);
        *order = k as u32;
        to.number(energy);
    }
}

/// The number of a state as trajectories count them.
fn number(n: u64) -> i64 {
    i64::try_from(n).unwrap_or(i64::MAX)
}
