//! Kepler's problem: the change of the modified energy per step, the accumulated change, and the best m.

use shadowstep::Number;
use shadowstep::shadow::StoppingRule;

use super::kepler::{FAR, NEAR, off, run};
use crate::calculation::Energies;
use crate::chart::{Axis, Curve, Marker};
use crate::drawing::Drawing;
use crate::estimator::best;
use crate::figure::Figure;
use crate::numbers::{number, power};
use crate::results::Results;

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-orders", title: "Kepler: change per step, accumulated change, and m", draw };

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The change per step, the accumulated change, and the optimal m, capped at 200, for Störmer–Verlet with h = 1/20 and \
         e = 0.6. Near the singularity quite a high m is used; away from it a lower one suffices.",
        "The ad-hoc criterion, which stops where the errors rise, gives plots that are nearly indistinguishable from those of \
         the full search.",
    ]);
    let searches = [("full search", StoppingRule::Full), ("early stop", StoppingRule::Early)]
        .map(|(label, stop)| (label, results.energies(&run("stormer-verlet", 20), &best(200, stop))));
    for (label, found) in &searches {
        found.iter().for_each(|found| with_orders(&mut drawing, label, found));
    }
    let held = results.digits_held(&run("stormer-verlet", 20), &best(200, StoppingRule::Early), 200);
    drawing.digits_held("the drift by the early stop", held);
    let [(_, Some(full)), (_, Some(early))] = &searches else { return drawing };
    let mean = |at: &dyn Fn(f64) -> bool| {
        let of = full.distances.iter().zip(&full.orders).filter(|(r, _)| at(**r));
        let all: Vec<f64> = of.map(|(_, m)| f64::from(*m)).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let (near, far) = (mean(&|r| r < NEAR), mean(&|r| r > FAR));
    drawing.check(
        "Near the singularity a higher m is used.",
        format!("on average {near:.0} where |q| < 0.8, {far:.0} where |q| > 1.5"),
        near > far,
    );
    let (full, early) = (drift(full), drift(early));
    drawing.check(
        "The early stop gives nearly the same.",
        format!("drift {} by the early stop, {} by the full search", power(early), power(full)),
        (early - full).abs() < 0.3,
    );
    drawing
}

fn with_orders(drawing: &mut Drawing, label: &str, found: &Energies) {
    let values: Vec<_> = found.values.iter().map(|value| number(value)).collect();
    let steps = values.windows(2).map(|pair| (pair[1].clone() - &pair[0]).log10_abs());
    let shown = |points: Vec<(f64, f64)>| points.into_iter().filter(|(t, _)| *t <= 20.0).collect::<Vec<_>>();
    let per_step = found.times[1..].iter().copied().zip(steps).collect();
    let orders = found.times.iter().zip(&found.orders).map(|(t, m)| (*t, f64::from(*m))).collect();
    drawing.chart_with_right_axis(
        &format!("Störmer–Verlet, h = 1/20, e = 0.6, {label}"),
        Axis::linear("time t"),
        Axis::log10("change of the modified energy"),
        Some(Axis::linear("m")),
        vec![
            Curve::line("accumulated", shown(off(found, 0)), 0),
            Curve::dashed("per step", shown(per_step), 1),
            Curve::dots("m", shown(orders), 2, Marker::Cross).on_the_right(),
        ],
        "t ≤ 20 of [0, 100].",
    );
}

/// log₁₀ of max − min
fn drift(energies: &Energies) -> f64 {
    let values: Vec<_> = energies.values.iter().map(|value| number(value)).collect();
    let most = values.iter().max_by(|a, b| a.total_cmp(b)).expect("there are values");
    let least = values.iter().min_by(|a, b| a.total_cmp(b)).expect("there are values");
    (most.clone() - least).log10_abs()
}
