//! Intervals of confidence, and what they decide.

use std::fmt;

use crate::figures::numbers::decimal;
use crate::verdict::{INTERVAL, Verdict};

/// A value with the interval that contains the true one with 95 % confidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) value: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// The number of values that it is from.
    pub(crate) count: usize,
}

/// The 97.5 % points of Student's t for 1, 2, …, 30 degrees of freedom (Abramowitz and Stegun, table 26.10).
const STUDENT: [f64; 30] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
    2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
];

/// The 97.5 % point of Student's t; that of 30 degrees of freedom, which is larger, for more of them.
fn student(freedom: usize) -> f64 {
    STUDENT[freedom.clamp(1, STUDENT.len()) - 1]
}

impl Interval {
    /// The mean of values that are independent and about normal, mean ± t s/√n; `None` for fewer than three values that
    /// are finite.
    pub(crate) fn of_mean(values: &[f64]) -> Option<Interval> {
        let values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        let n = values.len() as f64;
        if values.len() < 3 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        Some(Interval::about(mean, (variance / n).sqrt(), values.len(), values.len() - 1))
    }

    /// A value with this standard error and this many degrees of freedom.
    pub(crate) fn about(value: f64, error: f64, count: usize, freedom: usize) -> Interval {
        let half = student(freedom) * error;
        Interval { value, low: value - half, high: value + half, count }
    }

    /// The interval of a function that does not fall.
    pub(crate) fn map(self, function: impl Fn(f64) -> f64) -> Interval {
        Interval { value: function(self.value), low: function(self.low), high: function(self.high), count: self.count }
    }

    /// Whether the value is larger than a limit.
    pub(crate) fn above(&self, limit: f64) -> Verdict {
        match () {
            () if self.low > limit => Verdict::Agrees,
            () if self.high < limit => Verdict::Differs,
            () => Verdict::NotDecided(INTERVAL),
        }
    }

    /// Whether the value is from `low` to `high`: it is if the whole interval is, and is not if no part of it is.
    pub(crate) fn within(&self, low: f64, high: f64) -> Verdict {
        match () {
            () if self.low >= low && self.high <= high => Verdict::Agrees,
            () if self.high < low || self.low > high => Verdict::Differs,
            () => Verdict::NotDecided(INTERVAL),
        }
    }
}

impl fmt::Display for Interval {
    /// `2.51 (95 %: 2.26 to 2.79)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Interval { value, low, high, .. } = self;
        let digits = f.precision().unwrap_or(2);
        let [value, low, high] = [value, low, high].map(|number| decimal(*number, digits));
        write!(f, "{value} (95 %: {low} to {high})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3: mean 2, s = 1, t of two degrees of freedom 4.303: 2 ± 4.303/√3.
    #[test]
    fn interval_by_hand() {
        let mean = Interval::of_mean(&[1.0, f64::NAN, 2.0, 3.0]).unwrap();
        assert!((mean.value - 2.0).abs() < 1e-15 && (mean.high - 2.0 - 4.303 / 3.0f64.sqrt()).abs() < 1e-12);
        assert_eq!((mean.low + mean.high, mean.count), (4.0, 3));
        assert_eq!(Interval::of_mean(&[1.0, 2.0]), None);
        assert_eq!(format!("{mean:.1}"), "2.0 (95 %: -0.5 to 4.5)");
    }

    #[test]
    fn what_an_interval_allows_is_not_decided() {
        let interval = Interval { value: 1.5, low: 1.0, high: 2.0, count: 3 };
        assert_eq!(
            [0.9, 1.5, 2.1].map(|limit| interval.above(limit)),
            [Verdict::Agrees, Verdict::NotDecided(INTERVAL), Verdict::Differs]
        );
        assert_eq!(interval.within(0.5, 2.5), Verdict::Agrees);
        assert_eq!(interval.within(1.5, 2.5), Verdict::NotDecided(INTERVAL));
        assert_eq!(interval.within(2.5, 3.5), Verdict::Differs);
    }
}
