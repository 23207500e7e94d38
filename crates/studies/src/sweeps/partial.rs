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
use tempfile::Builder;

use crate::sweeps::chunk::{self, AGAIN, Header, left, open};
use crate::sweeps::plan::hash;
use crate::sweeps::record::Record;

/// A chunk of which some records are not there: those that are, and the file to which others are appended.
pub(crate) struct Partial {
    pub(crate) header: Header,
    path: PathBuf,
    file: File,
    /// The JSON of records by their runs.
    pub(crate) records: BTreeMap<u64, String>,
    /// The runs that may have to be made.
    rest: Range<u64>,
}

impl Partial {
    /// Takes what others have left of a chunk, and begins a file.
    pub(crate) fn open(folder: &Path, header: Header) -> Result<Partial, Error> {
        let path = header.chunk.path(folder);
        let parent = path.parent().unwrap_or(folder);
        let begin = format!("{}.partial-", header.chunk.name());
        let (left, first) = (left(parent, &begin), serde_json::to_string(&header)?);
        let (mut records, rest) = (BTreeMap::new(), header.range());
        left.iter().for_each(|path| take(path, &first, &rest, &mut records));
        let begun = || -> io::Result<_> {
            let mut file = Builder::new().prefix(&begin).tempfile_in(parent)?;
            let mut text = format!("{first}\n");
            records.values().for_each(|json| text += &line(json));
            file.write_all(text.as_bytes())?;
            Ok(file.keep()?)
        };
        let (file, path) = begun().map_err(|error| not_written(&path, error, AGAIN))?;
        left.iter().for_each(|path| drop(fs::remove_file(path)));
        Ok(Partial { header, path, file, records, rest })
    }

    /// Takes runs that are not saved, `most` at most, and fewer at the end of the chunk, so that all threads have some.
    pub(crate) fn take(&mut self, most: usize, threads: usize) -> Vec<u64> {
        let left = usize::try_from(self.rest.end - self.rest.start).unwrap_or(usize::MAX);
        let most = most.min(left.div_ceil(2 * threads));
        self.rest.by_ref().filter(|run| !self.records.contains_key(run)).take(most).collect()
    }

    /// Keeps a record.
    pub(crate) fn keep(&mut self, record: &Record) -> Result<(), Error> {
        let json = serde_json::to_string(record)?;
        let written = self.file.write_all(line(&json).as_bytes());
        written.map_err(|error| not_written(&self.path, error, AGAIN))?;
        self.records.insert(record.run, json);
        Ok(())
    }

    pub(crate) fn is_complete(&self) -> bool {
        self.records.len() as u64 == self.header.runs
    }

    /// Writes the chunk, which removes the file.
    pub(crate) fn finish(self, folder: &Path) -> Result<(), Error> {
        chunk::write(folder, &self.header, self.records.values())
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
