//! Kepler's problem: the change of the modified energy per step, the accumulated change, and the best m.

use super::kepler::{FAR, NEAR, off, run};
use crate::figures::prelude::*;

pub(super) fn draw(d: &mut Drawing<'_>) {
    let rules = [
        ("full search", StoppingRule::Full),
        ("early stop, with <", StoppingRule::Early),
        ("early stop, with ≤ as printed", StoppingRule::Printed),
    ];
    let verlet = run("stormer-verlet", 20);
    let searches = rules.map(|(label, stop)| (label, d.results.energies(&verlet, &best(200, stop))));
    for (label, found) in &searches {
        found.iter().for_each(|found| with_orders(d, label, found));
    }
    let held = d.results.digits_held(&verlet, &best(200, StoppingRule::Early), 200);
    d.held("the drift by the early stop", held);
    let [(_, Some(full)), early @ ..] = &searches else { return };
    near_the_singularity(d, full);
    for (label, found) in early {
        let Some(found) = found else { continue };
        let (early, full) = (drift(found), drift(full));
        let ratio = 10_f64.powf(early - full);
        let [early, full] = [early, full].map(power);
        d.check(
            format!("The {label}, gives nearly the same as the full search."),
            format!("drift {early} instead of {full}: {ratio:.2} times; 0.5 to 2 counts as nearly the same"),
            (0.5..=2.0).contains(&ratio),
        );
    }
    d.found(
        "With ≤ the search also ends where the oldest of the twelve terms is not the largest, thus at the first \
         ripple. This program's `--stop early` has <, and `--stop printed` has ≤.",
    );
}

/// The mean m near the singularity less that far from it, orbit by orbit.
fn near_the_singularity(d: &mut Drawing<'_>, full: &Energies) {
    let mean = |orbit: u32, at: &dyn Fn(f64) -> bool| {
        let in_orbit = |t: f64| (t / std::f64::consts::TAU) as u32 == orbit;
        let of =
            full.times.iter().zip(&full.distances).zip(&full.orders).filter(|((t, r), _)| in_orbit(**t) && at(**r));
        let all: Vec<f64> = of.map(|(_, m)| f64::from(*m)).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let orbits = (full.times.last().copied().unwrap_or(0.0) / std::f64::consts::TAU) as u32;
    let means = |at: &dyn Fn(f64) -> bool| (0..orbits).map(|orbit| mean(orbit, at)).collect::<Vec<_>>();
    let (near, far) = (means(&|r| r < NEAR), means(&|r| r > FAR));
    let Some(more) = Interval::of_mean(&near.iter().zip(&far).map(|(near, far)| near - far).collect::<Vec<_>>()) else {
        return;
    };
    let all = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    d.check(
        "Near the singularity a higher m is used.",
        format!(
            "on average {:.0} where |q| < {NEAR} and {:.0} where |q| > {FAR}; {more:.0} more in the mean of {orbits} orbits",
            all(&near),
            all(&far)
        ),
        more.above(0.0),
    );
}

fn with_orders(d: &mut Drawing<'_>, label: &str, found: &Energies) {
    let values: Vec<_> = found.values.iter().map(|value| number(value)).collect();
    let steps = values.windows(2).map(|pair| (&pair[1] - &pair[0]).log10_abs());
    let shown = |points: Points| points.into_iter().filter(|(t, _)| *t <= 20.0).collect::<Points>();
    let per_step = found.times[1..].iter().copied().zip(steps).collect();
    let orders = found.times.iter().zip(&found.orders).map(|(t, m)| (*t, f64::from(*m))).collect();
    let curves = vec![
        Curve::line("accumulated", shown(off(found, 0)), 0),
        Curve::dashed("per step", shown(per_step), 1),
        Curve::dots("m", shown(orders), 2, Marker::Cross).on_the_right(),
    ];
    d.chart_of("changes", &[("search", label)], curves).second_y = Some(Axis::linear("m"));
}

/// log₁₀ of max − min
fn drift(energies: &Energies) -> f64 {
    let values: Vec<_> = energies.values.iter().map(|value| number(value)).collect();
    let ordered = |a: &&Wide, b: &&Wide| a.partial_cmp(b).expect("energies are finite");
    let most = values.iter().max_by(ordered).expect("there are values");
    let least = values.iter().min_by(ordered).expect("there are values");
    (most - least).log10_abs()
}
