//! A file that gets its name when it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// A file under a temporary name, which is removed unless the file is finished.
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
    writer: BufWriter<File>,
    temporary: PathBuf,
    path: PathBuf,
}

impl WholeFile {
    /// Creates the temporary file beside `path`, where no file may be yet. In messages, `named` is the flag or key that gives the
    /// path.
    ///
    /// # Errors
    /// As [`WholeFile::create`]; a file that exists.
    pub fn create_new(path: &Path, named: &str) -> Result<Self, Error> {
        if path.is_file() {
            let message = format!("{named} {} already exists", path.display());
            return Err(Error::usage(message, "use another name, move the file, or replace it with --force"));
        }
        WholeFile::create(path, named)
    }

    /// Creates the temporary file beside `path`; a file that is there is replaced by the complete new one.
    ///
    /// # Errors
    /// A path that is not of a file, a folder that cannot be written.
    pub fn create(path: &Path, named: &str) -> Result<Self, Error> {
        let name = path.file_name().filter(|_| path.is_file() || !path.exists()).ok_or_else(|| {
            Error::usage(format!("{named} {} is not a file", path.display()), "give the name of a file")
        })?;
        let temporary = path.with_file_name(format!("{}.{}.partial", name.display(), std::process::id()));
        let file = File::create_new(&temporary).map_err(|error| {
            let message = format!("{named} {} cannot be written: {error}", path.display());
            Error::usage(message, "give a file in a folder that exists and can be written")
        })?;
        Ok(WholeFile { writer: BufWriter::new(file), temporary, path: path.to_owned() })
    }

    /// The name that it gets.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// The file cannot be written or renamed.
    pub fn finish(mut self) -> Result<(), Error> {
        self.flush()?;
        Ok(fs::rename(&self.temporary, &self.path)?)
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        // after `finish` this file does not exist
        let _ = fs::remove_file(&self.temporary);
    }
}
