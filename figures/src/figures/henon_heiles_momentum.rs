//! The Hénon–Heiles problem: the drift against the initial momentum.

use super::henon_heiles::run;
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::results::Results;

pub(super) const FIGURE: Figure =
    Figure { name: "henon-heiles-momentum", title: "Hénon–Heiles: drift against the initial momentum", draw };

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The drift as p₁(0) is varied, q₁ = q₂ = p₂ = 0, for h = 0.25, 0.1, 0.05: there is no abrupt change in energy preservation when \
         moving from the regular motions (H < 1/12, p₁ < 1/√6 ≈ 0.4) to the chaotic regime.",
    ]);
    let all: Vec<u32> = (1..=28).map(|n| 2 * n).collect();
    let hundredths = results.grid(&all, &[2, 12, 30, 42, 56]);
    let mut curves = Vec::new();
    for (i, n) in [4, 10, 20].into_iter().enumerate() {
        let of = |p: u32| run("stormer-verlet", n).with("px", format!("{p}/100"));
        let points: Vec<_> =
            hundredths.iter().map(|&p| (f64::from(p) / 100.0, results.log10_drift(&of(p), &BEST))).collect();
        let steepest = |of: &dyn Fn(f64, f64) -> bool| {
            let within = points.windows(2).filter(|pair| of(pair[0].0, pair[1].0));
            within.map(|pair| (pair[1].1 - pair[0].1).abs() / (pair[1].0 - pair[0].0)).fold(0.0, f64::max)
        };
        let across = steepest(&|from, to| to > 0.36 && from < 0.46);
        let before = steepest(&|_, to| to <= 0.36);
        drawing.check(
            &format!("h = 1/{n}: no abrupt change about p₁ = 0.408."),
            format!("the steepest change there is {across:.0} decades per unit of p₁, below it up to {before:.0}"),
            across > 0.0 && across <= before,
        );
        curves.push(Curve::line(format!("h = 1/{n}"), points, i));
    }
    let chaotic = run("stormer-verlet", 10).with("px", "1/2");
    drawing.digits_held("the drift at h = 1/10, p₁ = 0.5", results.digits_held(&chaotic, &BEST, 200));
    drawing.chart(
        "Störmer–Verlet, Hénon–Heiles, q₁ = q₂ = p₂ = 0",
        Axis::linear("p₁(0)"),
        Axis::drift(),
        curves,
        "Chaos begins at p₁ = 1/√6 ≈ 0.408 (H = 1/12), escape at 1/√3 ≈ 0.577 (H = 1/6).",
    );
    drawing
}
