//! The pendulum: the drift against the step, and against the initial momentum.

use std::f64::consts::PI;

use super::calculation::{By, Setting};
use super::charts::{dashed, line, linear, log10_axis, thick};
use super::drawn::{DECAY_HEADER, Drawn, ROUND_OFF, decay, decay_row, power};
use super::results::Results;
use shadowstep_scenes::library::EXACT_FLOW;

const SCHEME: &str = "stormer-verlet";

/// The m of the paper.
const ORDERS: [u32; 7] = [2, 5, 10, 15, 20, 30, 40];

/// 1/h
const STEPS: [u32; 22] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 26, 28, 30];

/// The distance of the nearest singularity of q(t) from the real axis: K(k'), k = p(0)/2, by π/(2 AGM(1, k)).
pub(crate) fn singularity(p: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, p / 2.0);
    for _ in 0..60 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}

/// The m by which T_{m,m} have converged: what is missing is about exp(ρ²/(h² m)), by the paper's lemma 3. Beyond 1000 a step
/// takes too long.
fn limit(n: u32, quick: bool) -> By {
    let wanted = (singularity(1.0) * f64::from(n)).powi(2) * 3.0;
    By::Central { m: (wanted as u32).clamp(200, if quick { 400 } else { 1000 }) }
}

pub(crate) fn step(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The drift, max − min of the modified energy over [0, 100], computed from T_{m,m} for m = 2, 5, 10, 15, 20, 30, 40. The \
         approximations T_{m,m} converge for this problem.",
        "The limit, the thick line, follows the exp(−c/h) behaviour that the theory predicts.",
    ]);
    let steps = results.grid(&STEPS, &[2, 4, 6, 10, 14, 20]);
    let run = |n: u32| Setting::of("pendulum", SCHEME, format!("1/{n}"));
    let drifts = |by: &dyn Fn(u32) -> By| -> Vec<(f64, f64)> {
        steps.iter().map(|&n| (1.0 / f64::from(n), results.log10_drift(&run(n), by(n)))).collect()
    };
    let limit = drifts(&|n| limit(n, results.quick));
    let fixed = ORDERS.map(|m| (m, drifts(&|_| By::Central { m })));
    let against = |points: &[(f64, f64)]| points.iter().map(|(h, y)| (1.0 / h, *y)).collect::<Vec<_>>();
    let mut curves: Vec<_> =
        fixed.iter().enumerate().map(|(i, (m, points))| line(format!("m = {m}"), against(points), i + 1)).collect();
    curves.push(thick("limit", against(&limit), 0));
    drawn.chart(
        "Störmer–Verlet, pendulum, q(0) = 0, p(0) = 1",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "The limit is taken at m = 3 ρ²/h², but at least 200 and at most 1000.",
    );
    converges(results, &mut drawn);
    let falls = fixed.windows(2).all(|pair| {
        pair[0].1.iter().zip(&pair[1].1).all(|((_, lower), (_, higher))| *higher < lower + 0.05 || *higher < ROUND_OFF)
    });
    drawn.check("A larger m gives no larger drift.", if falls { "at every step" } else { "not at every step" }, falls);
    let fit = decay(&limit, 0.25);
    if let Some(fit) = &fit {
        drawn.check(
            "The limit follows exp(−c/h).",
            format!("c = {:.3} ± {:.3}, a line to within {:.2} decades", fit.c, fit.c_error, fit.spread),
            fit.spread < 0.5 && fit.c > 0.0,
        );
    }
    let rho = singularity(1.0);
    drawn.table(
        "The rate of the limit",
        &DECAY_HEADER,
        vec![
            decay_row("limit", fit.as_ref()),
            vec![
                "π ρ, what differences of samples alias to".to_owned(),
                format!("{:.4}", PI * rho),
                String::new(),
                String::new(),
            ],
        ],
    );
    let checked = (run(10), By::Central { m: 20 });
    drawn.digits_held("the drift at h = 1/10 by m = 20", results.digits_held(&checked.0, checked.1, 200));
    drawn.found(format!(
        "c is that of the estimator, π ρ with ρ = {rho:.4}, the distance of the nearest singularity of q(t) from the real axis: \
         the bilinear estimator, below, finds a modified energy that is conserved far better."
    ));
    drawn
}

/// With m far beyond those of the figure, at h = 1/4.
fn converges(results: &Results, drawn: &mut Drawn) {
    let run = Setting::of("pendulum", SCHEME, "1/4");
    let many = [40, 80, 160, 320, 640].map(|m| results.log10_drift(&run, By::Central { m }));
    let [.., last, most] = many;
    drawn.check(
        "T_{m,m} converge as m → ∞.",
        format!("at h = 1/4: {} by m = 40, 80, 160, 320, 640", many.map(power).join(", ")),
        (last - most).abs() < 0.05,
    );
}

