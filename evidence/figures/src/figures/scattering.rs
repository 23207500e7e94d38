//! Scattering at a hill that vanishes far away: there H is the modified energy, and its change is observed without an
//! estimator.

use shadowstep::Real;
use shadowstep::problems::Problem;

use crate::drawing::digits_held;
use crate::estimator::{BEST, bilinear};
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, decay, decay_row};
use crate::numbers::{Wide, power};
use crate::results::Results;
use crate::run::Run;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure = Figure {
    name: "scattering",
    title: "Scattering: the change of the energy itself",
    of_paper: "section 5, text",
    draw,
};

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
fn change(results: &Results, n: u32, phase: u32) -> Option<Wide> {
    results.transit(&run(n, phase % PHASES))
}

/// log₁₀ of its size.
fn size(results: &Results, n: u32, phase: u32) -> f64 {
    change(results, n, phase).map_or(f64::NAN, |change| change.log10_abs())
}

fn largest(results: &Results, n: u32) -> f64 {
    (0..PHASES).map(|phase| size(results, n, phase)).fold(f64::NEG_INFINITY, f64::max)
}

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "Benettin and Giorgilli's experiment: a potential that vanishes fast, a start far away. Where U vanishes the methods \
         conserve H itself, so |H(y₀) − H(y_T)| can be observed; it is of the order exp(−C/h).",
        "Repeated with the authors' method, the experiment had zero error: a matter that warrants further \
            investigation.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 8, 12, 16]);
    let against = |y: &dyn Fn(u32) -> f64| -> Vec<(f64, f64)> { steps.iter().map(|&n| (f64::from(n), y(n))).collect() };
    let changes = against(&|n| largest(results, n));
    let [best, bilinear] = [BEST, bilinear(40)].map(|by| against(&|n| results.log10_drift(&run(n, 0), &by)));
    let every = steps.iter().flat_map(|&n| (0..PHASES).map(move |phase| (f64::from(n), size(results, n, phase))));
    finding.chart(
        Chart::new(
            "Störmer–Verlet, U = exp(−|q|²), impact parameter 0.3, speed 2",
            Axis::linear("1/h"),
            Axis::log10("energy"),
            vec![
                Curve::thick("drift by the best m", best.clone(), 0),
                Curve::line("drift by E_40", bilinear, 2),
                Curve::line("largest change of H", changes.clone(), 1),
                Curve::dots("change of H, each start", every.collect(), 1, Marker::Dot),
            ],
        ),
        "The change of H from before the encounter to after it, for 12 starts within one step.",
    );
    against_the_phase(results, &mut finding);
    rates(&mut finding, &changes, &best);
    let smallest = (0..PHASES).map(|phase| size(results, 8, phase)).fold(f64::INFINITY, f64::min);
    finding.check(
        "The experiment has zero error.",
        format!(
            "at h = 1/8 the change is up to {}; among 12 starts the smallest is {}: a start for which it vanishes \
             would look like zero error",
            power(largest(results, 8)),
            power(smallest)
        ),
        largest(results, 8) < -100.0,
    );
    let held = [run(8, 1), run(8, 1).digits(200)].map(|run| results.transit(&run));
    if let [Some(few), Some(many)] = held {
        digits_held(
            &mut finding,
            "the change of H at h = 1/8 from the second start",
            Some(-(&many - &few).log10_abs()),
        );
    }
    finding
}

fn against_the_phase(results: &Results, finding: &mut Finding) {
    let curves = results.grid(&[4, 6, 8, 12], &[4, 8]).iter().enumerate().map(|(i, &n)| {
        let most = largest(results, n);
        let relative = |phase: u32| {
            let change = change(results, n, phase)?;
            let sign = if change.is_below_zero() { -1.0 } else { 1.0 };
            Some(sign * 10_f64.powf(change.log10_abs() - most))
        };
        let shift = |phase: u32| f64::from(phase) / f64::from(PHASES);
        let points = (0..=PHASES).map(|phase| (shift(phase), relative(phase).unwrap_or(f64::NAN)));
        Curve::line(format!("h = 1/{n}"), points.collect(), i)
    });
    finding.chart(
        Chart::new(
            "Change of H against the phase of the first step",
            Axis::linear("shift of the start in steps"),
            Axis::linear("change of H / largest"),
            curves.collect(),
        ),
        "A sinusoid, which vanishes for two starts within a step.",
    );
}

fn rates(finding: &mut Finding, changes: &[(f64, f64)], best: &[(f64, f64)]) {
    let fit = |points: &[(f64, f64)]| decay(&points.iter().map(|(n, y)| (1.0 / n, *y)).collect::<Vec<_>>(), 0.25);
    let (change, best) = (fit(changes), fit(best));
    if let (Some(change), Some(best)) = (&change, &best) {
        finding.check(
            "|H(y₀) − H(y_T)| is of the order exp(−C/h).",
            format!("for the largest change over the starts, {}", change.described()),
            change.is_exponential(),
        );
        finding.found(format!(
            "C is {:.3} times the c of the drift by the best m, whose fit gives {:.3}.",
            change.c / best.c,
            best.rate()
        ));
    }
    let rows = vec![decay_row("largest change of H", change.as_ref()), decay_row("drift by the best m", best.as_ref())];
    finding.table("Rates", &DECAY_HEADER, rows);
}
