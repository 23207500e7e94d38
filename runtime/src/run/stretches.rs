//! Stretches of a run in which errors are small, with larger ones between them.

use std::collections::BTreeMap;

use crate::number::Number;

/// What errors have to rise and fall by for two stretches: a factor of 2^10.
const APART: i32 = 10;

/// Valleys of the error, each with its quietest estimate.
#[derive(Clone, Debug)]
pub(super) struct Stretches<N> {
    /// The sizes of errors are falling, or have not yet risen by 2^[`APART`] above the valley; else they are beyond it.
    in_valley: bool,
    /// The largest size since the last valley.
    peak: i32,
    valley: Valley<N>,
    last: Option<Valley<N>>,
    /// How many valleys are that quiet.
    counts: BTreeMap<i32, u64>,
    jump: N,
    largest_jump: N,
}

#[derive(Clone, Debug)]
struct Valley<N> {
    /// ⌊log₂ error⌋
    size: i32,
    value: N,
    error: N,
}

impl<N: Number> Stretches<N> {
    pub(super) fn new(context: &N::Context) -> Self {
        let zero = N::zero(context);
        Stretches {
            in_valley: true,
            peak: i32::MIN,
            valley: Valley { size: i32::MAX, value: zero.clone(), error: zero.clone() },
            last: None,
            counts: BTreeMap::new(),
            jump: zero.clone(),
            largest_jump: zero,
        }
    }

    /// Whether errors of these sizes make one stretch.
    pub(super) fn are_alike(least: i32, largest: i32) -> bool {
        largest.saturating_sub(least) <= APART
    }

    /// Takes the next estimate.
    pub(super) fn include(&mut self, size: i32, value: &N, error: &N) {
        if self.in_valley {
            if size < self.valley.size {
                self.begin(size, value, error);
            } else if size.saturating_sub(self.valley.size) > APART {
                self.end_valley();
                (self.in_valley, self.peak) = (false, size);
            }
        } else if self.peak.saturating_sub(size) > APART {
            self.in_valley = true;
            self.begin(size, value, error);
        } else {
            self.peak = self.peak.max(size);
        }
    }

    fn begin(&mut self, size: i32, value: &N, error: &N) {
        self.valley.size = size;
        self.valley.value.assign(value);
        self.valley.error.assign(error);
    }

    fn end_valley(&mut self) {
        *self.counts.entry(self.valley.size).or_default() += 1;
        if let Some(last) = &self.last {
            assign_jump(&mut self.jump, last, &self.valley);
            if self.jump > self.largest_jump {
                self.largest_jump.assign(&self.jump);
            }
        }
        self.last = Some(self.valley.clone());
    }

    /// The one that the run ends in, if it is quiet enough to be one.
    fn unfinished(&self, quiet: i32) -> Option<&Valley<N>> {
        Some(&self.valley).filter(|valley| self.in_valley && valley.size <= quiet)
    }

    /// How many stretches reach errors of this size or less.
    pub(super) fn count(&self, quiet: i32) -> u64 {
        self.counts.range(..=quiet).map(|(_, count)| count).sum::<u64>() + u64::from(self.unfinished(quiet).is_some())
    }

    /// The largest change from one stretch to the next.
    pub(super) fn largest_jump(&self, quiet: i32) -> N {
        let mut largest = self.largest_jump.clone();
        if let (Some(last), Some(valley)) = (&self.last, self.unfinished(quiet)) {
            let mut jump = largest.clone();
            assign_jump(&mut jump, last, valley);
            if jump > largest {
                largest = jump;
            }
        }
        largest
    }
}

/// The difference of the values, or 0 where their errors can feign it.
fn assign_jump<N: Number>(jump: &mut N, a: &Valley<N>, b: &Valley<N>) {
    jump.assign_sum(&a.error, &b.error);
    jump.multiply_integer(2);
    let feigned = jump.clone();
    jump.assign_difference(&a.value, &b.value);
    jump.make_absolute();
    if *jump < feigned {
        jump.assign_zero();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stretches(sizes: &[i32]) -> Stretches<f64> {
        let mut stretches = Stretches::new(&());
        for (n, size) in sizes.iter().enumerate() {
            stretches.include(*size, &(n as f64), &f64::from(*size).exp2());
        }
        stretches
    }

    #[test]
    fn stretches_are_counted_by_what_is_between_them() {
        for (sizes, quiet, count) in [
            (&[-10, -60, -10, -60, -10][..], -30, 2),
            (&[-60, -10, -60], -30, 2),
            (&[-10, -60, -10], -30, 1),
            (&[-10, -30, -50, -70], -30, 1),
            (&[-10, -60, -10, -25], -30, 1),
            (&[-50, -55, -52, -58, -50], -30, 1),
            (&[-10, -60, -45, -60, -10], -30, 2),
            (&[-10, -60, -55, -60, -10], -30, 1),
        ] {
            assert_eq!(stretches(sizes).count(quiet), count, "{sizes:?}");
        }
    }

    #[test]
    fn the_largest_jump_is_from_valley_to_valley() {
        assert_eq!(stretches(&[-10, -60, -10, -60, -10]).largest_jump(-30), 2.0);
        assert_eq!(stretches(&[-60, -10, -10, -10, -60, -10, -60]).largest_jump(-30), 4.0);
        assert_eq!(stretches(&[-10, -60, -10]).largest_jump(-30), 0.0);
        // errors of 1/2 each feign a difference of 2
        assert_eq!(stretches(&[20, -1, 20, -1, 20]).largest_jump(0), 2.0);
        assert_eq!(stretches(&[20, 0, 20, 0, 20]).largest_jump(0), 0.0);
    }
}
