//! A lock on a file, which the system releases when the process ends in whatever way.
//!
//! Files that a program writes under names that are known before lie perhaps in a folder of others: symbolic links of
//! these names are not followed, and files with other names, by hard links, are not opened.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
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
/// A pipe, a symbolic link, a file with several names; a file that cannot be opened, or that another process has.
pub fn open_locked(path: &Path, options: &OpenOptions) -> Result<File, LockError> {
    refuse_pipe(path)?;
    let file = open_itself(path, options)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => return Err(LockError::Taken),
        Err(TryLockError::Error(error)) => return Err(error.into()),
    }
    // the process that held the lock may have given the file another name just now
    let still_there = Handle::from_path(path).ok() == Some(Handle::from_file(file.try_clone()?)?);
    if still_there { Ok(file) } else { Err(LockError::Taken) }
}

/// Opens a file as the options say; it is the file of this name, and of no other.
///
/// # Errors
/// `InvalidInput` for a symbolic link, for what is not a file, and for a file with several names; a file that cannot be
/// opened.
pub(crate) fn open_itself(path: &Path, options: &OpenOptions) -> io::Result<File> {
    let refused = |what: &str| io::Error::new(ErrorKind::InvalidInput, format!("{} {what}", path.display()));
    let file = match not_following(options).open(path) {
        Err(_) if path.is_symlink() => return Err(refused("is a symbolic link, which is not followed")),
        opened => opened?,
    };
    let found = file.metadata()?;
    if !found.is_file() {
        return Err(refused("is not a file"));
    }
    if names(&found) > 1 {
        return Err(refused("is a file that has another name, too, by a hard link"));
    }
    Ok(file)
}

#[cfg(unix)]
fn not_following(options: &OpenOptions) -> OpenOptions {
    use std::os::unix::fs::OpenOptionsExt;
    let flag = rustix::fs::OFlags::NOFOLLOW.bits().cast_signed();
    options.clone().custom_flags(flag).to_owned()
}

#[cfg(not(unix))]
fn not_following(options: &OpenOptions) -> OpenOptions {
    options.clone()
}

/// How many names a file has.
#[cfg(unix)]
fn names(found: &std::fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::nlink(found)
}

#[cfg(not(unix))]
fn names(_: &std::fs::Metadata) -> u64 {
    1
}
