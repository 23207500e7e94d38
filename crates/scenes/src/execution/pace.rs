//! How many steps of a run are made at once, where nothing needs the states between.

use std::time::{Duration, Instant};

/// Whoever watches a run is asked about as often as this.
const ASKED: Duration = Duration::from_millis(10);

/// At most this number of steps is made at once.
const MOST_AT_ONCE: u64 = 1 << 16;

/// The number of steps after which a run looks up: it follows the time that they take.
pub(crate) struct Pace {
    at_once: u64,
    /// The states from the first one on between which no steps are made at once.
    one_by_one: u64,
    looked_up: Instant,
}

impl Pace {
    /// Begins with a step, and with steps one by one up to the state `one_by_one`.
    pub(crate) fn new(one_by_one: u64) -> Self {
        Pace { at_once: 1, one_by_one, looked_up: Instant::now() }
    }

    /// The next state after n at which the run looks up.
    pub(crate) fn next(&self, n: u64) -> u64 {
        (n / self.at_once + 1).saturating_mul(self.at_once)
    }

    /// Looks at the clock, if the state n is one of those.
    pub(crate) fn look_up(&mut self, n: u64) {
        if n < self.one_by_one || !n.is_multiple_of(self.at_once) {
            return;
        }
        let took = self.looked_up.elapsed();
        if took < ASKED / 4 {
            self.at_once = (2 * self.at_once).min(MOST_AT_ONCE);
        } else if took > ASKED {
            self.at_once = (self.at_once / 2).max(1);
        }
        self.looked_up = Instant::now();
    }
}
