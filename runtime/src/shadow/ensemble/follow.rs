//! A few systems of lanes from their beginning to their end, and what is seen of each lane.

use crate::number::Lanes;
use crate::shadow::Estimator;
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::stepper::Stepper;
use crate::systems::increments::Carried;
use crate::systems::system::System;

use super::seen::{Outcome, Seen};

/// At most this number of steps is made at once, as the caller may want to end them.
const AT_ONCE: u64 = 128;

/// The outcomes of all lanes of the systems after `steps` steps, merged or not, whose energy is looked at every `every` steps; `None` where
/// `continues` returns false.
pub(super) fn follow<const W: usize, S, M, E>(
    stepper: &Stepper<S, Lanes<W>>,
    mut systems: Vec<M>,
    (steps, every, merged): (u64, u64, bool),
    estimator: Option<&E>,
    continues: impl Fn() -> bool,
) -> Option<Vec<Outcome>>
where
    S: Scheme + ValidFor<M::Class>,
    M: System<Number = Lanes<W>>,
    E: Estimator<Lanes<W>> + Clone,
{
    let mut seen: Vec<_> = systems.iter_mut().map(|system| Seen::new(system, estimator.cloned())).collect();
    systems.iter_mut().for_each(|system| stepper.preprocess(system));
    let mut n = 0;
    while n < steps {
        // all have their windows at the same states
        let carried = seen.iter_mut().zip(&systems).map(|(seen, system)| seen.carried(n, every, system));
        let carried = carried.last();
        let next = steps.min(n - n % every + every);
        if carried == Some(Carried::Increments) {
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
