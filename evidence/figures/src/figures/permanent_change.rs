//! The permanent change of the modified energy of the schemes, between low-error states.

use super::kepler::{self, run};
use crate::drawing::{additional, digits_held};
use crate::estimator::{BEST, bilinear};
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, decay_row, theory_row};
use crate::numbers::power;
use crate::results::Results;
use crate::run::{EXACT_FLOW, FORCES, SCHEMES};
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::{Coverage, Verdict};

pub(super) const FIGURE: Figure =
    Figure { name: "permanent-change", title: "The permanent change of the schemes", of_paper: "", draw };

/// The paper's drift above, the permanent change below, and their rates; the drifts at the steps of their own figure.
fn drift_and_change(results: &Results, finding: &mut Finding, changes: &[Curve]) {
    let steps = results.grid(&kepler::STEPS, &kepler::FEW_STEPS);
    let drifts = SCHEMES.map(|(scheme, _)| kepler::drifts(results, scheme, steps, &BEST));
    let control = kepler::drifts(results, EXACT_FLOW, steps, &BEST);
    let row = |what: &str, points: &[(f64, f64)]| decay_row(what, kepler::rate(points).as_ref());
    let mut rows: Vec<_> =
        changes.iter().map(|curve| row(&format!("change, {}", curve.label), &curve.points)).collect();
    rows.extend(SCHEMES.iter().zip(&drifts).map(|((_, label), points)| row(&format!("drift, {label}"), points)));
    rows.push(row("drift, exact flow", &control));
    let rho = kepler::singularity(0.6) * std::f64::consts::PI;
    rows.push(theory_row("π ρ and 2π ρ", format!("{rho:.3} and {:.3}", 2.0 * rho)));
    finding.table("Rates over h ≤ 1/10", &DECAY_HEADER, rows);
    findings(finding, changes, &drifts, rho);
    let mut curves: Vec<_> = drifts
        .into_iter()
        .enumerate()
        .map(|(i, points)| Curve::dashed(format!("drift, {}", SCHEMES[i].1), points, i))
        .collect();
    curves.push(Curve::thick("drift, exact flow", control, 8));
    curves.extend(changes.iter().cloned().map(|mut curve| {
        curve.label.insert_str(0, "change, ");
        curve
    }));
    finding.chart(
        Chart::new(
            "The paper's drift, and the permanent change",
            Axis::linear("1/h"),
            Axis::log10("modified energy over [0, 100]"),
            curves,
        ),
        "Above, the drift by the best m, of four schemes and of the exact flow, whose energy does not change. Below, \
         the permanent change.",
    );
}

/// How far the changes are below the drifts, their rates, and the place of the drifts in each other's order.
fn findings(finding: &mut Finding, changes: &[Curve], drifts: &[Vec<(f64, f64)>; 4], rho: f64) {
    let below = changes.iter().zip(drifts).flat_map(|(change, drift)| {
        let common = change.points.iter().filter_map(|(n, y)| Some((*y, drift.iter().find(|(m, _)| m == n)?.1)));
        common.filter(|(y, _)| y.is_finite()).map(|(y, drift)| drift - y).collect::<Vec<_>>()
    });
    let below: Vec<f64> = below.collect();
    let (least, most) = below.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(*y), b.max(*y)));
    let rates: Vec<_> = changes.iter().filter_map(|curve| Some(kepler::rate(&curve.points)?.c)).collect();
    let (slow, fast) = rates.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), c| (a.min(*c), b.max(*c)));
    finding.highlight(format!(
        "The permanent change of the modified energy, between states whose estimates are accurate, is {least:.1} to \
         {most:.1} decades below the paper's drift at the step sizes that both have. It falls like exp(−c/h) with c = \
         {slow:.2} to {fast:.2} over h ≤ 1/10, near 2π ρ = {:.3}.",
        2.0 * rho
    ));
    let at = |scheme: usize, n: usize| drifts[scheme][n].1;
    let all = drifts[0].len();
    let first = (0..all).filter(|&n| at(2, n).min(at(3, n)) > at(0, n).max(at(1, n))).count();
    finding.found(format!(
        "The drifts by the best m of S6 and SRKN6b are the two largest of the four schemes at \
        {first} of {all} step sizes."
    ));
}

/// log₁₀ of the permanent change and of its largest jump, by E_24.
fn change(results: &Results, scheme: &'static str, n: u32) -> Option<(f64, f64)> {
    results.sizes(&run(scheme, n), &bilinear(24))?.permanent
}

