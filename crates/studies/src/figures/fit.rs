//! Lines through points by least squares with the error of the slope, rates of exponential decay, and ratios.

use std::f64::consts::LOG10_E;
use std::fmt;

use crate::figures::interval::Interval;
use crate::verdict::Verdict;

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
    /// The same of a power law, log₁₀(drift) = a + r log₁₀(h), at the same points.
    pub(crate) power_law: f64,
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
        let power_law = Line::through(&used.iter().map(|(h, y)| (h.log10(), *y)).collect::<Vec<_>>())?;
        Some(ExponentialDecay {
            power_law: power_law.deviation,
            a: line.intercept,
            c: -line.slope,
            c_error: line.slope_error,
            deviation: line.deviation,
            steps: range(used.iter().map(|(h, _)| *h)),
            points: line.points,
        })
    }

    /// c with its interval.
    pub(crate) fn rate(&self) -> Interval {
        Interval::about(self.c, self.c_error, self.points, self.points - 2)
    }

    /// Whether the drift is exponential in 1/h: it is if exp(−c/h), c > 0, fits at least twice as well as a power of h,
    /// and is not if the power fits twice as well.
    pub(crate) fn is_exponential(&self) -> Verdict {
        let line = match () {
            () if 2.0 * self.deviation <= self.power_law => Verdict::Agrees,
            () if 2.0 * self.power_law <= self.deviation => Verdict::Differs,
            () => Verdict::NotDecided(NEITHER),
        };
        Verdict::of_all([line, self.rate().above(0.0)])
    }

    /// What [`is_exponential`](Self::is_exponential) is decided by.
    pub(crate) fn described(&self) -> String {
        format!(
            "c = {:.3} at {} steps; exp(−c/h) fits to within {:.2} decades, a power of h to within {:.2}",
            self.rate(),
            self.points,
            self.deviation,
            self.power_law
        )
    }
}

/// Whether all rates are that of the first, which they are if their ratios are from 0.9 to 1.1 with all of their
/// uncertainty; and the ratios in words.
pub(crate) fn same_rates(first: &ExponentialDecay, others: &[(&str, &ExponentialDecay)]) -> (Verdict, String) {
    let ratio = |other: &ExponentialDecay| {
        let error = (first.c_error.powi(2) + other.c_error.powi(2)).sqrt() / first.c;
        Interval::about(other.c / first.c, error, other.points, first.points.min(other.points) - 2)
    };
    let ratios: Vec<_> = others.iter().map(|(label, other)| (*label, ratio(other))).collect();
    let verdict = Verdict::of_all(ratios.iter().map(|(_, ratio)| ratio.within(1.0 - SAME_RATE, 1.0 + SAME_RATE)));
    let list: Vec<_> = ratios.iter().map(|(label, ratio)| format!("{label} {ratio:.3}")).collect();
    (verdict, format!("relative to the first, {}; from 0.9 to 1.1 counts as the same", list.join(", ")))
}

/// drift = 10^a · h^−r · e^(−c/h): c and r with their intervals, by least squares; `None` for fewer than five points.
fn with_power(drifts: &[(f64, f64)]) -> Option<(Interval, Interval)> {
    let used = drifts.iter().filter(|(h, y)| *h > 0.0 && y.is_finite());
    let points: Vec<([f64; 3], f64)> = used.map(|(h, y)| ([1.0, LOG10_E / h, -h.log10()], *y)).collect();
    if points.len() < 5 {
        return None;
    }
    let sum = |i: usize, j: usize| points.iter().map(|(x, _)| x[i] * x[j]).sum::<f64>();
    let inverse = inverse([0, 1, 2].map(|i| [0, 1, 2].map(|j| sum(i, j))))?;
    let right = [0, 1, 2].map(|i| points.iter().map(|(x, y)| x[i] * y).sum::<f64>());
    let found = inverse.map(|row| row.iter().zip(right).map(|(a, b)| a * b).sum::<f64>());
    let squares = points.iter().map(|(x, y)| (y - x.iter().zip(found).map(|(a, b)| a * b).sum::<f64>()).powi(2));
    let freedom = points.len() - 3;
    let variance = squares.sum::<f64>() / freedom as f64;
    let interval = |i: usize, sign: f64| {
        Interval::about(sign * found[i], (variance * inverse[i][i]).sqrt(), points.len(), freedom)
    };
    Some((interval(1, -1.0), interval(2, 1.0)))
}

/// The rate of (h, log₁₀ drift) beside π ρ, that of the aliasing of differences of samples, in words.
pub(crate) fn against_aliasing(drifts: &[(f64, f64)], theory: f64) -> Option<String> {
    let (c, power) = with_power(drifts)?;
    let place = if c.within(theory, theory) == Verdict::Differs { "outside" } else { "within" };
    Some(format!(
        "Aliasing of differences of samples gives the rate π ρ = {theory:.3} with a power of h before the \
         exponential. Fitted with a power, c is {c:.3} and the factor is h⁻ʳ, r = {power:.1}: π ρ is {place} that \
         interval."
    ))
}

