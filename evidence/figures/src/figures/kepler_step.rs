//! Kepler's problem: the drift against the step size.

use std::f64::consts::PI;

use shadowstep::Real;

use super::kepler::{FEW_STEPS, STEPS, apocentre, drifts, rate, run, singularity};
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::{BEST, central};
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, against_aliasing, decay_row, theory_row};
use crate::numbers::{Wide, number, power};
use crate::results::Results;
use crate::run::EXACT_FLOW;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-step", title: "Kepler: drift against the step size", of_paper: "figure 3, left", draw };

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The drift against the step size, e = 0.6: the theoretical exp(−c/h) behaviour.",
        "In contrast with the pendulum, the T_{m,m} do not converge as m → ∞: the m of 2 … 200 with the smallest \
            |T_{m,m} − T_{m−1,m−1}| is taken.",
    ]);
    let steps = results.grid(&STEPS, &FEW_STEPS);
    let best = drifts(results, "stormer-verlet", steps, &BEST);
    let fixed = [5, 20, 60, 200].map(|m| (m, drifts(results, "stormer-verlet", steps, &central(m))));
    let mut curves = vec![Curve::thick("best m ≤ 200", best.clone(), 0)];
    curves.extend(
        fixed.iter().enumerate().map(|(i, (m, points))| Curve::line(format!("m = {m}"), points.clone(), i + 1)),
    );
    finding.chart(
        Chart::new("Störmer–Verlet, Kepler, e = 0.6", Axis::linear("1/h"), drift_axis(), curves),
        "The same m at every state, and the best m of each state.",
    );
    let fit = rate(&best);
    if let Some(fit) = &fit {
        finding.check(
            "The drift follows exp(−c/h).",
            format!("over h ≤ 1/10, {}", fit.described()),
            fit.is_exponential(),
        );
    }
    let by_step: Vec<_> = best.iter().filter(|(n, _)| *n >= 10.0).map(|(n, y)| (1.0 / n, *y)).collect();
    if let Some(found) = against_aliasing(&by_step, PI * singularity(0.6)) {
        finding.found(found);
    }
    errors_against_m(results, &mut finding);
    finding.table(
        "The rate",
        &DECAY_HEADER,
        vec![
            decay_row("best m ≤ 200", fit.as_ref()),
            theory_row("π ρ, from aliasing of differences of samples", format!("{:.4}", PI * singularity(0.6))),
        ],
    );
    digits_held(
        &mut finding,
        "the drift at h = 1/20 by the best m",
        results.digits_held(&run("stormer-verlet", 20), &BEST, 200),
    );
    digits_held(
        &mut finding,
        "the drift at h = 1/20 by m = 20",
        results.digits_held(&run("stormer-verlet", 20), &central(20), 200),
    );
    finding
}

/// The errors of T_{m,m} at a pericentre and at an apocentre of the exact flow, whose energy is known.
fn errors_against_m(results: &Results, finding: &mut Finding) {
    let orders =
        results.grid(&[2, 5, 10, 15, 20, 25, 30, 35, 40, 50, 60, 80, 100, 130, 160, 200], &[5, 20, 35, 50, 200]);
    let off = |m: u32| {
        let energies = results.energies(&run(EXACT_FLOW, 20).until("4"), &central(m))?;
        let at = |n: usize| (&number(&energies.values[n]) + &Wide::from(0.5)).log10_abs();
        Some((f64::from(m), at(0), at(apocentre(&energies))))
    };
    let found: Vec<_> = orders.iter().filter_map(|&m| off(m)).collect();
    let apocentre: Vec<(f64, f64)> = found.iter().map(|(m, _, y)| (*m, *y)).collect();
    let pericentre = found.iter().map(|(m, y, _)| (*m, *y)).collect();
    let least = apocentre.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    if let (Some((m, least)), Some((last, at_last))) = (least, apocentre.last()) {
        finding.check(
            "T_{m,m} do not converge as m → ∞.",
            format!(
                "at an apocentre of the exact flow the error falls to {} at m = {m} and is {} at m = {last}",
                power(least),
                power(*at_last)
            ),
            results.coverage().any(*at_last > least + 3.0),
        );
    }
    finding.chart(
        Chart::new(
            "Exact flow, Kepler, e = 0.6, h = 1/20",
            Axis::linear("m"),
            Axis::log10("|T_{m,m} + 1/2|"),
            vec![Curve::line("at a pericentre", pericentre, 0), Curve::line("at an apocentre", apocentre, 1)],
        ),
        "With m > 60 the states around an apocentre reach into the close encounters.",
    );
}
