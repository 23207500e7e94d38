//! Curves of runs → charts.

use shadowstep_scenes::plot::{Content, Distance, Orbit, Picture};
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker};
use shadowstep_symbolic::decimal::significant;

use super::lines::{Lines, RunOfChart};

/// The chart of a picture, the one of this number, with the curves of all runs.
pub(super) fn chart(title: &str, picture: &Picture, runs: &[RunOfChart], number: usize) -> Chart {
    let runs: Vec<(&RunOfChart, &Lines)> = runs.iter().map(|run| (run, &run.lines[number])).collect();
    let title = match &runs[..] {
        [(run, _)] => format!("{title}: {}", run.name),
        _ => title.to_owned(),
    };
    match &picture.content {
        Content::Energies => energies(title, &runs),
        Content::Orbit { axes, curves, is_in_space } => orbits(title, &runs, axes, curves, *is_in_space),
        Content::Distances(distances) => in_time(title, &runs, distances),
    }
}

/// The changes of one run with the estimated error; of several runs those of H are dashed.
fn energies(title: String, runs: &[(&RunOfChart, &Lines)]) -> Chart {
    let mut curves = Vec::new();
    for (colour, (run, lines)) in runs.iter().enumerate() {
        let Lines::Energies { energy, modified_energy, estimate, .. } = lines else { continue };
        let name = |text: &str| if runs.len() > 1 { format!("{text}, {}", run.name) } else { text.to_owned() };
        let drawn = match runs.len() {
            1 => vec![
                Curve::line("H", energy.clone(), 0),
                Curve::line("H̄", modified_energy.clone(), 1),
                Curve::dashed("error of H̄", estimate.clone(), 2),
            ],
            _ => vec![
                Curve::dashed(name("H"), energy.clone(), colour),
                Curve::line(name("H̄"), modified_energy.clone(), colour),
            ],
        };
        curves.extend(drawn.into_iter().filter(|curve| !curve.points.is_empty()));
    }
    let label = match curves.iter().any(|curve| curve.label.starts_with("error")) {
        true => "change; estimated error",
        false => "change",
    };
    let mut chart = Chart::new(title, Axis::linear("time t"), Axis::log10(label), curves);
    chart.notes = vec![
        "|H − H(0)|, and |H̄ − H̄*| of the modified energy H̄, H̄* the one with the least estimated error; changes of \
            0 are left out."
            .to_owned(),
    ];
    if let [(_, Lines::Energies { reference: Some((t, error)), .. })] = runs {
        let error = power(*error);
        chart.notes.push(format!(
            "H̄* is that at t = {}, with an estimated error of {error}; smaller changes of H̄ are not resolved.",
            significant(*t, 7)
        ));
    }
    chart
}

/// 10^x with two digits, also where that is less than every `f64`.
fn power(log10: f64) -> String {
    let value = format!("{:.1e}", 10_f64.powf(log10 - log10.floor()));
    let (digits, carried) = value.split_once('e').unwrap_or((&value, "0"));
    format!("{digits}e{}", log10.floor() as i64 + carried.parse::<i64>().unwrap_or(0))
}

fn orbits(
    title: String,
    runs: &[(&RunOfChart, &Lines)],
    axes: &[String; 2],
    orbits: &[Orbit],
    is_in_space: bool,
) -> Chart {
    let mut curves = Vec::new();
    let mut every = 1;
    for (run, lines) in runs {
        let Lines::Orbits(all) = lines else { continue };
        for (orbit, (points, of_states)) in orbits.iter().zip(all) {
            let body = orbit.body.as_ref().map(|body| match body.starts_with(|first: char| first.is_ascii_digit()) {
                true => format!("body {body}"),
                false => body.clone(),
            });
            let label = named(&body.unwrap_or_default(), run, runs.len());
            let curve = match of_states {
                1 => Curve::line(label, points.clone(), curves.len()),
                _ => Curve::dots(label, points.clone(), curves.len(), Marker::Dot),
            };
            every = every.max(*of_states);
            curves.push(curve);
        }
    }
    let [x, y] = axes.each_ref().map(|name| Axis::linear(name));
    let mut chart = Chart::new(title, x, y, curves);
    chart.equal_scales = is_in_space;
    if every > 1 {
        chart.notes = vec![format!("Dots: one of every {every} states.")];
    }
    chart
}

fn in_time(title: String, runs: &[(&RunOfChart, &Lines)], distances: &[Distance]) -> Chart {
    let mut curves = Vec::new();
    for (run, lines) in runs {
        let Lines::Distances(all) = lines else { continue };
        for (distance, points) in distances.iter().zip(all) {
            curves.push(Curve::line(named(&distance.label, run, runs.len()), points.clone(), curves.len()));
        }
    }
    Chart::new(title, Axis::linear("time t"), Axis::linear("distance"), curves)
}

/// The label of a curve: what it is of, and the run if there are several.
fn named(what: &str, run: &RunOfChart, runs: usize) -> String {
    match (what, runs) {
        ("", 1) => "orbit".to_owned(),
        (what, 1) => what.to_owned(),
        ("", _) => run.name.clone(),
        (what, _) => format!("{what}, {}", run.name),
    }
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
