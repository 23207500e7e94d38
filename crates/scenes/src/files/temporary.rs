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

    /// Opens a file, which is removed from then on if it is new. The program does not end between the two.
    pub(crate) fn open<F, E>(
        path: &Path,
        open: impl FnOnce() -> Result<F, E>,
        is_new: impl FnOnce(&F) -> bool,
    ) -> Result<(Option<Temporary>, F), E> {
        let mut all = all();
        let file = open()?;
        let temporary = is_new(&file).then(|| {
            all.push(path.to_owned());
            Temporary { path: path.to_owned(), kept: false }
        });
        Ok((temporary, file))
    }

    /// Leaves the file where it is.
    pub(crate) fn keep(mut self) {
        self.kept = true;
    }

    /// Gives the file another name, under which it stays, and keeps another file as well. It is removed if that fails.
    pub(crate) fn rename(
        mut self,
        rename: impl FnOnce(&Path) -> io::Result<()>,
        other: Option<&mut Temporary>,
    ) -> io::Result<()> {
        let mut all = all();
        rename(&self.path)?;
        for kept in [Some(&mut self), other].into_iter().flatten() {
            kept.kept = true;
            all.retain(|path| *path != kept.path);
        }
        Ok(())
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
