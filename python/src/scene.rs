//! Runs that the text of a scene describes, ensembles of trajectories among them, and the program `shadowstep`.

use std::ffi::OsString;
use std::path::PathBuf;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use shadowstep::Rational;
use shadowstep::shadow::ensemble::Outcome as Trajectory;
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::outside::reading_outside;
use shadowstep_scenes::{Error, FileOptions, Note, Outcome, Scene, source};

use crate::errors::{Fallible, usage};
use crate::values::{Json, Rows};
use crate::waiting::{Watched, waiting_for};

/// What a run of a scene gives: the rows as CSV or JSON lines, where it has no file; the summary as lines and as an
/// object; notes.
type SceneResult = (Option<String>, Option<(String, Json)>, Vec<String>);

/// Runs a scene, from a file or a text. One that names a file is written there, from its last checkpoint on.
#[pyfunction]
pub(crate) fn run_scene(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
    restart: bool,
    allow_outside: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> Fallible<SceneResult> {
    waiting_for(py, progress, None, move |watched| {
        // a text is an argument, whose paths the caller has written
        let outside = allow_outside || text.is_some();
        let source = match text {
            Some(text) => Source { path: path.display().to_string(), text },
            None => source(&path)?,
        };
        Ok(reading_outside(outside, || run(source, restart, watched))?)
    })
}

fn run(source: Source, restart: bool, watched: &Watched) -> Result<SceneResult, Error> {
    let options = FileOptions { restart, ..FileOptions::default() };
    let mut rows = Vec::new();
    let text = |rows| Some(String::from_utf8(rows).expect("rows are text"));
    let texts = |notes: &[Note]| notes.iter().map(Note::to_string).collect();
    if Ensemble::is_in(&source) {
        let ensemble = Ensemble::read(source)?;
        let continues = || watched.continues();
        let notes = texts(&ensemble.first().notes);
        if ensemble.first().output.file.is_some() {
            ensemble.run_to_file(options, continues)?;
            return Ok((None, None, notes));
        }
        ensemble.run_into(&mut rows, continues)?;
        return Ok((text(rows), None, notes));
    }
    let scene = Scene::read(source)?;
    let mut observer = watched.observer();
    observer.summarises = true;
    observer.notes.clone_from(&scene.notes);
    let outcome = match &scene.output.file {
        Some(_) => scene.run_to_file(options, &mut observer)?,
        None => scene.run_into(&mut rows, &mut observer)?,
    };
    if let Outcome::Stopped { n } = outcome {
        return Err(Error::run(format!("the run was interrupted at n = {n}"), "run the scene again"));
    }
    let rows = scene.output.file.is_none().then(|| text(rows)).flatten();
    Ok((rows, observer.summary()?, texts(&observer.notes)))
}

/// Computes the trajectories of a scene whose numbers contain the names of columns; q and p are flat.
#[pyfunction]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    text: String,
    names: Vec<String>,
    columns: Vec<Rows>,
    progress: Option<&Bound<'py, PyAny>>,
) -> Fallible<Bound<'py, PyDict>> {
    let outcomes = waiting_for(py, progress, None, move |watched| {
        let trajectories = columns.first().map_or(0, |column| column.numbers.len());
        let cell = |(name, column): (&String, &Rows), t: usize| {
            let value = column.numbers[t];
            Rational::from_float(value)
                .ok_or_else(|| usage(format!("{name} of trajectory {t} is {value}"), "give finite numbers"))
        };
        let row = |t| names.iter().zip(&columns).map(|column| cell(column, t)).collect::<Fallible<_>>();
        let rows = (0..trajectories).map(row).collect::<Fallible<Vec<Vec<Rational>>>>()?;
        let ensemble = Ensemble::with_columns(Source { path: "ensemble".to_owned(), text }, names, rows)?;
        Ok(ensemble.outcomes(|| watched.continues())?)
    })?;
    let all = PyDict::new(py);
    let numbers = |number: fn(&Trajectory) -> f64| PyArray1::from_vec(py, outcomes.iter().map(number).collect());
    all.set_item("energy_error", numbers(|outcome| outcome.energy_error.unwrap_or(f64::NAN)))?;
    all.set_item("modified_drift", numbers(|outcome| outcome.modified_drift.unwrap_or(f64::NAN)))?;
    all.set_item("energy_start", numbers(|outcome| outcome.energies[0]))?;
    all.set_item("energy_end", numbers(|outcome| outcome.energies[1]))?;
    all.set_item("modified_start", numbers(|outcome| outcome.modified_energies.map_or(f64::NAN, |[start, _]| start)))?;
    all.set_item("modified_end", numbers(|outcome| outcome.modified_energies.map_or(f64::NAN, |[_, end]| end)))?;
    all.set_item("q", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.q.clone()).collect()))?;
    all.set_item("p", PyArray1::from_vec(py, outcomes.iter().flat_map(|outcome| outcome.p.clone()).collect()))?;
    let first = |outcome: &Trajectory| outcome.not_finite.map_or(-1, |n| i64::try_from(n).unwrap_or(i64::MAX));
    all.set_item("not_finite", PyArray1::from_vec(py, outcomes.iter().map(first).collect::<Vec<i64>>()))?;
    Ok(all)
}

/// The text of a shipped scene, or of a scene of a shipped problem.
#[pyfunction]
pub(crate) fn scene_text(name: &str) -> Fallible<String> {
    Ok(shadowstep_scenes::scene_text(name)?)
}

/// Runs the program with its arguments, the first of which is its name; gives its exit code. `program` is the path
/// under which job scripts can call it.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>, program: Option<PathBuf>) -> u8 {
    py.detach(|| shadowstep_cli::main(arguments, program))
}
