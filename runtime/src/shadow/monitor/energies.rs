//! H at the states in the middles of windows, until the windows end.

use super::schedule::Schedule;
use crate::number::Number;
use crate::number::saved::Fields;

/// H of the windows whose middle has come, but not yet their end.
///
/// They are found at the middle itself, where the gradient of the last kick is known, from which H follows without an
/// evaluation.
#[derive(Clone, Debug)]
pub(super) struct Energies<N> {
    /// Where the next middle is.
    schedule: Schedule,
    /// H, each window in turn.
    ring: Vec<N>,
    /// Places of the next window whose middle comes, and of the next one that ends.
    next: usize,
    oldest: usize,
    /// How many middles have come.
    count: u64,
    /// The number of the next window in which the rate is checked, and how many were before it.
    checked: u64,
    checks: u64,
}

/// The rate is checked in this number of windows, then in one window of as many; of windows that overlap, in windows
/// that have no state in common.
const CHECKS: u64 = 8;
/// There a part of the windows is enough: they have as many states as windows with plain steps between them.
const CHECKS_OF_OVERLAPPING: u64 = 64;

impl<N: Number> Energies<N> {
    /// For windows of `states` states.
    pub(super) fn new(schedule: Schedule, states: usize, context: &N::Context) -> Self {
        Energies { schedule, ring: vec![N::zero(context); states], next: 0, oldest: 0, count: 0, checked: 0, checks: 0 }
    }

    /// The room for H of the state n, if it is the middle of a window, and whether the rate is checked there.
    #[inline]
    pub(super) fn at_middle(&mut self, n: u64) -> Option<(&mut N, bool)> {
        if !self.schedule.is_middle(n) {
            return None;
        }
        self.schedule.advance();
        let place = self.next;
        self.next = self.after(place);
        let is_checked = self.count == self.checked;
        if is_checked {
            self.checks += 1;
            let apart = if self.schedule.overlaps() { CHECKS_OF_OVERLAPPING } else { CHECKS };
            self.checked += self.schedule.windows_apart() * if self.checks < CHECKS { 1 } else { apart };
        }
        self.count += 1;
        Some((&mut self.ring[place], is_checked))
    }

    /// H of the window that ends.
    #[inline]
    pub(super) fn at_end(&mut self) -> &N {
        let place = self.oldest;
        self.oldest = self.after(place);
        &self.ring[place]
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let Energies { schedule, ring, next, oldest, count, checked, checks } = self;
        schedule.fields(to);
        to.numbers(ring);
        [next, oldest].into_iter().for_each(|place| to.place(place, ring.len()));
        [count, checked, checks].into_iter().for_each(|count| to.count(count));
    }

    #[inline]
    fn after(&self, place: usize) -> usize {
        if place + 1 < self.ring.len() { place + 1 } else { 0 }
    }
}
