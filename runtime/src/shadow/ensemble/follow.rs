//! A few systems of lanes from their beginning to their end, and what is seen of each lane.

use crate::number::{Lanes, Number};
use crate::shadow::{BuildEstimator, Estimator, FixedBilinear};
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::stepper::Stepper;
use crate::systems::system::System;

type EstimatorOf<const W: usize> = <FixedBilinear as BuildEstimator<Lanes<W>>>::Estimator;

/// What became of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Positions at the end; for a processed scheme the trajectory's, not the kernel's, as in all results.
    pub q: Vec<f64>,
    /// Momenta at the end.
    pub p: Vec<f64>,
    /// H at the beginning and at the end; NaN at the end of a trajectory that is not finite.
    pub energies: [f64; 2],
    /// The largest |H − H₀|/|H₀| that was seen, H₀ at the beginning: finite ones only.
    pub energy_error: f64,
    /// max − min of the modified energy; `None` where it was not asked for, or no k + 1 states were finite.
    pub modified_drift: Option<f64>,
    /// The first estimate of the modified energy and the last one; `None` as before, NaN for the last one of a trajectory that is not finite.
    pub modified_energies: Option<[f64; 2]>,
    /// The first step after which the state or the energy was found to be infinite or NaN. Other trajectories do not notice.
    pub not_finite: Option<u64>,
}

/// At most this number of steps is made at once, as the caller may want to end them.
const AT_ONCE: u64 = 128;

/// The outcomes of all lanes of the systems after `steps` steps, merged or not, whose energy is looked at every `every` steps; `None` where
/// `continues` returns false.
pub(super) fn follow<const W: usize, S, M>(
    stepper: &Stepper<S, Lanes<W>>,
    mut systems: Vec<M>,
    (steps, every, merged): (u64, u64, bool),
    estimator: Option<&EstimatorOf<W>>,
    continues: impl Fn() -> bool,
) -> Option<Vec<Outcome>>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number = Lanes<W>>,
{
    let mut seen: Vec<Seen<W>> = systems.iter_mut().map(Seen::new).collect();
    systems.iter_mut().for_each(|system| stepper.preprocess(system));
    let window = estimator.map_or(0, |estimator| estimator.states() as u64 - 1);
    let mut n = 0;
    // up to here each state goes to the estimator
    let mut window_end = 0;
    while n < steps {
        if n % every == 0 {
            if n >= window_end {
                seen.iter_mut().zip(&systems).for_each(|(seen, system)| seen.begin_window(estimator, system));
            }
            window_end = n + window;
        }
        let next = steps.min(n - n % every + every);
        if n < window_end {
            stepper.step_each_augmented(&mut systems);
            seen.iter_mut().zip(&systems).for_each(|(seen, system)| seen.push(system));
            n += 1;
        } else {
            let count = (next - n).min(AT_ONCE);
            match merged {
                true => stepper.merged_steps(&mut systems, count),
                false => stepper.steps(&mut systems, count),
            }
            n += count;
        }
        if n % AT_ONCE == 0 && !continues() {
            return None;
        }
        if n == next {
            for (seen, system) in seen.iter_mut().zip(&mut systems) {
                stepper.at_output(system, |system| seen.look(system, n));
            }
        }
    }
    systems.iter_mut().for_each(|system| stepper.postprocess(system));
    let outcomes = seen.iter().zip(&systems).flat_map(|(seen, system)| (0..W).map(|lane| seen.outcome(system, lane)));
    Some(outcomes.collect())
}

/// What is seen of a system.
struct Seen<const W: usize> {
    initial: Lanes<W>,
    newest: Lanes<W>,
    largest_error: Lanes<W>,
    not_finite: [Option<u64>; W],
    estimator: Option<EstimatorOf<W>>,
    /// The least and the largest modified energy; NaN before the first one.
    modified: [Lanes<W>; 2],
    /// The first and the newest.
    modified_ends: [Lanes<W>; 2],
}

impl<const W: usize> Seen<W> {
    fn new<M: System<Number = Lanes<W>>>(system: &mut M) -> Self {
        let initial = system.energy();
        let mut seen = Seen {
            initial,
            newest: initial,
            largest_error: Lanes::all(0.0),
            not_finite: [None; W],
            estimator: None,
            modified: [Lanes::all(f64::NAN); 2],
            modified_ends: [Lanes::all(f64::NAN); 2],
        };
        seen.look(system, 0);
        seen
    }

    /// Looks at the state after n steps.
    fn look<M: System<Number = Lanes<W>>>(&mut self, system: &mut M, n: u64) {
        let energy = system.energy();
        for (lane, not_finite) in self.not_finite.iter_mut().enumerate() {
            let is_finite = |x: &Lanes<W>| x.0[lane].is_finite();
            if not_finite.is_none() && !(is_finite(&energy) && system.q().iter().chain(system.p()).all(is_finite)) {
                *not_finite = Some(n);
            }
        }
        self.newest = energy;
        let mut error = energy;
        error.subtract(&self.initial);
        error.make_absolute();
        for ((largest, error), not_finite) in self.largest_error.0.iter_mut().zip(error.0).zip(self.not_finite) {
            *largest = if not_finite.is_none() { largest.max(error) } else { *largest };
        }
    }

    /// A window of states for the modified energy begins at the present one.
    fn begin_window<M: System<Number = Lanes<W>>>(&mut self, estimator: Option<&EstimatorOf<W>>, system: &M) {
        self.estimator = estimator.cloned();
        self.push(system);
    }

    fn push<M: System<Number = Lanes<W>>>(&mut self, system: &M) {
        let Some(estimator) = &mut self.estimator else { return };
        let massive = system.massive_coordinates();
        let (q, p, increments) = (system.q(), system.p(), system.state().increments().of_first(massive));
        let Some(estimate) = estimator.push(&q[..massive], &p[..massive], increments) else { return };
        let ([least, most], [first, newest]) = (&mut self.modified, &mut self.modified_ends);
        newest.0 = estimate.value.0;
        for (((least, most), first), value) in least.0.iter_mut().zip(&mut most.0).zip(&mut first.0).zip(newest.0) {
            if value.is_finite() {
                *first = if first.is_nan() { value } else { *first };
                // `min` and `max` ignore NaN
                *least = least.min(value);
                *most = most.max(value);
            }
        }
    }

    fn outcome<M: System<Number = Lanes<W>>>(&self, system: &M, lane: usize) -> Outcome {
        let of_lane = |x: &[Lanes<W>]| x.iter().map(|x| x.0[lane]).collect();
        let drift = self.modified[1].0[lane] - self.modified[0].0[lane];
        let drift = Some(drift).filter(|drift| drift.is_finite());
        let ends = |[first, last]: [Lanes<W>; 2]| {
            [first.0[lane], if self.not_finite[lane].is_none() { last.0[lane] } else { f64::NAN }]
        };
        Outcome {
            q: of_lane(system.q()),
            p: of_lane(system.p()),
            energies: ends([self.initial, self.newest]),
            energy_error: self.largest_error.0[lane] / self.initial.0[lane].abs(),
            modified_drift: drift,
            modified_energies: drift.map(|_| ends(self.modified_ends)),
            not_finite: self.not_finite[lane],
        }
    }
}
