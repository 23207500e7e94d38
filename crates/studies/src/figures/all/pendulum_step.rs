//! The pendulum: the drift against the step size.

use std::f64::consts::PI;

use shadowstep::shadow::HIGHEST_ORDER;

use super::pendulum::singularity;
use crate::figures::prelude::*;

/// The largest m of the limit: a step takes too long with a larger one.
fn largest(quick: bool) -> u32 {
    if quick { 400 } else { HIGHEST_ORDER }
}

/// 3 ρ²/h², but at least 200: from about m = ρ²/h² on T_{m,m} has converged, as the remainder is about exp(ρ²/(h² m))
/// by lemma 3 of the paper.
fn of_limit(n: f64) -> u32 {
    ((3.0 * (singularity(1.0) * n).powi(2)) as u32).max(200)
}

/// (1/h, log₁₀ drift) where such an m is not too large.
fn limit(d: &Drawing<'_>) -> Points {
    let point = |x: &String| {
        let n = x.parse().expect("steps are whole numbers");
        let m = Some(of_limit(n)).filter(|m| *m <= largest(d.results.quick))?;
        Some((n, d.results.log10_drift(&d.run("fixed", "", x), &central(m))))
    };
    d.xs("fixed").iter().filter_map(point).collect()
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    let limit = limit(d);
    let fixed = d.family("fixed");
    let steps = fixed[0].points.len();
    let mut curves = lines(&fixed, 1);
    curves.push(Curve::thick("limit", limit.clone(), 0));
    let [unknown, steps] = [steps - limit.len(), steps].map(|count| count.to_string());
    let largest = largest(d.results.quick).to_string();
    d.chart_of("drifts", &[("unknown", &unknown), ("steps", &steps), ("largest", &largest)], curves);
    check_convergence(d);
    check_orders(d, &fixed);
    check_limit(d, &by_step(&limit));
}

/// The drifts by each m, which must not grow with m.
fn check_orders(d: &mut Drawing<'_>, fixed: &[Series]) {
    let falls = fixed.windows(2).all(|pair| {
        let mut both = pair[0].points.iter().zip(&pair[1].points);
        both.all(|((_, lower), (_, higher))| *higher < lower + 0.05 || *higher < ROUND_OFF)
    });
    let found = format!("{} of {} step sizes", if falls { "at all" } else { "not at all" }, fixed[0].points.len());
    d.check("A larger m does not give a larger drift.", found, d.coverage().every(falls));
}

/// The limit must decay exponentially; its rate, beside that of the theory.
fn check_limit(d: &mut Drawing<'_>, limit: &[(f64, f64)]) {
    let (fit, theory) = (decay(limit, 0.5), PI * singularity(1.0));
    if let Some(fit) = &fit {
        d.check("The limit follows exp(−c/h).", fit.described(), fit.is_exponential());
    }
    if let Some(found) = against_aliasing(limit, theory) {
        d.found(found);
    }
    let aliasing = ("π ρ, from aliasing of differences of samples", format!("{theory:.4}"));
    d.rates("The rate of the limit", [("limit".to_owned(), fit)], Some(aliasing));
}

/// The limit must be reached.
fn check_convergence(d: &mut Drawing<'_>) {
    for n in d.cs("convergence") {
        let orders = d.xs("convergence");
        let many: Vec<f64> = d.series("convergence", &n).points.iter().map(|(_, y)| *y).collect();
        let changes: Vec<f64> = many.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
        let last = changes[changes.len() - 1];
        let verdict = match () {
            () if last < 0.05 => Verdict::Agrees,
            () if changes.is_sorted() => Verdict::Differs,
            () => Verdict::NotDecided("The changes neither end by m = 640 nor grow; a larger m would decide."),
        };
        let drifts: Vec<_> = many.into_iter().map(power).collect();
        d.check(
            format!("h = 1/{n}: T_{{m,m}} converge as m → ∞."),
            format!("{} by m = {}; the last change is by {last:.3} decades", drifts.join(", "), orders.join(", ")),
            verdict,
        );
    }
}
