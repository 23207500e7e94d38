//! The curves of a run from the file that it has written: CSV, JSON lines or records of NumPy.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use serde::Deserialize;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::{Error, Format, Scene};
use shadowstep_schemes::symbolic::decimal::from_text;

use super::{Plots, Values};

/// A row with the texts of its numbers; what is not there is `None`.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Row {
    n: u64,
    t: String,
    energy: Option<String>,
    modified_energy: Option<String>,
    estimate: Option<String>,
    q: Vec<String>,
    p: Vec<String>,
}

/// Adds the curves of a scene's run from its complete file.
///
/// # Errors
/// A file that cannot be read, or has other rows than those of the scene.
pub(crate) fn of_rows(plots: &mut Plots, scene: &Scene, path: &Path, name: String) -> Result<(), Error> {
    scene.arithmetic.compute(Reading { plots, scene, path, name })
}

struct Reading<'a> {
    plots: &'a mut Plots,
    scene: &'a Scene,
    path: &'a Path,
    name: String,
}

impl Computation for Reading<'_> {
    type Output = Result<(), Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Reading { plots, scene, path, name } = self;
        let steps = match scene.steps() {
            Some(steps) => steps,
            None => last_row(scene, path)?,
        };
        let mut run = plots.run::<N>(name, steps);
        let damaged = |n: u64| {
            let message = format!("{}: the row after n = {n} cannot be read, so there is no plot", path.display());
            Error::usage(message, "--restart runs the scene again")
        };
        let number = |text: &str| from_text(text).ok().map(|exact| N::from_rational(&exact, context));
        let mut last = 0;
        each_row(scene, path, |row| {
            let row = row.ok_or_else(|| damaged(last))?;
            last = row.n;
            let texts = [&row.energy, &row.modified_energy, &row.estimate];
            let numbers = texts.map(|text| text.as_deref().map(number));
            if numbers.iter().any(|number| matches!(number, Some(None))) {
                return Err(damaged(last));
            }
            let [energy, modified_energy, estimate] = numbers.map(Option::flatten);
            let state: Result<Vec<f64>, _> = row.q.iter().chain(&row.p).map(|text| text.parse()).collect();
            let state = state.ok().filter(|state| state.is_empty() || state.len() == 2 * scene.system.q.len());
            run.take(&Values {
                n: row.n,
                t: row.t.parse().map_err(|_| damaged(last))?,
                energy: energy.as_ref(),
                modified_energy: modified_energy.as_ref(),
                estimate: estimate.as_ref(),
                state: &state.ok_or_else(|| damaged(last))?,
            });
            Ok(())
        })?;
        plots.add(run);
        Ok(())
    }
}

/// The n of the last row.
fn last_row(scene: &Scene, path: &Path) -> Result<u64, Error> {
    let mut last = 0;
    each_row(scene, path, |row| {
        last = row.map_or(last, |row| row.n);
        Ok(())
    })?;
    Ok(last)
}

/// Gives each row, or `None` for one that cannot be read, to `take`.
fn each_row(scene: &Scene, path: &Path, mut take: impl FnMut(Option<Row>) -> Result<(), Error>) -> Result<(), Error> {
    let file = File::open(path)?;
    match scene.output.format {
        Format::JsonLines => BufReader::new(file).lines().try_for_each(|line| take(serde_json::from_str(&line?).ok())),
        Format::Csv => {
            let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(file);
            let row = RowOfCells::new(scene, &reader.headers()?.iter().map(str::to_owned).collect::<Vec<_>>());
            reader
                .records()
                .try_for_each(|record| take(record.ok().and_then(|record| row.of(|number| record.get(number)))))
        }
        Format::Numpy => {
            let row = RowOfCells::new(scene, &scene.column_names());
            let mut rows = scene.numpy_rows(path)?;
            rows.try_for_each(|cells| {
                take(cells.ok().and_then(|cells| row.of(|number| cells.get(number).map(String::as_str))))
            })
        }
    }
}

/// The places of columns.
struct RowOfCells {
    known: [Option<usize>; 5],
    q: Vec<Option<usize>>,
    p: Vec<Option<usize>>,
}

impl RowOfCells {
    fn new(scene: &Scene, header: &[String]) -> Self {
        let column = |name: &str| header.iter().position(|known| known == name);
        let all = |names: &[String]| names.iter().map(|name| column(name)).collect::<Vec<_>>();
        let known = ["n", "t", "energy", "modified_energy", "estimate"].map(column);
        RowOfCells { known, q: all(&scene.system.coordinates), p: all(&scene.system.momenta) }
    }

    /// The row of these cells.
    fn of<'c>(&self, cell: impl Fn(usize) -> Option<&'c str>) -> Option<Row> {
        let text = |number: &Option<usize>| number.and_then(&cell).filter(|text| !text.is_empty()).map(str::to_owned);
        let [n, t, energy, modified_energy, estimate] = self.known.each_ref().map(text);
        let state = |numbers: &[Option<usize>]| numbers.iter().filter_map(text).collect::<Vec<_>>();
        let p = state(&self.p);
        // a coordinate may be t, which rows without states have, too
        let q = if p.is_empty() { Vec::new() } else { state(&self.q) };
        Some(Row { n: n?.parse().ok()?, t: t?, energy, modified_energy, estimate, q, p })
    }
}
