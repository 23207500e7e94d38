//! States in the order of time, wherever they come from.

use crate::number::Real;
use crate::number::instructions;
use crate::shadow::run::error::{Quantity, RunError, check_value};
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::Increments;
use crate::systems::state::State;
use crate::systems::summation::Summation;
use crate::systems::system::System;

/// A state of a trajectory.
#[derive(Clone, Copy, Debug)]
pub struct TrajectoryState<'a, N> {
    /// Its number: t = n h.
    pub n: i64,
    /// Positions.
    pub q: &'a [N],
    /// Momenta.
    pub p: &'a [N],
    /// What the step to it added to q, p and β.
    pub increments: Increments<'a, N>,
}

impl<'a, N: Real> TrajectoryState<'a, N> {
    /// The state of a system.
    #[inline]
    pub(crate) fn of<V: Coordinates<N>, S: Summation<N>>(state: &'a State<N, V, S>, n: i64) -> Self {
        TrajectoryState { n, q: state.q(), p: state.p(), increments: state.increments() }
    }

    /// The first coordinates of the state.
    #[inline(always)]
    pub(crate) fn of_first(self, coordinates: usize) -> Self {
        let TrajectoryState { n, q, p, increments } = self;
        TrajectoryState { n, q: &q[..coordinates], p: &p[..coordinates], increments: increments.of_first(coordinates) }
    }

    /// The state without particles of mass 0, which have no part in the modified energy.
    #[inline(always)]
    pub(crate) fn massive<M: System<Number = N> + ?Sized>(system: &'a M, n: i64) -> Self {
        TrajectoryState::of(system.state(), n).of_first(system.massive_coordinates())
    }

    /// Refuses a state with a value that is not finite.
    #[inline(always)]
    pub(crate) fn check(&self) -> Result<(), RunError> {
        let TrajectoryState { q, p, increments, .. } = *self;
        // without a branch for each coordinate
        let are_finite = |numbers: &[N]| {
            instructions::widest_if_long(
                N::IN_VECTORS,
                numbers.len(),
                #[inline(always)]
                || numbers.iter().fold(true, |finite, x| finite & x.is_finite()),
            )
        };
        if are_finite(q) & are_finite(p) & increments.beta.is_finite() { Ok(()) } else { self.refuse() }
    }

    #[cold]
    fn refuse(&self) -> Result<(), RunError> {
        let TrajectoryState { n, q, p, increments } = *self;
        for (index, position) in q.iter().enumerate() {
            check_value(position, Quantity::Position(index), n)?;
        }
        for (index, momentum) in p.iter().enumerate() {
            check_value(momentum, Quantity::Momentum(index), n)?;
        }
        check_value(increments.beta, Quantity::Beta, n)
    }
}

/// A source of states for an estimator: a [`Trajectory`](crate::shadow::run::Trajectory), or the exact flow.
pub trait States {
    /// The type of their numbers.
    type Number: Real;

    /// Goes to the next state in the order of time; `None` at the end.
    ///
    /// # Errors
    /// A state that is not finite.
    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, Self::Number>>, RunError>;

    /// Whether the round-off of a step comes from its increments only: see
    /// [`State::is_compensated`](crate::State::is_compensated). By default it is not.
    fn is_compensated(&self) -> bool {
        false
    }
}

impl<T: States + ?Sized> States for &mut T {
    type Number = T::Number;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, T::Number>>, RunError> {
        (**self).advance()
    }

    fn is_compensated(&self) -> bool {
        (**self).is_compensated()
    }
}

/// The number of the last state that the estimate of the state `steps` needs.
pub(crate) fn last(steps: u64, reach: usize) -> i64 {
    i64::try_from(steps).unwrap_or(i64::MAX).saturating_add(reach as i64)
}
