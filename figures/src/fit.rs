//! Lines through points by least squares with the error of the slope, and rates of exponential decay.

use std::f64::consts::LOG10_E;

/// y = intercept + slope · x, which minimises the sum of (y − intercept − slope · x)².
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) intercept: f64,
    pub(crate) slope: f64,
    /// The standard error of the slope: deviation / √Σ(x − mean)².
    pub(crate) slope_error: f64,
    /// The standard deviation of the residuals, with n − 2 degrees of freedom.
    pub(crate) deviation: f64,
    /// The number of points.
    pub(crate) points: usize,
}

impl Line {
    /// Points with a value that is not finite are ignored.
    ///
    /// `None` if fewer than three remain, or all have the same x: then the line or its error is undefined.
    pub(crate) fn through(points: &[(f64, f64)]) -> Option<Line> {
        let points: Vec<_> = points.iter().filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
        let n = points.len() as f64;
        if points.len() < 3 || points.iter().all(|(x, _)| *x == points[0].0) {
            return None;
        }
        let mean = |value: &dyn Fn(f64, f64) -> f64| points.iter().map(|(x, y)| value(*x, *y)).sum::<f64>() / n;
        let (x_mean, y_mean) = (mean(&|x, _| x), mean(&|_, y| y));
        // about the means, to avoid cancellation
        let x_variance = mean(&|x, _| (x - x_mean).powi(2));
        let slope = mean(&|x, y| (x - x_mean) * (y - y_mean)) / x_variance;
        let residual = |x: f64, y: f64| y - y_mean - slope * (x - x_mean);
        let deviation = (mean(&|x, y| residual(x, y).powi(2)) * n / (n - 2.0)).sqrt();
        Some(Line {
            intercept: y_mean - slope * x_mean,
            slope,
            slope_error: deviation / (n * x_variance).sqrt(),
            deviation,
            points: points.len(),
        })
    }
}

/// An energy drift that is exponentially small in the step size: drift = 10^a · e^(−c/h).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ExponentialDecay {
    /// log₁₀ of the factor.
    pub(crate) a: f64,
    pub(crate) c: f64,
    /// The standard error of c.
    pub(crate) c_error: f64,
    /// The standard deviation of the residuals, in decades.
    pub(crate) deviation: f64,
    /// The smallest and the largest step size that were used.
    pub(crate) steps: (f64, f64),
    /// The number of points that were used.
    pub(crate) points: usize,
}

impl ExponentialDecay {
    /// From pairs of h > 0 and log₁₀(drift): the line log₁₀(drift) = a − c · log₁₀(e)/h by least squares.
    ///
    /// Pairs with a value that is not finite, or h ≤ 0, are ignored; `None` as for [`Line::through`].
    pub(crate) fn of(drifts: &[(f64, f64)]) -> Option<ExponentialDecay> {
        let used: Vec<_> = drifts.iter().copied().filter(|(h, y)| h.is_finite() && *h > 0.0 && y.is_finite()).collect();
        let points: Vec<_> = used.iter().map(|(h, y)| (LOG10_E / h, *y)).collect();
        let line = Line::through(&points)?;
        let steps = used.iter().map(|(h, _)| *h);
        Some(ExponentialDecay {
            a: line.intercept,
            c: -line.slope,
            c_error: line.slope_error,
            deviation: line.deviation,
            steps: (steps.clone().fold(f64::INFINITY, f64::min), steps.fold(0.0, f64::max)),
            points: line.points,
        })
    }
}

/// log₁₀ of the drift below which the round-off of 120 digits may be visible.
pub(crate) const ROUND_OFF: f64 = -108.0;

/// Rates with a smaller relative difference are called the same: those to be distinguished differ by a factor of two.
pub(crate) const SAME_RATE: f64 = 0.1;

/// The rate of a drift over the step sizes up to `coarsest` at which it is above the round-off.
pub(crate) fn decay(drifts: &[(f64, f64)], coarsest: f64) -> Option<ExponentialDecay> {
    let used: Vec<_> = drifts.iter().copied().filter(|(h, y)| *h <= coarsest && *y > ROUND_OFF).collect();
    ExponentialDecay::of(&used)
}

/// A row of a table of rates.
pub(crate) fn decay_row(label: &str, fit: Option<&ExponentialDecay>) -> Vec<String> {
    let Some(fit) = fit else {
        return vec![label.to_owned(), "not enough points".to_owned(), String::new(), String::new()];
    };
    vec![
        label.to_owned(),
        format!("{:.4} ± {:.4}", fit.c, fit.c_error),
        format!("{:.2}", fit.deviation),
        format!("h = {:.4} … {:.4}, {} steps", fit.steps.0, fit.steps.1, fit.points),
    ]
}

