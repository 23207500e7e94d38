//! Lines of many points: what a picture can show of them.

use crate::picture::elements::Point;

/// The path with at most four points within each column of a pixel: where the line enters it, its lowest, its
/// highest and where it leaves it, in their order. Columns with fewer points stay as they are, so the drawn line is the
/// same to within a column.
pub(super) fn thinned(path: &[Point]) -> Vec<Point> {
    let same_column = |a: &Point, b: &Point| a.0.floor() == b.0.floor();
    let mut thin = Vec::with_capacity(path.len().min(4096));
    for run in path.chunk_by(same_column) {
        let last = run.len() - 1;
        let by_height = |a: &usize, b: &usize| run[*a].1.total_cmp(&run[*b].1);
        let (low, high) = ((0..=last).min_by(by_height).unwrap_or(0), (0..=last).max_by(by_height).unwrap_or(0));
        let mut kept = if run.len() > 4 { vec![0, low, high, last] } else { (0..=last).collect() };
        kept.sort_unstable();
        kept.dedup();
        thin.extend(kept.into_iter().map(|n| run[n]));
    }
    thin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_stay() {
        let path = [(0.0, 5.0), (0.3, 1.0), (0.9, 9.0), (1.5, 2.0), (1.4, 3.0)];
        assert_eq!(thinned(&path), path);
        assert!(thinned(&[]).is_empty());
    }

    #[test]
    fn peaks_stay_and_points_between_them_go() {
        let path: Vec<_> = (0..100_000)
            .map(|n| (f64::from(n / 1000) / 10.0, if n == 54_321 { 900.0 } else { f64::from(n % 7) }))
            .collect();
        let thin = thinned(&path);
        assert!(thin.len() <= 40, "{}", thin.len());
        assert!(thin.contains(&(5.4, 900.0)) && thin.is_sorted_by_key(|point| point.0));
        assert_eq!((thin.first(), thin.last()), (path.first(), path.last()));
    }

    /// Back in a column that it has left, a line is drawn again.
    #[test]
    fn closed_lines_keep_both_halves() {
        let circle: Vec<_> = (0..360).map(f64::from).map(|a| a.to_radians().sin_cos()).collect();
        let path: Vec<_> = circle.iter().map(|(y, x)| (5.0 * x, 5.0 * y)).collect();
        let thin = thinned(&path);
        let half = |upper: bool| thin.iter().filter(|point| (point.1 > 0.0) == upper).count();
        assert!(half(true) >= 10 && half(false) >= 10);
    }
}
