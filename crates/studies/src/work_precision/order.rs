//! The order that a scheme shows: the slope of log(error) over log(h), and the steps at which it holds.

/// The order measured at neighbouring steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredOrder {
    /// The slope.
    pub order: f64,
    /// Its standard error.
    pub error: f64,
    /// The smallest step size and the largest one between which it holds.
    pub from: f64,
    /// The largest step size.
    pub to: f64,
    /// How many steps there are.
    pub points: usize,
}

/// The fewest steps that show an order.
const LEAST_POINTS: usize = 4;
/// No point is farther from the line, in decades.
const LARGEST_RESIDUAL: f64 = 0.1;

impl MeasuredOrder {
    /// The order that the most neighbouring steps show within 0.1 decades; of several such ranges the one with the
    /// largest steps, where round-off is least. Points are (h, log₁₀ error) in the order of h.
    pub(crate) fn of(points: &[(f64, f64)]) -> Option<MeasuredOrder> {
        let mut best: Option<MeasuredOrder> = None;
        for first in 0..points.len() {
            for last in first + LEAST_POINTS..=points.len() {
                let Some(found) = through(&points[first..last]) else { break };
                if best.is_none_or(|best| (found.points, found.to) > (best.points, best.to)) {
                    best = Some(found);
                }
            }
        }
        // errors that do not depend on the step show no order
        best.filter(|best| best.order > 0.5)
    }
}

/// The line through all these points, if they are on it.
fn through(points: &[(f64, f64)]) -> Option<MeasuredOrder> {
    let n = points.len() as f64;
    let x: Vec<f64> = points.iter().map(|(h, _)| h.log10()).collect();
    let (x_mean, y_mean) = (x.iter().sum::<f64>() / n, points.iter().map(|(_, y)| y).sum::<f64>() / n);
    let squares: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    let order = x.iter().zip(points).map(|(x, (_, y))| (x - x_mean) * (y - y_mean)).sum::<f64>() / squares;
    let residuals = x.iter().zip(points).map(|(x, (_, y))| y - y_mean - order * (x - x_mean));
    let residuals: Vec<f64> = residuals.collect();
    let variance = residuals.iter().map(|r| r * r).sum::<f64>() / (n - 2.0);
    let steps = points.iter().map(|(h, _)| *h);
    residuals.iter().all(|r| r.abs() <= LARGEST_RESIDUAL).then_some(MeasuredOrder {
        order,
        error: (variance / squares).sqrt(),
        from: steps.clone().fold(f64::INFINITY, f64::min),
        to: steps.fold(0.0, f64::max),
        points: points.len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// h^4 between a resonance at large steps and round-off.
    fn errors() -> Vec<(f64, f64)> {
        let error = |h: f64| (h.powi(4) + 1e-9 + if h > 0.2 { 1.0 } else { 0.0 }).log10();
        (0..16).map(|i| 0.5 * 2_f64.powf(-f64::from(i) / 2.0)).map(|h| (h, error(h))).collect()
    }

    #[test]
    fn the_order_holds_between_instability_and_round_off() {
        let found = MeasuredOrder::of(&errors()).unwrap();
        assert!((found.order - 4.0).abs() < 0.05, "{found:?}");
        assert!(found.to < 0.2 && found.from > 5e-3 && found.points >= 9, "{found:?}");
    }

    #[test]
    fn what_does_not_depend_on_the_step_has_no_order() {
        assert_eq!(MeasuredOrder::of(&errors()[13..]), None);
        assert_eq!(MeasuredOrder::of(&errors()[..3]), None);
    }
}
