//! The modified energy in time: for several steps and schemes, and with the m that was found best.

use shadowstep::Number;

use super::super::calculation::{By, Energies, number};
use super::super::chart::Marker;
use super::super::charts::{dashed, dots, line, linear, log10_axis, right};
use super::super::drawn::{Drawn, power};
use super::super::results::Results;
use super::{BEST, EXACT, SCHEMES, run};

/// The semi-major axis is 1: |q| is 0.4 at a pericentre and 1.6 at an apocentre.
const NEAR: f64 = 0.8;
const FAR: f64 = 1.5;

/// Runs with their labels.
type Labelled = Vec<(String, Option<Energies>)>;

/// (t, log₁₀|value − reference|)
fn off(energies: &Energies, reference: usize) -> Vec<(f64, f64)> {
    let reference = number(&energies.values[reference]);
    let sizes = energies.values.iter().map(|value| (number(value) - &reference).log10_abs());
    energies.times.iter().copied().zip(sizes).collect()
}

/// The place of the first apocentre.
pub(super) fn apocentre(energies: &Energies) -> usize {
    energies.distances.windows(2).position(|pair| pair[1] < pair[0]).unwrap_or(0)
}

/// The largest log₁₀|value − that at the first apocentre| at these distances.
fn largest_off(energies: &Energies, at: impl Fn(f64) -> bool) -> f64 {
    let points = off(energies, apocentre(energies)).into_iter().zip(&energies.distances);
    points.filter(|(_, distance)| at(**distance)).map(|((_, y), _)| y).fold(f64::NEG_INFINITY, f64::max)
}

pub(crate) fn energies(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The modified energy less the initial one, for several steps (Störmer–Verlet) and for the methods at h = 0.1. There \
         are peaks when the particle is near the singularity, and the energy essentially recovers its value after this point \
         before another close encounter.",
        "The methods give rather different results, even though the maximal variation is almost the same. The Blanes–Moan \
         method seems to preserve the modified energy better after the close encounter.",
    ]);
    let steps = results.grid(&[10, 20, 30], &[10, 20]);
    let of_steps: Labelled =
        steps.iter().map(|&n| (format!("h = 1/{n}"), results.energies(&run("stormer-verlet", n), BEST))).collect();
    let all = SCHEMES.into_iter().chain([(EXACT, "exact flow")]);
    let of_schemes: Labelled =
        all.map(|(scheme, label)| (label.to_owned(), results.energies(&run(scheme, 10), BEST))).collect();
    for (title, of) in [("Störmer–Verlet, several steps", &of_steps), ("h = 1/10, several schemes", &of_schemes)] {
        in_time(&mut drawn, title, of, false);
        in_time(&mut drawn, &format!("{title}, from the apocentre"), of, true);
    }
    let verlet = of_steps.iter().find(|(label, _)| label == "h = 1/20").and_then(|(_, energies)| energies.as_ref());
    if let Some(verlet) = verlet {
        let (encounter, between) = (largest_off(verlet, |r| r < NEAR), largest_off(verlet, |r| r > FAR));
        drawn.check(
            "It essentially recovers its value after a close encounter (Störmer–Verlet, h = 1/20).",
            format!("off by up to {} where |q| < 0.8, by {} where |q| > 1.5", power(encounter), power(between)),
            between < encounter - 2.0,
        );
    }
    compare_schemes(&mut drawn, &of_schemes);
    let held = results.digits_held(&run("blanes-moan-srkn6b", 10), BEST, 200);
    drawn.digits_held("the drift of SRKN6b at h = 1/10", held);
    drawn
}

/// A chart of differences from the first state, or from the first apocentre.
fn in_time(drawn: &mut Drawn, title: &str, of: &Labelled, from_apocentre: bool) {
    let curves = of.iter().enumerate().filter_map(|(i, (label, energies))| {
        let energies = energies.as_ref()?;
        let points = off(energies, if from_apocentre { apocentre(energies) } else { 0 });
        let curve = points.into_iter().filter(|(t, _)| *t <= 40.0).collect();
        Some(if i == 4 { dashed(label.clone(), curve, 8) } else { line(label.clone(), curve, i) })
    });
    let (y, caption) = if from_apocentre {
        (
            "|modified energy − its value at the first apocentre|",
            "The start is a pericentre, where the estimate is worst; from an apocentre the changes between encounters can be \
             seen.",
        )
    } else {
        ("|modified energy − its first value|", "t ≤ 40 of [0, 100]; the start is a pericentre.")
    };
    drawn.chart(title, linear("time t"), log10_axis(y), curves.collect(), caption);
}

