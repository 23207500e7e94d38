//! The Hénon–Heiles problem: the drift against the step size.

use std::f64::consts::LOG10_E;

use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let of = d.family("drifts");
    d.chart("drifts", lines(&of, 0));
    compare(d, &of);
    let fits: Vec<_> = of.iter().map(|one| (one.label.clone(), decay(&by_step(&one.points), 0.25))).collect();
    if let Some(first) = &fits[0].1 {
        d.check("The drift is exponentially small.", first.described(), first.is_exponential());
        d.same_rates("The value of c is the same.", &fits);
        round_off(d, &of[0].points, first);
    }
    d.rates("Rates", fits, None);
}

/// Whether the first scheme preserves the energy better than the others, and by how much.
fn compare(d: &mut Drawing<'_>, of: &[Series]) {
    let [verlet, others @ ..] = of else { return };
    let relative: Vec<_> = others.iter().map(|one| one.relative_to(&verlet.points)).collect();
    d.chart("relative", lines(&relative, 1));
    for Series { label, points } in others {
        let Some(ratio) = Ratio::of(points, &verlet.points) else { continue };
        d.check(
            format!("Störmer–Verlet preserves it slightly better than {label}."),
            format!("{label}'s drift is {ratio} times as large"),
            ratio.mean.above(1.0),
        );
    }
}

/// Where the drifts leave the fitted line: the round-off is visible at the first step from which on all are above it by
/// three standard deviations.
fn round_off(d: &mut Drawing<'_>, points: &[(f64, f64)], fit: &ExponentialDecay) {
    let line = |n: f64| fit.a - fit.c * LOG10_E * n;
    let on_it = points.iter().rposition(|(n, y)| *y <= line(*n) + 3.0 * fit.deviation);
    let Some((first, last)) = on_it.and_then(|at| Some((points.get(at + 1)?.0, points[at].0))) else { return };
    let (n, y) = points.last().expect("there are steps");
    let verdict = match () {
        () if first <= 20.0 => Verdict::Differs,
        () if last >= 20.0 => Verdict::Agrees,
        () => Verdict::NotDecided(
            "It begins between two step sizes, of which one is on either side of 1/20; steps between them would decide.",
        ),
    };
    let found = format!(
        "it is between 1/h = {last} and {first}; at 1/h = {n} the drift is {}, where the fitted line gives {}",
        power(*y),
        power(line(*n))
    );
    d.check("The effect of round-off error becomes visible when 1/h exceeds 20.", found, verdict);
}
