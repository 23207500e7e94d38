//! Kepler's problem: the drift of several schemes, and of the exact flow.

use super::kepler::{STEPS, drifts, rate, run};
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, SAME_RATE, decay_row, ratios};
use crate::results::Results;
use crate::run::{EXACT_FLOW, SCHEMES};

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-schemes", title: "Kepler: three schemes, and the exact flow", draw };

/// The label of a scheme, and its drifts against 1/h.
type Labelled = (&'static str, Vec<(f64, f64)>);

/// The points with h ≤ 1/10.
fn fine(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    points.iter().copied().filter(|(n, _)| *n >= 10.0).collect()
}

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The plots for the drift of Yoshida's method and of the Blanes–Moan method look the same as for Störmer–Verlet; in particular \
         the constant c in exp(−c/h) is the same.",
        "The drift of Störmer–Verlet is about a factor of three smaller than that of Yoshida's method and a factor of four smaller than that of \
         Blanes and Moan.",
    ]);
    let steps = results.grid(&STEPS, &[4, 6, 10, 14, 20, 30]);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, steps, &BEST)));
    let control = drifts(results, EXACT_FLOW, steps, &BEST);
    let mut curves: Vec<_> =
        of.iter().enumerate().map(|(i, (label, points))| Curve::line(*label, points.clone(), i)).collect();
    curves.push(Curve::dashed("exact flow", control.clone(), 8));
    drawing.chart(
        "Kepler, e = 0.6, the best m up to 200",
        Axis::linear("1/h"),
        Axis::drift(),
        curves,
        "Dashed: the same estimator on the exact flow, whose energy is −1/2 at every state.",
    );
    compare_drifts(&mut drawing, &of);
    compare_rates(&mut drawing, &of, &control);
    for (scheme, label) in SCHEMES.into_iter().skip(1) {
        drawing.digits_held(
            &format!("the drift of {label} at h = 1/20"),
            results.digits_held(&run(scheme, 20), &BEST, 200),
        );
    }
    let [least, mean, most] = ratios(&fine(&control), &fine(&of[3].1));
    drawing.found(format!(
        "The exact flow shows {mean:.2} times the drift of Blanes and Moan's SRKN6b (geometric mean over h ≤ 1/10; {least:.3} to \
         {most:.3}), although its energy does not change at all: that drift belongs to the estimator, not to the scheme."
    ));
    drawing
}

/// The ratios of the drifts to that of the first scheme, against those that the paper states.
fn compare_drifts(drawing: &mut Drawing, of: &[Labelled]) {
    let [verlet, others @ ..] = of else { return };
    for ((label, points), stated) in others.iter().zip([3.0, 4.0, 4.0]) {
        let [least, mean, most] = ratios(&fine(points), &fine(&verlet.1));
        drawing.check(
            &format!("The drift of {label} is about {stated} times that of Störmer–Verlet."),
            format!(
                "{mean:.2} times (geometric mean over h ≤ 1/10; {least:.2} to {most:.2}); within 35 % counts as about"
            ),
            (mean / stated - 1.0).abs() < 0.35,
        );
    }
}

/// The rates of the schemes, which must be the same, and of the exact flow.
fn compare_rates(drawing: &mut Drawing, of: &[Labelled], control: &[(f64, f64)]) {
    let fits: Vec<_> = of.iter().map(|(label, points)| (*label, rate(points))).collect();
    let rates: Vec<f64> = fits.iter().filter_map(|(_, fit)| Some(fit.as_ref()?.c)).collect();
    if let [first, others @ ..] = &rates[..] {
        let off = others.iter().map(|c| (c / first - 1.0).abs()).fold(0.0, f64::max);
        drawing.check(
            "The constant c is the same.",
            format!("to within {:.2} %; within 10 % counts as the same", 100.0 * off),
            off < SAME_RATE,
        );
    }
    let mut rows: Vec<_> = fits.iter().map(|(label, fit)| decay_row(label, fit.as_ref())).collect();
    rows.push(decay_row("exact flow", rate(control).as_ref()));
    drawing.table("Rates", &DECAY_HEADER, rows);
}
