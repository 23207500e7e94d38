//! Ours: what estimators show against the states that they store, on the exact flow and on schemes; and what is left of the schemes' own.

use super::calculation::{By, Setting};
use super::chart::Curve;
use super::charts::{dashed, line, linear, log10_axis, thick};
use super::drawn::{DECAY_HEADER, Drawn, decay_row, power};
use super::kepler::{self, BEST, EXACT, SCHEMES, run};
use super::results::Results;

const ORDERS: [u32; 14] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 50, 80, 130, 200];

/// (log₁₀ of the states, log₁₀ of the drift)
fn against_states(results: &Results, run: &Setting, by: &dyn Fn(u32) -> By, orders: &[u32]) -> Vec<(f64, f64)> {
    let point = |&order: &u32| (f64::from(by(order).states()).log10(), results.log10_drift(run, by(order)));
    orders.iter().map(point).collect()
}

/// Even ones, whose values belong to states.
fn even(orders: &[u32]) -> Vec<u32> {
    orders.iter().map(|order| 2 * order).filter(|order| *order <= 200).collect()
}

const STATES: &str = "states that an estimate needs";

pub(crate) fn on_the_exact_flow(results: &Results) -> Drawn {
    let mut drawn = Drawn::ours(
        "The states of Kepler's exact flow (e = 0.6) at t = n h, with β along it: the modified energy of this trajectory is −1/2 at every state, so \
         everything that an estimator shows is its own error.",
    );
    let orders = results.grid(&ORDERS, &[1, 3, 8, 24, 200]);
    for n in [10, 20, 40] {
        let exact = run(EXACT, n);
        let central = against_states(results, &exact, &|m| By::Central { m }, orders);
        let best = against_states(results, &exact, &|largest| By::Best { largest, early: false }, &orders[1..]);
        let bilinear = against_states(results, &exact, &|k| By::Bilinear { k }, &even(orders));
        let least = |points: &[(f64, f64)]| points.iter().map(|(_, y)| *y).fold(f64::INFINITY, f64::min);
        drawn.found(format!(
            "h = 1/{n}: with up to 401 states the best m shows {}, any fixed m at least {}; the bilinear estimator shows {} with up to 201.",
            power(best.last().map_or(f64::NAN, |(_, y)| *y)),
            power(least(&central)),
            power(least(&bilinear)),
        ));
        drawn.chart(
            &format!("Exact flow, Kepler, e = 0.6, h = 1/{n}"),
            log10_axis(STATES),
            log10_axis("max − min of the estimates"),
            vec![
                line("T_{m,m}, every state the same m", central, 0),
                line("best m up to a cap", best, 1),
                line("bilinear E_k", bilinear, 2),
            ],
            "2m + 1 or k + 1 states.",
        );
    }
    let held = results.digits_held(&run(EXACT, 20), By::Bilinear { k: 16 }, 200);
    drawn.digits_held("the drift of the exact flow at h = 1/20 by E_16", held);
    drawn
}

