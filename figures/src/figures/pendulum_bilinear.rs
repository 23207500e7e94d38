//! The pendulum by the bilinear estimator.

use std::f64::consts::PI;

use shadowstep::problems::Problem;
use shadowstep::shadow::EstimatorSettings;

use super::pendulum::{SCHEME, singularity};
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::{bilinear, central};
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, decay, decay_row, theory_row};
use crate::numbers::power;
use crate::results::Results;
use crate::run::{EXACT_FLOW, Run};

pub(super) const FIGURE: Figure =
    Figure { name: "pendulum-bilinear", title: "The pendulum by the bilinear estimator", draw };

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::additional(
        "The pendulum by the bilinear estimator E_k of k + 1 states and by T_{m,m} with m = 200 (401 states), each also on the exact flow, whose \
         energy does not change.",
    );
    let steps = results.grid(&[2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20], &[2, 4, 7, 10]);
    let drifts = |propagator: &'static str, estimator: &EstimatorSettings| -> Vec<(f64, f64)> {
        let run = |n: u32| Run::of(Problem::Pendulum, propagator, format!("1/{n}"));
        steps.iter().map(|&n| (f64::from(n), results.log10_drift(&run(n), estimator))).collect()
    };
    let central_200 = central(200);
    let central_drifts = drifts(SCHEME, &central_200);
    let orders = results.grid(&[8, 16, 40, 100, 200], &[8, 16, 40, 100]);
    let of: Vec<_> = orders.iter().map(|&k| (k, drifts(SCHEME, &bilinear(k)))).collect();
    let [control, control_40] = [central_200, bilinear(40)].map(|by| drifts(EXACT_FLOW, &by));
    let mut curves = vec![
        Curve::thick("m = 200", central_drifts.clone(), 0),
        Curve::dashed("m = 200, exact flow", control.clone(), 1),
    ];
    curves.extend(of.iter().enumerate().map(|(i, (k, points))| Curve::line(format!("E_{k}"), points.clone(), i + 2)));
    curves.push(Curve::dashed("E_40, exact flow", control_40.clone(), 7));
    drawing.chart(
        "Störmer–Verlet, pendulum, p(0) = 1",
        Axis::linear("1/h"),
        Axis::drift(),
        curves,
        "An estimator cannot resolve what is below its curve.",
    );
    let highest = &of[of.len() - 1].1;
    let ten = |points: &[(f64, f64)]| power(points.iter().find(|(n, _)| *n == 10.0).map_or(f64::NAN, |(_, y)| *y));
    drawing.found(format!(
        "At h = 1/10: {} by m = 200 with 401 states, {} by E_40 with 41 states, {} by E_{}.",
        ten(&central_drifts),
        ten(&of[2].1),
        ten(highest),
        orders[orders.len() - 1]
    ));
    for (what, scheme, control) in [("m = 200", &central_drifts, &control), ("E_40", &of[2].1, &control_40)] {
        let off = scheme.iter().zip(control).map(|((_, a), (_, b))| (a - b).abs()).fold(0.0, f64::max);
        drawing.found(format!(
            "By {what} the drift of the exact flow is the same to within {off:.2} decades at every step size: the drift shown for the scheme belongs \
             to the estimator."
        ));
    }
    let checked = Run::of(Problem::Pendulum, SCHEME, "1/10");
    let held = results.digits_held(&checked, &bilinear(40), 200);
    drawing.digits_held("the drift at h = 1/10 by E_40", held);
    let k = orders[orders.len() - 1];
    let control_highest = drifts(EXACT_FLOW, &bilinear(k));
    let curves = [
        ("m = 200".to_owned(), &central_drifts),
        ("m = 200, exact flow".to_owned(), &control),
        (format!("E_{k}"), highest),
        (format!("E_{k}, exact flow"), &control_highest),
    ];
    rates(&mut drawing, &curves);
    drawing
}

/// The rates at large steps, beside those of the theory.
fn rates(drawing: &mut Drawing, curves: &[(String, &Vec<(f64, f64)>)]) {
    let rate = |points: &[(f64, f64)]| {
        let coarse: Vec<_> = points.iter().map(|(n, y)| (1.0 / n, *y)).filter(|(h, _)| *h > 0.12).collect();
        decay(&coarse, 0.5)
    };
    let mut rows: Vec<_> = curves.iter().map(|(label, points)| decay_row(label, rate(points).as_ref())).collect();
    let rho = singularity(1.0);
    rows.push(theory_row("π ρ and 2π ρ", format!("{:.3} and {:.3}", PI * rho, 2.0 * PI * rho)));
    drawing.table("Rates over h ≥ 1/8, where the orders do not limit them", &DECAY_HEADER, rows);
}
