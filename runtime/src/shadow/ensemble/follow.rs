//! Systems of an ensemble from their beginning to their end, and what is seen of each.

use crate::number::Number;
use crate::shadow::Estimator;
use crate::steps::integrator::{Integrator, at_output};
use crate::steps::scheme::{Scheme, ValidFor};
use crate::steps::stepper::Stepper;
use crate::steps::together::{Together, follow};
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::Carried;
use crate::systems::summation::Summation;
use crate::systems::system::{AnySystem, System};

use super::seen::{Outcome, Seen};

/// At most this number of steps is made at once, as the caller may want to end them.
const AT_ONCE: u64 = 128;

/// Takes a system and its number.
type Take<'t, T> = &'t mut dyn FnMut(
    usize,
    &mut AnySystem<'_, <T as Systems>::Number, <T as Systems>::Coordinates, <T as Systems>::Summation>,
);

/// Systems of an ensemble that are advanced together: one with its integrator, or several.
pub trait Systems: Together {
    /// The type of their numbers.
    type Number: Number;
    /// What holds positions, and momenta.
    type Coordinates: Coordinates<Self::Number>;
    /// How increments are added to q and p.
    type Summation: Summation<Self::Number>;

    /// Shows each at the state of its steps.
    fn each(&mut self, take: Take<'_, Self>);

    /// Shows each at the state of its trajectory.
    fn each_at_output(&mut self, take: Take<'_, Self>);

    /// The pre-map of a processed scheme.
    fn preprocess_each(&mut self);

    /// The post-map of a processed scheme.
    fn postprocess_each(&mut self);
}

impl<I: Integrator + ?Sized> Systems for I {
    type Number = I::Number;
    type Coordinates = I::Coordinates;
    type Summation = I::Summation;

    fn each(&mut self, take: Take<'_, Self>) {
        take(0, self.system());
    }

    fn each_at_output(&mut self, take: Take<'_, Self>) {
        at_output(self, |integrator| take(0, integrator.system()));
    }

    fn preprocess_each(&mut self) {
        self.preprocess();
    }

    fn postprocess_each(&mut self) {
        self.postprocess();
    }
}

/// Systems that take turns.
pub(super) struct InTurns<'s, S: Scheme, M: System> {
    pub(super) stepper: &'s Stepper<S, M::Number>,
    pub(super) systems: Vec<M>,
    /// Whether the last map of a step and the first of the next are made as one.
    pub(super) merged: bool,
}

impl<S: Scheme + ValidFor<M::Class>, M: System> Together for InTurns<'_, S, M> {
    fn advance(&mut self, steps: u64, carried: Carried) {
        let InTurns { stepper, systems, merged } = self;
        match (carried, merged) {
            (Carried::Nothing, true) => stepper.merged_steps(systems, steps),
            (Carried::Nothing, false) => stepper.steps(systems, steps),
            _ => (0..steps).for_each(|_| stepper.step_each_augmented(systems)),
        }
    }
}

impl<S: Scheme + ValidFor<M::Class>, M: System> Systems for InTurns<'_, S, M> {
    type Number = M::Number;
    type Coordinates = M::Coordinates;
    type Summation = M::Summation;

    fn each(&mut self, take: Take<'_, Self>) {
        self.systems.iter_mut().enumerate().for_each(|(i, system)| take(i, system));
    }

    fn each_at_output(&mut self, take: Take<'_, Self>) {
        let InTurns { stepper, systems, .. } = self;
        systems.iter_mut().enumerate().for_each(|(i, system)| stepper.at_output(system, |system| take(i, system)));
    }

    fn preprocess_each(&mut self) {
        self.systems.iter_mut().for_each(|system| self.stepper.preprocess(system));
    }

    fn postprocess_each(&mut self) {
        self.systems.iter_mut().for_each(|system| self.stepper.postprocess(system));
    }
}

/// The outcomes of all lanes of the systems, which are at their initial states, after `steps` steps; the energy is
/// looked at every `every` steps. `None` where `continues` returns false.
pub fn outcomes<T: Systems + ?Sized, E: Estimator<T::Number> + Clone>(
    systems: &mut T,
    (steps, every): (u64, u64),
    estimator: Option<&E>,
    continues: impl Fn() -> bool,
) -> Option<Vec<Outcome>> {
    let mut seen = Vec::new();
    systems.each(&mut |_, system| seen.push(Seen::new(system, estimator.cloned())));
    systems.preprocess_each();
    let (mut carried, mut asked) = (Carried::Nothing, 0);
    let followed = follow(systems, steps, |n, systems| {
        if carried == Carried::Increments {
            systems.each(&mut |i, system| seen[i].push(system));
        }
        if n >= asked + AT_ONCE {
            asked = n;
            if !continues() {
                return Err(());
            }
        }
        if n > 0 && (n == steps || n.is_multiple_of(every)) {
            systems.each_at_output(&mut |i, system| seen[i].look(system, n));
        }
        if n == steps {
            // no window begins there
            return Ok((n, Carried::Nothing));
        }
        // all have their windows at the same states
        systems.each(&mut |i, system| carried = seen[i].carried(n, every, system));
        let next = if carried == Carried::Increments { n + 1 } else { n - n % every + every };
        Ok((next.min(n + AT_ONCE), carried))
    });
    followed.ok()?;
    systems.postprocess_each();
    let mut outcomes = Vec::new();
    systems.each(&mut |i, system| outcomes.extend((0..T::Number::LANES).map(|lane| seen[i].outcome(system, lane))));
    Some(outcomes)
}