/// Curves of the changes of all schemes.
fn changes(results: &Results, steps: &[u32], x: impl Fn(f64, f64) -> f64) -> Vec<Curve> {
    let of = |scheme: &'static str, n: u32| change(results, scheme, n).map_or(f64::NAN, |(change, _)| change);
    let curves = SCHEMES.into_iter().zip(FORCES).enumerate().map(|(i, ((scheme, label), cost))| {
        Curve::line(label, steps.iter().map(|&n| (x(f64::from(n), cost), of(scheme, n))).collect(), i)
    });
    curves.collect()
}

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "The permanent change of the modified energy over [0, 100], Kepler, e = 0.6: max − min over the low-error \
         states, which are near the apocentres; by E_24. It is the range of a sum of jumps, one per encounter. Each \
         jump is a sinusoidal function of the position of the encounter within a step, so the sum also depends on the \
         start and on the ratio of the period to the step size.",
    );
    let all = [5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 23, 26, 30, 35, 40];
    let steps = results.grid(&all, &[5, 7, 10, 14, 20, 30, 40]);
    let (equal_steps, equal_cost) = (changes(results, steps, |n, _| n), changes(results, steps, |n, cost| n * cost));
    let y = || Axis::log10("permanent change over [0, 100]");
    finding.chart(
        Chart::new("Kepler, e = 0.6, at equal step sizes", Axis::linear("1/h"), y(), equal_steps.clone()),
        "Lower is better.",
    );
    let per_time = Axis::linear("force evaluations per unit of time");
    finding.chart(Chart::new("Kepler, e = 0.6, at equal cost", per_time, y(), equal_cost.clone()), "Lower is better.");
    drift_and_change(results, &mut finding, &equal_steps);
    rank(&mut finding, &equal_steps, &equal_cost, results.coverage());
    let shown = |(change, jump)| format!("{} ({})", power(change), power(jump));
    let row = |n: &u32| {
        let cells = SCHEMES.map(|(scheme, _)| change(results, scheme, *n).map_or("not resolved".to_owned(), shown));
        [format!("1/{n}")].into_iter().chain(cells).collect()
    };
    let rows = steps.iter().filter(|n| [5, 10, 20, 40].contains(*n)).map(row).collect();
    let header: Vec<&str> = ["h"].into_iter().chain(SCHEMES.map(|(_, label)| label)).collect();
    finding.table("Permanent change (largest jump)", &header, rows);
    let held = results.digits_held(&run(SCHEMES[3].0, 20), &bilinear(24), 200);
    digits_held(&mut finding, "the drift of SRKN6b at h = 1/20 by E_24", held);
    finding
}

/// Which schemes change less, at equal step sizes and at equal cost.
fn rank(finding: &mut Finding, equal_steps: &[Curve], equal_cost: &[Curve], coverage: Coverage) {
    let at = |scheme: usize| equal_steps[scheme].points.iter().map(|(_, y)| *y);
    let both = at(0).zip(at(1)).filter(|(verlet, yoshida)| verlet.is_finite() && yoshida.is_finite());
    let (larger, count) =
        both.fold((0, 0), |(larger, n), (verlet, yoshida)| (larger + u32::from(verlet > yoshida), n + 1));
    let others = at(0).zip(at(1)).zip(at(2).zip(at(3))).map(|((a, b), (c, d))| c.max(d) - a.min(b));
    let others: Vec<f64> = others.filter(|y| y.is_finite()).collect();
    let least = others.iter().filter(|y| **y < 0.0).count();
    let most = others.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    finding.check(
        "At equal step sizes S6 and SRKN6b change least.",
        format!(
            "at {least} of {} step sizes at which all changes are resolved; by at most {:.2} times the smaller change \
                of the others",
            others.len(),
            10_f64.powf(most)
        ),
        of_counts(least, others.len(), coverage),
    );
    finding.found(format!(
        "Störmer–Verlet changes more than Yoshida 4 at {larger} of {count} step sizes: which of the two changes more \
            depends on the phases of the encounters."
    ));
    let verlet = &equal_cost[0].points;
    let behind =
        equal_cost[1..].iter().flat_map(|curve| &curve.points).filter_map(|(x, y)| Some(interpolated(verlet, *x)? - y));
    let behind: Vec<f64> = behind.filter(|y| y.is_finite()).collect();
    let least = behind.iter().filter(|y| **y < 0.0).count();
    finding.check(
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
