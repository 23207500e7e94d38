//! Steps of several systems, which take turns: all kicks and drifts of one system up to the next evaluation of its gradient, then those of the next one.
//!
//! So an evaluation of one system need not wait for the results of another, and what is between two evaluations stays in the processor's registers.
//! Few steps, and those with gradient kicks, are made map by map for all systems.

use std::mem::{needs_drop, take};

use super::flows::{FEW, Flows, Moving, kicks_and_drifts};
use crate::coordinates::Coordinates;
use crate::kept::Kept;
use crate::kinetic::Kinetic;
use crate::maps::{MapKind, MapSequence};
use crate::number::Number;
use crate::potential::{Potential, Repeated};
use crate::summation::Summation;

/// A system of flows, and of what they change.
pub(super) trait Flowing {
    type Number: Number;
    type Coordinates: Coordinates<Self::Number>;
    type Potential: Potential<Self::Number>;
    type Kinetic: Kinetic<Self::Number>;
    type Summation: Summation<Self::Number>;

    fn flows(&mut self) -> (&mut FlowsOf<Self>, &mut MovingOf<Self>);
}

type FlowsOf<M> = Flows<<M as Flowing>::Number, <M as Flowing>::Potential, <M as Flowing>::Kinetic>;
type MovingOf<M> = Moving<<M as Flowing>::Number, <M as Flowing>::Coordinates, <M as Flowing>::Summation>;

/// `count` steps of each system.
#[inline(always)]
pub(super) fn advance<M: Flowing>(systems: &mut [M], maps: &impl MapSequence<M::Number>, count: u64) {
    let in_turns = if count >= FEW { kicks_and_drifts(maps, count, count) } else { None };
    match in_turns {
        Some(steps) => advance_in_turns(systems, &steps),
        None => advance_map_by_map(systems, maps, count),
    }
}

#[inline(always)]
fn advance_map_by_map<M: Flowing>(systems: &mut [M], maps: &impl MapSequence<M::Number>, count: u64) {
    maps.each(
        0..count,
        count,
        #[inline(always)]
        |kind, weight, _| {
            for system in &mut *systems {
                let (flows, moving) = system.flows();
                match kind {
                    MapKind::Kick => flows.kick(moving, weight, flows.keeps_rate),
                    MapKind::Drift => flows.drift(moving, weight),
                    MapKind::GradientKick => {
                        flows.gradient_kick(moving, weight, flows.keeps_rate);
                    }
                }
            }
        },
    );
}

/// The kicks and drifts of the first, of each middle and of the last step.
#[inline(always)]
fn advance_in_turns<M: Flowing>(
    systems: &mut [M],
    [(first, _), (middle, times), (last, _)]: &[Repeated<M::Number>; 3],
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

    /// The maps of one system, in which the gradient stays.
    #[inline(always)]
    fn advance<P, K: Kinetic<N>, S: Summation<N>>(
        &self,
        flows: &mut Flows<N, P, K>,
        summation: &mut S,
        (q, p): (&mut [N], &mut [N]),
        gradient: &[N],
    ) {
        let Flows { kinetic, kinetic_scratch, .. } = flows;
        // one by one: the compiler would not unroll loops
        let Turn { kicks: [kick, other_kick], drifts: [drift, other_drift] } = self;
        if let Some(weight) = kick {
            summation.kick(weight, gradient, p);
        }
        if let Some(weight) = other_kick {
            summation.kick(weight, gradient, p);
        }
        if let Some(weight) = drift {
            summation.drift(kinetic, weight, p, q, kinetic_scratch);
        }
        if let Some(weight) = other_drift {
            summation.drift(kinetic, weight, p, q, kinetic_scratch);
        }
    }

    /// Those of one system after the other.
    #[inline(always)]
    fn apply<M: Flowing<Number = N>>(&self, systems: &mut [M]) {
        // what is there and what is not as constants: so each of these is compiled without branches
        let Turn { kicks: [kick, other_kick], drifts: [drift, other_drift] } = *self;
        match (kick, other_kick, drift, other_drift) {
            (Some(_), None, Some(_), None) => {
                advance_each(systems, &Turn { kicks: [kick, None], drifts: [drift, None] })
            }
            (Some(_), Some(_), Some(_), None) => advance_each(systems, &Turn { drifts: [drift, None], ..*self }),
            (Some(_), None, Some(_), Some(_)) => advance_each(systems, &Turn { kicks: [kick, None], ..*self }),
            _ => advance_each(systems, &Turn { ..*self }),
        }
    }
}

#[inline(always)]
fn advance_each<M: Flowing>(systems: &mut [M], turn: &Turn<'_, M::Number>) {
    for system in systems {
        let (flows, moving) = system.flows();
        moving.settle();
        if turn.kicks[0].is_some() && moving.kept == Kept::Nothing {
            flows.evaluate(moving, flows.keeps_rate);
        }
        if needs_drop::<M::Coordinates>() {
            let Moving { summation, q, p, gradient, .. } = moving;
            turn.advance(flows, summation, (q.as_mut(), p.as_mut()), gradient.as_ref());
        } else {
            // a copy, which the compiler can hold in registers
            let mut p = moving.p.clone();
            let Moving { summation, q, gradient, .. } = moving;
            turn.advance(flows, summation, (q.as_mut(), p.as_mut()), gradient.as_ref());
            moving.p = p;
        }
        if turn.drifts[0].is_some() {
            moving.kept = Kept::Nothing;
        }
    }
}
