//! Ensembles: many trajectories of systems that differ in their initial states and parameters, in lanes and on all
//! cores.
//!
//! ```
//! use shadowstep::shadow::ensemble::Ensemble;
//! use shadowstep::{Motion, Stepper, UnitMasses, potential, splitting_scheme};
//!
//! #[splitting_scheme("yoshida4.toml")]
//! pub struct Yoshida4;
//!
//! potential! { pub struct Well { depth } U(x) = -depth / (1 + x^2) }
//!
//! // columns: a value for each trajectory
//! let depth: Vec<f64> = (0..1000).map(|t| 1.0 + 1e-3 * f64::from(t)).collect();
//! let p: Vec<f64> = (0..1000).map(|t| 1e-3 * f64::from(t)).collect();
//!
//! let stepper = Stepper::new(Yoshida4, "1/10")?;
//! let ensemble = Ensemble { trajectories: 1000, steps: 500, every: 50, modified_energy: Some(8), ..Ensemble::default() };
//! let outcomes = ensemble.run::<8, _, _, _>(&stepper, |block| {
//!     let potential = Well { depth: block.lanes(|t| depth[t]) };
//!     Motion::new(potential, UnitMasses, [block.lanes(|_| 0.2)], [block.lanes(|t| p[t])])
//! })?;
//! assert_eq!(outcomes.len(), 1000);
//! for outcome in &outcomes {
//!     assert!(outcome.not_finite.is_none() && outcome.energy_error.unwrap() < 1e-4);
//!     assert!(outcome.modified_drift.unwrap() < 1e-8);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod follow;
mod seen;

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use thiserror::Error;

use crate::number::Lanes;
use crate::shadow::{BuildEstimator, EstimatorError, FixedBilinear};
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::stepper::Stepper;
use crate::systems::system::System;
use follow::InTurns;

pub use follow::{Systems, outcomes};
pub use seen::Outcome;

/// What is computed of each of a number of trajectories.
///
/// A trajectory has the bits that it has alone: they depend neither on the other trajectories, nor on the number of
/// lanes and threads, nor on the processor's vector instructions. (Elementary functions are taken from [`Lanes`].)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ensemble {
    /// How many trajectories there are.
    pub trajectories: usize,
    /// Steps of each.
    pub steps: u64,
    /// The energy is looked at every `every` steps, at the beginning and at the end; at least 1.
    pub every: u64,
    /// The k of [E_k](FixedBilinear), where the drift of the modified energy is computed: from the k + 1 states that
    /// begin with each state whose energy is computed.
    pub modified_energy: Option<u32>,
    /// Whether, between states whose energy is computed, the last map of a step and the first of the next are made as
    /// one: faster, with the bits of [`Stepper::merged_steps`] in stretches of 128 steps at most. By default they are
    /// not.
    pub merged: bool,
    /// Threads; `None` means as many as the processor has.
    pub threads: Option<NonZero<usize>>,
}

impl Default for Ensemble {
    /// No trajectories, no steps, the energy after each step.
    fn default() -> Self {
        Ensemble { trajectories: 0, steps: 0, every: 1, modified_energy: None, merged: false, threads: None }
    }
}

/// The trajectories that are the lanes of one system.
#[derive(Clone, Copy, Debug)]
pub struct Block<const W: usize> {
    first: usize,
    trajectories: usize,
}

impl<const W: usize> Block<W> {
    /// A number of each trajectory, such as a coordinate or a parameter: `block.lanes(|t| column[t])`.
    pub fn lanes(&self, value: impl Fn(usize) -> f64) -> Lanes<W> {
        Lanes(self.each(value))
    }

    /// Something of the trajectory of each lane, such as its masses.
    pub fn each<T>(&self, of: impl Fn(usize) -> T) -> [T; W] {
        std::array::from_fn(|lane| of(self.trajectory(lane)))
    }

    /// The trajectory of each lane.
    pub fn trajectories(&self) -> impl Iterator<Item = usize> {
        (0..W).map(|lane| self.trajectory(lane))
    }

    /// Where trajectories end, the last one is there again.
    fn trajectory(&self, lane: usize) -> usize {
        (self.first + lane).min(self.trajectories - 1)
    }
}

/// An ensemble that cannot be computed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EnsembleError<E> {
    /// The system of some lanes cannot be made.
    #[error(transparent)]
    System(E),
    /// The k of the modified energy is not valid.
    #[error("the modified energy: {0}")]
    Estimator(EstimatorError),
    /// It was stopped before its end.
    #[error("the ensemble was stopped")]
    Stopped,
    /// The energy cannot be computed every 0 steps.
    #[error("the energy can be looked at every 1 step or more, not every 0 steps")]
    EveryZero,
}

