//! A file that gets its name when it is complete.

use std::collections::hash_map::RandomState;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::hash::{BuildHasher, Hasher};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use crate::files::lock::{LockError, open_locked};
use crate::files::temporary::Temporary;
use crate::texts::error::{Error, not_written};

/// How the names of files end that are not complete.
const ENDING: &str = ".shadowstep-partial";

/// The digits of the number before it.
const DIGITS: usize = 16;

/// How often two processes that begin at the same moment try again.
const TRIES: u32 = 4;

/// A file under a temporary name, `FILE.`*random number*`.shadowstep-partial`, which is removed unless the file is
/// finished.
///
/// One process writes it at a time. The temporary file is a new one, whose name no one knows before, so that nothing
/// that lies in the folder is opened; what a process that was killed has left of the file is removed. Where the name is
/// a symbolic link to another name in its folder or below, the file that it leads to is written. The file is on the
/// disk before it has its name.
///
/// ```
/// use std::io::Write;
/// use shadowstep_scenes::WholeFile;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("out.csv");
/// let mut file = WholeFile::create_new(&path, "file")?;
/// writeln!(file, "n,t")?;
/// assert!(!path.exists());
/// file.finish()?;
/// assert_eq!(std::fs::read_to_string(&path)?, "n,t\n");
/// # Ok::<(), shadowstep_scenes::Error>(())
/// ```
pub struct WholeFile {
    /// Removed before the lock of the writer ends.
    temporary: Option<Temporary>,
    writer: BufWriter<File>,
    path: PathBuf,
    /// Whether a file that is there is replaced.
    replaces: bool,
}

impl WholeFile {
    /// Creates the temporary file beside `path`, where no file may be yet. In messages, `named` is the flag or key that
    /// gives the path.
    ///
    /// # Errors
    /// As [`WholeFile::create`]; a file that exists.
    pub fn create_new(path: &Path, named: &str) -> Result<Self, Error> {
        if path.is_file() {
            return Err(exists(&format!("{named} {}", path.display())));
        }
        Ok(WholeFile { replaces: false, ..WholeFile::create(path, named)? })
    }

    /// Creates the temporary file beside `path`; a file that is there is replaced by the complete new one.
    ///
    /// # Errors
    /// A path that is not of a file, a symbolic link out of its folder, a folder that cannot be written, a file that
    /// another process is writing.
    pub fn create(path: &Path, named: &str) -> Result<Self, Error> {
        let path = destination(path)?;
        // asked once: another process may give the file its name meanwhile
        let is_other = path.metadata().is_ok_and(|found| !found.is_file());
        let name = path.file_name().filter(|_| !is_other).ok_or_else(|| {
            Error::usage(format!("{named} {} is not a file", path.display()), "give the name of a file")
        })?;
        let opened = create_temporary(&path, &[name, ".".as_ref()].into_iter().collect());
        let (temporary, file) = opened.map_err(|error| cannot_write(&format!("{named} {}", path.display()), error))?;
        Ok(WholeFile { temporary, writer: BufWriter::new(file), path, replaces: true })
    }

    /// The name that it gets.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// The file cannot be written or renamed; a file that was created in the meantime and must not be replaced.
    pub fn finish(mut self) -> Result<(), Error> {
        self.flush()?;
        self.writer.get_ref().sync_all().map_err(|error| not_written(&self.path, error, AGAIN))?;
        if !self.replaces && self.path.symlink_metadata().is_ok() {
            return Err(exists(&format!("file {}", self.path.display())));
        }
        let WholeFile { temporary, path, .. } = self;
        let renamed = temporary.map_or(Ok(()), |partial| partial.rename(|partial| fs::rename(partial, &path), None));
        renamed.map_err(|error| not_written(&path, error, AGAIN))?;
        sync_folder(&path);
        Ok(())
    }
}

/// A new file, locked, whose name begins like this; others of the same file that no process writes are removed.
fn create_temporary(path: &Path, begin: &OsString) -> Result<(Option<Temporary>, File), LockError> {
    let mut tries = 0;
    loop {
        let number = RandomState::new().build_hasher().finish();
        let mut name = begin.clone();
        name.push(format!("{number:0DIGITS$x}{ENDING}"));
        let partial = path.with_file_name(name);
        let options = OpenOptions::new().write(true).create_new(true).to_owned();
        let opened = match Temporary::open(&partial, || open_locked(&partial, &options), |_| true) {
            Ok(opened) if !is_written_by_others(&partial, begin) => return Ok(opened),
            Err(LockError::Io(error)) if error.kind() != ErrorKind::AlreadyExists => return Err(error.into()),
            opened => opened,
        };
        drop(opened);
        tries += 1;
        if tries == TRIES {
            return Err(LockError::Taken);
        }
        // of two that begin at the same moment, one waits longer
        sleep(Duration::from_millis(number % 16));
    }
}

