//! A file that a run can go on with after it was stopped at any moment.
//!
//! Rows go to `FILE.partial`. `FILE.checkpoint` says how many of its bytes are good and what to go on from; it is
//! written after those bytes are on the disk, and under another name until it is there as a whole. Once all rows are
//! there, `FILE.partial` becomes `FILE` and the checkpoint goes away. A run holds a lock on `FILE.partial`, which the
//! system takes off when the run ends in whatever way.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::lock::{LockError, open_locked};
use crate::note::Note;
use crate::observer::Observer;
use crate::results::checkpoint::{Checkpoint, Identity, SavedState};
use crate::results::metadata::hexadecimal;

/// The ending of a checkpoint that is being written.
const NEW_CHECKPOINT: &str = "checkpoint.new";

/// The partial file of a run.
pub(crate) struct Resumable {
    identity: Identity,
    path: PathBuf,
    partial: PathBuf,
    checkpoint: PathBuf,
    file: BufWriter<File>,
    bytes: u64,
    hash: Sha256,
}

impl Resumable {
    /// Begins the file, or opens it where its checkpoint is; `restart` begins in any case.
    pub(crate) fn open(
        path: &Path,
        identity: Identity,
        restart: bool,
        observer: &mut dyn Observer,
    ) -> Result<(Resumable, Option<Checkpoint>), Error> {
        let [partial, checkpoint] = ["partial", "checkpoint"].map(|ending| beside(path, ending));
        let file = locked(path, &partial)?;
        let length = file.metadata()?.len();
        let mut resumable = Resumable {
            identity,
            path: path.to_owned(),
            partial,
            checkpoint,
            file: BufWriter::new(file),
            bytes: 0,
            hash: Sha256::new(),
        };
        let found = match fs::read(&resumable.checkpoint) {
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(error.into()),
            Ok(_) if restart => None,
            // the run was complete, and stopped just before it could take the checkpoint away
            Ok(_) if length == 0 => {
                observer.note(&Note::CheckpointWithoutRows { checkpoint: resumable.checkpoint.clone() });
                None
            }
            Ok(bytes) => Some(resumable.resume(&String::from_utf8_lossy(&bytes), length)?),
        };
        if found.is_none() {
            resumable.forget()?;
            resumable.file.get_ref().set_len(0)?;
        }
        Ok((resumable, found))
    }

    fn resume(&mut self, text: &str, length: u64) -> Result<Checkpoint, Error> {
        let checkpoint = Checkpoint::read(text, &self.identity).map_err(|why| self.refused(&self.checkpoint, &why))?;
        let file = self.file.get_mut();
        if length < checkpoint.bytes {
            return Err(self.refused(&self.partial, "is shorter than its checkpoint says"));
        }
        io::copy(&mut BufReader::new(&*file).take(checkpoint.bytes), &mut Hashing(&mut self.hash))?;
        if hexadecimal(&self.hash.clone().finalize()) != checkpoint.sha256 {
            return Err(self.refused(&self.partial, "was changed after its checkpoint was written"));
        }
        // rows after the checkpoint come again
        file.set_len(checkpoint.bytes)?;
        file.seek(SeekFrom::Start(checkpoint.bytes))?;
        self.bytes = checkpoint.bytes;
        Ok(checkpoint)
    }

    fn refused(&self, file: &Path, why: &str) -> Error {
        let hint = "discard it and begin again with --restart, or restore what it was made with";
        Error::usage(format!("{} {why}, so the run cannot be resumed from it", file.display()), hint)
    }

    /// Makes a checkpoint: all rows up to n are written, and the run can go on from a state.
    pub(crate) fn keep(&mut self, n: i64, state: Option<SavedState>) -> Result<(), Error> {
        self.file.flush()?;
        self.file.get_ref().sync_data()?;
        let sha256 = hexadecimal(&self.hash.clone().finalize());
        let checkpoint = Checkpoint { identity: self.identity.clone(), n, bytes: self.bytes, sha256, state };
        let new = beside(&self.path, NEW_CHECKPOINT);
        let mut file = File::create(&new)?;
        file.write_all(checkpoint.to_text().as_bytes())?;
        file.sync_all()?;
        fs::rename(&new, &self.checkpoint)?;
        sync_folder(&self.path);
        Ok(())
    }

    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> Result<(), Error> {
        self.file.flush()?;
        self.file.get_ref().sync_all()?;
        fs::rename(&self.partial, &self.path)?;
        sync_folder(&self.path);
        self.forget()
    }

    /// After a run that ends before its time for a reason of its own: its rows stay in the partial file.
    pub(crate) fn give_up(mut self, observer: &mut dyn Observer) -> Result<(), Error> {
        self.file.flush()?;
        observer.note(&Note::RowsKept { partial: self.partial.clone() });
        self.forget()
    }

    /// Takes the checkpoint away, and what is left of one that was never complete.
    fn forget(&self) -> Result<(), Error> {
        remove(&self.checkpoint)?;
        remove(&beside(&self.path, NEW_CHECKPOINT))
    }
}

impl Write for Resumable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hash.update(&bytes[..written]);
        self.bytes += written as u64;
        Ok(written)
    }

    /// Rows are of no use to anyone before the next checkpoint.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Hashes what is written.
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

/// The partial file, for this run alone.
fn locked(path: &Path, partial: &Path) -> Result<File, Error> {
    let cannot = |error: io::Error| {
        let message = format!("file {} cannot be written: {error}", path.display());
        Error::usage(message, "give a file in a folder that exists and can be written")
    };
    if path.is_dir() || path.file_name().is_none() {
        return Err(Error::usage(format!("file {} is a folder", path.display()), "give the name of a file"));
    }
    let options = OpenOptions::new().read(true).write(true).create(true).truncate(false).to_owned();
    open_locked(partial, &options).map_err(|error| match error {
        LockError::Io(error) => cannot(error),
        LockError::Taken => {
            let message = format!("another run is writing {}", path.display());
            Error::usage(message, "wait until it ends, or give this scene another file")
        }
    })
}

fn beside(path: &Path, ending: &str) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!("{name}.{ending}"))
}

fn remove(path: &Path) -> Result<(), Error> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error.into()),
        _ => Ok(()),
    }
}

/// Makes a rename last through a loss of power, where a folder can be synchronized.
fn sync_folder(path: &Path) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}
