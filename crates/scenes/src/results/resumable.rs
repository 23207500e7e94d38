//! The file of a scene, whose run can be resumed after it was stopped at any moment.
//!
//! Rows go to `FILE.partial`. `FILE.checkpoint` has the length of its valid bytes and the state from which the run is
//! resumed. It is written after those bytes are on the disk, under another name until it is complete. When all rows are
//! written, `FILE.partial` is renamed to `FILE`. The last checkpoint, that of the last state, stays beside it: a run of
//! the same scene with a later end begins with the rows of `FILE`, and goes on from there. A run holds a lock on
//! `FILE.partial`, which the system releases however the run ends. Rows that no checkpoint belongs to are removed when
//! the run stops.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use shadowstep_schemes::document::read_text;

use crate::files::lock::{LockError, open_itself, open_locked};
use crate::files::temporary::Temporary;
use crate::files::whole_file::{cannot_write, sync_folder};
use crate::results::checkpoint::{Checkpoint, Identity};
use crate::results::metadata::hexadecimal;
use crate::results::moment::Moment;
use crate::results::numpy::MAGIC;
use crate::results::options::FileOptions;
use crate::run::note::Note;
use crate::texts::error::{Error, NotWritten, not_written};
use crate::watch::observer::Observer;

/// The extension of rows that are not complete.
const PARTIAL: &str = "partial";

/// The extension of a checkpoint.
pub(super) const CHECKPOINT: &str = "checkpoint";

/// The extension of a checkpoint that is being written.
pub(super) const NEW_CHECKPOINT: &str = "checkpoint.new";

/// How a checkpoint begins.
const HEAD_OF_CHECKPOINT: &str = "{\n  \"checkpoint\": {";

/// How a file of CSV begins.
const HEAD_OF_CSV: &str = "# shadowstep: ";

/// How a row of JSON lines begins.
const HEAD_OF_ROW: &str = "{\"n\":";

/// The most bytes of a checkpoint.
const LARGEST_CHECKPOINT: u64 = 256 << 20;

/// The metadata at the beginning of a file are shorter.
pub(super) const LONGEST_HEAD: u64 = 1 << 20;

/// The partial file of a run.
pub(crate) struct Resumable {
    identity: Identity,
    path: PathBuf,
    partial: PathBuf,
    checkpoint: PathBuf,
    /// Whether checkpoints are made.
    saves: bool,
    /// The partial file while there is no checkpoint; removed before the lock of `file` ends.
    temporary: Option<Temporary>,
    file: BufWriter<File>,
    bytes: u64,
    /// The length of the head.
    head: u64,
    /// From where on bytes are hashed.
    hashed_from: u64,
    hash: Sha256,
    /// Whether the last checkpoint is at the last state.
    is_kept_at_end: bool,
    /// The hash of the scene whose file is prolonged.
    prolongs: Option<String>,
}

/// Where a run begins.
pub(crate) enum Begun {
    /// At t = 0.
    Anew,
    /// At a checkpoint, whose rows are in the partial file.
    Resumed(Checkpoint),
    /// At the last state of the same scene with an earlier end, whose rows are in the complete file.
    Prolonged(Checkpoint),
}

impl Begun {
    pub(crate) fn checkpoint(&self) -> Option<&Checkpoint> {
        match self {
            Begun::Anew => None,
            Begun::Resumed(checkpoint) | Begun::Prolonged(checkpoint) => Some(checkpoint),
        }
    }
}

