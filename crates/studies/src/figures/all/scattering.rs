//! Scattering at a hill that vanishes far away: there H is the modified energy, and its change is observed without an
//! estimator.

use crate::figures::prelude::*;

/// Starts within one step.
const PHASES: u32 = 12;

/// 1/h
const STEPS: [u32; 13] = [2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20];

/// The start is moved by `phase`/12 of the distance per step at speed 2.
fn run(n: u32, phase: u32) -> Run {
    Run::of(Problem::Scattering, "stormer-verlet", format!("1/{n}"))
        .with("start", format!("17 + {}/{}", 2 * phase, n * PHASES))
        .until("18")
}

/// H after the encounter less H before it.
fn change(d: &Drawing<'_>, n: u32, phase: u32) -> Option<Wide> {
    d.results.transit(&run(n, phase % PHASES))
}

/// log₁₀ of its size for each start.
fn sizes(d: &Drawing<'_>, n: u32) -> Vec<f64> {
    (0..PHASES).map(|phase| change(d, n, phase).map_or(f64::NAN, |change| change.log10_abs())).collect()
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    let steps = d.results.grid(&STEPS, &[2, 4, 6, 8, 12, 16]);
    let against = |y: &dyn Fn(u32) -> f64| -> Points { steps.iter().map(|&n| (f64::from(n), y(n))).collect() };
    let changes = against(&|n| range(sizes(d, n)).1);
    let [best, bilinear] = [BEST, bilinear(40)].map(|by| against(&|n| d.results.log10_drift(&run(n, 0), &by)));
    let every = steps.iter().flat_map(|&n| sizes(d, n).into_iter().map(move |size| (f64::from(n), size)));
    let curves = vec![
        Curve::thick("drift by the best m", best.clone(), 0),
        Curve::line("drift by E_40", bilinear, 2),
        Curve::line("largest change of H", changes.clone(), 1),
        Curve::dots("change of H, each start", every.collect(), 1, Marker::Dot),
    ];
    d.chart("changes", curves);
    against_the_phase(d);
    rates(d, &changes, &best);
    let (smallest, largest) = range(sizes(d, 8));
    let found = format!(
        "at h = 1/8 the change is up to {}; among 12 starts the smallest is {}: a start for which it vanishes would \
         look like zero error",
        power(largest),
        power(smallest)
    );
    d.check("The experiment has zero error.", found, largest < -100.0);
    let held = [run(8, 1), run(8, 1).digits(200)].map(|run| d.results.transit(&run));
    if let [Some(few), Some(many)] = held {
        d.held("the change of H at h = 1/8 from the second start", Some(-(&many - &few).log10_abs()));
    }
}

fn against_the_phase(d: &mut Drawing<'_>) {
    let curve = |(i, &n): (usize, &u32)| {
        let most = range(sizes(d, n)).1;
        let relative = |phase: u32| {
            let change = change(d, n, phase)?;
            let sign = if change.is_below_zero() { -1.0 } else { 1.0 };
            Some(sign * 10_f64.powf(change.log10_abs() - most))
        };
        let shift = |phase: u32| f64::from(phase) / f64::from(PHASES);
        let points = (0..=PHASES).map(|phase| (shift(phase), relative(phase).unwrap_or(f64::NAN)));
        Curve::line(format!("h = 1/{n}"), points.collect(), i)
    };
    let curves = d.results.grid(&[4, 6, 8, 12], &[4, 8]).iter().enumerate().map(curve).collect();
    d.chart("phases", curves);
}

fn rates(d: &mut Drawing<'_>, changes: &[(f64, f64)], best: &[(f64, f64)]) {
    let [change, best] = [changes, best].map(|points| decay(&by_step(points), 0.25));
    if let (Some(change), Some(best)) = (&change, &best) {
        d.check(
            "|H(y₀) − H(y_T)| is of the order exp(−C/h).",
            format!("for the largest change over the starts, {}", change.described()),
            change.is_exponential(),
        );
        d.found(format!(
            "C is {:.3} times the c of the drift by the best m, whose fit gives {:.3}.",
            change.c / best.c,
            best.rate()
        ));
    }
    d.rates("Rates", [("largest change of H".to_owned(), change), ("drift by the best m".to_owned(), best)], None);
}
