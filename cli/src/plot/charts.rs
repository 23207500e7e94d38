//! Curves of runs → charts.

use shadowstep_scenes::plot::{Content, Orbit, Picture};
use shadowstep_schemes::symbolic::decimal::significant;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};

use super::lines::RunOfChart;

/// The chart of a picture, the one of this number, with the curves of all runs.
pub(super) fn chart(title: &str, picture: &Picture, runs: &[RunOfChart], number: usize) -> Chart {
    let title = match runs {
        [run] => format!("{title}: {}", run.name),
        _ => title.to_owned(),
    };
    let names = names(&picture.content, runs.len());
    let all =
        runs.iter().flat_map(|run| names.iter().zip(&run.charts[number]).map(move |(name, line)| (run, name, line)));
    let all = all.enumerate().filter(|(_, (_, _, line))| picture.content != Content::Energies || !line.0.is_empty());
    let curve = |(n, (run, name, (points, every))): (usize, (&RunOfChart, &String, &(Vec<_>, u64)))| {
        let (label, points) = (label(name, run, runs.len()), points.clone());
        match picture.content {
            // of several runs the changes of H are dashed
            Content::Energies if runs.len() > 1 && n % 2 == 0 => Curve::dashed(label, points, n / 2),
            Content::Energies if runs.len() > 1 => Curve::line(label, points, n / 2),
            Content::Energies if name == ERROR => Curve::dashed(label, points, n),
            _ if *every > 1 => Curve::dots(label, points, n, Marker::Dot),
            _ => Curve::line(label, points, n),
        }
    };
    let curves: Vec<Curve> = all.map(curve).collect();
    let time = || Axis::linear("time t");
    let (x, y) = match &picture.content {
        Content::Energies if curves.iter().any(|curve| curve.label == ERROR) => {
            (time(), Axis::log10("change; estimated error"))
        }
        Content::Energies => (time(), Axis::log10("change")),
        Content::Orbit { axes: [x, y], .. } => (Axis::linear(x), Axis::linear(y)),
        Content::Distances(_) => (time(), Axis::linear("distance")),
    };
    let equal_scales = matches!(picture.content, Content::Orbit { is_in_space: true, .. });
    Chart { equal_scales, notes: notes(&picture.content, runs, number), ..Chart::new(title, x, y, curves) }
}

/// The estimated error, which a chart of one run has.
const ERROR: &str = "error of H̄";

/// What the curves of each of several runs are of.
fn names(content: &Content, runs: usize) -> Vec<String> {
    let body = |orbit: &Orbit| match &orbit.body {
        Some(body) if body.starts_with(|first: char| first.is_ascii_digit()) => format!("body {body}"),
        body => body.clone().unwrap_or_default(),
    };
    match content {
        Content::Energies => {
            ["H", "H̄", ERROR].into_iter().take(if runs > 1 { 2 } else { 3 }).map(str::to_owned).collect()
        }
        Content::Orbit { curves, .. } => curves.iter().map(body).collect(),
        Content::Distances(distances) => distances.iter().map(|distance| distance.label.clone()).collect(),
    }
}

/// The label of a curve: what it is of, and the run if there are several.
fn label(what: &str, run: &RunOfChart, runs: usize) -> String {
    match (what, runs) {
        ("", 1) => "orbit".to_owned(),
        (what, 1) => what.to_owned(),
        ("", _) => run.name.clone(),
        (what, _) => format!("{what}, {}", run.name),
    }
}

fn notes(content: &Content, runs: &[RunOfChart], number: usize) -> Vec<String> {
    let mut notes = Vec::new();
    if *content == Content::Energies {
        let changes = "|H − H(0)|, and |H̄ − H̄*| of the modified energy H̄, H̄* the one with the least estimated error; \
            changes of 0 are left out.";
        notes.push(changes.to_owned());
        if let [RunOfChart { reference: Some((t, error)), .. }] = runs {
            notes.push(format!(
                "H̄* is that at t = {}, with an estimated error of {}; smaller changes of H̄ are not resolved.",
                significant(*t, 7),
                power(*error)
            ));
        }
    }
    let every = runs.iter().flat_map(|run| &run.charts[number]).map(|(_, every)| *every).max();
    notes.extend(every.filter(|every| *every > 1).map(|every| format!("Dots: one of every {every} states.")));
    notes
}

/// 10^x with two digits, also where that is less than every `f64`.
fn power(log10: f64) -> String {
    let value = format!("{:.1e}", 10_f64.powf(log10 - log10.floor()));
    let (digits, carried) = value.split_once('e').unwrap_or((&value, "0"));
    format!("{digits}e{}", log10.floor() as i64 + carried.parse::<i64>().unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::power;

    #[test]
    fn powers_of_ten_have_two_digits() {
        for (log10, text) in [(-3.0, "1.0e-3"), (-400.5, "3.2e-401"), (0.3, "2.0e0"), (-0.001, "1.0e0")] {
            assert_eq!(power(log10), text);
        }
    }
}
