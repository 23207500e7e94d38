//! Where rows go: stdout, a file that has its name when it is complete, or one that a later run can go on with.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use crate::complaint::Complaint;
use crate::output::Output;
use crate::scene::checkpoint::{Checkpoint, Identity, Saved};
use crate::scene::metadata::sha256;
use crate::scene::read::Scene;
use crate::scene::resumable::Resumable;

pub(crate) enum Target {
    Output(Output),
    Resumable(Box<Resumable>),
}

/// More than the head of any file.
const LONGEST_HEAD: u64 = 1 << 20;

/// Whether there is a file that is not the result of this scene; that is replaced, by the same bytes.
fn is_of_another(path: &Path, scene: &Scene) -> bool {
    let Ok(file) = File::open(path) else { return false };
    let mut head = Vec::new();
    let read = file.take(LONGEST_HEAD).read_to_end(&mut head);
    let hash = sha256(&scene.source.text);
    path.is_file() && (read.is_err() || !head.windows(hash.len()).any(|part| part == hash.as_bytes()))
}

impl Target {
    /// What the scene asks for, and the checkpoint to go on from.
    pub(crate) fn open(scene: &Scene, restart: bool) -> Result<(Target, Option<Checkpoint>), Complaint> {
        let Some((path, place)) = &scene.output.file else {
            return Ok((Target::Output(Output::open(None, "")?), None));
        };
        if same_file::is_same_file(path, &scene.source.path).unwrap_or(false) {
            let complaint = Complaint::usage("the file is the scene itself", "give it another name");
            return Err(scene.at(place, complaint));
        }
        if !restart && is_of_another(path, scene) {
            let sentence = format!("{} is there already, and not from this scene as it is now", path.display());
            let complaint = Complaint::usage(sentence, "give another name, move it away, or replace it by --restart");
            return Err(scene.at(place, complaint));
        }
        if scene.output.checkpoint.is_none() {
            let output = Output::open(Some(path), "file").map_err(|complaint| scene.at(place, complaint))?;
            return Ok((Target::Output(output), None));
        }
        let (file, checkpoint) =
            Resumable::open(path, Identity::of(scene), restart).map_err(|complaint| scene.at(place, complaint))?;
        Ok((Target::Resumable(Box::new(file)), checkpoint))
    }

    /// Makes a checkpoint, where there can be one.
    pub(crate) fn keep(&mut self, n: i64, state: Option<Saved>) -> Result<(), Complaint> {
        match self {
            Target::Output(_) => Ok(()),
            Target::Resumable(file) => file.keep(n, state),
        }
    }

    pub(crate) fn finish(self) -> Result<(), Complaint> {
        match self {
            Target::Output(output) => output.finish(),
            Target::Resumable(file) => file.finish(),
        }
    }

    /// After a run that cannot go on.
    pub(crate) fn give_up(self) -> Result<(), Complaint> {
        match self {
            Target::Output(_) => Ok(()),
            Target::Resumable(file) => file.give_up(),
        }
    }
}

impl Write for Target {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Target::Output(output) => output.write(bytes),
            Target::Resumable(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Target::Output(output) => output.flush(),
            Target::Resumable(file) => file.flush(),
        }
    }
}
