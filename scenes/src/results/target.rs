//! Where rows go: a writer of the caller, or a file that gets its name when it is complete.

use std::fs::File;
use std::io::{self, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use shadowstep::tables::Faults;

use crate::error::Error;
use crate::observer::Observer;
use crate::results::checkpoint::{Checkpoint, Identity, SavedState};
use crate::results::options::FileOptions;
use crate::results::resumable::{CHECKPOINT, LONGEST_HEAD, NEW_CHECKPOINT, Resumable, beside};
use crate::scene::{Format, Scene};
use crate::whole_file::destination;

pub(crate) enum Target<'a> {
    /// A writer of the caller.
    Writer(&'a mut dyn Write),
    /// The file of a scene.
    File(Box<Resumable>),
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

/// Refuses what is neither a file nor absent: to open a named pipe waits for its other end.
fn refuse_special(path: &Path) -> Result<(), Error> {
    let is_special = path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir());
    let others = [METADATA, CHECKPOINT, NEW_CHECKPOINT].map(|ending| beside(path, ending));
    let special = is_special.then_some(path).or(others.iter().map(PathBuf::as_path).find(|path| is_pipe(path)));
    special.map_or(Ok(()), |special| {
        let message = format!("{} is not a file", special.display());
        Err(Error::usage(message, "give the name of a file; rows go to stdout where no file is given"))
    })
}

#[cfg(unix)]
fn is_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    path.metadata().is_ok_and(|found| found.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_pipe(_: &Path) -> bool {
    false
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
        let path = &destination(path).map_err(at_place)?;
        refuse_special(path).map_err(at_place)?;
        if same_file::is_same_file(path, &scene.source.path).unwrap_or(false) {
            return Err(at_place(Error::usage("the file is the scene itself", "give it another name")));
        }
        match origin(path, scene) {
            Origin::Other if !options.force && !path.is_dir() => {
                let message = format!("{} already exists and is not from this unchanged scene", path.display());
                let hint = "use another name, move the file, or replace it with `force`";
                return Err(at_place(Error::usage(message, hint)));
            }
            Origin::Same if !options.restart && !Resumable::is_begun_again(path) => return Ok(None),
            _ => {}
        }
        let saves = scene.output.checkpoint.is_some();
        let opened = Resumable::open(path, Identity::of(scene), saves, options, observer);
        let (file, checkpoint) = opened.map_err(at_place)?;
        Ok(Some((Target::File(Box::new(file)), checkpoint)))
    }

    /// The name of the file when it is complete; `None` for a writer.
    pub(super) fn path(&self) -> Option<&Path> {
        match self {
            Target::Writer(_) => None,
            Target::File(file) => Some(file.path()),
        }
    }

    /// Makes a checkpoint, where there can be one.
    pub(crate) fn keep(&mut self, n: i64, state: Option<SavedState>) -> Result<(), Error> {
        match self {
            Target::Writer(_) => Ok(()),
            Target::File(file) => file.keep(n, state),
        }
    }

    pub(crate) fn finish(self) -> Result<(), Error> {
        match self {
            Target::Writer(writer) => Ok(writer.flush()?),
            Target::File(file) => file.finish(),
        }
    }

    /// After a run that failed.
    pub(crate) fn give_up(self, observer: &mut dyn Observer) -> Result<(), Error> {
        match self {
            Target::Writer(_) => Ok(()),
            Target::File(file) => file.give_up(observer),
        }
    }
}

impl Write for Target<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Target::Writer(writer) => writer.write(bytes),
            Target::File(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Target::Writer(writer) => writer.flush(),
            Target::File(file) => file.flush(),
        }
    }
}
