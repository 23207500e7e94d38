//! Runs that files describe, and the program `shadowstep`.

use std::ffi::OsString;
use std::path::PathBuf;

use pyo3::prelude::*;
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::outside::reading_outside;
use shadowstep_scenes::{Error, FileOptions, Note, Outcome, Scene, source};

use crate::errors::Fallible;
use crate::json::Json;
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