pub(crate) fn momentum(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The drift as a function of the initial momentum p(0), q(0) = 0.",
        "The Störmer–Verlet method shows improved energy preservation near the equilibrium point, revealing the dependence \
         exp(−c/(h ‖f‖)), in which ‖f‖ decreases as p → 0.",
    ]);
    let all: Vec<u32> = (1..=19).chain([21]).chain((22..=30).step_by(2)).collect();
    let tenths = results.grid(&all, &[1, 5, 10, 15, 19, 21, 30]);
    let mut curves = Vec::new();
    for (i, n) in [2_u32, 4, 10].into_iter().enumerate() {
        let by = By::Best { largest: 200, early: false };
        let run = |p: u32| Setting::of("pendulum", SCHEME, format!("1/{n}")).with("p", format!("{p}/10"));
        let points: Vec<_> = tenths.iter().map(|&p| (f64::from(p) / 10.0, results.log10_drift(&run(p), by))).collect();
        let at = [1, 5, 10, 15, 19].map(|p| results.log10_drift(&run(p), by));
        drawn.check(
            &format!("h = 1/{n}: the drift falls as p(0) → 0."),
            format!("{} at p(0) = 0.1, 0.5, 1, 1.5, 1.9", at.map(power).join(", ")),
            at.is_sorted(),
        );
        curves.push(line(format!("h = 1/{n}"), points, i));
    }
    let checked = Setting::of("pendulum", SCHEME, "1/4").with("p", "19/10");
    let by = By::Best { largest: 200, early: false };
    drawn.digits_held("the drift at h = 1/4, p(0) = 1.9", results.digits_held(&checked, by, 200));
    drawn.chart(
        "Störmer–Verlet, pendulum, q(0) = 0",
        linear("p(0)"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "Best m up to 200. Beyond p(0) = 2 the pendulum goes round; at 2 is the separatrix.",
    );
    drawn
}

/// Again with the bilinear estimator.
pub(crate) fn bilinear(results: &Results) -> Drawn {
    let mut drawn = Drawn::ours(
        "The pendulum again, by the bilinear estimator E_k of k + 1 states, beside T_{m,m} with m = 200 (401 states), and what both \
         show on the exact flow, whose energy does not change.",
    );
    let steps = results.grid(&[2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20], &[2, 4, 7, 10]);
    let drifts = |propagator: &'static str, by: By| -> Vec<(f64, f64)> {
        let run = |n: u32| Setting::of("pendulum", propagator, format!("1/{n}"));
        steps.iter().map(|&n| (f64::from(n), results.log10_drift(&run(n), by))).collect()
    };
    let central = By::Central { m: 200 };
    let linear_one = drifts(SCHEME, central);
    let orders = results.grid(&[8, 16, 40, 100, 200], &[8, 16, 40, 100]);
    let of: Vec<_> = orders.iter().map(|&k| (k, drifts(SCHEME, By::Bilinear { k }))).collect();
    let [control, control_40] = [central, By::Bilinear { k: 40 }].map(|by| drifts(EXACT_FLOW, by));
    let mut curves = vec![thick("m = 200", linear_one.clone(), 0), dashed("m = 200, exact flow", control.clone(), 1)];
    curves.extend(of.iter().enumerate().map(|(i, (k, points))| line(format!("E_{k}"), points.clone(), i + 2)));
    curves.push(dashed("E_40, exact flow", control_40.clone(), 7));
    drawn.chart(
        "Störmer–Verlet, pendulum, p(0) = 1",
        linear("1/h"),
        log10_axis("drift of the modified energy over [0, 100]"),
        curves,
        "What goes on below a curve cannot be seen by its estimator.",
    );
    let highest = &of[of.len() - 1].1;
    let ten = |points: &[(f64, f64)]| power(points.iter().find(|(n, _)| *n == 10.0).map_or(f64::NAN, |(_, y)| *y));
    drawn.found(format!(
        "At h = 1/10: {} by m = 200 with 401 states, {} by E_40 with 41 states, {} by E_{}.",
        ten(&linear_one),
        ten(&of[2].1),
        ten(highest),
        orders[orders.len() - 1]
    ));
    for (what, scheme, control) in [("m = 200", &linear_one, &control), ("E_40", &of[2].1, &control_40)] {
        let off = scheme.iter().zip(control).map(|((_, a), (_, b))| (a - b).abs()).fold(0.0, f64::max);
        drawn.found(format!(
            "By {what} the exact flow shows the same drift to within {off:.2} decades at every step: what is shown on the scheme \
             is the estimator's own."
        ));
    }
    let checked = Setting::of("pendulum", SCHEME, "1/10");
    let held = results.digits_held(&checked, By::Bilinear { k: 40 }, 200);
    drawn.digits_held("the drift at h = 1/10 by E_40", held);
    let rho = singularity(1.0);
    let coarse = |points: &[(f64, f64)]| {
        points.iter().map(|(n, y)| (1.0 / n, *y)).filter(|(h, _)| *h > 0.12).collect::<Vec<_>>()
    };
    let k = orders[orders.len() - 1];
    let control_highest = drifts(EXACT_FLOW, By::Bilinear { k });
    let row = |label: &str, points: &[(f64, f64)]| decay_row(label, decay(&coarse(points), 0.5).as_ref());
    let mut rows = vec![
        row("m = 200", &linear_one),
        row("m = 200, exact flow", &control),
        row(&format!("E_{k}"), highest),
        row(&format!("E_{k}, exact flow"), &control_highest),
    ];
    let theory = format!("{:.3} and {:.3}", PI * rho, 2.0 * PI * rho);
    rows.push(vec!["π ρ and 2π ρ".to_owned(), theory, String::new(), String::new()]);
    drawn.table("Rates over h ≥ 1/8, where the orders do not limit them", &DECAY_HEADER, rows);
    drawn
}