/// The inverse of a symmetric matrix by its cofactors; `None` if it is singular.
fn inverse(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |i: usize, j: usize| {
        let at = |row: usize, column: usize| m[(i + row) % 3][(j + column) % 3];
        at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    (determinant != 0.0).then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) / determinant)))
}

/// log₁₀ of the drift below which the round-off of 120 digits may be visible.
pub(crate) const ROUND_OFF: f64 = -108.0;

/// Rates with a smaller relative difference are called the same: those to be distinguished differ by a factor of two.
const SAME_RATE: f64 = 0.1;
const NEITHER: &str = "Neither law fits twice as well as the other; a wider range of step sizes would part them.";

/// The rate of a drift over the step sizes up to `coarsest` at which it is above the round-off.
pub(crate) fn decay(drifts: &[(f64, f64)], coarsest: f64) -> Option<ExponentialDecay> {
    let used: Vec<_> = drifts.iter().copied().filter(|(h, y)| *h <= coarsest && *y > ROUND_OFF).collect();
    ExponentialDecay::of(&used)
}

/// The points (h, y) of points (1/h, y).
pub(crate) fn by_step(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    points.iter().map(|(n, y)| (1.0 / n, *y)).collect()
}

/// The least and the largest of values.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), y| (least.min(y), most.max(y)))
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

/// The ratios of two drifts at the same step sizes, where both are above the round-off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ratio {
    /// The geometric mean, with its interval if the ratios at different steps are independent.
    pub(crate) mean: Interval,
    pub(crate) least: f64,
    pub(crate) most: f64,
}

impl Ratio {
    /// Of (x, log₁₀ drift), relative to others at the same x; `None` for fewer than three.
    pub(crate) fn of(points: &[(f64, f64)], to: &[(f64, f64)]) -> Option<Ratio> {
        let all = logarithms(points, to);
        let sizes = all.iter().map(|(_, ratio)| *ratio);
        let (least, most) = range(sizes.clone());
        let power = |y: f64| 10_f64.powf(y);
        let mean = Interval::of_mean(&sizes.collect::<Vec<_>>())?.map(power);
        Some(Ratio { mean, least: power(least), most: power(most) })
    }

    /// Whether it is about a factor that is given with one digit: what rounds to it.
    pub(crate) fn is_about(&self, factor: f64) -> Verdict {
        self.mean.within(factor - 0.5, factor + 0.5)
    }
}

impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Ratio { mean, least, most } = self;
        write!(f, "{mean} in the geometric mean of {} steps; {least:.2} to {most:.2}", mean.count)
    }
}

/// (x, log₁₀ of the ratio) where both drifts are above the round-off.
pub(crate) fn logarithms(points: &[(f64, f64)], to: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let both = points.iter().zip(to).filter(|((_, a), (_, b))| *a > ROUND_OFF && *b > ROUND_OFF);
    both.map(|((x, a), (_, b))| (*x, a - b)).filter(|(_, ratio)| ratio.is_finite()).collect()
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
    fn an_exponential_and_a_power_are_distinguished() {
        let steps = [0.2, 0.1, 0.07, 0.05, 0.04, 0.025];
        let wiggle = |i: usize| if i.is_multiple_of(2) { 0.1 } else { -0.1 };
        let fit = |y: &dyn Fn(f64) -> f64| {
            let points: Vec<_> = steps.iter().enumerate().map(|(i, &h)| (h, y(h) + wiggle(i))).collect();
            ExponentialDecay::of(&points).unwrap().is_exponential()
        };
        assert_eq!(fit(&|h| -1.0 / h), Verdict::Agrees);
        assert_eq!(fit(&|h| 8.0 * h.log10()), Verdict::Differs);
        assert_eq!(fit(&|_| 0.0), Verdict::NotDecided(NEITHER));
    }

    #[test]
    fn a_power_before_the_exponential_is_found_again() {
        let drift = |h: f64| (h, -1.0 - 6.0 * LOG10_E / h - 2.0 * h.log10());
        let (c, power) = with_power(&[0.5, 0.4, 0.3, 0.2, 0.15, 0.1].map(drift)).unwrap();
        assert!((c.value - 6.0).abs() < 1e-9 && (power.value - 2.0).abs() < 1e-9, "{c:?} {power:?}");
        assert!(c.low <= c.value && c.high - c.low < 1e-6);
        assert_eq!(with_power(&[0.5, 0.4, 0.3, 0.2].map(drift)), None);
    }

    #[test]
    fn ratios_leave_out_what_round_off_hides() {
        let points = [(1.0, -10.0), (2.0, -20.0), (3.0, -30.0), (4.0, -110.0)];
        let to = points.map(|(x, y)| (x, y - 3.0f64.log10()));
        let ratio = Ratio::of(&points, &to).unwrap();
        assert_eq!(ratio.mean.count, 3);
        assert!(near(ratio.mean.value, 3.0) && near(ratio.least, ratio.most), "{ratio}");
        assert_eq!((ratio.is_about(3.0), ratio.is_about(4.0)), (Verdict::Agrees, Verdict::Differs));
        assert_eq!(ratio.mean.above(1.0), Verdict::Agrees);
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
