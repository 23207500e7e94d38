//! Where rows go: a writer of the caller, a file that gets its name when it is complete, or one that can be resumed.

use std::fs::File;
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::Path;

use shadowstep::tables::Faults;

use crate::error::Error;
use crate::observer::Observer;
use crate::results::checkpoint::{Checkpoint, Identity, SavedState};
use crate::results::metadata::sha256;
use crate::results::resumable::Resumable;
use crate::scene::Scene;
use crate::whole_file::WholeFile;

pub(crate) enum Target<'a> {
    /// A writer of the caller.
    Writer(&'a mut dyn Write),
    /// A file without checkpoints.
    File(WholeFile),
    /// A file with checkpoints.
    Resumable(Box<Resumable>),
}

/// Longer than the metadata of any file.
const LONGEST_HEAD: u64 = 1 << 20;

/// Whether there is a file that is not the result of this scene. A result of this scene may be replaced: by the same bytes.
fn is_of_another(path: &Path, scene: &Scene) -> bool {
    let Ok(file) = File::open(path) else { return false };
    let mut head = Vec::new();
    let read = file.take(LONGEST_HEAD).read_to_end(&mut head);
    let hash = sha256(&scene.source.text);
    path.is_file() && (read.is_err() || !head.windows(hash.len()).any(|part| part == hash.as_bytes()))
}

/// An error about a value of the scene, at its place.
fn at(scene: &Scene, place: &Range<usize>, error: Error) -> Error {
    match error {
        Error::Usage { message, hint } => Faults(vec![scene.source.fault(place, message).hint(hint)]).into(),
        other => other,
    }
}

impl<'a> Target<'a> {
    /// The file of the scene, and the checkpoint from which the run is resumed.
    pub(crate) fn open(
        scene: &Scene,
        restart: bool,
        observer: &mut dyn Observer,
    ) -> Result<(Target<'a>, Option<Checkpoint>), Error> {
        let Some((path, place)) = &scene.output.file else {
            return Err(Error::usage("the scene names no file", "add `file = \"out.csv\"` to [output]"));
        };
        let at_place = |error| at(scene, place, error);
        if same_file::is_same_file(path, &scene.source.path).unwrap_or(false) {
            return Err(at_place(Error::usage("the file is the scene itself", "give it another name")));
        }
        if !restart && is_of_another(path, scene) {
            let message = format!("{} already exists and is not from this unchanged scene", path.display());
            let hint = "use another name, move the file, or replace it with --restart";
            return Err(at_place(Error::usage(message, hint)));
        }
        if scene.output.checkpoint.is_none() {
            return Ok((Target::File(WholeFile::create(path, "file").map_err(at_place)?), None));
        }
        let opened = Resumable::open(path, Identity::of(scene), restart, observer);
        let (file, checkpoint) = opened.map_err(at_place)?;
        Ok((Target::Resumable(Box::new(file)), checkpoint))
    }

    /// Makes a checkpoint, where there can be one.
    pub(crate) fn keep(&mut self, n: i64, state: Option<SavedState>) -> Result<(), Error> {
        match self {
            Target::Writer(_) | Target::File(_) => Ok(()),
            Target::Resumable(file) => file.keep(n, state),
        }
    }

    pub(crate) fn finish(self) -> Result<(), Error> {
        match self {
            Target::Writer(writer) => Ok(writer.flush()?),
            Target::File(file) => file.finish(),
            Target::Resumable(file) => file.finish(),
        }
    }

    /// After a run that failed.
    pub(crate) fn give_up(self, observer: &mut dyn Observer) -> Result<(), Error> {
        match self {
            Target::Writer(_) | Target::File(_) => Ok(()),
            Target::Resumable(file) => file.give_up(observer),
        }
    }
}

impl Write for Target<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Target::Writer(writer) => writer.write(bytes),
            Target::File(file) => file.write(bytes),
            Target::Resumable(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Target::Writer(writer) => writer.flush(),
            Target::File(file) => file.flush(),
            Target::Resumable(file) => file.flush(),
        }
    }
}
