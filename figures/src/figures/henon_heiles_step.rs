//! The Hénon–Heiles problem: the drift against the step size.

use super::henon_heiles::{STEPS, drifts, run};
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, ExponentialDecay, SAME_RATE, decay, decay_row, ratios};
use crate::numbers::power;
use crate::results::Results;
use crate::run::SCHEMES;

pub(super) const FIGURE: Figure =
    Figure { name: "henon-heiles-step", title: "Hénon–Heiles: drift against the step size", draw };

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The drift against the step size with p₁(0) = 0.1. The expected exponential smallness is indeed present, and there is no problem \
         in using the algorithm other than allowing for large values of m (capped at 200). The effect of round-off error becomes \
         visible when 1/h exceeds 20.",
        "The fourth-order methods of Yoshida and of Blanes and Moan show the same as for Kepler's problem: Störmer–Verlet preserves the \
         energy slightly better, and the value of c is the same.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 12, 25]);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, steps, &BEST)));
    let curves = of.iter().enumerate().map(|(i, (label, [points, _]))| Curve::line(*label, points.clone(), i));
    drawing.chart(
        "Hénon–Heiles, p₁(0) = 0.1, the best m up to 200",
        Axis::linear("1/h"),
        Axis::drift(),
        curves.collect(),
        "At 120 digits.",
    );
    let [(_, [verlet, _]), others @ ..] = &of;
    for (label, [points, _]) in others {
        let [least, mean, most] = ratios(points, verlet);
        drawing.check(
            &format!("Störmer–Verlet preserves it slightly better than {label}."),
            format!("{label}'s drift is {mean:.2} times as large (geometric mean; {least:.2} to {most:.2})"),
            mean > 1.0,
        );
    }
    let fits = of.map(|(label, [points, by_step])| (label, points, decay(&by_step, 0.25)));
    rates(&mut drawing, &fits);
    drawing.digits_held("the drift at h = 1/10", results.digits_held(&run("stormer-verlet", 10), &BEST, 200));
    drawing
}

/// A scheme's label, its drifts against 1/h, and their rate.
type Fitted = (&'static str, Vec<(f64, f64)>, Option<ExponentialDecay>);

/// Checks whether the rates are the same, and whether the first scheme leaves its line where round-off begins.
fn rates(drawing: &mut Drawing, fits: &[Fitted]) {
    if let [(_, points, Some(first)), others @ ..] = fits {
        drawing.check(
            "The drift is exponentially small.",
            format!("c = {:.2}, a line to within {:.2} decades", first.c, first.deviation),
            first.deviation < 1.5,
        );
        let off =
            others.iter().filter_map(|(_, _, fit)| Some((fit.as_ref()?.c / first.c - 1.0).abs())).fold(0.0, f64::max);
        drawing.check(
            "The value of c is the same.",
            format!("to within {:.1} %; within 10 % counts as the same", 100.0 * off),
            off < SAME_RATE,
        );
        let (n, y) = points.last().expect("there are steps");
        let line = first.a - first.c * std::f64::consts::LOG10_E * n;
        drawing.check(
            "The effect of round-off error becomes visible when 1/h exceeds 20.",
            format!("at h = 1/{n} the drift is {}, where the fitted line gives {}", power(*y), power(line)),
            *y > line + 1.0,
        );
    }
    let rows = fits.iter().map(|(label, _, fit)| decay_row(label, fit.as_ref())).collect();
    drawing.table("Rates", &DECAY_HEADER, rows);
}
