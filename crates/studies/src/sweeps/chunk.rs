//! Chunks: which runs one has, and its file.
//!
//! A file has a header, a record a line in the order of the runs, and a hash of all that. Its bytes depend on the plan
//! only, not on who computes it, when, or with how many threads.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use shadowstep_scenes::{Error, hexadecimal, not_written};
use shadowstep_schemes::document::refuse_pipe;
use tempfile::Builder;

use crate::sweeps::plan::Digests;
use crate::sweeps::record::Record;

/// The most runs of a chunk: they are sorted in memory.
pub(crate) const MOST_RUNS_OF_CHUNK: u64 = 1 << 20;

/// The folder of the chunks, in the one of the sweep.
pub(crate) const CHUNKS_FOLDER: &str = "chunks";

/// What helps when a chunk cannot be written.
pub(crate) const AGAIN: &str = "run the command again: it computes what is not saved yet";

/// Chunk `number` of `of`, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Chunk {
    /// From 1 to `of`.
    #[serde(rename = "chunk")]
    pub number: u64,
    /// How many chunks there are.
    pub of: u64,
}

/// The first line of a chunk's file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Header {
    #[serde(flatten)]
    pub(crate) digests: Digests,
    /// The elementary functions of double precision, which depend on the machine; `None` where they are not used.
    pub(crate) functions: Option<String>,
    #[serde(flatten)]
    pub(crate) chunk: Chunk,
    pub(crate) first: u64,
    pub(crate) runs: u64,
}

/// The last line of a chunk's file, with the hash of all others.
fn trailer(hash: Sha256) -> Value {
    json!({ "sha256": hexadecimal(&hash.finalize()) })
}

impl Chunk {
    /// The runs of the chunk, out of this number: the chunks have equally many, give or take one.
    pub(crate) fn runs(self, runs: u64) -> Range<u64> {
        let bound = |chunk: u64| (u128::from(chunk) * u128::from(runs) / u128::from(self.of)) as u64;
        bound(self.number - 1)..bound(self.number)
    }

    /// How many runs it has, out of this number.
    pub(crate) fn count(self, runs: u64) -> u64 {
        let Range { start, end } = self.runs(runs);
        end - start
    }

    /// `chunks/00003-of-00016` in the folder of a sweep.
    pub(crate) fn path(self, folder: &Path) -> PathBuf {
        folder.join(CHUNKS_FOLDER).join(self.name())
    }

    /// The name of the file; those of temporary files begin with it and a dot.
    pub(crate) fn name(self) -> String {
        format!("{:05}-of-{:05}", self.number, self.of)
    }
}

impl Header {
    /// The runs of the chunk.
    pub(crate) fn range(&self) -> Range<u64> {
        self.first..self.first + self.runs
    }
}

/// Writes the file of a chunk from its records in the order of the runs. Several processes may do it at the same time.
pub(crate) fn write<'a>(
    folder: &Path,
    header: &Header,
    mut records: impl Iterator<Item = &'a String>,
) -> Result<(), Error> {
    let path = header.chunk.path(folder);
    put(&path, true, |file| {
        let mut hash = Sha256::new();
        let mut line = |text: &str| {
            hash.update(text);
            hash.update("\n");
            writeln!(file, "{text}")
        };
        line(&serde_json::to_string(header)?)?;
        records.try_for_each(|record| line(record))?;
        writeln!(file, "{}", trailer(hash))
    })?;
    let begin = format!("{}.", header.chunk.name());
    left(path.parent().unwrap_or(folder), &begin).iter().for_each(|path| drop(fs::remove_file(path)));
    Ok(())
}

/// Writes a file that is whole when it has its name: under a new one, synchronised with the disk, and then renamed.
/// Locks are not needed, which a cluster's file system may not have. One that is there is replaced, or it stays.
pub(crate) fn put(
    path: &Path,
    replaces: bool,
    fill: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), Error> {
    let (folder, name) = (path.parent().unwrap_or(path), path.file_name().unwrap_or_default().to_string_lossy());
    let written = || -> io::Result<()> {
        let file = Builder::new().prefix(&format!("{name}.new-")).tempfile_in(folder)?;
        let mut writer = BufWriter::new(file.as_file());
        fill(&mut writer)?;
        writer.flush()?;
        drop(writer);
        // temporary files are for their owner only; others of a group collect the results
        #[cfg(unix)]
        file.as_file().set_permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644))?;
        file.as_file().sync_all()?;
        let named = if replaces { file.persist(path) } else { file.persist_noclobber(path) };
        match named {
            // another process has written the file, or has removed what was left
            Err(_) if path.exists() => {}
            named => drop(named?),
        }
        // makes the name permanent
        #[cfg(unix)]
        File::open(folder)?.sync_all()?;
        Ok(())
    };
    Ok(written().map_err(|error| not_written(path, error, AGAIN))?)
}

