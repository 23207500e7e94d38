//! Kepler's problem: the modified energy in time, for several step sizes and schemes.

use shadowstep::Real;

use super::kepler::{FAR, NEAR, apocentre, off, run};
use crate::drawing::digits_held;
use crate::estimator::{BEST, bilinear};
use crate::figure::Figure;
use crate::measured::Energies;
use crate::numbers::{Wide, number, power};
use crate::results::Results;
use crate::run::{EXACT_FLOW, SCHEMES};
use shadowstep_studies::chart::{Axis, Chart, Curve, Mark, power_of_ten};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::verdict::Verdict;

pub(super) const FIGURE: Figure =
    Figure { name: "kepler-energies", title: "Kepler: the modified energy in time", of_paper: "figure 4", draw };

/// Runs with their labels.
type Labelled = Vec<(String, Option<Energies>)>;

/// The largest log₁₀|value − that at the first apocentre| at these distances.
fn largest_off(energies: &Energies, at: impl Fn(f64) -> bool) -> f64 {
    let points = off(energies, apocentre(energies)).into_iter().zip(&energies.distances);
    points.filter(|(_, distance)| at(**distance)).map(|((_, y), _)| y).fold(f64::NEG_INFINITY, f64::max)
}

fn draw(results: &Results) -> Finding {
    let mut finding = Finding::on(&[
        "The modified energy less the initial one, for several step sizes (Störmer–Verlet) and for the methods at h = \
         0.1. There are peaks when the particle is near the singularity, and the energy essentially recovers its \
         value after this point before another close encounter.",
        "The methods give rather different results, even though the maximal variation is almost the same. The \
         Blanes–Moan method seems to preserve the modified energy better after the close encounter.",
    ]);
    let steps = results.grid(&[10, 20, 30], &[10, 20]);
    let of_steps: Labelled =
        steps.iter().map(|&n| (format!("h = 1/{n}"), results.energies(&run("stormer-verlet", n), &BEST))).collect();
    let all = SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]);
    let of_schemes: Labelled =
        all.map(|(scheme, label)| (label.to_owned(), results.energies(&run(scheme, 10), &BEST))).collect();
    for (title, of) in [("Störmer–Verlet, several step sizes", &of_steps), ("h = 1/10, several schemes", &of_schemes)]
    {
        in_time(&mut finding, title, of, false);
        in_time(&mut finding, &format!("{title}, from the apocentre"), of, true);
    }
    let verlet = of_steps.iter().find(|(label, _)| label == "h = 1/20").and_then(|(_, energies)| energies.as_ref());
    if let Some(verlet) = verlet {
        let (encounter, between) = (largest_off(verlet, |r| r < NEAR), largest_off(verlet, |r| r > FAR));
        let lost = between - encounter;
        let verdict = match () {
            () if lost < -2.0 => Verdict::Agrees,
            () if lost > -1.0 => Verdict::Differs,
            () => Verdict::NotDecided(
                "A difference that is 10 to 100 times smaller is neither; the statement has no number that would decide.",
            ),
        };
        finding.check(
            "It essentially recovers its value after a close encounter (Störmer–Verlet, h = 1/20).",
            format!(
                "the difference is up to {} where |q| < 0.8 and up to {} where |q| > 1.5",
                power(encounter),
                power(between)
            ),
            verdict,
        );
    }
    compare_schemes(&mut finding, &of_schemes);
    staircases(results, &mut finding);
    let held = results.digits_held(&run("blanes-moan-srkn6b", 10), &BEST, 200);
    digits_held(&mut finding, "the drift of SRKN6b at h = 1/10", held);
    finding
}

/// A chart of differences from the first state, or from the first apocentre.
fn in_time(finding: &mut Finding, title: &str, of: &Labelled, from_apocentre: bool) {
    let curves = of.iter().enumerate().filter_map(|(i, (label, energies))| {
        let energies = energies.as_ref()?;
        let points = off(energies, if from_apocentre { apocentre(energies) } else { 0 });
        let curve = points.into_iter().filter(|(t, _)| *t <= 40.0).collect();
        Some(if i == 4 { Curve::dashed(label.clone(), curve, 8) } else { Curve::line(label.clone(), curve, i) })
    });
    let (y, caption) = if from_apocentre {
        (
            "|H̄ − H̄ at the first apocentre|",
            "The start is a pericentre, where the estimate is worst; relative to an apocentre the changes between \
                encounters are visible.",
        )
    } else {
        ("|H̄ − H̄ at the start|", "t ≤ 40 of [0, 100]; the start is a pericentre.")
    };
    finding.chart(Chart::new(title, Axis::linear("time t"), Axis::log10(y), curves.collect()), caption);
}

