//! A lock on a file, which the system releases when the process ends in whatever way.

use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

use same_file::Handle;
use shadowstep_schemes::document::refuse_pipe;
use thiserror::Error;

/// Why a file cannot be locked.
#[derive(Debug, Error)]
pub enum LockError {
    /// Another process has it.
    #[error("another process has the file")]
    Taken,
    /// The file cannot be opened.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Opens a file as the options say and locks it for this process alone.
///
/// ```
/// use shadowstep_scenes::lock::{LockError, open_locked};
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("rows");
/// let mut options = std::fs::OpenOptions::new();
/// options.read(true).append(true).create(true);
/// let file = open_locked(&path, &options).unwrap();
/// assert!(matches!(open_locked(&path, &options), Err(LockError::Taken)));
/// drop(file);
/// assert!(open_locked(&path, &options).is_ok());
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// A pipe; a file that cannot be opened, or that another process has.
pub fn open_locked(path: &Path, options: &OpenOptions) -> Result<File, LockError> {
    refuse_pipe(path)?;
    let file = options.open(path)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(LockError::Taken),
        Err(TryLockError::Error(error)) => return Err(error.into()),
    }
    // the process that held the lock may have given the file another name just now
    let still_there = Handle::from_path(path).ok() == Some(Handle::from_file(file.try_clone()?)?);
    if still_there { Ok(file) } else { Err(LockError::Taken) }
}
