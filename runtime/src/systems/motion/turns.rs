//! Steps of several systems, which take turns: all kicks and drifts of one system up to the next evaluation of its gradient, then those of the next one.
//!
//! So an evaluation of one system need not wait for the results of another, and what is between two evaluations stays in the processor's registers.
//! Of states in vectors, which are in memory, each map of a turn is made for all systems; so are few steps, and those with gradient kicks.

use std::mem::{needs_drop, take};

use super::Motion;
use super::few::FEW;
use super::hamiltonian::{Evaluated, Hamiltonian, kicks_and_drifts};
use crate::number::Number;
use crate::systems::coordinates::Coordinates;
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::{MapKind, MapSequence};
use crate::systems::potential::{Potential, Repeated};
use crate::systems::state::State;
use crate::systems::summation::Summation;
use crate::systems::system::Each;

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

/// The kicks and drifts of the first, of each middle and of the last step.
#[inline(always)]
fn advance_in_turns<N, V, P, K, S>(
    motions: &mut [Motion<N, V, P, K, S>],
    [(first, _), (middle, times), (last, _)]: &[Repeated<N>; 3],
) where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    let mut turn = Turn::default();
    let mut begin = turn.continued(first);
    begin.extend(turn.continued(middle));
    let repeated = turn.continued(middle);
    let mut end = turn.continued(last);
    end.push(turn);
    // every middle step has a kick after a drift, which begins a turn: what is left over at its end is the same
    for (turns, times) in [(begin, 1), (repeated, times - 1), (end, 1)] {
        for _ in 0..times {
            for turn in &turns {
                turn.apply(motions);
            }
        }
    }
}

/// Kicks with one gradient, and the drifts after them.
struct Turn<'a, N> {
    kicks: [Option<&'a N>; 2],
    drifts: [Option<&'a N>; 2],
}

impl<N> Default for Turn<'_, N> {
    fn default() -> Self {
        Turn { kicks: [None; 2], drifts: [None; 2] }
    }
}

impl<'a, N: Number> Turn<'a, N> {
    /// The turns that end within these maps, which follow those of this one; it becomes the one that is left over.
    fn continued(&mut self, maps: &'a [(MapKind, N)]) -> Vec<Self> {
        let mut turns = Vec::new();
        for (kind, weight) in maps {
            let is_full = match kind {
                MapKind::Drift => self.drifts[1].is_some(),
                _ => self.drifts[0].is_some() || self.kicks[1].is_some(),
            };
            if is_full {
                turns.push(take(self));
            }
            let own = if *kind == MapKind::Drift { &mut self.drifts } else { &mut self.kicks };
            let next = usize::from(own[0].is_some());
            own[next] = Some(weight);
        }
        turns
    }

    #[inline(always)]
    fn evaluate<V, P, K, S>(&self, Motion { hamiltonian, at }: &mut Motion<N, V, P, K, S>)
    where
        V: Coordinates<N>,
        P: Potential<N>,
        K: Kinetic<N>,
        S: Summation<N>,
    {
        at.state.settle();
        if self.kicks[0].is_some() && at.kept == KeptForce::Nothing {
            hamiltonian.evaluate(at, false);
        }
    }

    // one by one: the compiler would not unroll loops
    #[inline(always)]
    fn kick(&self, sums: &mut impl Summation<N>, p: &mut [N], gradient: &[N]) {
        let [kick, other_kick] = self.kicks;
        if let Some(weight) = kick {
            sums.kick(weight, gradient, p);
        }
        if let Some(weight) = other_kick {
            sums.kick(weight, gradient, p);
        }
    }

    #[inline(always)]
    fn drift<P, K: Kinetic<N>>(
        &self,
        Hamiltonian { kinetic, kinetic_scratch, .. }: &mut Hamiltonian<N, P, K>,
        sums: &mut impl Summation<N>,
        (q, p): (&mut [N], &[N]),
        kept: &mut KeptForce,
    ) {
        let [drift, other_drift] = self.drifts;
        if let Some(weight) = drift {
            sums.drift(kinetic, weight, p, q, kinetic_scratch);
            *kept = KeptForce::Nothing;
        }
        if let Some(weight) = other_drift {
            sums.drift(kinetic, weight, p, q, kinetic_scratch);
        }
    }

    /// The maps of all motions.
    #[inline(always)]
    fn apply<V, P, K, S>(&self, motions: &mut [Motion<N, V, P, K, S>])
    where
        V: Coordinates<N>,
        P: Potential<N>,
        K: Kinetic<N>,
        S: Summation<N>,
    {
        // what is there and what is not as constants: so each of these is compiled without branches
        let Turn { kicks: [kick, other_kick], drifts: [drift, other_drift] } = *self;
        match (kick, other_kick, drift, other_drift) {
            (Some(_), None, Some(_), None) => {
                advance_each(motions, &Turn { kicks: [kick, None], drifts: [drift, None] })
            }
            (Some(_), Some(_), Some(_), None) => advance_each(motions, &Turn { drifts: [drift, None], ..*self }),
            (Some(_), None, Some(_), Some(_)) => advance_each(motions, &Turn { kicks: [kick, None], ..*self }),
            _ => advance_each(motions, &Turn { ..*self }),
        }
    }
}

#[inline(always)]
fn advance_each<N, V, P, K, S>(motions: &mut [Motion<N, V, P, K, S>], turn: &Turn<'_, N>)
where
    N: Number,
    V: Coordinates<N>,
    P: Potential<N>,
    K: Kinetic<N>,
    S: Summation<N>,
{
    if const { needs_drop::<V>() } {
        // in memory: one map of all motions, none of which waits for what it has just stored
        for motion in &mut *motions {
            turn.evaluate(motion);
        }
        for Motion { at, .. } in &mut *motions {
            let State { p, sums, .. } = &mut at.state;
            turn.kick(sums, p.as_mut(), at.gradient.as_ref());
        }
        for Motion { hamiltonian, at } in &mut *motions {
            let State { q, p, sums, .. } = &mut at.state;
            turn.drift(hamiltonian, sums, (q.as_mut(), p.as_ref()), &mut at.kept);
        }
        return;
    }
    for motion in motions {
        turn.evaluate(motion);
        let Motion { hamiltonian, at: Evaluated { state: State { q, p, sums, .. }, gradient, kept, .. } } = motion;
        // a copy, which the compiler can hold in registers
        let mut copy = p.clone();
        turn.kick(sums, copy.as_mut(), gradient.as_ref());
        turn.drift(hamiltonian, sums, (q.as_mut(), copy.as_ref()), kept);
        *p = copy;
    }
}
