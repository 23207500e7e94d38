//! What a submission adds to a folder, which is removed if it is refused.

use std::fs;
use std::path::{Path, PathBuf};

use super::script::{ARRAY, COLLECT, LOGS};
use crate::chunk::CHUNKS_FOLDER;
use crate::manifest;

/// The files and folders that are not there when a sweep is submitted. Unless they are kept, they are removed at the
/// end.
#[derive(Debug)]
pub struct Added(Vec<PathBuf>);

impl Added {
    /// Those of the folder of a sweep, and the folder itself.
    pub fn to(folder: &Path) -> Added {
        let within = [ARRAY, COLLECT, LOGS, CHUNKS_FOLDER, manifest::NAME].map(|name| folder.join(name));
        let above = folder.ancestors().filter(|path| !path.as_os_str().is_empty());
        Added(within.into_iter().chain(above.map(Path::to_owned)).filter(|path| !path.exists()).collect())
    }

    /// They stay.
    pub fn keep(mut self) {
        self.0.clear();
    }
}

impl Drop for Added {
    fn drop(&mut self) {
        for path in self.0.iter().filter(|path| path.exists()) {
            // a folder in which another process has written stays, and what is above it
            let removed = if path.is_dir() { fs::remove_dir(path) } else { fs::remove_file(path) };
            if removed.is_err() {
                break;
            }
        }
    }
}
