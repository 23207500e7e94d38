//! A change of H from one state to the next that lasts: at a close encounter, or where a step was too large. The
//! windows of a monitor may miss its beginning, if the run has few states before it.

use shadowstep::number::saved::{Fields, optional};

/// The least and the largest H of some states.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    largest: f64,
    states: u64,
    /// The n of the first and the last one.
    from: i64,
    to: i64,
}

impl Range {
    fn of(n: i64, energy: f64) -> Self {
        Range { least: energy, largest: energy, states: 1, from: n, to: n }
    }

    /// With H of a state within it.
    fn with(self, energy: f64) -> Self {
        Range { least: self.least.min(energy), largest: self.largest.max(energy), ..self }
    }

    fn joined(self, other: Range) -> Range {
        Range {
            least: self.least.min(other.least),
            largest: self.largest.max(other.largest),
            states: self.states + other.states,
            from: self.from,
            to: other.to,
        }
    }

    fn width(self) -> f64 {
        self.largest - self.least
    }

    /// How far another range is above this one, or below it; not positive where they meet.
    fn gap(self, other: Range) -> f64 {
        (other.least - self.largest).max(self.least - other.largest)
    }
}

/// The largest gap so far between the H of all states before some n and of all since then.
#[derive(Clone, Debug, Default)]
pub(super) struct LastingChanges {
    before: Option<Range>,
    since: Option<Range>,
}

/// H after the change is a part of its range, this or more, away from H before it.
const LEAST_PART: f64 = 0.25;
/// On both sides of it: a run may begin at a pericentre, of which no other of its states has the energy.
const LEAST_STATES: u64 = 3;
/// Fewer states may be on both sides of a gap by chance.
const LEAST_OF_ALL: u64 = 32;
/// A change takes no more states than this.
const LONGEST: u64 = 4;
/// A step by this part of a change or more begins it anew.
const MOST_OF_IT: f64 = 0.6;

/// A change of H that lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LastingChange {
    /// How far H since then is from H before it, at least.
    pub(super) gap: f64,
    /// The n of the last state before it, and of the first one after it.
    pub(super) between: [i64; 2],
}

impl LastingChanges {
    /// Takes H, less a constant, of the next state, or of one that comes after later states.
    pub(super) fn include(&mut self, n: i64, energy: f64) {
        let new = Range::of(n, energy);
        let (Some(before), Some(since)) = (self.before, self.since) else {
            *self = LastingChanges { before: self.before.or(Some(new)), since: self.before.and(Some(new)) };
            return;
        };
        if n <= since.to {
            let side = if n < since.from { &mut self.before } else { &mut self.since };
            *side = side.map(|range| range.with(energy));
            return;
        }
        let gap = before.gap(since);
        let (of_all, of_new) = (before.joined(since).gap(new), before.gap(new));
        if gap > 0.0 && since.states < LONGEST && of_new > gap + since.width() && of_all < MOST_OF_IT * of_new {
            // the change goes on
            self.since = Some(Range { states: since.states + 1, ..new });
        } else if of_all > gap {
            (self.before, self.since) = (Some(before.joined(since)), Some(new));
        } else {
            self.since = Some(since.joined(new));
        }
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        for range in [&mut self.before, &mut self.since] {
            optional(to, range, &Range::of(0, 0.0), |to, Range { least, largest, states, from, to: last }| {
                [least, largest].into_iter().for_each(|energy| to.double(energy));
                to.count(states);
                [from, last].into_iter().for_each(|n| to.whole(n));
            });
        }
    }

    /// max − min of H.
    pub(super) fn range(&self) -> f64 {
        self.before.zip(self.since).map_or(0.0, |(before, since)| before.joined(since).width())
    }

    /// The change, if there is one.
    pub(super) fn found(&self) -> Option<LastingChange> {
        let (before, since) = self.before.zip(self.since)?;
        let all = before.joined(since);
        let gap = before.gap(since);
        let lasts = before.states.min(since.states) >= LEAST_STATES && all.states >= LEAST_OF_ALL;
        (lasts && gap >= LEAST_PART * all.width()).then_some(LastingChange { gap, between: [before.to, since.from] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(energies: impl IntoIterator<Item = f64>) -> Option<LastingChange> {
        let mut lasting = LastingChanges::default();
        (0..).zip(energies).for_each(|(n, energy)| lasting.include(n, energy));
        lasting.found()
    }

    /// H of a run that begins at a pericentre, where its error is largest.
    fn pericentres(n: u32, steps: f64) -> f64 {
        1.0 / (1.1 - (f64::from(n) / steps).cos()).powi(3)
    }

    #[test]
    fn what_comes_back_does_not_last() {
        for steps in [2.0, 10.0, 50.0, 1000.0] {
            assert_eq!(change((0..2000).map(|n| pericentres(n, steps))), None, "{steps}");
            // half an oscillation, and less
            for part in [1.0, 0.5, 0.2] {
                assert_eq!(change((0..100).map(|n| (0.0314 * part * f64::from(n)).cos())), None, "{part}");
            }
        }
        let few_at_the_start = (0..2000).map(|n| if n < 2 { 1.0 } else { 1e-3 * f64::from(n).sin() });
        assert_eq!(change(few_at_the_start), None);
        assert_eq!(change((0..2000).map(|n| if n == 1000 { 5.0 } else { f64::from(n).sin() })), None, "once");
    }

    #[test]
    fn a_change_lasts() {
        for at in [3, 10, 1000, 1990] {
            for size in [1.0, -3.0] {
                let energies = (0..2000).map(|n| f64::from(n).sin() / 2.0 + if n < at { 0.0 } else { 2.0 * size });
                let Some(LastingChange { gap, between }) = change(energies) else { panic!("{size} at {at}") };
                let at = i64::from(at);
                assert!(between[0] == at - 1 && (at..at + 4).contains(&between[1]), "{size} at {at}: {between:?}");
                assert!((gap - (2.0 * size.abs() - 1.0)).abs() < 0.6, "{size} at {at}: {gap}");
            }
        }
        // in some steps, of which each is less than a quarter
        let slow = (0..2000).map(|n| f64::from(n.clamp(500, 504) - 500) + 0.1 * f64::from(n).sin());
        assert_eq!(change(slow).unwrap().between[0], 500);
    }

    #[test]
    fn late_states_are_within_others() {
        let mut lasting = LastingChanges::default();
        for n in 0..200_i64 {
            lasting.include(10 * n, f64::from(n >= 5));
            lasting.include(10 * n - 5, f64::from(n > 5));
        }
        assert_eq!(lasting.found(), Some(LastingChange { gap: 1.0, between: [40, 50] }));
    }
}