fn compare_schemes(drawn: &mut Drawn, of: &Labelled) {
    let change = |(label, energies): &(String, Option<Energies>)| {
        let energies = energies.as_ref()?;
        Some((label.clone(), largest_off(energies, |_| true), largest_off(energies, |r| r > FAR)))
    };
    let changes: Vec<(String, f64, f64)> = of.iter().filter_map(change).collect();
    let [verlet, .., s6, srkn, _] = &changes[..] else { return };
    let most = changes.iter().map(|(_, peak, _)| *peak);
    let (least, largest) = (most.clone().fold(f64::INFINITY, f64::min), most.fold(f64::NEG_INFINITY, f64::max));
    drawn.check(
        "The maximal variation is almost the same.",
        format!("from {} to {} at h = 1/10", power(least), power(largest)),
        largest - least < 1.0,
    );
    drawn.check(
        "Blanes and Moan's methods preserve it better after the encounter.",
        format!(
            "where |q| > 1.5 off by {} for S6 and {} for SRKN6b, {} for Störmer–Verlet",
            power(s6.2),
            power(srkn.2),
            power(verlet.2)
        ),
        s6.2 < verlet.2 && srkn.2 < verlet.2,
    );
    let rows = changes.iter().map(|(label, peak, quiet)| vec![label.clone(), power(*peak), power(*quiet)]).collect();
    let header = ["", "at all times", "where |q| > 1.5"];
    drawn.table("Largest difference from the first apocentre, h = 1/10, t ≤ 100", &header, rows);
}

pub(crate) fn orders(results: &Results) -> Drawn {
    let mut drawn = Drawn::of_paper(&[
        "The change per step, the accumulated change, and the optimal m, capped at 200, for Störmer–Verlet with h = 1/20 and \
         e = 0.6. Near the singularity quite a high m is used; away from it a lower one suffices.",
        "The ad-hoc criterion, which stops where the errors rise, gives plots that are nearly indistinguishable from those of \
         the full search.",
    ]);
    let searches = [("full search", false), ("early stop", true)]
        .map(|(label, early)| (label, results.energies(&run("stormer-verlet", 20), By::Best { largest: 200, early })));
    for (label, found) in &searches {
        found.iter().for_each(|found| with_orders(&mut drawn, label, found));
    }
    let held = results.digits_held(&run("stormer-verlet", 20), By::Best { largest: 200, early: true }, 200);
    drawn.digits_held("the drift by the early stop", held);
    let [(_, Some(full)), (_, Some(early))] = &searches else { return drawn };
    let mean = |at: &dyn Fn(f64) -> bool| {
        let of = full.distances.iter().zip(&full.orders).filter(|(r, _)| at(**r));
        let all: Vec<f64> = of.map(|(_, m)| f64::from(*m)).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let (near, far) = (mean(&|r| r < NEAR), mean(&|r| r > FAR));
    drawn.check(
        "Near the singularity a higher m is used.",
        format!("on average {near:.0} where |q| < 0.8, {far:.0} where |q| > 1.5"),
        near > far,
    );
    let (full, early) = (drift(full), drift(early));
    drawn.check(
        "The early stop gives nearly the same.",
        format!("drift {} by the early stop, {} by the full search", power(early), power(full)),
        (early - full).abs() < 0.3,
    );
    drawn
}

fn with_orders(drawn: &mut Drawn, label: &str, found: &Energies) {
    let values: Vec<_> = found.values.iter().map(|value| number(value)).collect();
    let steps = values.windows(2).map(|pair| (pair[1].clone() - &pair[0]).log10_abs());
    let shown = |points: Vec<(f64, f64)>| points.into_iter().filter(|(t, _)| *t <= 20.0).collect::<Vec<_>>();
    let per_step = found.times[1..].iter().copied().zip(steps).collect();
    let orders = found.times.iter().zip(&found.orders).map(|(t, m)| (*t, f64::from(*m))).collect();
    drawn.chart_with_right_axis(
        &format!("Störmer–Verlet, h = 1/20, e = 0.6, {label}"),
        linear("time t"),
        log10_axis("change of the modified energy"),
        Some(linear("m")),
        vec![
            line("accumulated", shown(off(found, 0)), 0),
            dashed("per step", shown(per_step), 1),
            right(dots("m", shown(orders), 2, Marker::Cross)),
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
