//! The files of a study.

use std::io::Write;
use std::path::{Path, PathBuf};

use shadowstep_scenes::{Error, WholeFile};
use shadowstep_tasks::Store;

use crate::reference::Origin;
use crate::study::Study;

const DATA: &str = "work-precision.csv";
const LINES: &str = "work-precision.jsonl";

/// What was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// The file to look at first.
    pub report: PathBuf,
}

/// Writes the data and the charts.
///
/// # Errors
/// A file that cannot be written.
pub fn write(study: &Study<'_>, title: &str, command: &str, folder: &Path) -> Result<Written, Error> {
    let reference = match &study.reference.origin {
        Origin::ExactFlow => "reference: the exact flow".to_owned(),
        Origin::Scheme { name, steps, digits } => {
            let error = study.reference.error();
            format!("reference: {name}, {steps} steps, {digits} digits, estimated error {error}")
        }
    };
    let head = [
        format!("shadowstep: {}", env!("CARGO_PKG_VERSION")),
        format!("command: {command}"),
        title.to_owned(),
        reference,
    ];
    write_file(folder, DATA, &study.csv(&head)?)?;
    write_file(folder, LINES, &study.json_lines()?)?;
    Ok(Written { report: folder.join(DATA) })
}

fn write_file(folder: &Path, name: &str, text: &str) -> Result<(), Error> {
    let mut file = WholeFile::create(&folder.join(name), "the file")?;
    file.write_all(text.as_bytes())?;
    file.finish()
}

/// Files of this program have its results beside them. Without them, files of the same names are not replaced.
pub(crate) fn refuse_foreign(folder: &Path) -> Result<(), Error> {
    let foreign = [DATA, LINES].into_iter().map(|name| folder.join(name)).find(|path| path.exists());
    match foreign.filter(|_| !Store::is_in(folder)) {
        None => Ok(()),
        Some(path) => {
            let message = format!("{} exists, without results of this program beside it", path.display());
            Err(Error::usage(message, "give another folder, or replace its files with --force"))
        }
    }
}
