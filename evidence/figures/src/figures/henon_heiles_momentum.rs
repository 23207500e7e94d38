//! The Hénon–Heiles problem: the drift against the initial momentum.

use super::henon_heiles::run;
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::results::Results;
use shadowstep_studies::chart::{Axis, Chart, Curve, Mark};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::{Coverage, Verdict};

pub(super) const FIGURE: Figure = Figure {
    name: "henon-heiles-momentum",
    title: "Hénon–Heiles: drift against the initial momentum",
    of_paper: "figure 6, right",
    draw,
};

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The drift as p₁(0) is varied, q₁ = q₂ = p₂ = 0, for h = 0.25, 0.1, 0.05: there is no abrupt change in energy \
         preservation when moving from the regular motions (H < 1/12, p₁ < 1/√6 ≈ 0.4) to the chaotic regime.",
    ]);
    let all: Vec<u32> = (1..=28).map(|n| 2 * n).collect();
    let hundredths = results.grid(&all, &[2, 12, 30, 42, 56]);
    let mut curves = Vec::new();
    for (i, n) in [4, 10, 20].into_iter().enumerate() {
        let of = |p: u32| run("stormer-verlet", n).with("px", format!("{p}/100"));
        let points: Vec<_> =
            hundredths.iter().map(|&p| (f64::from(p) / 100.0, results.log10_drift(&of(p), &BEST))).collect();
        check_change(&mut finding, n, &points);
        curves.push(Curve::line(format!("h = 1/{n}"), points, i));
    }
    let chaotic = run("stormer-verlet", 10).with("px", "1/2");
    digits_held(&mut finding, "the drift at h = 1/10, p₁ = 0.5", results.digits_held(&chaotic, &BEST, 200));
    let chart = finding.chart(
        Chart::new(
            "Störmer–Verlet, Hénon–Heiles, q₁ = q₂ = p₂ = 0",
            Axis::linear("p₁(0)").over(0.0, 0.6),
            drift_axis(),
            curves,
        ),
        "Marks: H = 1/12, beyond which there are chaotic motions, and H = 1/6, beyond which the body can escape.",
    );
    let marks = [(CHAOS, "p₁ = 1/√6 = 0.408"), (ESCAPE, "escape")];
    chart.marks = marks.map(|(x, label)| Mark::at(x, label)).to_vec();
    finding
}

/// H = p₁²/2 is 1/12, and 1/6.
const CHAOS: f64 = 0.408_248_290_463_863;
const ESCAPE: f64 = 0.577_350_269_189_626;

/// The change of the drift about H = 1/12 must not be steeper than those below it: the largest of them, and, as slopes
/// scatter, up to twice the largest is not decided.
fn check_change(finding: &mut Finding, n: u32, points: &[(f64, f64)]) {
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
    finding.check(
        format!("h = 1/{n}: no abrupt change about p₁ = 0.408."),
        format!(
            "the steepest of {} changes there is {across:.0} decades per unit of p₁, of {} below it {below:.0}",
            about.len(),
            before.len()
        ),
        verdict,
    );
}
