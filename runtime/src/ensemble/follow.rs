//! A few systems of lanes from their beginning to their end, and what is seen of each lane.

use super::{Ensemble, EnsembleError, Outcome};
use crate::number::{Lanes, Number};
use crate::scheme::{Scheme, ValidFor};
use crate::shadow::{BuildEstimator, Estimator, FixedBilinear};
use crate::stepper::Stepper;
use crate::system::System;

type EstimatorOf<const W: usize> = <FixedBilinear as BuildEstimator<Lanes<W>>>::Estimator;

/// The outcomes of all lanes of the systems.
pub(super) fn follow<const W: usize, S, M, E>(
    ensemble: &Ensemble,
    stepper: &Stepper<S, Lanes<W>>,
    mut systems: Vec<M>,
) -> Result<Vec<Outcome>, EnsembleError<E>>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number = Lanes<W>>,
{
    let dimension = systems.first().map_or(0, |system| system.q().len());
    let build = |k| FixedBilinear::new(k).build(stepper.step_size(), dimension, &());
    let estimator = ensemble.modified_energy.map(build).transpose().map_err(EnsembleError::Estimator)?;
    let mut seen: Vec<Seen<W>> = systems.iter_mut().map(Seen::new).collect();
    let window = u64::from(ensemble.modified_energy.unwrap_or(0));
    let mut n = 0;
    let mut states_end = 0;
    while n < ensemble.steps {
        if n % ensemble.every == 0 {
            if n >= states_end {
                seen.iter_mut().zip(&systems).for_each(|(seen, system)| seen.begin_window(estimator.as_ref(), system));
            }
            states_end = n + window;
        }
        let next = ensemble.steps.min(n - n % ensemble.every + ensemble.every);
        if n < states_end {
            for (seen, system) in seen.iter_mut().zip(&mut systems) {
                stepper.step_augmented(system);
                seen.push(system);
            }
            n += 1;
        } else {
            stepper.steps(&mut systems, next - n);
            n = next;
        }
        if n == next {
            seen.iter_mut().zip(&mut systems).for_each(|(seen, system)| seen.look(system, n));
        }
    }
    Ok(seen.iter().zip(&systems).flat_map(|(seen, system)| (0..W).map(|lane| seen.outcome(system, lane))).collect())
}

/// What is seen of a system.
struct Seen<const W: usize> {
    initial: Lanes<W>,
    largest_error: Lanes<W>,
    not_finite: [Option<u64>; W],
    estimator: Option<EstimatorOf<W>>,
    /// The least and the largest modified energy; NaN before the first one.
    modified: [Lanes<W>; 2],
}

impl<const W: usize> Seen<W> {
    fn new<M: System<Number = Lanes<W>>>(system: &mut M) -> Self {
        let mut seen = Seen {
            initial: system.energy(),
            largest_error: Lanes::all(0.0),
            not_finite: [None; W],
            estimator: None,
            modified: [Lanes::all(f64::NAN); 2],
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
        let Some(estimate) = estimator.push(system.q(), system.p(), system.increments()) else { return };
        let [least, most] = &mut self.modified;
        for ((least, most), value) in least.0.iter_mut().zip(&mut most.0).zip(estimate.value.0) {
            if value.is_finite() {
                // `min` and `max` ignore NaN
                *least = least.min(value);
                *most = most.max(value);
            }
        }
    }

    fn outcome<M: System<Number = Lanes<W>>>(&self, system: &M, lane: usize) -> Outcome {
        let of_lane = |x: &[Lanes<W>]| x.iter().map(|x| x.0[lane]).collect();
        let drift = self.modified[1].0[lane] - self.modified[0].0[lane];
        Outcome {
            q: of_lane(system.q()),
            p: of_lane(system.p()),
            energy_error: self.largest_error.0[lane] / self.initial.0[lane].abs(),
            modified_drift: Some(drift).filter(|drift| drift.is_finite()),
            not_finite: self.not_finite[lane],
        }
    }
}
