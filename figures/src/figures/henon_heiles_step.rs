//! The Hénon–Heiles system: the drift against the step, and against the initial momentum.

use super::calculation::{By, Setting};
use super::charts::{line, linear, log10_axis, thick};
use super::drawn::{DECAY_HEADER, Drawn, SAME_RATE, decay, decay_row, power, ratios};
use super::fit::ExponentialDecay;
use super::kepler::{BEST, SCHEMES};
use super::results::Results;

/// 1/h
const STEPS: [u32; 15] = [2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28];

fn run(scheme: &'static str, n: u32) -> Setting {
    Setting::of("henon-heiles", scheme, format!("1/{n}"))
}

/// (1/h, log₁₀ drift) and (h, log₁₀ drift)
fn drifts(results: &Results, scheme: &'static str, steps: &[u32], by: By) -> [Vec<(f64, f64)>; 2] {
    let drift = |n: u32| results.log10_drift(&run(scheme, n), by);
    let of = |x: &dyn Fn(f64) -> f64| steps.iter().map(|&n| (x(f64::from(n)), drift(n))).collect();
    [of(&|n| n), of(&|n| 1.0 / n)]
}

pub(crate) fn step(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The drift against the step with p₁(0) = 0.1. The expected exponential smallness is indeed present, and there is no problem \
         in using the algorithm other than allowing for large values of m (capped at 200). The effect of round-off error becomes \
         visible when 1/h exceeds 20.",
        "The fourth-order methods of Yoshida and of Blanes and Moan show the same as for Kepler's problem: Störmer–Verlet preserves the \
         energy slightly better, and the value of c is the same.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 12, 25]);
    let of = SCHEMES.map(|(scheme, label)| (label, drifts(results, scheme, steps, BEST)));
    let curves = of.iter().enumerate().map(|(i, (label, [points, _]))| line(*label, points.clone(), i));
    drawn.chart(
        "Hénon–Heiles, p₁(0) = 0.1, the best m up to 200",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves.collect(),
        "At 120 digits.",
    );
    let [(_, [verlet, _]), others @ ..] = &of;
    for (label, [points, _]) in others {
        let [least, mean, most] = ratios(points, verlet);
        drawn.check(
            &format!("Störmer–Verlet preserves it slightly better than {label}."),
            format!("{label}'s drift is {mean:.2} times as large (geometric mean; {least:.2} to {most:.2})"),
            mean > 1.0,
        );
    }
    let fits = of.map(|(label, [points, by_step])| (label, points, decay(&by_step, 0.25)));
    rates(&mut drawn, &fits);
    drawn.digits_held("the drift at h = 1/10", results.digits_held(&run("stormer-verlet", 10), BEST, 200));
    drawn
}

/// A scheme's label, its drifts against 1/h, and their rate.
type Fitted = (&'static str, Vec<(f64, f64)>, Option<ExponentialDecay>);

/// Whether the rates are the same, and where the first scheme leaves its line for the round-off.
fn rates(drawn: &mut Drawn, fits: &[Fitted]) {
    if let [(_, points, Some(first)), others @ ..] = fits {
        drawn.check(
            "The drift is exponentially small.",
            format!("c = {:.2}, a line to within {:.2} decades", first.c, first.spread),
            first.spread < 1.5,
        );
        let off =
            others.iter().filter_map(|(_, _, fit)| Some((fit.as_ref()?.c / first.c - 1.0).abs())).fold(0.0, f64::max);
        drawn.check(
            "The value of c is the same.",
            format!("to within {:.1} %; within 10 % is called the same", 100.0 * off),
            off < SAME_RATE,
        );
        let (n, y) = points.last().expect("there are steps");
        let line = first.a - first.c * std::f64::consts::LOG10_E * n;
        drawn.check(
            "The effect of round-off error becomes visible when 1/h exceeds 20.",
            format!("at h = 1/{n} the drift is {}, where the line goes on to {}", power(*y), power(line)),
            *y > line + 1.0,
        );
    }
    let rows = fits.iter().map(|(label, _, fit)| decay_row(label, fit.as_ref())).collect();
    drawn.table("Rates", &DECAY_HEADER, rows);
}

pub(crate) fn momentum(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The drift as p₁(0) is varied, q₁ = q₂ = p₂ = 0, for h = 0.25, 0.1, 0.05: there is no abrupt change in energy preservation when \
         moving from the regular motions (H < 1/12, p₁ < 1/√6 ≈ 0.4) to the chaotic regime.",
    ]);
    let all: Vec<u32> = (1..=28).map(|n| 2 * n).collect();
    let hundredths = results.grid(&all, &[2, 12, 30, 42, 56]);
    let mut curves = Vec::new();
    for (i, n) in [4, 10, 20].into_iter().enumerate() {
        let of = |p: u32| run("stormer-verlet", n).with("px", format!("{p}/100"));
        let points: Vec<_> =
            hundredths.iter().map(|&p| (f64::from(p) / 100.0, results.log10_drift(&of(p), BEST))).collect();
        let steepest = |of: &dyn Fn(f64, f64) -> bool| {
            let within = points.windows(2).filter(|pair| of(pair[0].0, pair[1].0));
            within.map(|pair| (pair[1].1 - pair[0].1).abs() / (pair[1].0 - pair[0].0)).fold(0.0, f64::max)
        };
        let across = steepest(&|from, to| to > 0.36 && from < 0.46);
        let before = steepest(&|_, to| to <= 0.36);
        drawn.check(
            &format!("h = 1/{n}: no abrupt change about p₁ = 0.408."),
            format!("the steepest change there is {across:.0} decades per unit of p₁, below it up to {before:.0}"),
            across > 0.0 && across <= before,
        );
        curves.push(line(format!("h = 1/{n}"), points, i));
    }
    let chaotic = run("stormer-verlet", 10).with("px", "1/2");
    drawn.digits_held("the drift at h = 1/10, p₁ = 0.5", results.digits_held(&chaotic, BEST, 200));
    drawn.chart(
        "Störmer–Verlet, Hénon–Heiles, q₁ = q₂ = p₂ = 0",
        linear("p₁(0)"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "Chaos begins at p₁ = 1/√6 ≈ 0.408 (H = 1/12), escape at 1/√3 ≈ 0.577 (H = 1/6).",
    );
    drawn
}

/// Again with the bilinear estimator.
pub(crate) fn bilinear(results: &Results) -> Drawn {
    let mut drawn = Drawn::ours(
        "Hénon–Heiles again, p₁(0) = 0.1, by the bilinear estimator E_k of k + 1 states beside central differences with the best m \
         up to 200 (401 states).",
    );
    let steps = results.grid(&STEPS, &[2, 4, 6, 12, 25]);
    let [best, _] = drifts(results, "stormer-verlet", steps, BEST);
    let mut curves = vec![thick("best m ≤ 200", best, 0)];
    for (i, &k) in results.grid(&[8, 16, 40, 100], &[8, 16, 40]).iter().enumerate() {
        let [points, _] = drifts(results, "stormer-verlet", steps, By::Bilinear { k });
        if let Some((_, y)) = points.iter().find(|(n, _)| *n == 6.0) {
            drawn.found(format!("At h = 1/6 the drift by E_{k} is {}.", power(*y)));
        }
        curves.push(line(format!("E_{k}"), points, i + 1));
    }
    drawn.chart(
        "Störmer–Verlet, Hénon–Heiles, p₁(0) = 0.1",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "The exact flow is not known here: there is no control.",
    );
    drawn
}