fn compare_schemes(finding: &mut Finding, of: &Labelled) {
    let change = |(label, energies): &(String, Option<Energies>)| {
        let energies = energies.as_ref()?;
        Some((label.clone(), largest_off(energies, |_| true), largest_off(energies, |r| r > FAR)))
    };
    let changes: Vec<(String, f64, f64)> = of.iter().filter_map(change).collect();
    let [verlet, .., s6, srkn, _] = &changes[..] else { return };
    // without the exact flow, which is no method
    let most = changes[..SCHEMES.len()].iter().map(|(_, peak, _)| *peak);
    let (least, largest) = (most.clone().fold(f64::INFINITY, f64::min), most.fold(f64::NEG_INFINITY, f64::max));
    let factor = 10_f64.powf(largest - least);
    finding.check(
        "The maximal variation is almost the same.",
        format!(
            "from {} to {} at h = 1/10, a factor of {factor:.1}; up to 2 counts as almost the same, more than 4 does not",
            power(least),
            power(largest)
        ),
        match () {
            () if factor <= 2.0 => Verdict::Agrees,
            () if factor > 4.0 => Verdict::Differs,
            () => Verdict::NotDecided("A factor from 2 to 4 counts as neither; the statement has no number that would decide."),
        },
    );
    finding.check(
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
    finding.table("Largest difference from the first apocentre, h = 1/10, t ≤ 100", &header, rows);
}

/// The value at each apocentre, and the time.
fn at_apocentres(energies: &Energies) -> Vec<(f64, Wide)> {
    let distances = &energies.distances;
    let is_apocentre =
        |n: &usize| distances[*n] > FAR && distances[n - 1] < distances[*n] && distances[*n] >= distances[n + 1];
    let all = (1..distances.len().saturating_sub(1)).filter(is_apocentre);
    all.map(|n| (energies.times[n], number(&energies.values[n]))).collect()
}

/// The signed change of the modified energy from apocentre to apocentre, whose jumps are at the encounters.
fn staircases(results: &Results, finding: &mut Finding) {
    let mut columns: Vec<(&str, Vec<Wide>)> = Vec::new();
    for (i, (scheme, label)) in SCHEMES.into_iter().enumerate() {
        let Some(energies) = results.energies(&run(scheme, 10), &bilinear(24)) else { continue };
        let values = at_apocentres(&energies);
        let jumps: Vec<Wide> = values.windows(2).map(|pair| &pair[1].1 - &pair[0].1).collect();
        if !jumps.is_empty() {
            staircase(finding, (label, i), &values, &jumps);
            columns.push((label, jumps));
        }
    }
    let header: Vec<&str> = ["encounter"].into_iter().chain(columns.iter().map(|(label, _)| *label)).collect();
    let row = |n: usize| {
        let jumps = columns.iter().map(|(_, jumps)| jumps.get(n).map_or("–".to_owned(), signed));
        [(n + 1).to_string()].into_iter().chain(jumps).collect()
    };
    let most = columns.iter().map(|(_, jumps)| jumps.len()).max().unwrap_or(0);
    let caption = "Jumps of the modified energy at the encounters, h = 1/10, by E_24 at the apocentres";
    finding.table(caption, &header, (0..most).map(row).collect());
}

/// t ≤ 40; the values between two encounters are those at the apocentre there.
fn staircase(finding: &mut Finding, (label, colour): (&str, usize), values: &[(f64, Wide)], jumps: &[Wide]) {
    let decade = jumps.iter().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max).floor();
    let relative = |value: &Wide| {
        let change = value - &values[0].1;
        let size = 10_f64.powf(change.log10_abs() - decade);
        if change.is_sign_negative() { -size } else { size }
    };
    let shown: Vec<_> = values.iter().filter(|(t, _)| *t <= 40.0).collect();
    let middle = |n: usize| f64::midpoint(shown[n].0, shown[n + 1].0);
    let mut points = vec![(shown[0].0, 0.0)];
    for n in 0..shown.len() - 1 {
        points.extend([n, n + 1].map(|side| (middle(n), relative(&shown[side].1))));
    }
    points.push((shown[shown.len() - 1].0, relative(&shown[shown.len() - 1].1)));
    let chart = finding.chart(
        Chart::new(
            format!("The staircase of the modified energy, h = 1/10, {label}"),
            Axis::linear("time t"),
            Axis::linear(&format!("change since the first apocentre / {}", power_of_ten(decade as i64))),
            vec![Curve::line(label, points, colour)],
        ),
        "At the apocentres, by E_24; marks: the jumps at the encounters.",
    );
    let of = |n: usize| relative(&shown[n].1);
    let mark = |n: usize| Mark::at(middle(n), signed(&jumps[n])).of_jump(of(n), of(n + 1));
    chart.marks = (0..shown.len() - 1).map(mark).collect();
}

/// +1.23e-9
fn signed(value: &Wide) -> String {
    format!("{}{}", if value.is_sign_negative() { "-" } else { "+" }, power(value.log10_abs()))
}
