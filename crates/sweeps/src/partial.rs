//! The records of a chunk that is not complete, in the order in which they were made.
//!
//! Each process has its own file, `chunks/00003-of-00016.partial-…`, and appends to it. A process that begins takes the
//! records that others have left, copies them and removes their files: it does no harm if another process is still at
//! work, which keeps its records in memory. So no locks are needed, which network file systems may not have.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use shadowstep_scenes::{Error, not_written};
use tempfile::{Builder, NamedTempFile};

use crate::chunk::{AGAIN, Chunk, Header, left, open};
use crate::plan::hash;
use crate::record::Record;

/// The records of a chunk that are there, and the file to which others are appended.
pub(crate) struct Partial {
    path: PathBuf,
    file: File,
    /// The JSON of records by their runs.
    pub(crate) records: BTreeMap<u64, String>,
}

impl Partial {
    /// Takes what others have left of a chunk, and begins a file.
    pub(crate) fn open(folder: &Path, chunk: Chunk, header: &Header, runs: Range<u64>) -> Result<Partial, Error> {
        let path = chunk.path(folder);
        let parent = path.parent().unwrap_or(folder).to_owned();
        let left = left(&parent, &format!("{}.partial-", chunk.name()));
        let header = serde_json::to_string(header)?;
        let mut records = BTreeMap::new();
        left.iter().for_each(|path| take(path, &header, &runs, &mut records));
        let begun = || -> io::Result<(PathBuf, File)> {
            let mut file: NamedTempFile =
                Builder::new().prefix(&format!("{}.partial-", chunk.name())).tempfile_in(&parent)?;
            let mut text = format!("{header}\n");
            records.values().for_each(|json| text += &line(json));
            file.write_all(text.as_bytes())?;
            let (file, path) = file.keep()?;
            Ok((path, file))
        };
        let (path, file) = begun().map_err(|error| not_written(&path, error, AGAIN))?;
        left.iter().for_each(|path| drop(fs::remove_file(path)));
        Ok(Partial { path, file, records })
    }

    /// Keeps a record.
    pub(crate) fn keep(&mut self, record: &Record) -> Result<(), Error> {
        let json = serde_json::to_string(record)?;
        let written = self.file.write_all(line(&json).as_bytes());
        written.map_err(|error| not_written(&self.path, error, AGAIN))?;
        self.records.insert(record.run, json);
        Ok(())
    }

    /// The records in the order of their runs. The file stays until the chunk is written.
    pub(crate) fn into_records(self) -> Vec<String> {
        self.records.into_values().collect()
    }
}

/// A hash and a record.
fn line(json: &str) -> String {
    format!("{} {json}\n", &hash(json)[..16])
}

/// Takes the records of a file up to the first line that is damaged, if the file is of the same plan and chunk.
fn take(path: &Path, header: &str, runs: &Range<u64>, records: &mut BTreeMap<u64, String>) {
    let Ok(file) = open(path) else { return };
    let mut lines = BufReader::new(file).lines().map_while(Result::ok);
    if lines.next().as_deref() != Some(header) {
        return;
    }
    for line in lines {
        let Some((_, json)) = line.split_once(' ').filter(|(found, json)| hash(json).get(..16) == Some(*found)) else {
            return;
        };
        match serde_json::from_str::<Record>(json) {
            Ok(record) if runs.contains(&record.run) => records.insert(record.run, json.to_owned()),
            _ => return,
        };
    }
}
