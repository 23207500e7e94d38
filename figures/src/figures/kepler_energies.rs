//! Kepler's problem: the modified energy in time, for several step sizes and schemes.

use super::kepler::{FAR, NEAR, apocentre, off, run};
use crate::calculation::Energies;
use crate::chart::{Axis, Curve};
use crate::drawing::Drawing;
use crate::estimator::BEST;
use crate::figure::Figure;
use crate::numbers::power;
use crate::results::Results;
use crate::run::{EXACT_FLOW, SCHEMES};

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-energies", title: "Kepler: the modified energy in time", draw };

/// Runs with their labels.
type Labelled = Vec<(String, Option<Energies>)>;

/// The largest log₁₀|value − that at the first apocentre| at these distances.
fn largest_off(energies: &Energies, at: impl Fn(f64) -> bool) -> f64 {
    let points = off(energies, apocentre(energies)).into_iter().zip(&energies.distances);
    points.filter(|(_, distance)| at(**distance)).map(|((_, y), _)| y).fold(f64::NEG_INFINITY, f64::max)
}

fn draw(results: &Results) -> Drawing {
    let mut drawing = Drawing::of_paper(&[
        "The modified energy less the initial one, for several step sizes (Störmer–Verlet) and for the methods at h = 0.1. There \
         are peaks when the particle is near the singularity, and the energy essentially recovers its value after this point \
         before another close encounter.",
        "The methods give rather different results, even though the maximal variation is almost the same. The Blanes–Moan \
         method seems to preserve the modified energy better after the close encounter.",
    ]);
    let steps = results.grid(&[10, 20, 30], &[10, 20]);
    let of_steps: Labelled =
        steps.iter().map(|&n| (format!("h = 1/{n}"), results.energies(&run("stormer-verlet", n), &BEST))).collect();
    let all = SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]);
    let of_schemes: Labelled =
        all.map(|(scheme, label)| (label.to_owned(), results.energies(&run(scheme, 10), &BEST))).collect();
    for (title, of) in [("Störmer–Verlet, several step sizes", &of_steps), ("h = 1/10, several schemes", &of_schemes)]
    {
        in_time(&mut drawing, title, of, false);
        in_time(&mut drawing, &format!("{title}, from the apocentre"), of, true);
    }
    let verlet = of_steps.iter().find(|(label, _)| label == "h = 1/20").and_then(|(_, energies)| energies.as_ref());
    if let Some(verlet) = verlet {
        let (encounter, between) = (largest_off(verlet, |r| r < NEAR), largest_off(verlet, |r| r > FAR));
        drawing.check(
            "It essentially recovers its value after a close encounter (Störmer–Verlet, h = 1/20).",
            format!(
                "the difference is up to {} where |q| < 0.8 and up to {} where |q| > 1.5",
                power(encounter),
                power(between)
            ),
            between < encounter - 2.0,
        );
    }
    compare_schemes(&mut drawing, &of_schemes);
    let held = results.digits_held(&run("blanes-moan-srkn6b", 10), &BEST, 200);
    drawing.digits_held("the drift of SRKN6b at h = 1/10", held);
    drawing
}

/// A chart of differences from the first state, or from the first apocentre.
fn in_time(drawing: &mut Drawing, title: &str, of: &Labelled, from_apocentre: bool) {
    let curves = of.iter().enumerate().filter_map(|(i, (label, energies))| {
        let energies = energies.as_ref()?;
        let points = off(energies, if from_apocentre { apocentre(energies) } else { 0 });
        let curve = points.into_iter().filter(|(t, _)| *t <= 40.0).collect();
        Some(if i == 4 { Curve::dashed(label.clone(), curve, 8) } else { Curve::line(label.clone(), curve, i) })
    });
    let (y, caption) = if from_apocentre {
        (
            "|modified energy − its value at the first apocentre|",
            "The start is a pericentre, where the estimate is worst; relative to an apocentre the changes between encounters are visible.",
        )
    } else {
        ("|modified energy − its first value|", "t ≤ 40 of [0, 100]; the start is a pericentre.")
    };
    drawing.chart(title, Axis::linear("time t"), Axis::log10(y), curves.collect(), caption);
}

fn compare_schemes(drawing: &mut Drawing, of: &Labelled) {
    let change = |(label, energies): &(String, Option<Energies>)| {
        let energies = energies.as_ref()?;
        Some((label.clone(), largest_off(energies, |_| true), largest_off(energies, |r| r > FAR)))
    };
    let changes: Vec<(String, f64, f64)> = of.iter().filter_map(change).collect();
    let [verlet, .., s6, srkn, _] = &changes[..] else { return };
    let most = changes.iter().map(|(_, peak, _)| *peak);
    let (least, largest) = (most.clone().fold(f64::INFINITY, f64::min), most.fold(f64::NEG_INFINITY, f64::max));
    drawing.check(
        "The maximal variation is almost the same.",
        format!("from {} to {} at h = 1/10", power(least), power(largest)),
        largest - least < 1.0,
    );
    drawing.check(
        "Blanes and Moan's methods preserve it better after the encounter.",
        format!(
            "where |q| > 1.5 the difference is up to {} for S6, {} for SRKN6b and {} for Störmer–Verlet",
            power(s6.2),
            power(srkn.2),
            power(verlet.2)
        ),
        s6.2 < verlet.2 && srkn.2 < verlet.2,
    );
    let rows = changes.iter().map(|(label, peak, far)| vec![label.clone(), power(*peak), power(*far)]).collect();
    let header = ["", "at all times", "where |q| > 1.5"];
    drawing.table("Largest difference from the first apocentre, h = 1/10, t ≤ 100", &header, rows);
}
