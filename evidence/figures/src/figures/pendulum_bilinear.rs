//! The pendulum by the bilinear estimator.

use std::f64::consts::PI;

use shadowstep::problems::Problem;
use shadowstep::shadow::EstimatorSettings;

use super::pendulum::{SCHEME, singularity};
use crate::drawing::{additional, digits_held, drift_axis};
use crate::estimator::{bilinear, central};
use crate::figure::Figure;
use crate::fit::{DECAY_HEADER, ROUND_OFF, decay, decay_row, logarithms, theory_row};
use crate::numbers::{decimal, power};
use crate::results::Results;
use crate::run::{EXACT_FLOW, Run};
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::{Coverage, Verdict};

pub(super) const FIGURE: Figure =
    Figure { name: "pendulum-bilinear", title: "The pendulum by the bilinear estimator", of_paper: "", draw };

fn draw(results: &Results) -> Finding {
    let mut finding = additional(
        "The pendulum by the bilinear estimator E_k of k + 1 states and by T_{m,m} with m = 200 (401 states), each \
         also on the exact flow, whose energy does not change.",
    );
    let steps = results.grid(&[2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20], &[2, 4, 7, 10]);
    let drifts = |propagator: &'static str, estimator: &EstimatorSettings| -> Vec<(f64, f64)> {
        let run = |n: u32| Run::of(Problem::Pendulum, propagator, format!("1/{n}"));
        steps.iter().map(|&n| (f64::from(n), results.log10_drift(&run(n), estimator))).collect()
    };
    let central_200 = central(200);
    let central_drifts = drifts(SCHEME, &central_200);
    let orders = results.grid(&[8, 16, 40, 100, 200], &[8, 16, 40, 100]);
    let highest_k = orders[orders.len() - 1];
    let of: Vec<_> = orders.iter().map(|&k| (k, drifts(SCHEME, &bilinear(k)))).collect();
    let [control, control_40, control_highest] =
        [central_200, bilinear(40), bilinear(highest_k)].map(|by| drifts(EXACT_FLOW, &by));
    let mut curves = vec![
        Curve::thick("m = 200", central_drifts.clone(), 0),
        Curve::dashed("m = 200, exact flow", control.clone(), 1),
    ];
    curves.extend(of.iter().enumerate().map(|(i, (k, points))| Curve::line(format!("E_{k}"), points.clone(), i + 2)));
    curves.push(Curve::dashed("E_40, exact flow", control_40.clone(), 7));
    curves.push(Curve::dashed(format!("E_{highest_k}, exact flow"), control_highest.clone(), 8));
    finding.chart(
        Chart::new("Störmer–Verlet, pendulum, p(0) = 1", Axis::linear("1/h"), drift_axis(), curves),
        "Each estimator on the scheme, and on the exact flow, whose energy does not change.",
    );
    let highest = &of[of.len() - 1].1;
    let ten = |points: &[(f64, f64)]| power(points.iter().find(|(n, _)| *n == 10.0).map_or(f64::NAN, |(_, y)| *y));
    finding.found(format!(
        "At h = 1/10: {} by m = 200 with 401 states, {} by E_40 with 41 states, {} by E_{highest_k} with {}.",
        ten(&central_drifts),
        ten(&of[2].1),
        ten(highest),
        highest_k + 1
    ));
    let pairs = [
        ("m = 200".to_owned(), central_drifts.as_slice(), control.as_slice()),
        ("E_40".to_owned(), of[2].1.as_slice(), control_40.as_slice()),
        (format!("E_{highest_k}"), highest.as_slice(), control_highest.as_slice()),
    ];
    relative_to_the_flow(&mut finding, &pairs);
    own_drift(&mut finding, &of, &control_highest, results.coverage());
    let checked = Run::of(Problem::Pendulum, SCHEME, "1/10");
    let held = results.digits_held(&checked, &bilinear(40), 200);
    digits_held(&mut finding, "the drift at h = 1/10 by E_40", held);
    let curves = [
        ("m = 200".to_owned(), &central_drifts),
        ("m = 200, exact flow".to_owned(), &control),
        (format!("E_{highest_k}"), highest),
        (format!("E_{highest_k}, exact flow"), &control_highest),
    ];
    rates(&mut finding, &curves);
    finding
}

