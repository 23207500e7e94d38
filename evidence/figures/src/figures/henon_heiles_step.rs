//! The Hénon–Heiles problem: the drift against the step size.

use super::henon_heiles::{FEW_STEPS, STEPS, drifts, run};
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, ExponentialDecay, Ratio, decay, decay_row, logarithms, same_rates};
use crate::numbers::power;
use crate::results::Results;
use crate::run::SCHEMES;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

pub(super) const FIGURE: Figure = Figure {
    name: "henon-heiles-step",
    title: "Hénon–Heiles: drift against the step size",
    of_paper: "figure 6, left",
    draw,
};

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The drift against the step size with p₁(0) = 0.1. The expected exponential smallness is indeed present, and \
         there is no problem in using the algorithm other than allowing for large values of m (capped at 200). The \
         effect of round-off error becomes visible when 1/h exceeds 20.",
        "The fourth-order methods of Yoshida and of Blanes and Moan show the same as for Kepler's problem: \
         Störmer–Verlet preserves the energy slightly better, and the value of c is the same.",
    ]);
    let steps = results.grid(&STEPS, &FEW_STEPS);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, steps, &BEST)));
    let curves = of.iter().enumerate().map(|(i, (label, [points, _]))| Curve::line(*label, points.clone(), i));
    finding.chart(
        Chart::new(
            "Hénon–Heiles, p₁(0) = 0.1, the best m up to 200",
            Axis::linear("1/h"),
            drift_axis(),
            curves.collect(),
        ),
        "At 120 digits.",
    );
    compare(&mut finding, &of);
    let fits = of.map(|(label, [points, by_step])| (label, points, decay(&by_step, 0.25)));
    rates(&mut finding, &fits);
    digits_held(&mut finding, "the drift at h = 1/10", results.digits_held(&run("stormer-verlet", 10), &BEST, 200));
    finding
}

/// A scheme's label, and its drifts against 1/h and against h.
type Labelled = (&'static str, [Vec<(f64, f64)>; 2]);

/// Whether the first scheme preserves the energy better than the others, and by how much.
fn compare(finding: &mut Finding, of: &[Labelled]) {
    let [(_, [verlet, _]), others @ ..] = of else { return };
    let curve = |(i, (label, [points, _])): (usize, &Labelled)| Curve::line(*label, logarithms(points, verlet), i + 1);
    finding.chart(
        Chart::new(
            "Drifts relative to that of Störmer–Verlet",
            Axis::linear("1/h"),
            Axis::log10("drift / drift of Störmer–Verlet"),
            others.iter().enumerate().map(curve).collect(),
        ),
        "Where both drifts are above the round-off of 120 digits. Above 1, Störmer–Verlet preserves the energy better.",
    );
    for (label, [points, _]) in others {
        let Some(ratio) = Ratio::of(points, verlet) else { continue };
        finding.check(
            format!("Störmer–Verlet preserves it slightly better than {label}."),
            format!("{label}'s drift is {ratio} times as large"),
            ratio.mean.above(1.0),
        );
    }
}

/// A scheme's label, its drifts against 1/h, and their rate.
type Fitted = (&'static str, Vec<(f64, f64)>, Option<ExponentialDecay>);

/// Checks whether the rates are the same, and whether the first scheme leaves its line where round-off begins.
fn rates(finding: &mut Finding, fits: &[Fitted]) {
    if let [(_, points, Some(first)), others @ ..] = fits {
        finding.check("The drift is exponentially small.", first.described(), first.is_exponential());
        let others: Vec<_> = others.iter().filter_map(|(label, _, fit)| Some((*label, fit.as_ref()?))).collect();
        let (verdict, found) = same_rates(first, &others);
        finding.check("The value of c is the same.", found, verdict);
        round_off(finding, points, first);
    }
    let rows = fits.iter().map(|(label, _, fit)| decay_row(label, fit.as_ref())).collect();
    finding.table("Rates", &DECAY_HEADER, rows);
}

/// Where the drifts leave the fitted line: the round-off is visible at the first step from which on all are above it by
/// three standard deviations.
fn round_off(finding: &mut Finding, points: &[(f64, f64)], fit: &ExponentialDecay) {
    let line = |n: f64| fit.a - fit.c * std::f64::consts::LOG10_E * n;
    let on_it = points.iter().rposition(|(n, y)| *y <= line(*n) + 3.0 * fit.deviation);
    let Some((first, last)) = on_it.and_then(|at| Some((points.get(at + 1)?.0, points[at].0))) else { return };
    let (n, y) = points.last().expect("there are steps");
    let verdict = match () {
        () if first <= 20.0 => Verdict::Differs,
        () if last >= 20.0 => Verdict::Agrees,
        () => Verdict::NotDecided(
            "It begins between two step sizes, of which one is on either side of 1/20; steps between them would decide.",
        ),
    };
    finding.check(
        "The effect of round-off error becomes visible when 1/h exceeds 20.",
        format!(
            "it is between 1/h = {last} and {first}; at 1/h = {n} the drift is {}, where the fitted line gives {}",
            power(*y),
            power(line(*n))
        ),
        verdict,
    );
}
