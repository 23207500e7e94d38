//! The permanent change of the modified energy of the schemes, between low-error states.

use std::f64::consts::PI;

use super::kepler;
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let change = |scheme: &str, n: &str| d.sizes("changes", scheme, n)?.permanent;
    let series = |(scheme, label): (&str, &str)| {
        let size = |n: &String| change(scheme, n).map_or(f64::NAN, |(change, _)| change);
        let points = d.xs("changes").iter().map(|n| (n.parse().expect("a step is a number"), size(n))).collect();
        Series { label: label.to_owned(), points }
    };
    let equal_steps = SCHEMES.map(series);
    let mut equal_cost = equal_steps.clone();
    for (series, cost) in equal_cost.iter_mut().zip(FORCES) {
        series.points.iter_mut().for_each(|(n, _)| *n *= cost);
    }
    let shown = |(change, jump)| format!("{} ({})", power(change), power(jump));
    let row = |n: &String| {
        let cells = SCHEMES.map(|(scheme, _)| change(scheme, n).map_or("not resolved".to_owned(), shown));
        [format!("1/{n}")].into_iter().chain(cells).collect()
    };
    let shown = d.xs("changes").into_iter().filter(|n| ["5", "10", "20", "40"].contains(&n.as_str()));
    let rows = shown.map(|n| row(&n)).collect();
    d.chart("equal_steps", lines(&equal_steps, 0));
    d.chart("equal_cost", lines(&equal_cost, 0));
    drift_and_change(d, &equal_steps);
    rank(d, &equal_steps, &equal_cost);
    let header: Vec<&str> = ["h"].into_iter().chain(SCHEMES.map(|(_, label)| label)).collect();
    d.finding.table("Permanent change (largest jump)", &header, rows);
}

/// The paper's drift above, the permanent change below, and their rates.
fn drift_and_change(d: &mut Drawing<'_>, changes: &[Series; 4]) {
    let (drifts, control) = (d.family("drifts"), d.series("drifts", EXACT_FLOW));
    let changed = changes.iter().map(|one| Series { label: format!("change, {}", one.label), ..one.clone() });
    let changed: Vec<_> = changed.collect();
    let all = changed.iter().chain(&drifts).chain([&control]);
    let fits = all.map(|series| (series.label.clone(), kepler::rate(&series.points)));
    let rho = kepler::singularity(0.6) * PI;
    d.rates("Rates over h ≤ 1/10", fits, Some(("π ρ and 2π ρ", format!("{rho:.3} and {:.3}", 2.0 * rho))));
    findings(d, changes, &drifts, rho);
    let dashed = drifts.into_iter().enumerate().map(|(i, drift)| Curve::dashed(drift.label, drift.points, i));
    let mut curves: Vec<_> = dashed.collect();
    curves.push(Curve::thick(control.label, control.points, 8));
    curves.extend(lines(&changed, 0));
    d.chart("drift_and_change", curves);
}

/// How far the changes are below the drifts, their rates, and the place of the drifts in each other's order.
fn findings(d: &mut Drawing<'_>, changes: &[Series], drifts: &[Series], rho: f64) {
    let below = changes.iter().zip(drifts).flat_map(|(change, drift)| {
        let common = change.points.iter().filter_map(|(n, y)| Some((*y, drift.points.iter().find(|(m, _)| m == n)?.1)));
        common.filter(|(y, _)| y.is_finite()).map(|(y, drift)| drift - y).collect::<Vec<_>>()
    });
    let (least, most) = range(below);
    let (slow, fast) = range(changes.iter().filter_map(|series| Some(kepler::rate(&series.points)?.c)));
    d.finding.highlight(format!(
        "The permanent change of the modified energy, between states whose estimates are accurate, is {least:.1} to \
         {most:.1} decades below the paper's drift at the step sizes that both have. It falls like exp(−c/h) with c = \
         {slow:.2} to {fast:.2} over h ≤ 1/10, near 2π ρ = {:.3}.",
        2.0 * rho
    ));
    let at = |scheme: usize, n: usize| drifts[scheme].points[n].1;
    let all = drifts[0].points.len();
    let first = (0..all).filter(|&n| at(2, n).min(at(3, n)) > at(0, n).max(at(1, n))).count();
    d.found(format!(
        "The drifts by the best m of S6 and SRKN6b are the two largest of the four schemes at \
        {first} of {all} step sizes."
    ));
}

/// Which schemes change less, at equal step sizes and at equal cost.
fn rank(d: &mut Drawing<'_>, equal_steps: &[Series], equal_cost: &[Series]) {
    let coverage = d.coverage();
    let at = |scheme: usize| equal_steps[scheme].points.iter().map(|(_, y)| *y);
    let both = at(0).zip(at(1)).filter(|(verlet, yoshida)| verlet.is_finite() && yoshida.is_finite());
    let (larger, count) =
        both.fold((0, 0), |(larger, n), (verlet, yoshida)| (larger + u32::from(verlet > yoshida), n + 1));
    let others = at(0).zip(at(1)).zip(at(2).zip(at(3))).map(|((a, b), (c, d))| c.max(d) - a.min(b));
    let others: Vec<f64> = others.filter(|y| y.is_finite()).collect();
    let least = others.iter().filter(|y| **y < 0.0).count();
    let most = others.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    d.check(
        "At equal step sizes S6 and SRKN6b change least.",
        format!(
            "at {least} of {} step sizes at which all changes are resolved; by at most {:.2} times the smaller change \
                of the others",
            others.len(),
            10_f64.powf(most)
        ),
        of_counts(least, others.len(), coverage),
    );
    d.found(format!(
        "Störmer–Verlet changes more than Yoshida 4 at {larger} of {count} step sizes: which of the two changes more \
            depends on the phases of the encounters."
    ));
    let verlet = &equal_cost[0].points;
    let behind =
        equal_cost[1..].iter().flat_map(|curve| &curve.points).filter_map(|(x, y)| Some(interpolated(verlet, *x)? - y));
    let behind: Vec<f64> = behind.filter(|y| y.is_finite()).collect();
    let least = behind.iter().filter(|y| **y < 0.0).count();
    d.check(
        "At equal cost Störmer–Verlet changes least.",
        format!(
            "at {least} of {} points of the others where costs overlap; by at most {} times their change",
            behind.len(),
            power(behind.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        ),
        // changes between the steps of a coarse grid are interpolated over too wide a range
        coverage.only_all(of_counts(least, behind.len(), coverage)),
    );
}

/// A statement about several steps, of which one that contradicts it is enough; without any step it is not decided.
fn of_counts(hold: usize, all: usize, coverage: Coverage) -> Verdict {
    if all == 0 { Verdict::of_all([]) } else { coverage.every(hold == all) }
}

/// Linear interpolation between points in the order of x.
fn interpolated(points: &[(f64, f64)], x: f64) -> Option<f64> {
    let pair = points.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0)?;
    let part = (x - pair[0].0) / (pair[1].0 - pair[0].0);
    Some(pair[0].1 + part * (pair[1].1 - pair[0].1))
}
