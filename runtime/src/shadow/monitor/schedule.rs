//! Which states belong to windows.

use crate::number::saved::Fields;

/// The odd number next to 2⁶⁴ times the golden section: its multiples, taken mod 2⁶⁴, are spread evenly.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// The n-th of numbers below `count` that are spread evenly.
#[inline]
fn spread(n: u64, count: u64) -> u64 {
    ((u128::from(n.wrapping_mul(GOLDEN)) * u128::from(count)) >> 64) as u64
}

/// Windows of up to this many states have their middles at the same states, where they are far enough apart.
///
/// The energies that are compared are taken at the middles, so that they do not depend on the estimator.
const RESERVED: u64 = 64;

/// One window of `states` states in every `every` steps.
///
/// A window begins at another one of its steps each time, at any of them where no two windows can then overlap: windows
/// at equal distances would see an oscillation whose period divides the distance always in the same phase, and take it
/// for a constant.
///
/// Places by the golden section spread phases evenly, so that means over few windows are accurate, but for some ratios
/// of `every` and the period, such as 1.382, 1.764 and 3.146, part of the phases is not seen: more than a tenth for 3
/// of 100 ratios, in 200 windows. Irregular places would leave no ratio, but the means of parts of runs are then known
/// less well, and more verdicts are undecided: 314 of 2634, in place of 256 of 2628.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule {
    states: u64,
    every: u64,
    /// The number of the present or next window.
    window: u64,
    /// Its last state.
    end: u64,
}

impl Schedule {
    pub(super) fn new(states: usize, every: u64) -> Self {
        let mut schedule = Schedule { states: states as u64, every: every.max(1), window: 0, end: 0 };
        schedule.end = schedule.last_of_first_place();
        schedule
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let Schedule { states: _, every, window, end } = self;
        [every, window, end].into_iter().for_each(|count| to.count(count));
        *self = Schedule { every: self.every.max(1), ..*self };
    }

    /// Whether the state n belongs to a window.
    #[inline]
    pub(super) fn takes(&self, n: u64) -> bool {
        self.overlaps() || n + self.states > self.end
    }

    /// How many states from n on do not belong to a window.
    pub(super) fn idle(&self, n: u64) -> u64 {
        if self.overlaps() { 0 } else { (self.end + 1).saturating_sub(n + self.states) }
    }

    /// Whether the state n is the first one of a window that follows plain steps.
    #[inline]
    pub(super) fn begins(&self, n: u64) -> bool {
        self.takes(n) && !self.needs_increments(n)
    }

    /// Whether the step to the state n must be augmented: not to the first one of a window, of which only q and p are
    /// used.
    #[inline]
    pub(super) fn needs_increments(&self, n: u64) -> bool {
        self.overlaps() || n + self.states > self.end + 1
    }

    /// Whether the state n is the last one of its window.
    #[inline]
    pub(super) fn ends(&self, n: u64) -> bool {
        n == self.end
    }

    /// Whether windows have states in common.
    #[inline]
    pub(super) fn overlaps(&self) -> bool {
        self.every <= self.states
    }

    /// Whether the state n is the one in the middle of its window, or just before.
    #[inline]
    pub(super) fn is_middle(&self, n: u64) -> bool {
        n + self.states / 2 == self.end
    }

    /// From one window to the next that has no state in common with it.
    #[inline]
    pub(super) fn windows_apart(&self) -> u64 {
        if self.overlaps() { self.states.div_ceil(self.every) } else { 1 }
    }

    /// How many states a window has.
    #[inline]
    pub(super) fn states(&self) -> usize {
        self.states as usize
    }

    /// How many states there are in the n-th pause between windows, where one of four is looked at closely: the states
    /// of three windows, or as many in the mean where windows overlap, another number each time, as equal distances
    /// would see an oscillation always in the same phase.
    #[inline]
    pub(super) fn pause(&self, n: u64) -> u64 {
        if self.overlaps() { 2 * self.states + spread(n, 2 * self.states + 1) } else { 3 * self.states }
    }

    /// Goes on to the next window.
    #[inline]
    pub(super) fn advance(&mut self) {
        self.window += 1;
        if self.every == 1 {
            self.end += 1;
            return;
        }
        self.end = self.last_of_first_place() + self.window * self.every + spread(self.window, self.places());
    }

