//! Whose result a file is, by the hashes in its metadata.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::Error;
use crate::results::options::FileOptions;
use crate::results::resumable::{LONGEST_HEAD, beside};
use crate::scene::Format;

/// The extension of the file with the metadata of JSON lines.
pub(super) const METADATA: &str = "metadata.json";

/// Whose result a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// There is no file.
    None,
    /// This scene, these tables and this version: a run would write the same bytes again.
    Same,
    /// This scene with other tables or another version.
    SameScene,
    /// Something else, or a changed scene.
    Other,
}

impl Origin {
    /// Of the file of a scene, whose text has these hashes, and which was made with these `others`.
    pub(crate) fn of<'a>(
        path: &Path,
        format: Format,
        scene: &[&str],
        mut others: impl Iterator<Item = &'a String>,
    ) -> Origin {
        let metadata = if format.has_metadata() { path.to_owned() } else { beside(path, METADATA) };
        let is_there = |path: &Path| path.symlink_metadata().is_ok();
        if !is_there(path) && !is_there(&metadata) {
            return Origin::None;
        }
        let mut head = Vec::new();
        let read = File::open(&metadata).and_then(|file| file.take(LONGEST_HEAD).read_to_end(&mut head));
        let has = |text: &str| head.windows(text.len()).any(|part| part == text.as_bytes());
        match read {
            Ok(_) if !scene.iter().all(|hash| has(hash)) => Origin::Other,
            Ok(_) if others.all(|text| has(text)) && is_there(path) => Origin::Same,
            Ok(_) => Origin::SameScene,
            Err(_) => Origin::Other,
        }
    }

    /// Refuses a file that is not from the scene, unless it is to be replaced.
    pub(crate) fn check(self, path: &Path, options: FileOptions) -> Result<(), Error> {
        if self != Origin::Other || options.force || path.is_dir() {
            return Ok(());
        }
        let message = format!("{} already exists and is not from this unchanged scene", path.display());
        Err(Error::usage(message, "use another name, move the file, or replace it with `force`"))
    }
}