impl Resumable {
    /// Creates the file, or opens it at its checkpoint. With `restart` it is always created. A partial file that has no
    /// checkpoint and is not from this program is replaced with `force` only. Without `saves`, no checkpoints are made.
    /// `earlier` is the checkpoint from which a complete file is prolonged.
    pub(crate) fn open(
        path: &Path,
        identity: Identity,
        (saves, earlier): (bool, Option<Checkpoint>),
        FileOptions { restart, force }: FileOptions,
        observer: &mut dyn Observer,
    ) -> Result<(Resumable, Begun), Error> {
        let [partial, checkpoint] = [PARTIAL, CHECKPOINT].map(|ending| beside(path, ending));
        let is_empty = |file: &File| file.metadata().is_ok_and(|file| file.len() == 0);
        let (temporary, file) = Temporary::open(&partial, || locked(path, &partial), is_empty)?;
        let length = file.metadata()?.len();
        let mut resumable = Resumable {
            identity,
            path: path.to_owned(),
            partial,
            checkpoint,
            saves,
            temporary,
            file: BufWriter::new(file),
            bytes: 0,
            head: 0,
            hashed_from: 0,
            hash: Sha256::new(),
            is_kept_at_end: false,
            prolongs: None,
        };
        let found = match resumable.checkpoint.try_exists()? {
            false if force || resumable.is_own_partial(length)? => None,
            false => return Err(not_own(&resumable.partial)),
            true if restart => None,
            true if earlier.is_some() => None,
            // that of a complete file
            true if length == 0 && path.exists() => None,
            // its partial file was removed
            true if length == 0 => {
                observer.note(&Note::CheckpointWithoutRows { checkpoint: resumable.checkpoint.clone() });
                None
            }
            true => Some(resumable.resume(length)?),
        };
        if let Some(found) = found {
            return Ok((resumable, Begun::Resumed(found)));
        }
        let partial = &resumable.partial;
        resumable.temporary.get_or_insert_with(|| Temporary::of(partial));
        resumable.file.get_ref().set_len(0)?;
        resumable.file.get_mut().rewind()?;
        match earlier {
            Some(earlier) => {
                resumable.prolongs = Some(earlier.scene().to_owned());
                Ok((resumable, Begun::Prolonged(earlier)))
            }
            // the checkpoint of a file that is prolonged stays until there is another one
            None => resumable.remove_checkpoint().map(|()| (resumable, Begun::Anew)),
        }
    }

    /// The rows begin here: the head is written, which another one [replaces](Resumable::finish) at the end where that
    /// is `written_anew`.
    pub(crate) fn end_head(&mut self, written_anew: bool) {
        self.head = self.bytes;
        if written_anew {
            self.hashed_from = self.bytes;
            self.hash = Sha256::new();
        }
    }

