//! The files that a text names lie in its own folder or below: a scene may come from someone else, and is not to write
//! or read elsewhere.
//!
//! Who runs it can allow other folders, for a process or for a call; what is given as an argument of a program is
//! allowed.

use std::cell::Cell;
use std::fs::canonicalize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use shadowstep::tables::{Faults, Source};
use shadowstep_schemes::document::Text;

use crate::files::whole_file::folder_of;
use crate::texts::refusal::Refusal;

static ALLOWED: AtomicBool = AtomicBool::new(false);

thread_local! {
    static ALLOWED_HERE: Cell<bool> = const { Cell::new(false) };
}

/// Allows the texts that this process reads to name files outside of their folders.
pub fn allow_outside() {
    ALLOWED.store(true, Ordering::Relaxed);
}

/// Whether the process allows it.
pub fn is_outside_allowed() -> bool {
    ALLOWED.load(Ordering::Relaxed)
}

/// What a function reads, with files outside of the folders of texts where `allowed`.
///
/// ```
/// use shadowstep::tables::Source;
/// use shadowstep_scenes::{Scene, outside::reading_outside};
///
/// let text = "problem.name = \"kepler\"\nrun = { scheme = \"ruth3\", step = \"1/9\", steps = 1 }\n\
///             output = { energy = true, file = \"../rows.csv\" }\n";
/// let source = || Source { path: "scene.toml".to_owned(), text: text.to_owned() };
/// let faults = Scene::read(source()).unwrap_err();
/// assert_eq!(faults.0[0].message, "`../rows.csv` is outside of the folder of this file");
/// assert!(reading_outside(true, || Scene::read(source())).is_ok());
/// ```
pub fn reading_outside<T>(allowed: bool, read: impl FnOnce() -> T) -> T {
    /// Sets it back, also after a panic.
    struct Before(bool);
    impl Drop for Before {
        fn drop(&mut self) {
            ALLOWED_HERE.set(self.0);
        }
    }
    let _before = Before(ALLOWED_HERE.replace(allowed));
    read()
}

/// The path of a file that a text names at a place.
///
/// # Errors
/// A file outside of the folder of the text, also by a symbolic link, where that is not allowed.
pub fn path_within(source: &Source, name: &Text) -> Result<PathBuf, Faults> {
    let fault = |Refusal { message, hint }| Faults(vec![source.fault(&name.at, message).hint(hint)]);
    path_of(source, &name.value).map_err(fault)
}

/// The path of a file that a text names.
///
/// # Errors
/// As [`path_within`].
pub(crate) fn path_of(source: &Source, name: &str) -> Result<PathBuf, Refusal> {
    let path = source.folder().join(name);
    if is_allowed(&path, folder_of(Path::new(&source.path))) {
        return Ok(path);
    }
    let message = format!("`{name}` is outside of the folder of this file");
    Err(Refusal::new(message, "move it into that folder, or allow other folders with `--allow-outside`"))
}

/// Whether a path leads into a folder or below, or may lead elsewhere.
pub(crate) fn is_allowed(path: &Path, folder: &Path) -> bool {
    is_outside_allowed() || ALLOWED_HERE.get() || is_in(path, folder)
}

/// Whether a path leads into a folder or below, as far as it exists.
fn is_in(path: &Path, folder: &Path) -> bool {
    let here = |path: &Path| if path.as_os_str().is_empty() { PathBuf::from(".") } else { path.to_owned() };
    let existing = path.ancestors().find_map(|path| canonicalize(here(path)).ok());
    // of a folder that does not exist nothing is written or read
    let Ok(folder) = canonicalize(folder) else { return !leaves(path) };
    existing.is_some_and(|existing| existing.starts_with(folder))
}

fn leaves(path: &Path) -> bool {
    use std::path::Component::{CurDir, Normal};
    !path.components().all(|part| matches!(part, Normal(_) | CurDir))
}
