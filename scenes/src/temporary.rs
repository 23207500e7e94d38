//! Files that are removed unless they are kept, also where a signal ends the program.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The paths of all such files of the process.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file that is removed when this is dropped, or by [`remove_temporary_files`].
///
/// Of a file that other processes may have under the same name before or after, the process must hold a lock as long.
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
    kept: bool,
}

impl Temporary {
    /// The file or folder of this path is removed from now on.
    pub fn of(path: &Path) -> Temporary {
        all().push(path.to_owned());
        Temporary { path: path.to_owned(), kept: false }
    }

    /// Leaves the file where it is.
    pub(crate) fn keep(mut self) {
        self.kept = true;
    }

    /// Gives the file another name, under which it stays; it is removed if that fails.
    pub(crate) fn rename(mut self, rename: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
        let all = all();
        let renamed = rename(&self.path);
        self.kept = renamed.is_ok();
        drop(all);
        renamed
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let mut all = all();
        all.retain(|path| *path != self.path);
        if !self.kept {
            remove(&self.path);
        }
    }
}

fn remove(path: &Path) {
    let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
}

fn all() -> MutexGuard<'static, Vec<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all such files, and keeps other threads from creating new ones: for a program that ends now.
pub fn remove_temporary_files() {
    let all = all();
    for path in &*all {
        remove(path);
    }
    std::mem::forget(all);
}