/// Removes what processes that were killed have left, when all chunks are there: one that is still at work comes to the
/// same files.
pub(crate) fn remove_left(folder: &Path) {
    let is_left = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        [".partial-", ".new-"].iter().any(|part| name.contains(part))
    };
    let chunks = left(&folder.join(CHUNKS_FOLDER), "").into_iter().filter(is_left);
    chunks.chain(left(folder, "plan.json.new-")).for_each(|path| drop(fs::remove_file(path)));
}

/// The files of a folder whose names begin like this.
pub(crate) fn left(folder: &Path, begin: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_left = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with(begin);
    let mut paths: Vec<_> = entries.filter(|entry| is_left(&entry.file_name())).map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// Creates a folder within that of a sweep, and those above it.
///
/// # Errors
/// A folder that cannot be created; a symbolic link of its name, which may lead to files of others.
pub(crate) fn create_folder(path: &Path) -> Result<(), Error> {
    refuse_link(path)?;
    fs::create_dir_all(path).map_err(|error| {
        Error::usage(format!("{} cannot be created: {error}", path.display()), "give a folder that can be written")
    })
}

/// Refuses a symbolic link in place of a folder within that of a sweep.
pub(crate) fn refuse_link(path: &Path) -> Result<(), Error> {
    if !path.is_symlink() {
        return Ok(());
    }
    let message = format!("{} is a symbolic link, which is not followed", path.display());
    Err(Error::usage(message, "remove it, or give the sweep another folder"))
}

/// Opens a file that is not a pipe, which would wait for its other end.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    refuse_pipe(path)?;
    File::open(path)
}

/// Gives each record of a chunk's file to `take`, in the order of the runs; returns the header, or why the file cannot be
/// used. Only when this returns is it known that the file is whole.
pub(crate) fn read(
    folder: &Path,
    chunk: Chunk,
    runs: u64,
    mut take: impl FnMut(Record) -> Result<(), Error>,
) -> Result<Result<Header, String>, Error> {
    let damaged = |what: &str| Ok(Err(what.to_owned()));
    let file = match open(&chunk.path(folder)) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return damaged("it is missing"),
        Err(error) => return damaged(&error.to_string()),
    };
    let mut lines = Lines::of(file);
    let Some(header) = lines.next::<Header>() else { return damaged("its first line is not a header") };
    if (header.chunk, header.range()) != (chunk, chunk.runs(runs)) {
        return damaged("it has other runs than its name");
    }
    for run in header.range() {
        match lines.next::<Record>() {
            Some(record) if record.run == run => take(record)?,
            _ => return damaged(&format!("run {run} is missing or cannot be read")),
        }
    }
    let trailer = trailer(lines.hash.clone());
    let is_whole = lines.next() == Some(trailer) && lines.reader.fill_buf().is_ok_and(<[u8]>::is_empty);
    if is_whole { Ok(Ok(header)) } else { damaged("its hash differs") }
}

/// The header of a chunk's file; `None` without a file, and within of one without a header.
pub(crate) fn header(path: &Path) -> Option<Option<Header>> {
    Some(Lines::of(open(path).ok()?).next())
}

/// Complete lines of JSON, and the hash of those read so far.
struct Lines {
    reader: BufReader<File>,
    hash: Sha256,
    line: String,
}

impl Lines {
    fn of(file: File) -> Lines {
        Lines { reader: BufReader::with_capacity(1 << 16, file), hash: Sha256::new(), line: String::new() }
    }

    fn next<T: DeserializeOwned>(&mut self) -> Option<T> {
        self.line.clear();
        self.reader.read_line(&mut self.line).ok()?;
        self.hash.update(self.line.as_bytes());
        serde_json::from_str(self.line.strip_suffix('\n')?).ok()
    }
}
