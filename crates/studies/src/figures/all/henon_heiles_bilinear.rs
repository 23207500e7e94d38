//! The Hénon–Heiles problem by the bilinear estimator.

use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let (best, all) = (d.series("best", ""), d.family("bilinear"));
    for Series { label, points } in &all {
        if let Some((_, y)) = points.iter().find(|(n, _)| *n == 6.0) {
            d.found(format!("At h = 1/6 the drift by {label} is {}.", power(*y)));
        }
    }
    let gained: Vec<_> = all.iter().map(|one| gain(&one.relative_to(&best.points))).collect();
    d.found(format!("Relative to the best m, where both are above the round-off: {}.", gained.join("; ")));
    let mut curves = vec![Curve::thick(best.label, best.points, 0)];
    curves.extend(lines(&all, 1));
    d.chart("drifts", curves);
}

/// How many decades E_k shows less than the best m, and at how many steps.
fn gain(relative: &Series) -> String {
    let Series { label, points } = relative;
    let sizes = points.iter().map(|(_, ratio)| -ratio);
    let (least, most) = range(sizes.clone());
    let less = sizes.filter(|gain| *gain > 0.0).count();
    let [least, most] = [least, most].map(|gain| decimal(gain, 1));
    format!("{label} shows less at {less} of {} steps; the gain is {least} to {most} decades", points.len())
}
