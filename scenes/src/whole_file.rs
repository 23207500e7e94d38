//! A file that gets its name when it is complete.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::{Error, not_written};
use crate::lock::{LockError, open_locked};
use crate::temporary::Temporary;

/// What the name of a file has after it until it is complete.
const ENDING: &str = "shadowstep-partial";

/// A file under a temporary name, `FILE.shadowstep-partial`, which is removed unless the file is finished.
///
/// One process has it at a time. What a process that was killed has left is replaced. Where the name is a symbolic link, the file
/// that it leads to is written.
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
    /// Creates the temporary file beside `path`, where no file may be yet. In messages, `named` is the flag or key that gives the
    /// path.
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
    /// A path that is not of a file, a folder that cannot be written, a file that another process is writing.
    pub fn create(path: &Path, named: &str) -> Result<Self, Error> {
        let path = &destination(path)?;
        // asked once: another process may give the file its name meanwhile
        let is_other = path.metadata().is_ok_and(|found| !found.is_file());
        let name = path.file_name().filter(|_| !is_other).ok_or_else(|| {
            Error::usage(format!("{named} {} is not a file", path.display()), "give the name of a file")
        })?;
        let partial = path.with_file_name(format!("{}.{ENDING}", name.display()));
        let options = OpenOptions::new().write(true).create(true).truncate(false).to_owned();
        let opened = Temporary::open(&partial, || open_locked(&partial, &options), |_| true);
        let (temporary, file) = opened.map_err(|error| cannot_write(&format!("{named} {}", path.display()), error))?;
        file.set_len(0).map_err(|error| not_written(path, error, AGAIN))?;
        Ok(WholeFile { temporary, writer: BufWriter::new(file), path: path.to_owned(), replaces: true })
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
        if !self.replaces && self.path.exists() {
            return Err(exists(&format!("file {}", self.path.display())));
        }
        let WholeFile { temporary, path, .. } = self;
        let renamed = temporary.map_or(Ok(()), |partial| partial.rename(|partial| fs::rename(partial, &path), None));
        renamed.map_err(|error| not_written(&path, error, AGAIN).into())
    }
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
            let message = format!("{file} cannot be written: {error}");
            Error::usage(message, "give a file in a folder that exists and can be written")
        }
        LockError::Taken => {
            let message = format!("another process is writing {file}");
            Error::usage(message, "wait until it ends, or give another file")
        }
    }
}

/// The file that a path leads to through symbolic links, which need not exist.
///
/// # Errors
/// A circle of links.
pub(crate) fn destination(path: &Path) -> Result<PathBuf, Error> {
    const MOST: usize = 40;
    let mut end = path.to_owned();
    for _ in 0..MOST {
        let Ok(target) = fs::read_link(&end) else { return Ok(end) };
        end = end.parent().unwrap_or(Path::new("")).join(target);
    }
    Err(Error::usage(format!("{} is a circle of symbolic links", path.display()), "give the name of a file"))
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
