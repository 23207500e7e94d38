//! The pendulum: the drift against the initial momentum.

use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let drifts = d.family("drifts");
    for series in &drifts {
        let at = [0.1, 0.5, 1.0, 1.5, 1.9].map(|p| at(&series.points, p));
        let found = format!("{} at p(0) = 0.1, 0.5, 1, 1.5, 1.9", at.map(power).join(", "));
        d.check(format!("{}: the drift falls as p(0) → 0.", series.label), found, at.is_sorted());
    }
    d.chart("drifts", lines(&drifts, 0));
}

/// The value at x.
fn at(points: &[(f64, f64)], x: f64) -> f64 {
    points.iter().find(|(at, _)| *at == x).map_or(f64::NAN, |(_, y)| *y)
}
