//! Turns of systems whose steps are made together: all kicks and drifts of one system between two evaluations of its
//! gradient.
//!
//! So an evaluation of one system need not wait for the results of another, and what is between two evaluations stays
//! in the processor's registers.

use std::mem::take;

use crate::number::Number;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::Kinetic;
use crate::systems::maps::{MapKind, Repeated};
use crate::systems::summation::Summation;

/// Kicks with one gradient, and the drifts after them.
pub(crate) struct Turn<'a, N> {
    kicks: [Option<&'a N>; 2],
    drifts: [Option<&'a N>; 2],
}

/// Systems that take turns.
pub(crate) trait InTurns<N> {
    /// Whether states are held in registers. Then each kind of turn is compiled without branches, which take longer
    /// than the maps; of others it is one piece of code.
    const IN_REGISTERS: bool;

    /// The maps of one turn, of all systems.
    fn advance(&mut self, turn: &Turn<'_, N>);
}

impl<N> Default for Turn<'_, N> {
    fn default() -> Self {
        Turn { kicks: [None; 2], drifts: [None; 2] }
    }
}

/// The kicks and drifts of the first, of each middle and of the last step, in turns.
#[inline(always)]
pub(crate) fn advance_in_turns<N: Number>(
    systems: &mut (impl InTurns<N> + ?Sized),
    [(first, _), (middle, times), (last, _)]: &[Repeated<N>; 3],
) {
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
                turn.apply(systems);
            }
        }
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

    /// The maps of this turn, of all systems.
    #[inline(always)]
    fn apply<T: InTurns<N> + ?Sized>(&self, systems: &mut T) {
        if const { !T::IN_REGISTERS } {
            return systems.advance(self);
        }
        // what is there and what is not as constants
        let Turn { kicks: [kick, other_kick], drifts: [drift, other_drift] } = *self;
        match (kick, other_kick, drift, other_drift) {
            (Some(_), None, Some(_), None) => systems.advance(&Turn { kicks: [kick, None], drifts: [drift, None] }),
            (Some(_), Some(_), Some(_), None) => systems.advance(&Turn { drifts: [drift, None], ..*self }),
            (Some(_), None, Some(_), Some(_)) => systems.advance(&Turn { kicks: [kick, None], ..*self }),
            _ => systems.advance(&Turn { ..*self }),
        }
    }

    /// Whether it has a kick, which needs the gradient.
    #[inline(always)]
    pub(crate) fn has_kick(&self) -> bool {
        self.kicks[0].is_some()
    }

    // one by one: the compiler would not unroll loops
    #[inline(always)]
    pub(crate) fn kick(&self, sums: &mut impl Summation<N>, p: &mut [N], gradient: &[N]) {
        let [kick, other_kick] = self.kicks;
        if let Some(weight) = kick {
            sums.kick(weight, gradient, p);
        }
        if let Some(weight) = other_kick {
            sums.kick(weight, gradient, p);
        }
    }

    #[inline(always)]
    pub(crate) fn drift<K: Kinetic<N>>(
        &self,
        sums: &mut impl Summation<N>,
        (kinetic, scratch): (&mut K, &mut [N]),
        (q, p): (&mut [N], &[N]),
        kept: &mut KeptForce,
    ) {
        let [drift, other_drift] = self.drifts;
        if let Some(weight) = drift {
            sums.drift(kinetic, weight, p, q, scratch);
            *kept = KeptForce::Nothing;
        }
        if let Some(weight) = other_drift {
            sums.drift(kinetic, weight, p, q, scratch);
        }
    }
}
