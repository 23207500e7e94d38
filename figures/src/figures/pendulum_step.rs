//! The pendulum: the drift against the step size.

use shadowstep::shadow::EstimatorSettings;
use std::f64::consts::PI;

use shadowstep::problems::Problem;

use super::pendulum::{SCHEME, singularity};
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::central;
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, ROUND_OFF, decay, decay_row, theory_row};
use crate::numbers::power;
use crate::results::Results;
use crate::run::Run;

pub(super) const FIGURE: Figure =
    Figure { name: "pendulum-step", title: "The pendulum: drift against the step size", draw };

/// The m of the paper's figure.
const ORDERS: [u32; 7] = [2, 5, 10, 15, 20, 30, 40];

/// 1/h
const STEPS: [u32; 22] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 26, 28, 30];

/// An m at which T_{m,m} has converged: the remainder is about exp(ρ²/(h² m)), by lemma 3 of the paper. It is at most 1000, as a
/// step takes too long with a larger one.
fn limit(n: u32, quick: bool) -> EstimatorSettings {
    let wanted = (singularity(1.0) * f64::from(n)).powi(2) * 3.0;
    central((wanted as u32).clamp(200, if quick { 400 } else { 1000 }))
}

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The drift, max − min of the modified energy over [0, 100], computed from T_{m,m} for m = 2, 5, 10, 15, 20, 30, 40. The \
         approximations T_{m,m} converge for this problem.",
        "The limit, the thick line, follows the exp(−c/h) behaviour that the theory predicts.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 10, 14, 20]);
    let run = |n: u32| Run::of(Problem::Pendulum, SCHEME, format!("1/{n}"));
    let drifts = |by: &dyn Fn(u32) -> EstimatorSettings| -> Vec<(f64, f64)> {
        steps.iter().map(|&n| (1.0 / f64::from(n), results.log10_drift(&run(n), &by(n)))).collect()
    };
    let limit = drifts(&|n| limit(n, results.quick));
    let fixed = ORDERS.map(|m| (m, drifts(&|_| central(m))));
    let against = |points: &[(f64, f64)]| points.iter().map(|(h, y)| (1.0 / h, *y)).collect::<Vec<_>>();
    let curves = fixed.iter().enumerate();
    let mut curves: Vec<_> =
        curves.map(|(i, (m, points))| Curve::line(format!("m = {m}"), against(points), i + 1)).collect();
    curves.push(Curve::thick("limit", against(&limit), 0));
    drawing.chart(
        "Störmer–Verlet, pendulum, q(0) = 0, p(0) = 1",
        Axis::linear("1/h"),
        Axis::drift(),
        curves,
        "The limit is taken at m = 3 ρ²/h², but at least 200 and at most 1000.",
    );
    check_convergence(results, &mut drawing);
    check_orders(&mut drawing, &fixed);
    check_limit(&mut drawing, &limit);
    drawing.digits_held("the drift at h = 1/10 by m = 20", results.digits_held(&run(10), &central(20), 200));
    drawing.found(format!(
        "c is the rate of the estimator, π ρ, where ρ = {:.4} is the distance of the nearest singularity of q(t) from the real axis. The \
         bilinear estimator, below, gives a modified energy that is conserved far better.",
        singularity(1.0)
    ));
    drawing
}

/// The drifts by each m, which must not grow with m.
fn check_orders(drawing: &mut Drawing, fixed: &[(u32, Vec<(f64, f64)>)]) {
    let falls = fixed.windows(2).all(|pair| {
        pair[0].1.iter().zip(&pair[1].1).all(|((_, lower), (_, higher))| *higher < lower + 0.05 || *higher < ROUND_OFF)
    });
    let found = if falls { "at every step size" } else { "not at every step size" };
    drawing.check("A larger m does not give a larger drift.", found, falls);
}

/// The limit must decay exponentially; its rate, beside that of the theory.
fn check_limit(drawing: &mut Drawing, limit: &[(f64, f64)]) {
    let fit = decay(limit, 0.25);
    if let Some(fit) = &fit {
        drawing.check(
            "The limit follows exp(−c/h).",
            format!("c = {:.3} ± {:.3}, a line to within {:.2} decades", fit.c, fit.c_error, fit.deviation),
            fit.deviation < 0.5 && fit.c > 0.0,
        );
    }
    let theory = format!("{:.4}", PI * singularity(1.0));
    let rows =
        vec![decay_row("limit", fit.as_ref()), theory_row("π ρ, from aliasing of differences of samples", theory)];
    drawing.table("The rate of the limit", &DECAY_HEADER, rows);
}

/// The limit must be reached: drifts by m far larger than those of the figure, at h = 1/4.
fn check_convergence(results: &Results, drawing: &mut Drawing) {
    let run = Run::of(Problem::Pendulum, SCHEME, "1/4");
    let many = [40, 80, 160, 320, 640].map(|m| results.log10_drift(&run, &central(m)));
    let [.., last, most] = many;
    drawing.check(
        "T_{m,m} converge as m → ∞.",
        format!("at h = 1/4: {} by m = 40, 80, 160, 320, 640", many.map(power).join(", ")),
        (last - most).abs() < 0.05,
    );
}
