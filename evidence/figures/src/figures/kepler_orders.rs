//! Kepler's problem: the change of the modified energy per step, the accumulated change, and the best m.

use shadowstep::Real;
use shadowstep::shadow::StoppingRule;

use super::kepler::{FAR, NEAR, off, run};
use crate::drawing::digits_held;
use crate::estimator::best;
use crate::figure::Figure;
use crate::interval::Interval;
use crate::measured::Energies;
use crate::numbers::{Wide, number, power};
use crate::results::Results;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};
use shadowstep_studies::finding::Finding;

pub(super) const FIGURE: Figure = Figure {
    name: "kepler-orders",
    title: "Kepler: change per step, accumulated change, and m",
    of_paper: "figure 5",
    draw,
};

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The change per step, the accumulated change, and the optimal m, capped at 200, for Störmer–Verlet with h = 1/20 and \
         e = 0.6. Near the singularity quite a high m is used; away from it a lower one suffices.",
        "The ad-hoc criterion stops at the first m with max_{j=m−11…m−1} |T_{j,j} − T_{j−1,j−1}| ≤ max_{j=m−10…m} \
         |T_{j,j} − T_{j−1,j−1}|. The plots are nearly indistinguishable from those of the full search.",
    ]);
    let rules = [
        ("full search", StoppingRule::Full),
        ("early stop, with <", StoppingRule::Early),
        ("early stop, with ≤ as printed", StoppingRule::Printed),
    ];
    let searches = rules.map(|(label, stop)| (label, results.energies(&run("stormer-verlet", 20), &best(200, stop))));
    for (label, found) in &searches {
        found.iter().for_each(|found| with_orders(&mut finding, label, found));
    }
    let held = results.digits_held(&run("stormer-verlet", 20), &best(200, StoppingRule::Early), 200);
    digits_held(&mut finding, "the drift by the early stop", held);
    let [(_, Some(full)), early @ ..] = &searches else { return finding };
    near_the_singularity(&mut finding, full);
    for (label, found) in early {
        let Some(found) = found else { continue };
        let (early, full) = (drift(found), drift(full));
        let ratio = 10_f64.powf(early - full);
        finding.check(
            format!("The {label}, gives nearly the same as the full search."),
            format!(
                "drift {} instead of {}: {ratio:.2} times; 0.5 to 2 counts as nearly the same",
                power(early),
                power(full)
            ),
            (0.5..=2.0).contains(&ratio),
        );
    }
    finding.found(
        "With ≤ the search also ends where the oldest of the twelve terms is not the largest, thus at the first \
         ripple. This program's `--stop early` has <, and `--stop printed` has ≤.",
    );
    finding
}

/// The mean m near the singularity less that far from it, orbit by orbit.
fn near_the_singularity(finding: &mut Finding, full: &Energies) {
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
    finding.check(
        "Near the singularity a higher m is used.",
        format!(
            "on average {:.0} where |q| < {NEAR} and {:.0} where |q| > {FAR}; {more:.0} more in the mean of {orbits} orbits",
            all(&near),
            all(&far)
        ),
        more.above(0.0),
    );
}

fn with_orders(finding: &mut Finding, label: &str, found: &Energies) {
    let values: Vec<_> = found.values.iter().map(|value| number(value)).collect();
    let steps = values.windows(2).map(|pair| (&pair[1] - &pair[0]).log10_abs());
    let shown = |points: Vec<(f64, f64)>| points.into_iter().filter(|(t, _)| *t <= 20.0).collect::<Vec<_>>();
    let per_step = found.times[1..].iter().copied().zip(steps).collect();
    let orders = found.times.iter().zip(&found.orders).map(|(t, m)| (*t, f64::from(*m))).collect();
    finding.chart(
        Chart {
            second_y: Some(Axis::linear("m")),
            ..Chart::new(
                format!("Störmer–Verlet, h = 1/20, e = 0.6, {label}"),
                Axis::linear("time t"),
                Axis::log10("change of the modified energy"),
                vec![
                    Curve::line("accumulated", shown(off(found, 0)), 0),
                    Curve::dashed("per step", shown(per_step), 1),
                    Curve::dots("m", shown(orders), 2, Marker::Cross).on_the_right(),
                ],
            )
        },
        "t ≤ 20 of [0, 100].",
    );
}

/// log₁₀ of max − min
fn drift(energies: &Energies) -> f64 {
    let values: Vec<_> = energies.values.iter().map(|value| number(value)).collect();
    let ordered = |a: &&Wide, b: &&Wide| a.partial_cmp(b).expect("energies are finite");
    let most = values.iter().max_by(ordered).expect("there are values");
    let least = values.iter().min_by(ordered).expect("there are values");
    (most - least).log10_abs()
}
