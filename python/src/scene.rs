//! Scenes and sweeps, as files describe them.

use std::path::PathBuf;

use pyo3::prelude::*;
use shadowstep::tables::Source;
use shadowstep_scenes::ensemble::Ensemble;
use shadowstep_scenes::outside::reading_outside;
use shadowstep_scenes::{Error, FileOptions, Note, Observer, Outcome, Scene, Summary, source};

use crate::errors::exception;
use crate::waiting::{Watched, waiting};

/// What a run of a scene gives: the rows as CSV or JSON lines, where it has no file; the summary as text and JSON;
/// notes.
type SceneResult = (Option<String>, Option<(String, String)>, Vec<String>);

/// Runs a scene, from a file or a text. One that names a file is written there, from its last checkpoint on.
#[pyfunction]
#[pyo3(signature = (path, text, *, restart, allow_outside, progress))]
pub(crate) fn run_scene(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
    restart: bool,
    allow_outside: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<SceneResult> {
    let failed = |error| exception(py, error);
    let (is_file, path_text) = (text.is_none(), path.display().to_string());
    let source = match text {
        Some(text) => Source { path: path_text, text },
        None => source(&path).map_err(failed)?,
    };
    // a text is an argument, whose paths the caller has written
    let outside = allow_outside || !is_file;
    let run = move |watched: &Watched| reading_outside(outside, || run(source, restart, watched));
    waiting(py, progress, run)?.map_err(failed)
}

fn run(source: Source, restart: bool, watched: &Watched) -> Result<SceneResult, Error> {
    let options = FileOptions { restart, ..FileOptions::default() };
    let mut rows = Vec::new();
    let text = |rows| Some(String::from_utf8(rows).expect("rows are text"));
    if Ensemble::is_in(&source) {
        let ensemble = Ensemble::read(source)?;
        let continues = || watched.continues();
        let notes = ensemble.first().notes.iter().map(Note::to_string).collect();
        if ensemble.first().output.file.is_some() {
            ensemble.run_to_file(options, continues)?;
            return Ok((None, None, notes));
        }
        ensemble.run_into(&mut rows, continues)?;
        return Ok((text(rows), None, notes));
    }
    let scene = Scene::read(source)?;
    let mut follower = Summarising::new(watched, scene.notes.clone());
    let outcome = match &scene.output.file {
        Some(_) => scene.run_to_file(options, &mut follower)?,
        None => scene.run_into(&mut rows, &mut follower)?,
    };
    if let Outcome::Stopped { n } = outcome {
        return Err(Error::run(format!("the run was interrupted at n = {n}"), "run the scene again"));
    }
    let notes = follower.notes.iter().map(Note::to_string).collect();
    Ok((scene.output.file.is_none().then(|| text(rows)).flatten(), follower.summary()?, notes))
}

/// Keeps the notes and the summary of a run.
pub(crate) struct Summarising<'a> {
    watched: &'a Watched,
    notes: Vec<Note>,
    summary: Option<Summary>,
}

impl<'a> Summarising<'a> {
    pub(crate) fn new(watched: &'a Watched, notes: Vec<Note>) -> Self {
        Summarising { watched, notes, summary: None }
    }

    /// The summary as text and JSON.
    pub(crate) fn summary(&self) -> Result<Option<(String, String)>, Error> {
        let texts = self
            .summary
            .as_ref()
            .map(|summary| -> Result<_, Error> { Ok((summary.to_string(), serde_json::to_string(summary)?)) });
        texts.transpose()
    }
}

impl Observer for Summarising<'_> {
    fn progress(&mut self, n: i64) {
        self.watched.reaches(n);
    }
    fn note(&mut self, note: &Note) {
        self.notes.push(note.clone());
    }
    fn summarises(&self) -> bool {
        true
    }
    fn summary(&mut self, summary: &Summary) {
        self.summary = Some(summary.clone());
    }
    fn stops(&mut self) -> bool {
        !self.watched.continues()
    }
}

/// The text of a shipped scene, or of a scene of a shipped problem.
#[pyfunction]
pub(crate) fn scene_text(py: Python<'_>, name: &str) -> PyResult<String> {
    shadowstep_scenes::scene_text(name).map_err(|error| exception(py, error))
}
