//! Chunks: which runs one has, and its file.
//!
//! A file has a header, a record a line in the order of the runs, and a hash of all that. Its bytes depend on the plan
//! only, not on who computes it, when, or with how many threads.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use shadowstep_scenes::{Error, hexadecimal, not_written};
use shadowstep_schemes::document::refuse_pipe;
use tempfile::Builder;

use crate::plan::Digests;
use crate::record::Record;

/// The most runs of a chunk: they are sorted in memory.
pub(crate) const MOST_RUNS_OF_CHUNK: u64 = 1 << 20;

/// The folder of the chunks, in the one of the sweep.
pub(crate) const CHUNKS_FOLDER: &str = "chunks";

/// What helps when a chunk cannot be written.
pub(crate) const AGAIN: &str = "run the command again: it computes what is not saved yet";

/// Chunk `number` of `of`, both counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chunk {
    /// From 1 to `of`.
    pub number: u64,
    /// How many chunks there are.
    pub of: u64,
}

/// The first line of a chunk's file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Header {
    pub(crate) shadowstep: String,
    #[serde(flatten)]
    pub(crate) digests: Digests,
    /// The elementary functions of double precision, which depend on the machine; `None` where they are not used.
    pub(crate) functions: Option<String>,
    pub(crate) chunk: u64,
    pub(crate) of: u64,
    pub(crate) first: u64,
    pub(crate) runs: u64,
}

#[derive(Serialize, Deserialize)]
struct Trailer {
    sha256: String,
}

/// Why a chunk's file cannot be used.
#[derive(Debug)]
pub(crate) enum Unusable {
    /// There is none.
    Missing,
    /// It is not what was written, or something else was.
    Damaged(String),
}

impl Chunk {
    /// The runs of the chunk, out of this number: the chunks have equally many, give or take one.
    pub(crate) fn runs(self, runs: u64) -> Range<u64> {
        let bound = |chunk: u64| (u128::from(chunk) * u128::from(runs) / u128::from(self.of)) as u64;
        bound(self.number - 1)..bound(self.number)
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

/// Writes the file of a chunk from its records in the order of the runs: under a temporary name, synchronised with the
/// disk, and then renamed. Several processes may do it at the same time.
pub(crate) fn write(folder: &Path, chunk: Chunk, header: &Header, records: &[String]) -> Result<(), Error> {
    let path = chunk.path(folder);
    let parent = path.parent().unwrap_or(folder);
    let written = || -> io::Result<()> {
        let file = Builder::new().prefix(&format!("{}.new-", chunk.name())).tempfile_in(parent)?;
        let mut writer = Hashing { writer: io::BufWriter::new(file.as_file()), hash: Sha256::new() };
        writeln!(writer, "{}", serde_json::to_string(header)?)?;
        for record in records {
            writer.write_all(record.as_bytes())?;
            writer.write_all(b"\n")?;
        }
        let trailer = Trailer { sha256: hexadecimal(&writer.hash.clone().finalize()) };
        writeln!(writer, "{}", serde_json::to_string(&trailer)?)?;
        writer.flush()?;
        drop(writer);
        make_readable(file.as_file())?;
        file.as_file().sync_all()?;
        match file.persist(&path) {
            // another process has saved the same bytes, and removed what was left
            Err(_) if path.exists() => {}
            persisted => drop(persisted?),
        }
        sync_folder(parent)
    };
    written().map_err(|error| not_written(&path, error, AGAIN))?;
    left(parent, &format!("{}.", chunk.name())).iter().for_each(|path| drop(std::fs::remove_file(path)));
    Ok(())
}

/// Removes what processes that were killed have left, when all chunks are there: one that is still at work comes to the
/// same files.
pub(crate) fn remove_left(folder: &Path) {
    let is_left = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        [".partial-", ".new-"].iter().any(|part| name.contains(part))
    };
    let chunks = left(&folder.join(CHUNKS_FOLDER), "").into_iter().filter(is_left);
    chunks.chain(left(folder, "plan.json.new-")).for_each(|path| drop(std::fs::remove_file(path)));
}

/// The files of a folder whose names begin like this.
pub(crate) fn left(folder: &Path, begin: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_left = |name: &std::ffi::OsStr| name.to_string_lossy().starts_with(begin);
    let mut paths: Vec<_> = entries.filter(|entry| is_left(&entry.file_name())).map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// Temporary files are for their owner only; others of a group collect the results.
#[cfg(unix)]
pub(crate) fn make_readable(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
pub(crate) fn make_readable(_: &File) -> io::Result<()> {
    Ok(())
}

/// Creates a folder within that of a sweep, and those above it.
///
/// # Errors
/// A folder that cannot be created; a symbolic link of its name, which may lead to files of others.
pub(crate) fn create_folder(path: &Path) -> Result<(), Error> {
    refuse_link(path)?;
    std::fs::create_dir_all(path).map_err(|error| {
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

/// Makes the name of a file permanent.
#[cfg(unix)]
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
pub(crate) fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

struct Hashing<W> {
    writer: W,
    hash: Sha256,
}

impl<W: Write> Write for Hashing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.writer.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Opens a file that is not a pipe, which would wait for its other end.
pub(crate) fn open(path: &Path) -> io::Result<File> {
    refuse_pipe(path)?;
    File::open(path)
}

/// Gives each record of a chunk's file to `take`, in the order of the runs; returns the header. Only when this returns
/// is it known that the file is whole.
pub(crate) fn read(
    folder: &Path,
    chunk: Chunk,
    runs: u64,
    mut take: impl FnMut(Record) -> Result<(), Error>,
) -> Result<Result<Header, Unusable>, Error> {
    let damaged = |what: &str| Ok(Err(Unusable::Damaged(what.to_owned())));
    let file = match open(&chunk.path(folder)) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Err(Unusable::Missing)),
        Err(error) => return damaged(&error.to_string()),
    };
    let mut lines = Lines { reader: BufReader::with_capacity(1 << 16, file), hash: Sha256::new(), line: String::new() };
    let Some(header) = lines.next().and_then(|line| serde_json::from_str::<Header>(line).ok()) else {
        return damaged("its first line is not a header");
    };
    let own = chunk.runs(runs);
    if (header.chunk, header.of, header.first, header.runs) != (chunk.number, chunk.of, own.start, own.end - own.start)
    {
        return damaged("it has other runs than its name");
    }
    for run in own {
        match lines.next().and_then(|line| serde_json::from_str::<Record>(line).ok()) {
            Some(record) if record.run == run => take(record)?,
            _ => return damaged(&format!("run {run} is missing or cannot be read")),
        }
    }
    let hash = hexadecimal(&lines.hash.clone().finalize());
    match lines.next().and_then(|line| serde_json::from_str::<Trailer>(line).ok()) {
        Some(trailer) if trailer.sha256 == hash && lines.is_at_end() => Ok(Ok(header)),
        _ => damaged("its hash differs"),
    }
}

/// Complete lines, and the hash of those read so far.
struct Lines<R> {
    reader: R,
    hash: Sha256,
    line: String,
}

impl<R: BufRead> Lines<R> {
    fn next(&mut self) -> Option<&str> {
        self.line.clear();
        self.reader.read_line(&mut self.line).ok().filter(|length| *length > 0)?;
        self.hash.update(self.line.as_bytes());
        self.line.strip_suffix('\n')
    }

    fn is_at_end(&mut self) -> bool {
        self.reader.fill_buf().is_ok_and(<[u8]>::is_empty)
    }
}
