//! The Hénon–Heiles problem by the bilinear estimator.

use super::henon_heiles::{FEW_STEPS, STEPS, drifts};
use crate::drawing::{additional, drift_axis};
use crate::estimator::{BEST, bilinear};
use crate::figure::Figure;
use crate::fit::logarithms;
use crate::numbers::{decimal, power};
use crate::results::Results;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure =
    Figure { name: "henon-heiles-bilinear", title: "Hénon–Heiles by the bilinear estimator", of_paper: "", draw };

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "The Hénon–Heiles problem, p₁(0) = 0.1, by the bilinear estimator E_k of k + 1 states and by central \
         differences with the best m up to 200 (401 states).",
    );
    let steps = results.grid(&STEPS, &FEW_STEPS);
    let [best, _] = drifts(results, "stormer-verlet", steps, &BEST);
    let mut curves = vec![Curve::thick("best m ≤ 200", best.clone(), 0)];
    let mut gained = Vec::new();
    for (i, &k) in results.grid(&[8, 16, 40, 100], &[8, 16, 40]).iter().enumerate() {
        let [points, _] = drifts(results, "stormer-verlet", steps, &bilinear(k));
        if let Some((_, y)) = points.iter().find(|(n, _)| *n == 6.0) {
            finding.found(format!("At h = 1/6 the drift by E_{k} is {}.", power(*y)));
        }
        gained.push(gain(k, &logarithms(&points, &best)));
        curves.push(Curve::line(format!("E_{k}"), points, i + 1));
    }
    finding.found(format!("Relative to the best m, where both are above the round-off: {}.", gained.join("; ")));
    finding.chart(
        Chart::new("Störmer–Verlet, Hénon–Heiles, p₁(0) = 0.1", Axis::linear("1/h"), drift_axis(), curves),
        "The exact flow of this problem is not known, so the estimator's own error is not shown.",
    );
    finding
}

/// How many decades E_k shows less than the best m, and at how many steps.
fn gain(k: u32, ratios: &[(f64, f64)]) -> String {
    let sizes = ratios.iter().map(|(_, ratio)| -ratio);
    let (least, most) = (sizes.clone().fold(f64::INFINITY, f64::min), sizes.clone().fold(f64::NEG_INFINITY, f64::max));
    let less = sizes.filter(|gain| *gain > 0.0).count();
    let [least, most] = [least, most].map(|gain| decimal(gain, 1));
    format!("E_{k} shows less at {less} of {} steps; the gain is {least} to {most} decades", ratios.len())
}
