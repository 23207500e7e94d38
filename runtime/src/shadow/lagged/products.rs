//! The products of a state with what the newest steps added.

use super::long::LongRows;
use super::short::ShortRows;
use crate::number::Number;
use crate::number::saved::Fields;

/// What the newest steps added to β, q and p.
#[derive(Clone, Debug)]
pub(super) struct LaggedProducts<N> {
    /// Of short states.
    short: ShortRows<N>,
    /// Of long states.
    long: LongRows<N>,
}

/// A state of fewer coordinates is short.
const LONG: usize = 64;

impl<N: Number> LaggedProducts<N> {
    pub(super) fn new(lags: usize, dimension: usize, context: &N::Context) -> Self {
        let (short, long) = if dimension < LONG { (dimension, 0) } else { (0, dimension) };
        LaggedProducts { short: ShortRows::new(short, context), long: LongRows::new(lags, long, context) }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.short.fields(to);
        self.long.fields(to);
    }

    /// Takes what a step added, and the state that it led to; q·δp − p·δq + δβ of the newest K = `lags` steps, the
    /// oldest first. Steps have the places 0 to K − 1 in turn. Those before the newest `known` steps may be left out.
    #[inline(always)]
    pub(super) fn of_state<const K: usize>(
        &mut self,
        place: usize,
        state: [&[N]; 2],
        (added, beta): ([&[N]; 2], &N),
        known: usize,
    ) -> [N; K] {
        // by the length, which may be known when this is compiled
        if state[0].len() < LONG {
            self.short.products(place, state, (added, beta))
        } else {
            self.long.keep(place, added, beta);
            self.long.products(place, state, known)
        }
    }
}