pub(crate) fn on_schemes(results: &Results) -> Drawn {
    let mut drawn = Drawn::ours(
        "The same on the schemes, Kepler, e = 0.6, h = 1/20, beside the permanent change between quiet states.",
    );
    let orders = results.grid(&ORDERS, &[1, 3, 8, 24, 200]);
    let best = |largest| By::Best { largest, early: false };
    let bilinear = |k| By::Bilinear { k };
    let mut chart = |title: &str, by: &dyn Fn(u32) -> By, orders: &[u32]| {
        let mut curves: Vec<Curve> = Vec::new();
        for (i, (scheme, label)) in SCHEMES.into_iter().enumerate() {
            curves.push(line(label, against_states(results, &run(scheme, 20), by, orders), i));
        }
        curves.push(dashed("exact flow", against_states(results, &run(EXACT, 20), by, orders), 8));
        drawn.chart(
            &format!("{title}, h = 1/20"),
            log10_axis(STATES),
            log10_axis("drift of the modified energy over [0, 100]"),
            curves,
            "Where a curve leaves that of the exact flow, it shows the scheme.",
        );
    };
    chart("Best m up to a cap", &best, &orders[1..]);
    chart("Bilinear E_k", &bilinear, &even(orders));
    let mut rows = Vec::new();
    for (scheme, label) in SCHEMES.into_iter().chain([(EXACT, "exact flow")]) {
        let [best, bilinear] =
            [super::kepler::BEST, By::Bilinear { k: 50 }].map(|by| results.sizes(&run(scheme, 20), by));
        let (Some(best), Some(bilinear)) = (best, bilinear) else { continue };
        let permanent = bilinear.permanent.map_or("not resolved".to_owned(), |(change, _)| power(change));
        rows.push(vec![label.to_owned(), power(best.drift), power(bilinear.drift), permanent]);
    }
    drawn.table("h = 1/20", &["", "drift by the best m ≤ 200", "drift by E_50", "permanent change"], rows);
    drawn
}

/// The paper's drift above, the permanent change below, and their rates.
fn drift_and_change(results: &Results, drawn: &mut Drawn, steps: &[u32], changes: &[Curve]) {
    let drifts = SCHEMES.map(|(scheme, _)| kepler::drifts(results, scheme, steps, BEST));
    let control = kepler::drifts(results, EXACT, steps, BEST);
    let row = |what: &str, points: &[(f64, f64)]| decay_row(what, kepler::rate(points).as_ref());
    let mut rows: Vec<_> =
        changes.iter().map(|curve| row(&format!("change, {}", curve.label), &curve.points)).collect();
    rows.extend(SCHEMES.iter().zip(&drifts).map(|((_, label), points)| row(&format!("drift, {label}"), points)));
    rows.push(row("drift, exact flow", &control));
    let rho = kepler::singularity(0.6) * std::f64::consts::PI;
    rows.push(vec!["π ρ and 2π ρ".to_owned(), format!("{rho:.3} and {:.3}", 2.0 * rho), String::new(), String::new()]);
    drawn.table("Rates over h ≤ 1/10", &DECAY_HEADER, rows);
    let mut curves: Vec<_> = drifts
        .into_iter()
        .enumerate()
        .map(|(i, points)| dashed(format!("drift, {}", SCHEMES[i].1), points, i))
        .collect();
    curves.push(thick("drift, exact flow", control, 8));
    curves.extend(changes.iter().cloned().map(|curve| Curve { label: format!("change, {}", curve.label), ..curve }));
    drawn.chart(
        "The paper's drift, and the permanent change",
        linear("1/h"),
        log10_axis("modified energy over [0, 100]"),
        curves,
        "Above, the drift by the best m: that of every scheme is that of the exact flow, whose energy does not change. Below, what changes for good.",
    );
}

/// Evaluations of the gradient a step.
const COSTS: [f64; 4] = [1.0, 3.0, 6.0, 6.0];

/// log₁₀ of the permanent change and of its largest jump, by E_24.
fn change(results: &Results, scheme: &'static str, n: u32) -> Option<(f64, f64)> {
    results.sizes(&run(scheme, n), By::Bilinear { k: 24 })?.permanent
}

/// Curves of the changes of all schemes.
fn changes(results: &Results, steps: &[u32], x: impl Fn(f64, f64) -> f64) -> Vec<Curve> {
    let of = |scheme: &'static str, n: u32| change(results, scheme, n).map_or(f64::NAN, |(change, _)| change);
    let curves = SCHEMES.into_iter().zip(COSTS).enumerate().map(|(i, ((scheme, label), cost))| {
        line(label, steps.iter().map(|&n| (x(f64::from(n), cost), of(scheme, n))).collect(), i)
    });
    curves.collect()
}

