//! Kepler's problem: the modified energy in time, for several step sizes and schemes.

use super::kepler::{FAR, NEAR, apocentre, off, run};
use crate::chart::power_of_ten;
use crate::figures::prelude::*;

/// Runs with their labels.
type Labelled = Vec<(String, Option<Energies>)>;

/// The largest log₁₀|value − that at the first apocentre| at these distances.
fn largest_off(energies: &Energies, at: impl Fn(f64) -> bool) -> f64 {
    let points = off(energies, apocentre(energies)).into_iter().zip(&energies.distances);
    points.filter(|(_, distance)| at(**distance)).map(|((_, y), _)| y).fold(f64::NEG_INFINITY, f64::max)
}

pub(super) fn draw(d: &mut Drawing<'_>) {
    let steps = d.results.grid(&[10, 20, 30], &[10, 20]);
    let of_step = |n: u32| d.results.energies(&run("stormer-verlet", n), &BEST);
    let of_steps: Labelled = steps.iter().map(|&n| (format!("h = 1/{n}"), of_step(n))).collect();
    let all = SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]);
    let of_schemes: Labelled =
        all.map(|(scheme, label)| (label.to_owned(), d.results.energies(&run(scheme, 10), &BEST))).collect();
    for (title, of) in [("Störmer–Verlet, several step sizes", &of_steps), ("h = 1/10, several schemes", &of_schemes)]
    {
        in_time(d, "from_start", title, of);
        in_time(d, "from_apocentre", title, of);
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
        let [encounter, between] = [encounter, between].map(power);
        d.check(
            "It essentially recovers its value after a close encounter (Störmer–Verlet, h = 1/20).",
            format!("the difference is up to {encounter} where |q| < 0.8 and up to {between} where |q| > 1.5"),
            verdict,
        );
    }
    compare_schemes(d, &of_schemes);
    staircases(d);
}

/// A chart of differences from the first state, or from the first apocentre.
fn in_time(d: &mut Drawing<'_>, chart: &str, title: &str, of: &Labelled) {
    let curves = of.iter().enumerate().filter_map(|(i, (label, energies))| {
        let energies = energies.as_ref()?;
        let points = off(energies, if chart == "from_apocentre" { apocentre(energies) } else { 0 });
        let curve = points.into_iter().filter(|(t, _)| *t <= 40.0).collect();
        Some(if i == 4 { Curve::dashed(label.clone(), curve, 8) } else { Curve::line(label.clone(), curve, i) })
    });
    d.chart_of(chart, &[("of", title)], curves.collect());
}

fn compare_schemes(d: &mut Drawing<'_>, of: &Labelled) {
    let change = |(label, energies): &(String, Option<Energies>)| {
        let energies = energies.as_ref()?;
        Some((label.clone(), largest_off(energies, |_| true), largest_off(energies, |r| r > FAR)))
    };
    let changes: Vec<(String, f64, f64)> = of.iter().filter_map(change).collect();
    let [verlet, .., s6, srkn, _] = &changes[..] else { return };
    // without the exact flow, which is no method
    let (least, largest) = range(changes[..SCHEMES.len()].iter().map(|(_, peak, _)| *peak));
    let factor = 10_f64.powf(largest - least);
    d.check(
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
    d.check(
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
    d.finding.table("Largest difference from the first apocentre, h = 1/10, t ≤ 100", &header, rows);
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
fn staircases(d: &mut Drawing<'_>) {
    let mut columns: Vec<(&str, Vec<Wide>)> = Vec::new();
    for (i, (scheme, label)) in SCHEMES.into_iter().enumerate() {
        let Some(energies) = d.results.energies(&run(scheme, 10), &bilinear(24)) else { continue };
        let values = at_apocentres(&energies);
        let jumps: Vec<Wide> = values.windows(2).map(|pair| &pair[1].1 - &pair[0].1).collect();
        if !jumps.is_empty() {
            staircase(d, (label, i), &values, &jumps);
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
    d.finding.table(caption, &header, (0..most).map(row).collect());
}

/// t ≤ 40; the values between two encounters are those at the apocentre there.
fn staircase(d: &mut Drawing<'_>, (label, colour): (&str, usize), values: &[(f64, Wide)], jumps: &[Wide]) {
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
    let of = |n: usize| relative(&shown[n].1);
    let mark = |n: usize| Mark::at(middle(n), signed(&jumps[n])).of_jump(of(n), of(n + 1));
    let marks = (0..shown.len() - 1).map(mark).collect();
    let (unit, curve) = (power_of_ten(decade as i64), Curve::line(label, points, colour));
    d.chart_of("staircase", &[("scheme", label), ("unit", &unit)], vec![curve]).marks = marks;
}

/// +1.23e-9
fn signed(value: &Wide) -> String {
    format!("{}{}", if value.is_sign_negative() { "-" } else { "+" }, power(value.log10_abs()))
}