/// Whether another process has a temporary file of this file; those that none has are removed.
fn is_written_by_others(own: &Path, begin: &OsString) -> bool {
    let begin = begin.as_encoded_bytes();
    let is_temporary = |name: &OsString| {
        let number = name.as_encoded_bytes().strip_prefix(begin).and_then(|rest| rest.strip_suffix(ENDING.as_bytes()));
        number.is_some_and(|number| number.len() == DIGITS && number.iter().all(u8::is_ascii_hexdigit))
    };
    let mut is_written = false;
    let entries = fs::read_dir(folder_of(own)).into_iter().flatten().flatten();
    for name in entries.map(|entry| entry.file_name()).filter(is_temporary) {
        let other = own.with_file_name(name);
        if other == own {
            continue;
        }
        match open_locked(&other, &OpenOptions::new().read(true).write(true).to_owned()) {
            Ok(_locked) => drop(fs::remove_file(&other)),
            Err(LockError::Taken) => is_written |= other.exists(),
            Err(LockError::Io(_)) => {}
        }
    }
    is_written
}

/// What helps after a file could not be written.
const AGAIN: &str = "run the command again";

fn exists(file: &str) -> Error {
    Error::usage(format!("{file} already exists"), "use another name, move the file, or replace it with `force`")
}

/// Why the file of a flag or key cannot be written.
pub(crate) fn cannot_write(file: &str, error: LockError) -> Error {
    match error {
        LockError::Io(error) => {
            let hint = match error.kind() {
                ErrorKind::InvalidInput => "remove it, or give another file",
                _ => "give a file in a folder that exists and can be written",
            };
            Error::usage(format!("{file} cannot be written: {error}"), hint)
        }
        LockError::Taken => {
            let message = format!("another process is writing {file}");
            Error::usage(message, "wait until it ends, or give another file")
        }
    }
}

/// The file that a path leads to through symbolic links, which need not exist; it is in the same folder or below.
///
/// # Errors
/// A circle of links; a link out of the folder.
pub(crate) fn destination(path: &Path) -> Result<PathBuf, Error> {
    const MOST: usize = 40;
    let mut end = path.to_owned();
    for _ in 0..MOST {
        let Ok(target) = fs::read_link(&end) else { return Ok(end) };
        end = folder_of(&end).join(target);
        if !is_within(&end, folder_of(path)) {
            let message =
                format!("{} is a symbolic link that leads out of its folder, to {}", path.display(), end.display());
            return Err(Error::usage(message, "give the path of that file itself, or remove the link"));
        }
    }
    Err(Error::usage(format!("{} is a circle of symbolic links", path.display()), "give the name of a file"))
}

/// Whether the folder of a file is another one or below it, as symbolic links lead.
pub(crate) fn is_within(file: &Path, folder: &Path) -> bool {
    let within = || Some(fs::canonicalize(folder_of(file)).ok()?.starts_with(fs::canonicalize(folder).ok()?));
    within().unwrap_or(false)
}

/// The folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Makes a rename last through a loss of power, where a folder can be synchronized.
pub(crate) fn sync_folder(path: &Path) {
    let _ = File::open(folder_of(path)).and_then(|folder| folder.sync_all());
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes).map_err(|error| not_written(&self.path, error, AGAIN).into())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush().map_err(|error| not_written(&self.path, error, AGAIN).into())
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    /// A file that appears while another writer begins is a file.
    #[test]
    fn a_file_may_get_its_name_at_any_moment() {
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("results.csv"), folder.path().join("other.csv"));
        thread::scope(|scope| {
            let renames = scope.spawn(|| {
                for _ in 0..20_000 {
                    File::create(&other).unwrap();
                    fs::rename(&other, &path).unwrap();
                    fs::remove_file(&path).unwrap();
                }
            });
            while !renames.is_finished() {
                WholeFile::create(&path, "file").unwrap();
            }
        });
    }
}
