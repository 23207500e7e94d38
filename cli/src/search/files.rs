//! The files of a search: tables, what each start found, the picture, the page.

use std::path::{Path, PathBuf};

use shadowstep_analysis::search::{Candidate, Search};
use shadowstep_scenes::Error;
use shadowstep_studies::chart::{Axis, Chart, Curve, Marker, log10_of};
use shadowstep_studies::files::{PAGE, csv, write_file, write_page, write_section};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::page::Report;

use crate::invocation;
use crate::search::rows::{Row, header, measures};

const STARTS: &str = "search.csv";
const PICTURE: &str = "search";

/// Shipped schemes that the picture names.
const MOST_NAMED: usize = 6;

/// A range of values that is wider is shown by decades.
const WIDE: f64 = 10.0;

/// The names of all files that are written.
pub(super) fn written(name: &str) -> impl Iterator<Item = String> {
    [STARTS.to_owned(), format!("{PICTURE}.svg"), PAGE.to_owned(), format!("{name}-*.toml")].into_iter()
}

/// Writes what the starts found, the picture and the page; the path of the page.
pub(super) fn write(search: &Search, candidates: &[Candidate], rows: &[Row], folder: &Path) -> Result<PathBuf, Error> {
    let command = invocation::command();
    write_file(folder, STARTS, &starts(search, candidates, &command)?)?;
    let charts = vec![(picture(search, candidates, rows), CAPTION.to_owned())];
    let mut finding = Finding { charts, ..Finding::default() };
    let met = candidates.len();
    finding.found(format!("{met} of {} random starts met the order conditions.", search.starts()));
    finding.table(
        "The schemes found, and those shipped of the same order and class.",
        &header(&search.request),
        rows.iter().map(Row::cells).collect(),
    );
    let tables = rows.iter().filter(|row| row.is_new).map(|row| format!("{}.toml", row.name));
    let title = format!("{}: schemes of order {}", search.request.name, search.request.order);
    let mut section = write_section(folder, PICTURE, &title, finding)?;
    section.files.extend([STARTS.to_owned()].into_iter().chain(tables));
    write_page(folder, &Report { sections: vec![section], ..Report::new("Search for schemes", &command) })
}

const CAPTION: &str = "What each start found, the schemes that were kept, and those shipped of the same order and \
    class. Less is better on both axes.";

fn starts(search: &Search, candidates: &[Candidate], command: &str) -> Result<String, Error> {
    let names = search.request.goal.measures().into_iter().map(|measure| measure.name().to_owned());
    let header = ["start", "stages", "goal"].map(str::to_owned).into_iter().chain(names).chain(["weights".to_owned()]);
    let row = |candidate: &Candidate| {
        let numbers =
            [candidate.start.to_string(), search.stages(candidate.start).to_string(), candidate.goal.to_string()];
        let weights = candidate.weights.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        numbers.into_iter().chain(candidate.values.iter().map(f64::to_string)).chain([weights]).collect::<Vec<_>>()
    };
    let rows = std::iter::once(header.collect()).chain(candidates.iter().map(row));
    csv(&[format!("shadowstep {}", env!("CARGO_PKG_VERSION")), format!("command: {command}")], rows)
}

/// The first two measures of all candidates, of the schemes kept, and of the shipped ones.
fn picture(search: &Search, candidates: &[Candidate], rows: &[Row]) -> Chart {
    let measures = measures(&search.request);
    let of_candidate =
        |c: &Candidate| (c.values[0], c.values.get(1).copied().unwrap_or_else(|| search.value(measures[1], c)));
    let candidates: Vec<_> = candidates.iter().map(of_candidate).collect();
    let of_row = |row: &Row| (row.values[0], row.values[1]);
    let shown: Vec<_> = rows.iter().map(of_row).collect();
    // starts that ended far off would leave little room for the others
    let end = |of: fn(&(f64, f64)) -> f64| 1.5 * shown.iter().map(of).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let (right, top) = (end(|p| p.0), end(|p| p.1));
    let near = candidates.into_iter().filter(|(x, y)| *x <= right && *y <= top).collect::<Vec<_>>();
    let is_wide = |of: fn(&(f64, f64)) -> f64| {
        let values = || near.iter().chain(&shown).map(of).filter(|value| *value > 0.0);
        values().fold(0.0, f64::max) > WIDE * values().fold(f64::INFINITY, f64::min)
    };
    let logs = (is_wide(|p| p.0), is_wide(|p| p.1));
    let axis = |n: usize, is_log: bool| {
        let name = measures[n].name();
        if is_log { Axis::log10(name) } else { Axis::linear(name) }
    };
    let mut curves = vec![Curve::dots("starts", log10_of(&near, logs), 0, Marker::Dot)];
    let mut colour = 0;
    let mut add = |label: String, points: &[(f64, f64)], marker| {
        colour += 1;
        curves.push(Curve::dots(label, log10_of(points, logs), colour, marker));
    };
    for row in rows.iter().filter(|row| row.is_new) {
        add(row.name.clone(), &[of_row(row)], Marker::Diamond);
    }
    for row in rows.iter().filter(|row| !row.is_new).take(MOST_NAMED) {
        add(row.name.clone(), &[of_row(row)], Marker::Square);
    }
    let title = format!("{}: what {} starts found", search.request.name, search.starts());
    Chart::new(title, axis(0, logs.0), axis(1, logs.1), curves)
}
