//! Which scheme needs the least for an error.

use crate::work_precision::size::Size;

/// A curve of cost and log₁₀ error, in the order of cost.
pub(crate) type Curve = Vec<(f64, f64)>;

/// What a scheme pays for an error of at most this size; `None` where no run meets it.
///
/// That is the cost of the first of two successive runs that meet it, as one alone may do so by accident; between the
/// run before, which does not, and this one both are powers of each other.
pub(crate) fn cost_of(curve: &Curve, error: Size) -> Option<f64> {
    let target = error.log10();
    let meets = |i: usize| curve.get(i).is_none_or(|(_, error)| *error <= target);
    let first = (0..curve.len()).find(|&i| meets(i) && meets(i + 1))?;
    let (cost, below) = curve[first];
    let Some((cost_before, above)) = first.checked_sub(1).map(|before| curve[before]) else { return Some(cost) };
    let part = (above - target) / (above - below);
    Some((cost_before.ln() + part * (cost.ln() - cost_before.ln())).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cost_of_an_error_is_between_those_of_two_runs() {
        let curve = vec![(100.0, 0.0), (200.0, -4.0), (400.0, -8.0)];
        let cost = |log10| cost_of(&curve, Size::power_of_ten(log10));
        assert!((cost(-6.0).unwrap() - 200.0 * 2_f64.sqrt()).abs() < 1e-9);
        assert!((cost(-8.0).unwrap() - 400.0).abs() < 1e-9);
        assert_eq!((cost(-9.0), cost(1.0)), (None, Some(100.0)));
    }

    #[test]
    fn an_error_that_is_met_by_accident_does_not_count() {
        let curve = vec![(1.0, 0.0), (2.0, -9.0), (4.0, -2.0), (8.0, -4.0)];
        assert!(cost_of(&curve, Size::power_of_ten(-3.0)).unwrap() > 4.0);
    }
}
