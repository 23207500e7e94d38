//! The linear change of a series with its uncertainty.

/// The change of a series from its begin to its end, by a straight line of least squares, and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    pub(super) value: f64,
    pub(super) error: f64,
    /// The last mean less the first one: a straight line underestimates a jump near an end of the run. 0 of fewer than
    /// 4 numbers, as where they are in an oscillation is chance.
    pub(super) of_ends: f64,
}

/// A change is excluded above its value and this many standard errors.
const CONFIDENCE: f64 = 3.0;
/// The first and the last mean are compared if they are of this number of numbers or more.
const LEAST_OF_ENDS: u64 = 4;
/// Correlations of successive residuals above this are not distinguished.
const LARGEST_CORRELATION: f64 = 0.95;

impl Change {
    /// Of means of `size` numbers each; `None` for fewer than 16 means, or numbers that are not finite.
    ///
    /// The standard error for independent residuals is multiplied by √((1 + r)/(1 − r)), r the correlation of
    /// successive ones: a slow oscillation or a random walk is not known better for being sampled often.
    pub(super) fn of(series: &[f64], size: u64) -> Option<Change> {
        let count = series.len() as f64;
        if series.len() < 16 || !series.iter().all(|value| value.is_finite()) {
            return None;
        }
        let time = |i: usize| (i as f64 - (count - 1.0) / 2.0) / count;
        let mean = series.iter().sum::<f64>() / count;
        let times: f64 = (0..series.len()).map(|i| time(i).powi(2)).sum();
        let slope = series.iter().enumerate().map(|(i, value)| time(i) * (value - mean)).sum::<f64>() / times;
        let residuals: Vec<f64> = series.iter().enumerate().map(|(i, value)| value - mean - slope * time(i)).collect();
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        let products: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        // 0 of 0 where nothing changes
        let correlation = if squares > 0.0 { (products / squares).clamp(0.0, LARGEST_CORRELATION) } else { 0.0 };
        let inflation = ((1.0 + correlation) / (1.0 - correlation)).sqrt();
        let error = (squares / (count - 2.0) / times).sqrt() * inflation;
        let of_ends = if size < LEAST_OF_ENDS { 0.0 } else { series[series.len() - 1] - series[0] };
        Some(Change { value: slope, error, of_ends })
    }

    /// What a change is excluded above.
    pub(super) fn bound(self) -> f64 {
        (self.value.abs() + CONFIDENCE * self.error).max(self.of_ends.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::Change;

    /// Numbers between −1/2 and 1/2 that look random.
    fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn a_line_is_its_own_change() {
        let line: Vec<f64> = (0..50).map(|i| 3.0 + 2.0 * f64::from(i) / 50.0).collect();
        let Change { value, error, of_ends } = Change::of(&line, 4).unwrap();
        // sums of 50 numbers of size 1
        assert!((value - 2.0).abs() < 1e-13 && error < 1e-13, "{value} {error}");
        assert!((of_ends - 2.0 * 49.0 / 50.0).abs() < 1e-13, "{of_ends}");
        assert_eq!(Change::of(&[1.0; 20], 4), Some(Change { value: 0.0, error: 0.0, of_ends: 0.0 }));
        assert_eq!((Change::of(&line[..15], 4), Change::of(&[f64::NAN; 20], 4)), (None, None));
    }

    /// A jump in the first of many parts: a line through it changes by a fifth of it.
    #[test]
    fn a_jump_near_an_end_is_not_excluded() {
        let jump: Vec<f64> = (0..32).map(|i| f64::from(i > 0)).collect();
        let found = Change::of(&jump, 4).unwrap();
        assert!(found.value + 3.0 * found.error < 0.5 && found.bound() >= 1.0, "{found:?}");
    }

    /// The bounds hold; for noise they are of the size that theory gives, 3 √(12/64) σ.
    #[test]
    fn bounds_hold_for_noise_and_for_walks() {
        let walk = |seed| {
            let mut sum = 0.0;
            noise(64, seed).into_iter().map(|step| (sum += step, sum).1).collect::<Vec<f64>>()
        };
        let beyond = |change: &dyn Fn(u64) -> (f64, Change)| {
            (1..=1000).map(|seed| change(seed * 7919)).filter(|(right, found)| right.abs() > found.bound()).count()
        };
        let of = |series: &[f64]| Change::of(series, 1).expect("there are enough numbers");
        // of a normal distribution 2.7 of 1000; the change of noise is 0
        let noises =
            (1..=1000).map(|seed| of(&noise(64, seed * 7919))).filter(|c| c.value.abs() > 3.0 * c.error).count();
        assert!(noises <= 10, "{noises}");
        let walks = beyond(&|seed| (walk(seed)[63] - walk(seed)[0], of(&walk(seed))));
        assert!(walks <= 50, "{walks}");
        let mean: f64 =
            (1..=1000).map(|seed| Change::of(&noise(64, seed * 7919), 1).unwrap().error).sum::<f64>() / 1000.0;
        let expected = (12.0_f64 / 64.0).sqrt() / 12.0_f64.sqrt();
        assert!((mean / expected - 1.0).abs() < 0.1, "{mean} {expected}");
    }
}
