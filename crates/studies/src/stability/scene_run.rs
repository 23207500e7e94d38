//! A run of a scene, as users make it: its rows, and what its summary says.

use serde::{Deserialize, Serialize};
use shadowstep::tables::Source;
use shadowstep_scenes::arithmetic::{Arithmetic, DigitsLabel};
use shadowstep_scenes::{Error, Observer, Scene, Summary};

use crate::Continues;

/// What a run reported at its end.
#[derive(Serialize, Deserialize)]
pub(crate) enum RunResult {
    /// It is complete.
    Ended(Ended),
    /// How it failed.
    Failed(String),
}

/// What a complete run has shown.
#[derive(Serialize, Deserialize)]
pub(crate) struct Ended {
    /// The largest error of H as a part of H(0); in transformed time that of H'.
    pub(crate) energy: f64,
    pub(crate) verdict: String,
    pub(crate) fine: bool,
    pub(crate) encounters: u64,
    /// The closest encounter in words.
    pub(crate) closest: String,
    /// The closest approach of two planets.
    pub(crate) hill_radii: Option<f64>,
    /// The column `energy` of all rows.
    pub(crate) energies: Vec<f64>,
    /// The last row.
    pub(crate) last: Vec<f64>,
}

impl Ended {
    /// Whether the verdict is neither fine nor undecided.
    pub(crate) fn is_reported(&self) -> bool {
        !self.fine && !self.verdict.starts_with("undecided")
    }

    /// The verdict in a word or a few.
    pub(crate) fn word(&self) -> &str {
        if self.fine { "fine" } else { self.verdict.trim_start_matches("the step size is ") }
    }
}

/// The value of the key `digits` for a number type.
pub(crate) fn digits(arithmetic: Arithmetic) -> String {
    match arithmetic.label() {
        DigitsLabel::Name(name) => format!("\"{name}\""),
        DigitsLabel::Digits(digits) => digits.to_string(),
    }
}

/// Runs a scene whose paths are relative to the folder of the program.
///
/// # Errors
/// A scene that cannot be read. A run that fails is a result.
pub(crate) fn run_scene(text: String, continues: Continues<'_>) -> Result<RunResult, Error> {
    let scene = Scene::read(Source { path: "case.toml".to_owned(), text })?;
    let (mut rows, mut watching) = (Vec::new(), Watching { continues, ended: None });
    match scene.run_into(&mut rows, &mut watching) {
        Ok(_) => {}
        Err(Error::Run { message, .. }) => return Ok(RunResult::Failed(message)),
        Err(error) => return Err(error),
    }
    // a run that was asked not to continue has no summary, and its result is dropped
    let Some(mut ended) = watching.ended else { return Ok(RunResult::Failed("the run was stopped".to_owned())) };
    let rows = String::from_utf8(rows).expect("rows are text");
    let mut lines = rows.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<_> = lines.next().unwrap_or_default().split(',').collect();
    let column = names.iter().position(|name| *name == "energy");
    for line in lines {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap_or(f64::MAX)).collect();
        ended.energies.extend(column.map(|column| row[column]));
        ended.last = row;
    }
    Ok(RunResult::Ended(ended))
}

/// Keeps the summary of a run.
struct Watching<'a> {
    continues: Continues<'a>,
    ended: Option<Ended>,
}

impl Observer for Watching<'_> {
    fn summarises(&self) -> bool {
        true
    }

    fn summary(&mut self, summary: &Summary) {
        let energy = summary.energy();
        let energy = energy.largest_relative.as_ref().unwrap_or(&energy.largest).parse::<f64>();
        self.ended = Some(Ended {
            // JSON has no infinity
            energy: energy.unwrap_or(f64::MAX).abs().min(f64::MAX),
            verdict: summary.verdict().to_owned(),
            fine: summary.is_bounded(),
            encounters: summary.encounters(),
            closest: summary.encounters_text(1),
            hill_radii: summary.interactions().and_then(|found| Some(found.closest.as_ref()?.hill_radii)),
            energies: Vec::new(),
            last: Vec::new(),
        });
    }

    fn stops(&mut self) -> bool {
        !(self.continues)(0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEPLER: &str = "problem.name = \"kepler\"\n\
        run = { scheme = \"yoshida4\", step = 0.05, steps = 400, digits = \"double\" }\n\
        output.energy = { every = 100 }\n";

    #[test]
    fn a_run_has_its_rows_and_its_summary() {
        let RunResult::Ended(ended) = run_scene(KEPLER.to_owned(), &|_| true).unwrap() else { panic!("it fails") };
        assert_eq!((ended.energies.len(), ended.energies[0]), (5, -0.5));
        assert!(ended.fine && ended.word() == "fine" && !ended.is_reported() && ended.energy < 1e-2);
    }

    #[test]
    fn a_run_that_is_stopped_has_no_result() {
        let said = run_scene(KEPLER.to_owned(), &|_| false).unwrap();
        assert!(matches!(said, RunResult::Failed(_)));
    }
}
