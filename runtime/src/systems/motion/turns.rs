//! Steps of several motions, which take [turns](Turn).
//!
//! Of states in vectors, which are in memory, each map of a turn is made for all systems; so are few steps, and those
//! with gradient kicks.

use std::mem::needs_drop;

use super::Motion;
use super::few::FEW;
use super::hamiltonian::{Hamiltonian, kicks_and_drifts};
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::evaluated::Evaluated;
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::MapSequence;
use crate::systems::potential::Potential;
use crate::systems::state::State;
use crate::systems::summation::Summation;
use crate::systems::system::Each;
use crate::systems::turn::{InTurns, Turn, advance_in_turns};

/// `count` plain steps of each motion.
#[inline(always)]
pub(super) fn advance<N, V, P, K, S>(motions: &mut [Motion<N, V, P, K, S>], maps: &impl MapSequence<N>, count: u64)
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    let in_turns = if count >= FEW { kicks_and_drifts(maps, count) } else { None };
    match in_turns {
        Some(steps) => advance_in_turns(motions, &steps),
        None => maps.each(0..count, count, &mut Each { systems: motions, carried: Carried::Nothing }),
    }
}

impl<N, V, P, K, S> InTurns<N> for [Motion<N, V, P, K, S>]
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    const IN_REGISTERS: bool = !needs_drop::<V>();

    #[inline(always)]
    fn advance(&mut self, turn: &Turn<'_, N>) {
        if const { !Self::IN_REGISTERS } {
            // in memory: one map of all motions, none of which waits for what it has just stored
            for motion in &mut *self {
                evaluate(turn, motion);
            }
            for Motion { at, .. } in &mut *self {
                let State { p, sums, .. } = &mut at.state;
                turn.kick(sums, p.as_mut(), at.gradient.as_ref());
            }
            for Motion { hamiltonian: Hamiltonian { kinetic, kinetic_scratch, .. }, at } in &mut *self {
                let State { q, p, sums, .. } = &mut at.state;
                turn.drift(sums, (kinetic, kinetic_scratch), (q.as_mut(), p.as_ref()), &mut at.kept);
            }
            return;
        }
        for motion in self {
            evaluate(turn, motion);
            let Motion {
                hamiltonian: Hamiltonian { kinetic, kinetic_scratch, .. },
                at: Evaluated { state: State { q, p, sums, .. }, gradient, kept, .. },
            } = motion;
            // a copy, which the compiler can hold in registers
            let mut copy = p.clone();
            turn.kick(sums, copy.as_mut(), gradient.as_ref());
            turn.drift(sums, (kinetic, kinetic_scratch), (q.as_mut(), copy.as_ref()), kept);
            *p = copy;
        }
    }
}

#[inline(always)]
fn evaluate<N, V, P, K, S>(turn: &Turn<'_, N>, Motion { hamiltonian, at }: &mut Motion<N, V, P, K, S>)
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    at.state.settle();
    if turn.has_kick() && at.kept == KeptForce::Nothing {
        at.evaluate(hamiltonian, false);
    }
}
