//! Lines of many points: what a picture can show of them.

/// The path with at most four points within each column of this width: where the line enters it, its lowest, its
/// highest and where it leaves it, in their order. Columns with fewer points stay as they are, so the drawn line is the
/// same to within a column.
pub(super) fn thinned(path: &[(i32, i32)], column: i32) -> Vec<(i32, i32)> {
    let same_column = |a: &(i32, i32), b: &(i32, i32)| a.0.div_euclid(column) == b.0.div_euclid(column);
    let mut thin = Vec::with_capacity(path.len().min(4096));
    for run in path.chunk_by(same_column) {
        let last = run.len() - 1;
        let by_height = |n: &usize| run[*n].1;
        let (low, high) =
            ((0..=last).min_by_key(by_height).unwrap_or(0), (0..=last).max_by_key(by_height).unwrap_or(0));
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
        let path = [(0, 5), (3, 1), (9, 9), (15, 2), (14, 3)];
        assert_eq!(thinned(&path, 10), path);
        assert!(thinned(&[], 10).is_empty());
    }

    #[test]
    fn peaks_stay_and_points_between_them_go() {
        let path: Vec<_> = (0..100_000).map(|n| (n / 1000, if n == 54_321 { 900 } else { n % 7 })).collect();
        let thin = thinned(&path, 10);
        assert!(thin.len() <= 40, "{}", thin.len());
        assert!(thin.contains(&(54, 900)) && thin.is_sorted_by_key(|point| point.0));
        assert_eq!((thin.first(), thin.last()), (path.first(), path.last()));
    }

    /// Back in a column that it has left, a line is drawn again.
    #[test]
    fn closed_lines_keep_both_halves() {
        let circle: Vec<_> = (0..360).map(f64::from).map(|a| a.to_radians().sin_cos()).collect();
        let path: Vec<_> = circle.iter().map(|(y, x)| ((100.0 * x) as i32, (100.0 * y) as i32)).collect();
        let thin = thinned(&path, 20);
        let half = |upper: bool| thin.iter().filter(|point| (point.1 > 0) == upper).count();
        assert!(half(true) >= 10 && half(false) >= 10);
    }
}
