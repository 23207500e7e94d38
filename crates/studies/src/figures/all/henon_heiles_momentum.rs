//! The Hénon–Heiles problem: the drift against the initial momentum.

use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let drifts = d.family("drifts");
    drifts.iter().for_each(|series| check_change(d, series));
    d.chart("drifts", lines(&drifts, 0));
}

/// The change of the drift about H = 1/12 must not be steeper than those below it: the largest of them, and, as slopes
/// scatter, up to twice the largest is not decided.
fn check_change(d: &mut Drawing<'_>, Series { label, points }: &Series) {
    let slopes = |of: &dyn Fn(f64, f64) -> bool| -> Vec<f64> {
        let within = points.windows(2).filter(|pair| of(pair[0].0, pair[1].0));
        within.map(|pair| (pair[1].1 - pair[0].1).abs() / (pair[1].0 - pair[0].0)).collect()
    };
    let steepest = |slopes: &[f64]| slopes.iter().copied().fold(0.0, f64::max);
    let (about, before) = (slopes(&|from, to| to > 0.36 && from < 0.46), slopes(&|_, to| to <= 0.36));
    let (across, below) = (steepest(&about), steepest(&before));
    let verdict = match () {
        () if about.len() < 3 || before.len() < 3 => Coverage::Some.only_all(true),
        () if across <= below => Verdict::Agrees,
        () if across > 2.0 * below => Verdict::Differs,
        () => Verdict::NotDecided(
            "It is steeper than all changes below, which scatter, but by less than twice; closer p₁ would decide.",
        ),
    };
    d.check(
        format!("{label}: no abrupt change about p₁ = 0.408."),
        format!(
            "the steepest of {} changes there is {across:.0} decades per unit of p₁, of {} below it {below:.0}",
            about.len(),
            before.len()
        ),
        verdict,
    );
}
