//! What is seen of a system whose numbers have a trajectory in each lane.

use crate::number::Number;
use crate::shadow::Estimator;
use crate::systems::increments::Carried;
use crate::systems::system::System;

/// What became of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Positions at the end; for a processed scheme the trajectory's, not the kernel's, as in all results.
    pub q: Vec<f64>,
    /// Momenta at the end.
    pub p: Vec<f64>,
    /// H at the beginning and at the end; NaN at the end of a trajectory that is not finite.
    pub energies: [f64; 2],
    /// The largest |H − H₀|/|H₀| that was seen, H₀ at the beginning: finite ones only; `None` where H₀ is 0 or not
    /// finite.
    pub energy_error: Option<f64>,
    /// max − min of the modified energy; `None` where it was not asked for, or no k + 1 states were finite.
    pub modified_drift: Option<f64>,
    /// The first estimate of the modified energy and the last one; `None` as before, NaN for the last one of a
    /// trajectory that is not finite.
    pub modified_energies: Option<[f64; 2]>,
    /// The first step after which the state or the energy was found to be infinite or NaN. Other trajectories do not
    /// notice.
    pub not_finite: Option<u64>,
}

/// What is seen of the trajectories in the lanes of a system: one, where the numbers have no lanes.
pub(super) struct Seen<E> {
    lanes: Vec<Lane>,
    /// Without states, and with those of the present window.
    estimator: Option<E>,
    window: Option<E>,
    /// Up to here each state goes to the estimator.
    window_end: u64,
}

/// What is seen of a trajectory.
#[derive(Clone)]
struct Lane {
    initial: f64,
    newest: f64,
    largest_error: f64,
    not_finite: Option<u64>,
    /// The least and the largest modified energy; NaN before the first one.
    modified: [f64; 2],
    /// The first and the newest.
    modified_ends: [f64; 2],
}

impl<E: Clone> Seen<E> {
    /// Of a system at its first states, for a processed scheme those of its trajectories; the estimator has no states
    /// yet.
    pub(super) fn new<M: System + ?Sized>(system: &mut M, estimator: Option<E>) -> Self {
        let energy = system.energy();
        let lane = |lane| Lane::from_energy(energy.lane(lane).0);
        let mut seen =
            Seen { lanes: (0..M::Number::LANES).map(lane).collect(), estimator, window: None, window_end: 0 };
        seen.include(&energy, system, 0);
        seen
    }

    /// Looks at the states after n steps.
    pub(super) fn look<M: System + ?Sized>(&mut self, system: &mut M, n: u64) {
        let energy = system.energy();
        self.include(&energy, system, n);
    }

    fn include<M: System + ?Sized>(&mut self, energy: &M::Number, system: &M, n: u64) {
        let (q, p) = (system.state().q(), system.state().p());
        for (index, lane) in self.lanes.iter_mut().enumerate() {
            let is_finite = |x: &M::Number| x.lane(index).0.is_finite();
            lane.newest = energy.lane(index).0;
            if lane.not_finite.is_none() && !(is_finite(energy) && q.iter().chain(p).all(is_finite)) {
                lane.not_finite = Some(n);
            }
            if lane.not_finite.is_none() {
                lane.largest_error = lane.largest_error.max((lane.newest - lane.initial).abs());
            }
        }
    }

    /// What the step from the present state, the n-th one, carries along: increments in a window of states for the
    /// modified energy. One begins every `every` steps, where it does not prolong the one before.
    pub(super) fn carried<M: System + ?Sized>(&mut self, n: u64, every: u64, system: &M) -> Carried
    where
        E: Estimator<M::Number>,
    {
        if let Some(estimator) = self.estimator.as_ref().filter(|_| n.is_multiple_of(every)) {
            let window_end = n + estimator.states() as u64 - 1;
            if n >= self.window_end {
                self.window.clone_from(&self.estimator);
                self.push(system);
            }
            self.window_end = window_end;
        }
        if n < self.window_end { Carried::Increments } else { Carried::Nothing }
    }

    /// Gives the present state, after an augmented step, to the window.
    pub(super) fn push<M: System + ?Sized>(&mut self, system: &M)
    where
        E: Estimator<M::Number>,
    {
        let Some(window) = &mut self.window else { return };
        let massive = system.massive_coordinates();
        let (q, p, increments) =
            (system.state().q(), system.state().p(), system.state().increments().of_first(massive));
        let Some(estimate) = window.push_for_value(&q[..massive], &p[..massive], increments) else { return };
        for (index, lane) in self.lanes.iter_mut().enumerate() {
            lane.include_modified(estimate.value.lane(index).0);
        }
    }

    /// What became of the trajectory in a lane of the system, which is at its last states.
    pub(super) fn outcome<M: System + ?Sized>(&self, system: &M, index: usize) -> Outcome {
        let of_lane = |x: &[M::Number]| x.iter().map(|x| x.lane(index).0).collect();
        self.lanes[index].outcome(of_lane(system.state().q()), of_lane(system.state().p()))
    }
}

impl Lane {
    fn from_energy(initial: f64) -> Self {
        Lane {
            initial,
            newest: initial,
            largest_error: 0.0,
            not_finite: None,
            modified: [f64::NAN; 2],
            modified_ends: [f64::NAN; 2],
        }
    }

    fn include_modified(&mut self, value: f64) {
        let ([least, most], [first, newest]) = (&mut self.modified, &mut self.modified_ends);
        *newest = value;
        if value.is_finite() {
            *first = if first.is_nan() { value } else { *first };
            // `min` and `max` ignore NaN
            *least = least.min(value);
            *most = most.max(value);
        }
    }

    fn outcome(&self, q: Vec<f64>, p: Vec<f64>) -> Outcome {
        let drift = Some(self.modified[1] - self.modified[0]).filter(|drift| drift.is_finite());
        let ends = |[first, last]: [f64; 2]| [first, if self.not_finite.is_none() { last } else { f64::NAN }];
        Outcome {
            q,
            p,
            energies: ends([self.initial, self.newest]),
            energy_error: Some(self.largest_error / self.initial.abs()).filter(|error| error.is_finite()),
            modified_drift: drift,
            modified_energies: drift.map(|_| ends(self.modified_ends)),
            not_finite: self.not_finite,
        }
    }
}