pub(crate) fn permanent(results: &Results) -> Drawn {
    let mut drawn = Drawn::ours(
        "By how much the modified energy changes for good over [0, 100], Kepler, e = 0.6: max − min over the states whose estimated \
         error is small, which are those near the apocentres; by E_24. It is the range of the sum of jumps, one an encounter; each \
         depends like a sine on where within a step the encounter comes, so that the sum also depends on the start and on how the \
         period fits the step.",
    );
    let all = [5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 23, 26, 30, 35, 40];
    let steps = results.grid(&all, &[5, 7, 10, 14, 20, 28, 40]);
    let (equal_steps, equal_cost) = (changes(results, steps, |n, _| n), changes(results, steps, |n, cost| n * cost));
    let y = || log10_axis("permanent change over [0, 100]");
    drawn.chart("At equal steps", linear("1/h"), y(), equal_steps.clone(), "Lower is better.");
    let per_time = linear("force evaluations per unit of time");
    drawn.chart("At equal cost", per_time, y(), equal_cost.clone(), "Lower is better.");
    drift_and_change(results, &mut drawn, steps, &equal_steps);
    rank(&mut drawn, &equal_steps, &equal_cost);
    let shown = |(change, jump)| format!("{} ({})", power(change), power(jump));
    let row = |n: &u32| {
        let cells = SCHEMES.map(|(scheme, _)| change(results, scheme, *n).map_or("not resolved".to_owned(), shown));
        [format!("1/{n}")].into_iter().chain(cells).collect()
    };
    let rows = steps.iter().filter(|n| [5, 10, 20, 40].contains(*n)).map(row).collect();
    let header: Vec<&str> = ["h"].into_iter().chain(SCHEMES.map(|(_, label)| label)).collect();
    drawn.table("Permanent change (largest jump)", &header, rows);
    let held = results.digits_held(&run(SCHEMES[3].0, 20), By::Bilinear { k: 24 }, 200);
    drawn.digits_held("the drift of SRKN6b at h = 1/20 by E_24", held);
    drawn
}

/// Which schemes change less, at equal steps and at equal cost.
fn rank(drawn: &mut Drawn, equal_steps: &[Curve], equal_cost: &[Curve]) {
    let at = |scheme: usize| equal_steps[scheme].points.iter().map(|(_, y)| *y);
    let both = at(0).zip(at(1)).filter(|(verlet, yoshida)| verlet.is_finite() && yoshida.is_finite());
    let (larger, count) =
        both.fold((0, 0), |(larger, n), (verlet, yoshida)| (larger + u32::from(verlet > yoshida), n + 1));
    let others = at(0).zip(at(1)).zip(at(2).zip(at(3))).map(|((a, b), (c, d))| c.max(d) - a.min(b));
    let most = others.filter(|y| y.is_finite()).fold(f64::NEG_INFINITY, f64::max);
    drawn.check(
        "At equal steps S6 and SRKN6b, whose drifts are the largest, change least.",
        format!("by {:.2} of the lesser of the others at most", 10_f64.powf(most)),
        most < 0.0,
    );
    drawn.found(format!(
        "Störmer–Verlet changes more than Yoshida 4 at {larger} of {count} steps: between these two the phases of the encounters decide."
    ));
    let verlet = &equal_cost[0].points;
    let behind =
        equal_cost[1..].iter().flat_map(|curve| &curve.points).filter_map(|(x, y)| Some(interpolated(verlet, *x)? - y));
    let behind = behind.filter(|y| y.is_finite()).fold(f64::NEG_INFINITY, f64::max);
    drawn.check(
        "At equal cost Störmer–Verlet changes least.",
        format!("by {} of the others at most, where costs overlap", power(behind)),
        behind < 0.0,
    );
}

/// Between points in the order of x.
fn interpolated(points: &[(f64, f64)], x: f64) -> Option<f64> {
    let pair = points.windows(2).find(|pair| pair[0].0 <= x && x <= pair[1].0)?;
    let part = (x - pair[0].0) / (pair[1].0 - pair[0].0);
    Some(pair[0].1 + part * (pair[1].1 - pair[0].1))
}