    /// At how many of its steps a window may begin.
    fn places(&self) -> u64 {
        if self.overlaps() || self.states <= self.least_distance() { self.every } else { self.every - self.states + 1 }
    }

    /// The least distance of the first states of successive windows that begin at any of their steps: successive
    /// multiples of the golden section mod 1 differ by 0.618… or by −0.382….
    fn least_distance(&self) -> u64 {
        (self.every * 618 / 1000).saturating_sub(1)
    }

    /// The last state of a window at the first place, counted from the first of its steps.
    fn last_of_first_place(&self) -> u64 {
        if self.overlaps() {
            return self.states - 1;
        }
        // the middle, or the state before it, is the same for all windows that have as much room
        let room = self.least_distance().min(RESERVED).max(self.states);
        (room - 1) / 2 + self.states / 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First and last states of the windows among the states 0..=last.
    fn windows(states: usize, every: u64, last: u64) -> Vec<(u64, u64)> {
        let mut schedule = Schedule::new(states, every);
        let (mut first, mut all) = (None, Vec::new());
        for n in 0..=last {
            if !schedule.takes(n) {
                continue;
            }
            first.get_or_insert(n);
            if schedule.ends(n) {
                all.extend(first.take().map(|first| (first, n)));
                schedule.advance();
            }
        }
        all
    }

    #[test]
    fn one_window_in_every_so_many_steps() {
        for (states, every) in [(9, 10), (9, 17), (9, 100), (17, 30), (17, 100), (65, 108), (3, 1000)] {
            let all = windows(states, every, 1001 * every);
            assert!(all.len() >= 1000);
            let (begin, mut free) = (all[0].0, 0);
            for (i, (first, last)) in (0..).zip(all) {
                assert_eq!(last - first + 1, states as u64);
                assert!(free <= first, "{states}, {every}: {first}–{last} has a state of the window before");
                free = last + 1;
                assert!(
                    (begin + i * every..begin + (i + 1) * every).contains(&first),
                    "{states}, {every}: {first}–{last}"
                );
            }
        }
    }

    #[test]
    fn windows_that_overlap_take_every_state() {
        let mut schedule = Schedule::new(9, 4);
        let mut ends = Vec::new();
        for n in 0..4000 {
            assert!(schedule.takes(n));
            if schedule.ends(n) {
                ends.push(n);
                schedule.advance();
            }
        }
        assert!((998..=1000).contains(&ends.len()), "{}", ends.len());
        assert_eq!(windows(9, 1, 100).len(), 92 + 1, "each state from the ninth on ends one");
    }

    /// Three windows; where windows overlap, two to four windows, three in the mean.
    #[test]
    fn pauses_change_where_windows_overlap() {
        let pauses = |every: u64| -> Vec<u64> {
            let schedule = Schedule::new(9, every);
            (0..1000).map(|n| schedule.pause(n)).collect()
        };
        assert!(pauses(100).iter().all(|pause| *pause == 27));
        for every in [1, 4, 9] {
            let pauses = pauses(every);
            let mean = pauses.iter().sum::<u64>() as f64 / 1000.0;
            assert!(
                pauses.iter().all(|pause| (18..=36).contains(pause)) && (mean - 27.0).abs() < 0.5,
                "{every}: {mean}"
            );
            assert!((18..=36).all(|pause| pauses.contains(&pause)), "{every}");
        }
    }

    /// A period that divides the distance of the windows, or is equal to it, is seen in all its phases.
    #[test]
    fn places_change() {
        for (every, period) in [(9, 9), (20, 20), (35, 35), (100, 4), (100, 50), (100, 100), (200, 200)] {
            let mut phases = vec![0; period];
            windows(9, every, 1000 * every).iter().for_each(|(first, _)| phases[*first as usize % period] += 1);
            assert!(phases.iter().all(|count| *count >= 900 / period), "{every}, {period}: {phases:?}");
        }
    }

    /// The middles do not depend on the number of states.
    #[test]
    fn middles_are_the_same() {
        let middles = |states: usize, every| {
            let all = windows(states, every, 100 * every);
            all.iter().map(|(_, last)| last - states as u64 / 2).take(98).collect::<Vec<_>>()
        };
        for (most, every) in [(17, 30), (51, 90), (64, 106), (64, 1000)] {
            for states in [3, 9, 17] {
                assert_eq!(middles(states, every), middles(most, every), "{states}, {every}");
            }
        }
    }
}