/// A row of a table of rates with a value of the theory.
pub(crate) fn theory_row(label: &str, value: String) -> Vec<String> {
    vec![label.to_owned(), value, String::new(), String::new()]
}

/// The header of a table of rates.
pub(crate) const DECAY_HEADER: [&str; 4] = ["", "c in exp(−c/h)", "standard deviation (decades)", "fitted over"];

/// The smallest, the geometric mean, and the largest ratio of two drifts at the same step sizes.
pub(crate) fn ratios(points: &[(f64, f64)], to: &[(f64, f64)]) -> [f64; 3] {
    let all = points.iter().zip(to).map(|((_, a), (_, b))| a - b).filter(|ratio| ratio.is_finite());
    let all: Vec<f64> = all.collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
    let (least, most) = all.iter().fold((least, most), |(least, most), y| (least.min(*y), most.max(*y)));
    [least, mean, most].map(|ratio| 10_f64.powf(ratio))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of a few numbers of size 1: a few units in the last place.
    fn near(left: f64, right: f64) -> bool {
        (left - right).abs() < 1e-13 * right.abs().max(1.0)
    }

    /// y = 0, 1, 1 at x = 0, 1, 2: by hand, y = 1/6 + x/2, residuals −1/6, 1/3, −1/6, squares' sum 1/6.
    #[test]
    fn three_points_by_hand() {
        let line = Line::through(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]).unwrap();
        assert!(near(line.slope, 0.5) && near(line.intercept, 1.0 / 6.0), "{line:?}");
        assert!(near(line.deviation, (1.0f64 / 6.0).sqrt()), "{line:?}");
        assert!(near(line.slope_error, (1.0f64 / 12.0).sqrt()), "{line:?}");
        assert_eq!(line.points, 3);
    }

    /// Residuals +d, −d, −d, +d are orthogonal to 1 and x: the line stays, and the errors have closed forms.
    #[test]
    fn orthogonal_residuals_leave_the_line() {
        let d = 0.25;
        let points = [(-3.0, d), (-1.0, -d), (1.0, -d), (3.0, d)].map(|(x, r)| (x, 2.0 - 7.0 * x + r));
        let line = Line::through(&points).unwrap();
        assert!(near(line.slope, -7.0) && near(line.intercept, 2.0), "{line:?}");
        assert!(near(line.deviation, d * 2.0f64.sqrt()), "{line:?}");
        assert!(near(line.slope_error, d * 2.0f64.sqrt() / 20.0f64.sqrt()), "{line:?}");
    }

    /// Sums of plain squares of 1e8 + 1, 2, 3, … would lose all digits of the slope.
    #[test]
    fn x_far_from_zero_costs_no_digits() {
        let points: Vec<_> = (1..=5).map(|i| (1e8 + f64::from(i), 3.0 * f64::from(i))).collect();
        let line = Line::through(&points).unwrap();
        assert!(near(line.slope, 3.0) && line.slope_error < 1e-12, "{line:?}");
    }

    #[test]
    fn no_line_without_three_points_and_two_places() {
        assert_eq!(Line::through(&[(0.0, 0.0), (1.0, 1.0)]), None);
        assert_eq!(Line::through(&[(0.0, 0.0), (1.0, 1.0), (2.0, f64::NAN)]), None);
        assert_eq!(Line::through(&[(1.0, 0.0), (1.0, 1.0), (1.0, 2.0)]), None);
    }

    #[test]
    fn exponential_decay_is_found_again() {
        let drift = |h: f64| (h, -2.0 - 4.0 * LOG10_E / h);
        let decay =
            ExponentialDecay::of(&[drift(0.1), drift(0.05), drift(0.025), (0.2, f64::NAN), (0.0, 1.0)]).unwrap();
        assert!(near(decay.a, -2.0) && near(decay.c, 4.0), "{decay:?}");
        assert!(decay.c_error < 1e-12 && decay.deviation < 1e-12, "{decay:?}");
        assert_eq!((decay.steps, decay.points), ((0.025, 0.1), 3));
    }

    /// A residual of one decade at every step is a deviation of about one decade, and an error of c in units of h.
    #[test]
    fn error_of_c_is_in_units_of_h() {
        let points = [(-3.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (3.0, 1.0)];
        let drifts = points.map(|(x, r)| (LOG10_E / (10.0 + x), r - 2.0 * (10.0 + x)));
        let decay = ExponentialDecay::of(&drifts).unwrap();
        assert!(near(decay.c, 2.0) && near(decay.c_error, (2.0f64 / 20.0).sqrt()), "{decay:?}");
    }
}
