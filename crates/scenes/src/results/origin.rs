//! Whose result a file is, by the hashes in its metadata.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::results::options::FileOptions;
use crate::results::resumable::{LONGEST_HEAD, beside};
use crate::scene::Format;
use crate::texts::error::Error;

/// The extension of the file with the metadata of JSON lines.
pub(super) const METADATA: &str = "metadata.json";

/// Whose result a file is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// There is no file.
    None,
    /// This scene, these inputs and this version: a run would write the same bytes again.
    Same,
    /// This scene with something else that differs, as the end of "was made".
    SameScene(String),
    /// Something else, or a changed scene.
    Other,
}

impl Origin {
    /// Of the file of a scene, whose text has this hash, and which was made with these `inputs`: what stands in
    /// metadata, and what differs where it does not.
    pub(crate) fn of<'a>(
        path: &Path,
        format: Format,
        scene: &str,
        mut inputs: impl Iterator<Item = (&'a str, String)>,
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
            Ok(_) if !has(scene) => Origin::Other,
            Ok(_) => match inputs.find(|(text, _)| !has(text)) {
                Some((_, differs)) => Origin::SameScene(differs),
                None if is_there(path) => Origin::Same,
                // the rows were removed
                None => Origin::None,
            },
            Err(_) => Origin::Other,
        }
    }

    /// Refuses a file that is not from the scene and its inputs, unless it is to be replaced.
    pub(crate) fn check(&self, path: &Path, options: FileOptions) -> Result<(), Error> {
        let why = match self {
            Origin::Other => "is not from this unchanged scene",
            Origin::SameScene(differs) => &format!("was made {differs}"),
            Origin::None | Origin::Same => return Ok(()),
        };
        if options.force || path.is_dir() {
            return Ok(());
        }
        let message = format!("{} already exists and {why}", path.display());
        Err(Error::usage(message, "use another name, move the file, or replace it with `force`"))
    }
}
