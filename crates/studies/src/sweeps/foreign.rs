//! What a folder has that is not from a sweep: it is refused, or removed where the user wants that.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::files;
use crate::sweeps::chunk::{CHUNKS_FOLDER, header, left};
use crate::sweeps::collect::WRITTEN;
use crate::sweeps::manifest::{self, Manifest, check_chunks};
use crate::sweeps::plan::SweepPlan;

/// Refuses a folder with files that [`collect`](crate::sweeps::collect()) would replace, and without a sweep beside them:
/// others wrote them.
///
/// # Errors
/// Such a file.
pub fn refuse_foreign(folder: &Path) -> Result<(), Error> {
    if Manifest::is_in(folder) || folder.join(CHUNKS_FOLDER).is_dir() {
        return Ok(());
    }
    files::refuse_foreign(folder, WRITTEN.map(str::to_owned))
}

/// Removes what is not from this plan, so that the sweep begins in the folder: files that [`collect`](crate::sweeps::collect())
/// would replace, and the plan and chunks of another sweep. A folder of this sweep stays as it is, as
/// processes may be at work in it.
///
/// # Errors
/// A number of chunks that the sweep cannot have, before anything is removed; a file that cannot be removed.
pub fn remove_foreign(folder: &Path, plan: &SweepPlan, chunks: Option<u64>) -> Result<(), Error> {
    if let Some(chunks) = chunks {
        check_chunks(chunks, plan.axes().runs())?;
    }
    if Manifest::read(folder).is_ok_and(|there| there.digests == plan.digests) {
        return Ok(());
    }
    let is_foreign = |path: &PathBuf| header(path).flatten().is_some_and(|header| header.digests != plan.digests);
    let named = WRITTEN.into_iter().chain([manifest::NAME]).map(|name| folder.join(name));
    for path in named.chain(left(&folder.join(CHUNKS_FOLDER), "").into_iter().filter(is_foreign)) {
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                let message = format!("{} cannot be removed: {error}", path.display());
                return Err(Error::usage(message, "give another folder"));
            }
            _ => {}
        }
    }
    Ok(())
}
