//! The pendulum by the bilinear estimator.

use std::f64::consts::PI;

use super::pendulum::singularity;
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let central = d.series("central", "stormer-verlet");
    let (orders, of) = (d.cs("bilinear"), d.family("bilinear"));
    let (k, highest) = (&orders[orders.len() - 1], &of[of.len() - 1]);
    let control = Series { label: "m = 200, exact flow".to_owned(), ..d.series("central", EXACT_FLOW) };
    let [control_40, control_highest] = ["40", k].map(|k| d.series("of_flow", k));
    let dashed = |series: &Series, colour| Curve::dashed(&series.label, series.points.clone(), colour);
    let mut curves = vec![Curve::thick(&central.label, central.points.clone(), 0), dashed(&control, 1)];
    curves.extend(lines(&of, 2));
    curves.extend([dashed(&control_40, 7), dashed(&control_highest, 8)]);
    d.chart("drifts", curves);
    let ten = |one: &Series| power(one.points.iter().find(|(n, _)| *n == 10.0).map_or(f64::NAN, |(_, y)| *y));
    d.found(format!(
        "At h = 1/10: {} by m = 200 with 401 states, {} by E_40 with 41 states, {} by E_{k} with {}.",
        ten(&central),
        ten(&of[2]),
        ten(highest),
        k.parse::<u32>().expect("k is a number") + 1
    ));
    let pairs = [(&central, &control), (&of[2], &control_40), (highest, &control_highest)];
    relative_to_the_flow(d, &pairs.map(|(own, control)| own.relative_to(&control.points)));
    own_drift(d, &of, &control_highest.points);
    let rate = |series: &Series| {
        let coarse: Points = by_step(&series.points).into_iter().filter(|(h, _)| *h > 0.12).collect();
        (series.label.clone(), decay(&coarse, 0.5))
    };
    let rho = singularity(1.0);
    let theory = ("π ρ and 2π ρ", format!("{:.3} and {:.3}", PI * rho, 2.0 * PI * rho));
    let fits = [&central, &control, highest, &control_highest].map(rate);
    d.rates("Rates over h ≥ 1/8, where the orders do not limit them", fits, Some(theory));
}

fn relative_to_the_flow(d: &mut Drawing<'_>, ratios: &[Series]) {
    for Series { label, points } in ratios {
        let (least, most) = range(points.iter().map(|(_, ratio)| *ratio));
        d.found(format!(
            "By {label}, log₁₀(drift / drift of the exact flow) is {} to {} at {} steps.",
            decimal(least, 2),
            decimal(most, 2),
            points.len()
        ));
    }
    d.chart("relative", lines(ratios, 0));
}

/// What the two largest k show is the scheme's own drift if k no longer matters, and if the exact flow shows far less.
fn own_drift(d: &mut Drawing<'_>, of: &[Series], control: &[(f64, f64)]) {
    let [.., before, now] = of else { return };
    let all = before.points.iter().zip(&now.points).zip(control).filter(|((_, (_, y)), _)| *y > ROUND_OFF);
    let own = |((_, before), (n, now)): (&(f64, f64), &(f64, f64)), exact: f64| {
        (*n, (before - now).abs() < 0.1 && now - exact > 1.0)
    };
    let all: Vec<_> = all.map(|(both, (_, exact))| own(both, *exact)).collect();
    let settled: Vec<_> = all.iter().filter(|(_, own)| *own).map(|(n, _)| format!("1/{n}")).collect();
    let verdict = match settled.len() {
        count if count == all.len() => d.coverage().every(true),
        _ => Verdict::NotDecided("Where it does not, E_k may show its own error; larger k would decide."),
    };
    let (before, now) = (&before.label, &now.label);
    d.check(
        format!("What {now} shows of the scheme is a drift of the modified energy, and not the error of {now}."),
        format!(
            "from {before} to {now} it changes by less than 0.1 decades, and is more than ten times that of the exact \
             flow, at {} of {} steps{}; where it does not, it is open",
            settled.len(),
            all.len(),
            if settled.is_empty() { String::new() } else { format!(" (h = {})", settled.join(", ")) },
        ),
        verdict,
    );
}