/// An estimator, its drifts on the scheme, and on the exact flow.
type Pair<'a> = (String, &'a [(f64, f64)], &'a [(f64, f64)]);

fn relative_to_the_flow(finding: &mut Finding, pairs: &[Pair<'_>]) {
    let ratios: Vec<_> = pairs.iter().map(|(label, of, control)| (label, logarithms(of, control))).collect();
    for (label, ratios) in &ratios {
        let sizes = ratios.iter().map(|(_, ratio)| *ratio);
        let (least, most) = (sizes.clone().fold(f64::INFINITY, f64::min), sizes.fold(f64::NEG_INFINITY, f64::max));
        finding.found(format!(
            "By {label}, log₁₀(drift / drift of the exact flow) is {} to {} at {} steps.",
            decimal(least, 2),
            decimal(most, 2),
            ratios.len()
        ));
    }
    let curves = ratios.into_iter().enumerate().map(|(i, (label, points))| Curve::line(label, points, i));
    finding.chart(
        Chart::new(
            "Drifts relative to that of the exact flow",
            Axis::linear("1/h"),
            Axis::log10("drift / drift of the exact flow"),
            curves.collect(),
        ),
        "Where both are above the round-off. Near 1 an estimator shows only its own error.",
    );
}

/// What the two largest k show is the scheme's own drift if k no longer matters, and if the exact flow shows far less.
fn own_drift(finding: &mut Finding, of: &[(u32, Vec<(f64, f64)>)], control: &[(f64, f64)], coverage: Coverage) {
    let [.., (before, lower), (k, highest)] = of else { return };
    let own = |((_, before), (_, now)): (&(f64, f64), &(f64, f64)), exact: f64| {
        (before - now).abs() < 0.1 && now - exact > 1.0
    };
    let all = lower.iter().zip(highest).zip(control).filter(|((_, (_, y)), _)| *y > ROUND_OFF);
    let all: Vec<_> = all.map(|((before, now), (_, exact))| (now.0, own((before, now), *exact))).collect();
    let settled: Vec<_> = all.iter().filter(|(_, own)| *own).map(|(n, _)| format!("1/{n}")).collect();
    let verdict = match settled.len() {
        count if count == all.len() => coverage.every(true),
        _ => Verdict::NotDecided("Where it does not, E_k may show its own error; larger k would decide."),
    };
    finding.check(
        format!("What E_{k} shows of the scheme is a drift of the modified energy, and not the error of E_{k}."),
        format!(
            "from E_{before} to E_{k} it changes by less than 0.1 decades, and is more than ten times that of the \
             exact flow, at {} of {} steps{}; where it does not, it is open",
            settled.len(),
            all.len(),
            if settled.is_empty() { String::new() } else { format!(" (h = {})", settled.join(", ")) },
        ),
        verdict,
    );
}

/// The rates at large steps, beside those of the theory.
fn rates(finding: &mut Finding, curves: &[(String, &Vec<(f64, f64)>)]) {
    let rate = |points: &[(f64, f64)]| {
        let coarse: Vec<_> = points.iter().map(|(n, y)| (1.0 / n, *y)).filter(|(h, _)| *h > 0.12).collect();
        decay(&coarse, 0.5)
    };
    let mut rows: Vec<_> = curves.iter().map(|(label, points)| decay_row(label, rate(points).as_ref())).collect();
    let rho = singularity(1.0);
    rows.push(theory_row("π ρ and 2π ρ", format!("{:.3} and {:.3}", PI * rho, 2.0 * PI * rho)));
    finding.table("Rates over h ≥ 1/8, where the orders do not limit them", &DECAY_HEADER, rows);
}
