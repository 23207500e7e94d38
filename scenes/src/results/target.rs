//! Where rows go: a writer of the caller, a file that gets its name when it is complete, or one that can be resumed.

use std::fs::File;
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::Path;

use shadowstep::tables::Faults;

use crate::error::Error;
use crate::observer::Observer;
use crate::results::checkpoint::{Checkpoint, Identity, SavedState};
use crate::results::options::FileOptions;
use crate::results::resumable::{LONGEST_HEAD, Resumable, beside};
use crate::scene::{Format, Scene};
use crate::whole_file::WholeFile;

pub(crate) enum Target<'a> {
    /// A writer of the caller.
    Writer(&'a mut dyn Write),
    /// A file without checkpoints.
    File(WholeFile),
    /// A file with checkpoints.
    Resumable(Box<Resumable>),
}

/// The extension of the file with the metadata of JSON lines.
pub(super) const METADATA: &str = "metadata.json";

/// Whose result a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    /// There is no file.
    None,
    /// This scene, these tables and this version: a run would write the same bytes again.
    Same,
    /// This scene with other tables or another version.
    SameScene,
    /// Something else, or a changed scene.
    Other,
}

/// Whose result the file of a scene is, by the hashes in its metadata.
fn origin(path: &Path, scene: &Scene) -> Origin {
    let metadata = match scene.output.format {
        Format::Csv => path.to_owned(),
        Format::JsonLines => beside(path, METADATA),
    };
    let is_there = |path: &Path| path.symlink_metadata().is_ok();
    if !is_there(path) && !is_there(&metadata) {
        return Origin::None;
    }
    let mut head = Vec::new();
    let read = File::open(&metadata).and_then(|file| file.take(LONGEST_HEAD).read_to_end(&mut head));
    let has = |text: &String| head.windows(text.len()).any(|part| part == text.as_bytes());
    let identity = Identity::of(scene);
    match read {
        Ok(_) if !has(identity.scene()) => Origin::Other,
        Ok(_) if identity.others().all(has) && is_there(path) => Origin::Same,
        Ok(_) => Origin::SameScene,
        Err(_) => Origin::Other,
    }
}

/// An error about a value of the scene, at its place.
fn at(scene: &Scene, place: &Range<usize>, error: Error) -> Error {
    match error {
        Error::Usage { message, hint } => Faults(vec![scene.source.fault(place, message).hint(hint)]).into(),
        other => other,
    }
}

impl<'a> Target<'a> {
    /// The file of the scene, and the checkpoint from which the run is resumed; `None` if the file is complete.
    pub(crate) fn open(
        scene: &Scene,
        options: FileOptions,
        observer: &mut dyn Observer,
    ) -> Result<Option<(Target<'a>, Option<Checkpoint>)>, Error> {
        let Some((path, place)) = &scene.output.file else {
            return Err(Error::usage("the scene names no file", "add `file = \"out.csv\"` to [output]"));
        };
        let at_place = |error| at(scene, place, error);
        if same_file::is_same_file(path, &scene.source.path).unwrap_or(false) {
            return Err(at_place(Error::usage("the file is the scene itself", "give it another name")));
        }
        match origin(path, scene) {
            Origin::Other if !options.force && !path.is_dir() => {
                let message = format!("{} already exists and is not from this unchanged scene", path.display());
                let hint = "use another name, move the file, or replace it with --force";
                return Err(at_place(Error::usage(message, hint)));
            }
            Origin::Same if !options.restart && !Resumable::has_checkpoint(path) => return Ok(None),
            _ => {}
        }
        if scene.output.checkpoint.is_none() {
            return Ok(Some((Target::File(WholeFile::create(path, "file").map_err(at_place)?), None)));
        }
        let opened = Resumable::open(path, Identity::of(scene), options, observer);
        let (file, checkpoint) = opened.map_err(at_place)?;
        Ok(Some((Target::Resumable(Box::new(file)), checkpoint)))
    }

    /// The name of the file when it is complete; `None` for a writer.
    pub(super) fn path(&self) -> Option<&Path> {
        match self {
            Target::Writer(_) => None,
            Target::File(file) => Some(file.path()),
            Target::Resumable(file) => Some(file.path()),
        }
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
