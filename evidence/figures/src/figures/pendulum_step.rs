//! The pendulum: the drift against the step size.

use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER};
use std::f64::consts::PI;

use shadowstep::problems::Problem;

use super::pendulum::{SCHEME, singularity};
use crate::drawing::{digits_held, drift_axis};
use crate::estimator::central;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, ROUND_OFF, against_aliasing, decay, decay_row, theory_row};
use crate::numbers::power;
use crate::results::Results;
use crate::run::Run;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::{Coverage, Verdict};

pub(super) const FIGURE: Figure =
    Figure { name: "pendulum-step", title: "The pendulum: drift against the step size", of_paper: "figure 1", draw };

/// The m of the paper's figure.
const ORDERS: [u32; 7] = [2, 5, 10, 15, 20, 30, 40];

/// 1/h
const STEPS: [u32; 22] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 26, 28, 30];

/// The largest m of the limit: a step takes too long with a larger one.
fn largest(quick: bool) -> u32 {
    if quick { 400 } else { HIGHEST_ORDER }
}

/// 3 ρ²/h²: from about m = ρ²/h² on T_{m,m} has converged, as the remainder is about exp(ρ²/(h² m)) by lemma 3 of the
/// paper.
fn of_limit(n: u32) -> u32 {
    (3.0 * (singularity(1.0) * f64::from(n)).powi(2)) as u32
}

/// The steps with a limit, those at which such an m is not too large, with it; at least 200.
fn limits(steps: &[u32], quick: bool) -> Vec<(u32, u32)> {
    steps.iter().map(|&n| (n, of_limit(n).max(200))).filter(|(_, m)| *m <= largest(quick)).collect()
}

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The drift, max − min of the modified energy over [0, 100], computed from T_{m,m} for m = 2, 5, 10, 15, 20, \
         30, 40. The approximations T_{m,m} converge for this problem.",
        "The limit, the thick line, follows the exp(−c/h) behaviour that the theory predicts.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 10, 14, 20]);
    let run = |n: u32| Run::of(Problem::Pendulum, SCHEME, format!("1/{n}"));
    let drifts = |by: &dyn Fn(u32) -> EstimatorSettings| -> Vec<(f64, f64)> {
        steps.iter().map(|&n| (1.0 / f64::from(n), results.log10_drift(&run(n), &by(n)))).collect()
    };
    let limits = limits(steps, results.quick);
    let limit: Vec<_> =
        limits.iter().map(|&(n, m)| (1.0 / f64::from(n), results.log10_drift(&run(n), &central(m)))).collect();
    let fixed = ORDERS.map(|m| (m, drifts(&|_| central(m))));
    let against = |points: &[(f64, f64)]| points.iter().map(|(h, y)| (1.0 / h, *y)).collect::<Vec<_>>();
    let curves = fixed.iter().enumerate();
    let mut curves: Vec<_> =
        curves.map(|(i, (m, points))| Curve::line(format!("m = {m}"), against(points), i + 1)).collect();
    curves.push(Curve::thick("limit", against(&limit), 0));
    let caption = format!(
        "The limit is taken at m = 3 ρ²/h², but at least 200. It is not known at {} of {} steps, where that is above {}.",
        steps.len() - limits.len(),
        steps.len(),
        largest(results.quick)
    );
    let title = "Störmer–Verlet, pendulum, q(0) = 0, p(0) = 1";
    finding.chart(Chart::new(title, Axis::linear("1/h"), drift_axis(), curves), caption);
    check_convergence(results, &mut finding);
    check_orders(&mut finding, &fixed, results.coverage());
    check_limit(&mut finding, &limit);
    digits_held(&mut finding, "the drift at h = 1/10 by m = 20", results.digits_held(&run(10), &central(20), 200));
    finding
}

/// The drifts by each m, which must not grow with m.
fn check_orders(finding: &mut Finding, fixed: &[(u32, Vec<(f64, f64)>)], coverage: Coverage) {
    let falls = fixed.windows(2).all(|pair| {
        pair[0].1.iter().zip(&pair[1].1).all(|((_, lower), (_, higher))| *higher < lower + 0.05 || *higher < ROUND_OFF)
    });
    let found = format!("{} of {} step sizes", if falls { "at all" } else { "not at all" }, fixed[0].1.len());
    finding.check("A larger m does not give a larger drift.", found, coverage.every(falls));
}

/// The limit must decay exponentially; its rate, beside that of the theory.
fn check_limit(finding: &mut Finding, limit: &[(f64, f64)]) {
    let fit = decay(limit, 0.5);
    if let Some(fit) = &fit {
        finding.check("The limit follows exp(−c/h).", fit.described(), fit.is_exponential());
    }
    let theory = PI * singularity(1.0);
    if let Some(found) = against_aliasing(limit, theory) {
        finding.found(found);
    }
    let rows = vec![
        decay_row("limit", fit.as_ref()),
        theory_row("π ρ, from aliasing of differences of samples", format!("{theory:.4}")),
    ];
    finding.table("The rate of the limit", &DECAY_HEADER, rows);
}

/// The limit must be reached: drifts by m far larger than those of the figure.
fn check_convergence(results: &Results, finding: &mut Finding) {
    for n in [2_u32, 4, 6] {
        let run = Run::of(Problem::Pendulum, SCHEME, format!("1/{n}"));
        let orders = [40, 80, 160, 320, 640];
        let many = orders.map(|m| results.log10_drift(&run, &central(m)));
        let changes: Vec<f64> = many.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
        let last = changes[changes.len() - 1];
        let verdict = match () {
            () if last < 0.05 => Verdict::Agrees,
            () if changes.is_sorted() => Verdict::Differs,
            () => Verdict::NotDecided("The changes neither end by m = 640 nor grow; a larger m would decide."),
        };
        finding.check(
            format!("h = 1/{n}: T_{{m,m}} converge as m → ∞."),
            format!(
                "{} by m = {}; the last change is by {last:.3} decades",
                many.map(power).join(", "),
                orders.map(|m| m.to_string()).join(", ")
            ),
            verdict,
        );
    }
}