/// How many trajectories take turns in a thread: several systems of lanes, so that one need not wait for another, which
/// together fit into the nearest cache.
const AT_ONCE: usize = 64;

impl Ensemble {
    /// Computes all trajectories. `system` makes the system of some lanes, in several threads.
    ///
    /// W is 4, 8 or 16; 8 is good for all processors.
    ///
    /// # Errors
    /// The first error of `system`; a k that is not valid; `every` = 0.
    pub fn run<const W: usize, S, M, E>(
        &self,
        stepper: &Stepper<S, Lanes<W>>,
        system: impl Fn(Block<W>) -> Result<M, E> + Sync,
    ) -> Result<Vec<Outcome>, EnsembleError<E>>
    where
        S: Scheme<Weights<Lanes<W>>: Sync> + ValidFor<M::Class> + Sync,
        M: System<Number = Lanes<W>>,
        E: Send,
    {
        self.run_while(stepper, system, || true)
    }

    /// The same, and `continues` is asked every few milliseconds in each thread: where it returns false, the
    /// computation ends.
    ///
    /// # Errors
    /// As [`run`](Ensemble::run); [`EnsembleError::Stopped`].
    pub fn run_while<const W: usize, S, M, E>(
        &self,
        stepper: &Stepper<S, Lanes<W>>,
        system: impl Fn(Block<W>) -> Result<M, E> + Sync,
        continues: impl Fn() -> bool + Sync,
    ) -> Result<Vec<Outcome>, EnsembleError<E>>
    where
        S: Scheme<Weights<Lanes<W>>: Sync> + ValidFor<M::Class> + Sync,
        M: System<Number = Lanes<W>>,
        E: Send,
    {
        if self.every == 0 {
            return Err(EnsembleError::EveryZero);
        }
        if let Some(k) = self.modified_energy {
            // a wrong k is an error also of no trajectories
            let built: Result<_, EstimatorError> =
                BuildEstimator::<f64>::build(&FixedBilinear::new(k), stepper.step_size(), 1, &());
            built.map_err(EnsembleError::Estimator)?;
        }
        let parts = self.trajectories.div_ceil(AT_ONCE);
        let found = self.on_threads(parts, |part| self.compute(stepper, &system, part * AT_ONCE, &continues));
        let found: Result<Vec<_>, _> = found.into_iter().collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// The outcomes of the trajectories from `first` on that take turns.
    fn compute<const W: usize, S, M, E>(
        &self,
        stepper: &Stepper<S, Lanes<W>>,
        system: impl Fn(Block<W>) -> Result<M, E>,
        first: usize,
        continues: &(impl Fn() -> bool + Sync),
    ) -> Result<Vec<Outcome>, EnsembleError<E>>
    where
        S: Scheme + ValidFor<M::Class>,
        M: System<Number = Lanes<W>>,
    {
        let end = self.trajectories.min(first + AT_ONCE);
        let block = |first| Block { first, trajectories: self.trajectories };
        let systems: Result<Vec<M>, E> = (first..end).step_by(W).map(|first| system(block(first))).collect();
        let systems = systems.map_err(EnsembleError::System)?;
        let dimension = systems.first().map_or(0, |system| system.massive_coordinates());
        let build = |k| FixedBilinear::new(k).build(stepper.step_size(), dimension, &());
        let estimator = self.modified_energy.map(build).transpose().map_err(EnsembleError::Estimator)?;
        let mut in_turns = InTurns { stepper, systems, merged: self.merged };
        let outcomes = outcomes(&mut in_turns, (self.steps, self.every), estimator.as_ref(), continues);
        let mut outcomes = outcomes.ok_or(EnsembleError::Stopped)?;
        outcomes.truncate(end - first);
        Ok(outcomes)
    }

    /// The results of parts, in their order, whichever thread computes them.
    fn on_threads<T: Send>(&self, parts: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
        let available = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = self.threads.map_or_else(available, NonZero::get).min(parts);
        if threads <= 1 {
            return (0..parts).map(work).collect();
        }
        let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    while let part @ 0.. = next.fetch_add(1, Relaxed)
                        && part < parts
                    {
                        let result = work(part);
                        results.lock().expect("no thread panics with it").push((part, result));
                    }
                });
            }
        });
        let mut results = results.into_inner().expect("no thread panics with it");
        results.sort_by_key(|(part, _)| *part);
        results.into_iter().map(|(_, result)| result).collect()
    }
}
