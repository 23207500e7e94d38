//! The intervals of a run in which errors are small, with peaks of the error between them.

use std::collections::BTreeMap;

use crate::number::Real;

/// The factor by which errors rise and fall between two intervals: 2^10.
const APART: i32 = 10;

/// Minima of the error, each with its estimate.
#[derive(Clone, Debug)]
pub(super) struct Intervals<N> {
    /// The errors are falling, or have not yet risen by 2^[`APART`] above the minimum; else they are near a peak.
    in_interval: bool,
    /// The largest size since the last interval.
    peak: i32,
    minimum: Minimum<N>,
    last: Option<Minimum<N>>,
    /// How many intervals have a minimum of this size.
    counts: BTreeMap<i32, u64>,
    jump: N,
    largest_jump: N,
}

#[derive(Clone, Debug)]
struct Minimum<N> {
    /// ⌊log₂ error⌋
    size: i32,
    value: N,
    error: N,
}

impl<N: Real> Intervals<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zero = N::zero(context);
        Intervals {
            in_interval: true,
            peak: i32::MIN,
            minimum: Minimum { size: i32::MAX, value: zero.clone(), error: zero.clone() },
            last: None,
            counts: BTreeMap::new(),
            jump: zero.clone(),
            largest_jump: zero,
        }
    }

    /// Whether errors of these sizes belong to one interval.
    pub(super) fn is_one(least: i32, largest: i32) -> bool {
        largest.saturating_sub(least) <= APART
    }

    /// Takes the next estimate.
    pub(super) fn include(&mut self, size: i32, value: &N, error: &N) {
        if self.in_interval {
            if size < self.minimum.size {
                self.begin(size, value, error);
            } else if size.saturating_sub(self.minimum.size) > APART {
                self.end_interval();
                (self.in_interval, self.peak) = (false, size);
            }
        } else if self.peak.saturating_sub(size) > APART {
            self.in_interval = true;
            self.begin(size, value, error);
        } else {
            self.peak = self.peak.max(size);
        }
    }

    fn begin(&mut self, size: i32, value: &N, error: &N) {
        self.minimum.size = size;
        self.minimum.value.assign(value);
        self.minimum.error.assign(error);
    }

    fn end_interval(&mut self) {
        *self.counts.entry(self.minimum.size).or_default() += 1;
        if let Some(last) = &self.last {
            assign_jump(&mut self.jump, last, &self.minimum);
            if self.jump > self.largest_jump {
                self.largest_jump.assign(&self.jump);
            }
        }
        self.last = Some(self.minimum.clone());
    }

    /// The minimum of the interval that the run ends in, if it is low enough.
    fn unfinished(&self, low: i32) -> Option<&Minimum<N>> {
        Some(&self.minimum).filter(|minimum| self.in_interval && minimum.size <= low)
    }

    /// How many intervals reach errors of this size or less.
    pub(super) fn count(&self, low: i32) -> u64 {
        self.counts.range(..=low).map(|(_, count)| count).sum::<u64>() + u64::from(self.unfinished(low).is_some())
    }

    /// The largest change from one interval to the next.
    pub(super) fn largest_jump(&self, low: i32) -> N {
        let mut largest = self.largest_jump.clone();
        if let (Some(last), Some(minimum)) = (&self.last, self.unfinished(low)) {
            let mut jump = largest.clone();
            assign_jump(&mut jump, last, minimum);
            if jump > largest {
                largest = jump;
            }
        }
        largest
    }
}

/// The difference of the values, or 0 where it is within their errors.
fn assign_jump<N: Real>(jump: &mut N, a: &Minimum<N>, b: &Minimum<N>) {
    jump.assign_sum(&a.error, &b.error);
    jump.multiply_integer(2);
    let within_errors = jump.clone();
    jump.assign_difference(&a.value, &b.value);
    jump.make_absolute();
    if *jump < within_errors {
        jump.assign_zero();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn intervals(sizes: &[i32]) -> Intervals<f64> {
        let mut intervals = Intervals::new(&());
        for (n, size) in sizes.iter().enumerate() {
            intervals.include(*size, &(n as f64), &f64::from(*size).exp2());
        }
        intervals
    }

    #[test]
    fn intervals_are_counted_by_what_is_between_them() {
        for (sizes, low, count) in [
            (&[-10, -60, -10, -60, -10][..], -30, 2),
            (&[-60, -10, -60], -30, 2),
            (&[-10, -60, -10], -30, 1),
            (&[-10, -30, -50, -70], -30, 1),
            (&[-10, -60, -10, -25], -30, 1),
            (&[-50, -55, -52, -58, -50], -30, 1),
            (&[-10, -60, -45, -60, -10], -30, 2),
            (&[-10, -60, -55, -60, -10], -30, 1),
        ] {
            assert_eq!(intervals(sizes).count(low), count, "{sizes:?}");
        }
    }

    #[test]
    fn the_largest_jump_is_from_minimum_to_minimum() {
        assert_eq!(intervals(&[-10, -60, -10, -60, -10]).largest_jump(-30), 2.0);
        assert_eq!(intervals(&[-60, -10, -10, -10, -60, -10, -60]).largest_jump(-30), 4.0);
        assert_eq!(intervals(&[-10, -60, -10]).largest_jump(-30), 0.0);
        // errors of 1/2 each explain a difference of 2
        assert_eq!(intervals(&[20, -1, 20, -1, 20]).largest_jump(0), 2.0);
        assert_eq!(intervals(&[20, 0, 20, 0, 20]).largest_jump(0), 0.0);
    }
}
