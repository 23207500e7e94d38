//! Points of long runs: what a picture can show of them, in little memory.

/// A run has at most this number of columns in time; a picture is less wide.
const COLUMNS: u64 = 4096;

/// An orbit of more points is drawn as dots of every n-th state.
const MOST_POINTS: usize = 20_000;

/// A value in time. Of each column of time, the first, the lowest, the highest and the last point are kept.
#[derive(Debug)]
pub(super) struct InTime<V = f64> {
    column: u64,
    within: Vec<(f64, V)>,
    points: Vec<(f64, V)>,
}

impl<V> Default for InTime<V> {
    fn default() -> Self {
        InTime { column: 0, within: Vec::new(), points: Vec::new() }
    }
}

impl InTime {
    /// Takes the point of the n-th step; a value that is not finite is left out.
    pub(super) fn take(&mut self, n: u64, steps: u64, point: (f64, f64)) {
        self.take_finite(n, steps, Some(point).filter(|(_, value)| value.is_finite()));
    }
}

impl<V: PartialOrd + Clone> InTime<V> {
    /// Takes the point of the n-th step, which has no value that is not finite.
    pub(super) fn take_finite(&mut self, n: u64, steps: u64, point: Option<(f64, V)>) {
        let column = (u128::from(n) * u128::from(COLUMNS) / u128::from(steps.max(1))) as u64;
        if column != self.column {
            self.close();
            self.column = column;
        }
        self.within.extend(point);
    }

    fn close(&mut self) {
        let by_value =
            |a: &usize, b: &usize| self.within[*a].1.partial_cmp(&self.within[*b].1).expect("all values are finite");
        let all = 0..self.within.len();
        let extremes = [all.clone().min_by(by_value), all.clone().max_by(by_value)];
        let mut numbers: Vec<usize> =
            extremes.into_iter().flatten().chain(all.clone().next()).chain(all.last()).collect();
        numbers.sort_unstable();
        numbers.dedup();
        self.points.extend(numbers.into_iter().map(|number| self.within[number].clone()));
        self.within.clear();
    }

    pub(super) fn finish(mut self) -> Vec<(f64, V)> {
        self.close();
        self.points
    }
}

/// The points of an orbit, all of them or, of a long run, those of every n-th state.
#[derive(Debug)]
pub(super) struct Points {
    every: u64,
    count: u64,
    points: Vec<(f64, f64)>,
}

impl Points {
    pub(super) fn new() -> Self {
        Points { every: 1, count: 0, points: Vec::new() }
    }

    pub(super) fn take(&mut self, point: (f64, f64)) {
        if self.count.is_multiple_of(self.every) {
            if self.points.len() == MOST_POINTS {
                let mut number = 0;
                self.points.retain(|_| {
                    number += 1;
                    number % 2 == 1
                });
                self.every *= 2;
            }
            if self.count.is_multiple_of(self.every) {
                self.points.push(point);
            }
        }
        self.count += 1;
    }

    /// The points, and of how many states one is shown.
    pub(super) fn finish(self) -> (Vec<(f64, f64)>, u64) {
        (self.points, self.every)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_runs_stay_as_they_are() {
        let mut line = InTime::default();
        let points: Vec<_> = (0..=3000).map(|n| (f64::from(n), f64::from(n * n % 17))).collect();
        (0..).zip(&points).for_each(|(n, point)| line.take(n, 3000, *point));
        assert_eq!(line.finish(), points);
    }

    #[test]
    fn long_runs_keep_their_peaks() {
        let mut line = InTime::default();
        let value = |n: u64| if n == 543_210 { 1e3 } else { (n % 7) as f64 };
        (0..=1_000_000).for_each(|n| line.take(n, 1_000_000, (n as f64, value(n))));
        let points = line.finish();
        assert!(points.len() <= 4 * 4097 && points.contains(&(543_210.0, 1e3)), "{}", points.len());
        assert_eq!((points[0].0, points[points.len() - 1].0), (0.0, 1e6));
        assert!(points.is_sorted_by_key(|point| point.0));
    }

    #[test]
    fn values_that_a_chart_cannot_show_are_left_out() {
        let mut line = InTime::default();
        [1.0, f64::NAN, f64::NEG_INFINITY, 2.0].into_iter().for_each(|y| line.take(0, 10, (0.0, y)));
        assert_eq!(line.finish(), [(0.0, 1.0), (0.0, 2.0)]);
    }

    #[test]
    fn long_orbits_keep_every_nth_state() {
        let orbit = |count: u64| {
            let mut orbit = Points::new();
            (0..count).for_each(|n| orbit.take((n as f64, 0.0)));
            orbit.finish()
        };
        assert_eq!((orbit(20_000).0.len(), orbit(20_000).1), (20_000, 1));
        let (points, every) = orbit(100_000);
        assert_eq!((points.len(), every), (12_500, 8));
        assert!(points.iter().zip(0_u64..).all(|(point, n)| point.0 == (8 * n) as f64));
    }
}