    /// Writes the rows of the file that is prolonged.
    pub(crate) fn copy_rows(&mut self, earlier: &Checkpoint) -> Result<(), Error> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(earlier.head))?;
        io::copy(&mut BufReader::new(file).take(earlier.bytes - earlier.head), self)?;
        Ok(())
    }

    /// The file's name when it is complete.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the run of a complete file was begun again.
    pub(crate) fn is_begun_again(path: &Path) -> bool {
        fs::metadata(beside(path, PARTIAL)).is_ok_and(|partial| partial.len() > 0)
    }

    /// The last checkpoint of a complete file that is of the same scene with an earlier end, if the file was not
    /// changed.
    pub(crate) fn earlier_end(path: &Path, identity: &Identity) -> Option<Checkpoint> {
        let text = read_text(beside(path, CHECKPOINT), LARGEST_CHECKPOINT).ok()?;
        let earlier = Checkpoint::of_earlier_end(&text, identity)?;
        let hash = hash_of(&mut File::open(path).ok()?, &earlier).ok()?;
        (hexadecimal(&hash.finalize()) == earlier.sha256).then_some(earlier)
    }

    /// In what a complete file differs from its last checkpoint, as the predicate of a sentence; `None` where there is
    /// no such checkpoint. `head` is what begins a file of this number of bytes after its head, in formats whose head
    /// is written at the end.
    pub(crate) fn damage(
        path: &Path,
        identity: &Identity,
        head: impl Fn(u64) -> Vec<u8>,
    ) -> Result<Option<String>, Error> {
        let last = read_text(beside(path, CHECKPOINT), LARGEST_CHECKPOINT).ok();
        let last = last.and_then(|text| Checkpoint::read(&text, identity).ok());
        let Some(last) = last.filter(|last| last.is_last) else { return Ok(None) };
        let Ok(mut file) = File::open(path) else { return Ok(None) };
        let length = file.metadata()?.len();
        if length != last.bytes {
            return Ok(Some(format!("has {length} bytes, and had {} when it was complete", last.bytes)));
        }
        let mut begin = vec![0; usize::try_from(last.hashed_from).unwrap_or_default()];
        file.read_exact(&mut begin)?;
        let is_whole = begin.is_empty() || begin == head(last.bytes - last.head);
        let is_same = is_whole && hexadecimal(&hash_of(&mut file, &last)?.finalize()) == last.sha256;
        Ok((!is_same).then(|| "was changed after it was complete: its bytes have another hash".to_owned()))
    }

    /// The hash of the scene whose complete file a run that was stopped has begun to prolong.
    pub(crate) fn prolongs(path: &Path, identity: &Identity) -> Option<String> {
        let text = read_text(beside(path, CHECKPOINT), LARGEST_CHECKPOINT).ok()?;
        Checkpoint::read(&text, identity).ok()?.prolongs
    }

    /// Whether the partial file is from a run that wrote no checkpoint, or removed it.
    fn is_own_partial(&mut self, length: u64) -> Result<bool, Error> {
        let mut head = Vec::new();
        self.file.get_ref().take(HEAD_OF_CSV.len() as u64).read_to_end(&mut head)?;
        let heads = [HEAD_OF_ROW.as_bytes(), HEAD_OF_CSV.as_bytes(), MAGIC];
        Ok(length == 0 || heads.iter().any(|own| head.starts_with(own) || own.starts_with(&head)))
    }

    fn resume(&mut self, length: u64) -> Result<Checkpoint, Error> {
        let text = read_text(&self.checkpoint, LARGEST_CHECKPOINT).map_err(|error| match error.kind() {
            ErrorKind::FileTooLarge => {
                self.refused(&self.checkpoint, &format!("is longer than {} MiB", LARGEST_CHECKPOINT >> 20))
            }
            ErrorKind::InvalidData => self.refused(&self.checkpoint, "is damaged"),
            _ => error.into(),
        })?;
        let checkpoint = Checkpoint::read(&text, &self.identity).map_err(|why| self.refused(&self.checkpoint, &why))?;
        let file = self.file.get_mut();
        if length < checkpoint.bytes {
            return Err(self.refused(&self.partial, "is shorter than its checkpoint states"));
        }
        self.hash = hash_of(file, &checkpoint)?;
        if hexadecimal(&self.hash.clone().finalize()) != checkpoint.sha256 {
            return Err(self.refused(&self.partial, "was changed after its checkpoint was written"));
        }
        // rows after the checkpoint are written again
        file.set_len(checkpoint.bytes)?;
        file.seek(SeekFrom::Start(checkpoint.bytes))?;
        (self.bytes, self.head, self.hashed_from) = (checkpoint.bytes, checkpoint.head, checkpoint.hashed_from);
        self.is_kept_at_end = checkpoint.is_last;
        self.prolongs.clone_from(&checkpoint.prolongs);
        Ok(checkpoint)
    }

    fn refused(&self, file: &Path, why: &str) -> Error {
        let hint = "discard it and begin again with `restart`, or restore what it was made with";
        Error::usage(format!("{} {why}, so the run cannot be resumed from it", file.display()), hint)
    }

    /// Writes a checkpoint: all rows up to n are written, and the run can be resumed from the state.
    pub(crate) fn keep(&mut self, moment: &Moment) -> Result<(), Error> {
        if !self.saves {
            return Ok(());
        }
        let synchronized = self.file.flush().and_then(|()| self.file.get_ref().sync_data());
        synchronized.map_err(|error| self.not_written(&self.partial, error))?;
        let sha256 = hexadecimal(&self.hash.clone().finalize());
        let (identity, prolongs) = (self.identity.clone(), self.prolongs.clone());
        let Moment { n, is_last, state, vectors, summary } = moment.clone();
        let (bytes, head, hashed_from) = (self.bytes, self.head, self.hashed_from);
        let checkpoint =
            Checkpoint { identity, n, is_last, bytes, head, hashed_from, sha256, state, prolongs, vectors, summary };
        let text = checkpoint.to_text();
        if text.len() as u64 > LARGEST_CHECKPOINT {
            let message = format!("a checkpoint of this run is longer than {} MiB", LARGEST_CHECKPOINT >> 20);
            return Err(Error::usage(message, "leave `checkpoint` out of [output]"));
        }
        let new = beside(&self.path, NEW_CHECKPOINT);
        remove_new_checkpoint(&new)?;
        self.replace_checkpoint(&new, &text).map_err(|error| self.not_written(&new, error))?;
        self.temporary = None;
        self.is_kept_at_end = moment.is_last;
        Ok(())
    }

    fn replace_checkpoint(&mut self, new: &Path, text: &str) -> io::Result<()> {
        let mut file = File::create_new(new)?;
        let temporary = Temporary::of(new);
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        temporary.rename(|new| fs::rename(new, &self.checkpoint), self.temporary.as_mut())?;
        sync_folder(&self.path);
        Ok(())
    }

    fn not_written(&self, path: &Path, error: io::Error) -> NotWritten {
        let then = match self.temporary {
            Some(_) => "run the scene again",
            None => "run the scene again: it is resumed from its last checkpoint",
        };
        not_written(path, error, then)
    }

    /// The bytes after the head.
    pub(super) fn bytes_of_rows(&self) -> u64 {
        self.bytes - self.head
    }

    /// Gives the file its name; a head that is known at the end replaces the one that it has.
    pub(crate) fn finish(mut self, head: Option<&[u8]>) -> Result<(), Error> {
        let mut written = self.file.flush();
        if let Some(head) = head {
            let file = self.file.get_mut();
            written = written.and_then(|()| file.rewind()).and_then(|()| file.write_all(head));
        }
        let written = written.and_then(|()| self.file.get_ref().sync_all());
        written.map_err(|error| self.not_written(&self.partial, error))?;
        let rename = |partial: &Path| fs::rename(partial, &self.path);
        let renamed = match self.temporary.take() {
            Some(temporary) => temporary.rename(rename, None),
            None => rename(&self.partial),
        };
        renamed.map_err(|error| self.not_written(&self.path, error))?;
        sync_folder(&self.path);
        if self.is_kept_at_end { Ok(()) } else { self.remove_checkpoint() }
    }

    /// After a run that failed: its rows stay in the partial file if checkpoints are made.
    pub(crate) fn give_up(mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        if !self.saves {
            return Ok(());
        }
        self.file.flush().map_err(|error| self.not_written(&self.partial, error))?;
        if let Some(temporary) = self.temporary.take() {
            temporary.keep();
        }
        observer.note(&Note::RowsKept { partial: self.partial.clone() });
        self.remove_checkpoint()
    }

    /// Removes the checkpoint, and an incomplete one.
    fn remove_checkpoint(&self) -> Result<(), Error> {
        remove(&self.checkpoint)?;
        remove_new_checkpoint(&beside(&self.path, NEW_CHECKPOINT))
    }
}

