//! Where rows go: a writer of the caller, or a file that gets its name when it is complete.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::Value;
use shadowstep::tables::Faults;
use shadowstep_schemes::document::refuse_pipe;

use crate::files::whole_file::destination;
use crate::results::checkpoint::{Checkpoint, Identity};
use crate::results::metadata::Metadata;
use crate::results::moment::Moment;
use crate::results::numpy;
use crate::results::options::FileOptions;
use crate::results::origin::{METADATA, Origin};
use crate::results::resumable::{Begun, CHECKPOINT, NEW_CHECKPOINT, Resumable, beside};
use crate::results::row::Name;
use crate::scene::Scene;
use crate::texts::error::Error;
use crate::watch::observer::Observer;

pub(crate) enum Target<'a> {
    /// A writer of the caller.
    Writer(&'a mut dyn Write),
    /// The file of a scene.
    File(Box<Resumable>),
}

/// A scene that does not name the file which is to be written.
pub(crate) fn no_file() -> Error {
    Error::usage("the scene names no file", "add `file = \"out.csv\"` to [output]")
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
    let special =
        is_special.then_some(path).or(others.iter().map(PathBuf::as_path).find(|path| refuse_pipe(path).is_err()));
    special.map_or(Ok(()), |special| {
        let message = format!("{} is not a file", special.display());
        Err(Error::usage(message, "give the name of a file; rows go to stdout where no file is given"))
    })
}

/// What is wrong with a complete file of the scene, or with its metadata, as a sentence.
fn damage(
    scene: &Scene,
    (path, origin): (&Path, &Origin),
    identity: &Identity,
    names: &[Name],
) -> Result<Option<String>, Error> {
    let head = |bytes: u64| numpy::head(names, bytes / numpy::length(names));
    if let Some(damage) = Resumable::damage(path, identity, head)? {
        return Ok(Some(format!("{} {damage}", path.display())));
    }
    if scene.output.format.has_metadata() || *origin != Origin::Same {
        return Ok(None);
    }
    let metadata = beside(path, METADATA);
    let read = File::open(&metadata).map(|file| serde_json::from_reader::<_, Value>(BufReader::new(file)));
    let same = read?.is_ok_and(|found| Metadata::of(scene).is(&found["metadata"]));
    Ok((!same).then(|| format!("{} was changed after it was complete", metadata.display())))
}

/// The hash of the scene with an earlier end whose complete file a run of this one prolongs, or has begun to prolong.
pub(crate) fn prolonged(scene: &Scene) -> Option<String> {
    let (path, _) = scene.output.file.as_ref().filter(|_| scene.output.checkpoint.is_some())?;
    let (path, identity) = (destination(path).ok()?, Identity::of(scene));
    let earlier = Resumable::earlier_end(&path, &identity).map(|earlier| earlier.scene().to_owned());
    let earlier = earlier.or_else(|| Resumable::prolongs(&path, &identity))?;
    (Origin::of(&path, scene.output.format, &earlier, identity.inputs()) == Origin::Same).then_some(earlier)
}

impl<'a> Target<'a> {
    /// The file of the scene, and the checkpoint from which the run is resumed; `None` if the file is complete.
    pub(crate) fn open(
        scene: &Scene,
        names: &[Name],
        mut options: FileOptions,
        observer: &mut dyn Observer,
    ) -> Result<Option<(Target<'a>, Begun)>, Error> {
        let Some((path, place)) = &scene.output.file else {
            return Err(no_file());
        };
        let at_place = |error| at(scene, place, error);
        let path = &destination(path).map_err(at_place)?;
        refuse_special(path).map_err(at_place)?;
        if !scene.output.format.has_metadata() {
            destination(&beside(path, METADATA)).map_err(at_place)?;
        }
        if same_file::is_same_file(path, &scene.source.path).unwrap_or(false) {
            return Err(at_place(Error::usage("the file is the scene itself", "give it another name")));
        }
        let identity = Identity::of(scene);
        let of_scene = |hash: &str| Origin::of(path, scene.output.format, hash, identity.inputs());
        let origin = of_scene(identity.scene());
        if origin != Origin::None && !options.restart && !Resumable::is_begun_again(path) {
            match damage(scene, (path, &origin), &identity, names).map_err(at_place)? {
                None if origin == Origin::Same => return Ok(None),
                None => {}
                Some(_) if options.force => options.restart = true,
                Some(damage) => {
                    let again = if origin == Origin::Same {
                        "run the scene again with `restart`"
                    } else {
                        "replace it with `force`"
                    };
                    return Err(at_place(Error::usage(damage, format!("restore it, or {again}"))));
                }
            }
        }
        let saves = scene.output.checkpoint.is_some();
        let is_allowed = saves && !options.restart && origin == Origin::Other;
        let earlier = is_allowed.then(|| Resumable::earlier_end(path, &identity)).flatten();
        let prolongs = earlier.as_ref().map(|earlier| earlier.scene().to_owned());
        let prolongs = prolongs.or_else(|| is_allowed.then(|| Resumable::prolongs(path, &identity)).flatten());
        if prolongs.is_none_or(|earlier| of_scene(&earlier) != Origin::Same) {
            origin.check(path, options).map_err(at_place)?;
        }
        let opened = Resumable::open(path, identity, (saves, earlier), options, observer);
        let (file, begun) = opened.map_err(at_place)?;
        Ok(Some((Target::File(Box::new(file)), begun)))
    }

    /// The name of the file when it is complete; `None` for a writer.
    pub(super) fn path(&self) -> Option<&Path> {
        match self {
            Target::Writer(_) => None,
            Target::File(file) => Some(file.path()),
        }
    }

    /// Makes a checkpoint, where there can be one.
    pub(crate) fn keep(&mut self, moment: &Moment) -> Result<(), Error> {
        match self {
            Target::Writer(_) => Ok(()),
            Target::File(file) => file.keep(moment),
        }
    }

    /// The head is written, which another one may replace at the end, and after it the rows of a file that is
    /// prolonged.
    pub(crate) fn end_head(&mut self, written_anew: bool, earlier: Option<&Checkpoint>) -> Result<(), Error> {
        let Target::File(file) = self else { return Ok(()) };
        file.end_head(written_anew);
        earlier.map_or(Ok(()), |earlier| file.copy_rows(earlier))
    }

    /// The bytes after the head; 0 of a writer.
    pub(super) fn bytes_of_rows(&self) -> u64 {
        match self {
            Target::Writer(_) => 0,
            Target::File(file) => file.bytes_of_rows(),
        }
    }

    /// Completes it; a head that is known at the end replaces one of the same length.
    pub(super) fn finish(self, head: Option<&[u8]>) -> Result<(), Error> {
        match self {
            Target::Writer(writer) => Ok(writer.flush()?),
            Target::File(file) => file.finish(head),
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
