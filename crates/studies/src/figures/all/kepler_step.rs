//! Kepler's problem: the drift against the step size.

use std::f64::consts::PI;

use super::kepler::{apocentre, fine, rate, singularity};
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let best = d.series("best", "");
    let mut curves = vec![Curve::thick(&best.label, best.points.clone(), 0)];
    curves.extend(lines(&d.family("fixed"), 1));
    d.chart("drifts", curves);
    let (fit, theory) = (rate(&best.points), PI * singularity(0.6));
    if let Some(fit) = &fit {
        let found = format!("over h ≤ 1/10, {}", fit.described());
        d.check("The drift follows exp(−c/h).", found, fit.is_exponential());
    }
    if let Some(found) = against_aliasing(&by_step(&fine(&best.points)), theory) {
        d.found(found);
    }
    errors_against_m(d);
    let aliasing = ("π ρ, from aliasing of differences of samples", format!("{theory:.4}"));
    d.rates("The rate", [(best.label, fit)], Some(aliasing));
}

/// The errors of T_{m,m} at a pericentre and at an apocentre of the exact flow, whose energy is known.
fn errors_against_m(d: &mut Drawing<'_>) {
    let off = |m: &String| {
        let order = m.parse::<u32>().expect("m is a number");
        let energies = d.results.energies(&d.run("of_flow", "", m).until("4"), &central(order))?;
        let at = |n: usize| (&number(&energies.values[n]) + &Wide::from(0.5)).log10_abs();
        Some((f64::from(order), at(0), at(apocentre(&energies))))
    };
    let found: Vec<_> = d.xs("of_flow").iter().filter_map(off).collect();
    let apocentre: Points = found.iter().map(|(m, _, y)| (*m, *y)).collect();
    let pericentre = found.iter().map(|(m, y, _)| (*m, *y)).collect();
    let least = apocentre.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    if let (Some((m, least)), Some((last, at_last))) = (least, apocentre.last()) {
        let found = format!(
            "at an apocentre of the exact flow the error falls to {} at m = {m} and is {} at m = {last}",
            power(least),
            power(*at_last)
        );
        d.check("T_{m,m} do not converge as m → ∞.", found, d.coverage().any(*at_last > least + 3.0));
    }
    let at_pericentre = Curve::line("at a pericentre", pericentre, 0);
    d.chart("errors", vec![at_pericentre, Curve::line("at an apocentre", apocentre, 1)]);
}