impl Write for Resumable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes).map_err(|error| self.not_written(&self.partial, error))?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    /// Rows are written out with the next checkpoint.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The hash of the bytes that belong to a checkpoint.
fn hash_of(file: &mut File, &Checkpoint { bytes, hashed_from, .. }: &Checkpoint) -> io::Result<Sha256> {
    let mut hash = Sha256::new();
    file.seek(SeekFrom::Start(hashed_from))?;
    io::copy(&mut BufReader::new(file).take(bytes - hashed_from), &mut Hashing(&mut hash))?;
    Ok(hash)
}

/// Hashes the bytes that are written to it.
struct Hashing<'a>(&'a mut Sha256);

impl Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The partial file, locked by this run.
fn locked(path: &Path, partial: &Path) -> Result<File, Error> {
    if path.is_dir() || path.file_name().is_none() {
        return Err(Error::usage(format!("file {} is a folder", path.display()), "give the name of a file"));
    }
    let options = OpenOptions::new().read(true).write(true).create(true).truncate(false).to_owned();
    open_locked(partial, &options).map_err(|error| match error {
        LockError::Io(_) => cannot_write(&format!("file {}", path.display()), error),
        LockError::Taken => {
            let message = format!("another run is writing {}", path.display());
            Error::usage(message, "wait until it ends, or give this scene another file")
        }
    })
}

/// `FILE.ending` for a path of FILE.
pub(super) fn beside(path: &Path, ending: &str) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!("{name}.{ending}"))
}

/// Removes the incomplete checkpoint of a run that was killed; any other file of this name is an error.
fn remove_new_checkpoint(path: &Path) -> Result<(), Error> {
    let mut begin = Vec::new();
    match open_itself(path, OpenOptions::new().read(true)) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        Err(error) if error.kind() == ErrorKind::InvalidInput => {
            return Err(Error::usage(error.to_string(), "remove it, or give this scene another file"));
        }
        Err(error) => return Err(error.into()),
        Ok(file) => file.take(HEAD_OF_CHECKPOINT.len() as u64).read_to_end(&mut begin)?,
    };
    if !HEAD_OF_CHECKPOINT.as_bytes().starts_with(&begin) {
        let message = format!("{} already exists and is not a checkpoint", path.display());
        return Err(Error::usage(message, "move it, or give this scene another file"));
    }
    remove(path)
}

fn not_own(partial: &Path) -> Error {
    let message = format!("{} already exists and is not from this program", partial.display());
    Error::usage(message, "move it, give this scene another file, or replace it with `force`")
}

fn remove(path: &Path) -> Result<(), Error> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error.into()),
        _ => Ok(()),
    }
}
