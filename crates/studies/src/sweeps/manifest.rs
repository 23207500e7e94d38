//! `plan.json` in the folder of a sweep: what its chunks are of. With it, results are collected without the sweep's
//! files.

use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use shadowstep::tables::Source;
use shadowstep_schemes::document::read_text;

use crate::Error;
use crate::sweeps::chunk::{CHUNKS_FOLDER, Chunk, Header, MOST_RUNS_OF_CHUNK, create_folder, put, refuse_link};
use crate::sweeps::keep::Column;
use crate::sweeps::plan::{Digests, SweepPlan, hash};

/// The name of the file.
pub(crate) const NAME: &str = "plan.json";

/// The most bytes of the file.
const LARGEST: u64 = 1 << 28;

/// The end of a sentence.
const OTHER_TABLES: &str = "was made with other tables of schemes, or other files of particles or bodies";

/// Where nothing else is said, a sweep on one machine has this many chunks.
const CHUNKS: u64 = 16;

/// And no more runs than this in each.
const RUNS_OF_CHUNK: u64 = 1 << 16;

/// What is in the folder of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// What determines the results.
    #[serde(flatten)]
    pub digests: Digests,
    /// How many runs there are.
    pub runs: u64,
    /// How many chunks.
    pub chunks: u64,
    /// What the values of a record are.
    pub columns: Vec<Column>,
    /// Whether numbers have more digits than double precision.
    pub long_numbers: bool,
    /// The path of the sweep's file.
    pub path: String,
    /// Its text, of which the axes and the picture are needed to collect the results.
    pub text: String,
    /// The hash of all that in the file; see [`Manifest::hash`].
    #[serde(default, skip_serializing_if = "String::is_empty")]
    sha256: String,
}

impl Manifest {
    /// That of the folder: the one that is there, which must be of this plan, or a new one with this many chunks.
    ///
    /// # Errors
    /// A folder of another sweep, or of another number of chunks; a folder that cannot be written.
    pub fn begin(folder: &Path, plan: &SweepPlan, chunks: Option<u64>) -> Result<Manifest, Error> {
        let runs = plan.axes().runs();
        let wanted = chunks.unwrap_or_else(|| runs.min(CHUNKS.max(runs.div_ceil(RUNS_OF_CHUNK))));
        check_chunks(wanted, runs)?;
        let own = Manifest {
            digests: plan.digests.clone(),
            runs,
            chunks: wanted,
            columns: plan.columns.clone(),
            long_numbers: plan.long_numbers,
            path: plan.source.path.clone(),
            text: plan.source.text.clone(),
            sha256: String::new(),
        };
        create_folder(&folder.join(CHUNKS_FOLDER))?;
        own.write(folder, false)?;
        let there = Manifest::read(folder)?;
        there.check(&own, chunks.is_some(), folder)?;
        // another picture or comment changes no result
        if there.text != own.text {
            let own = Manifest { chunks: there.chunks, ..own };
            own.write(folder, true)?;
            return Ok(own);
        }
        Ok(there)
    }

    /// That of a folder.
    ///
    /// # Errors
    /// A folder without one, a file that is not one.
    pub fn read(folder: &Path) -> Result<Manifest, Error> {
        refuse_link(&folder.join(CHUNKS_FOLDER))?;
        let path = folder.join(NAME);
        let wrong = |message| Error::usage(message, "give the folder of `shadowstep sweep FILE --out DIR`");
        let text = read_text(&path, LARGEST).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => wrong(format!("{} has no {NAME}", folder.display())),
            _ => wrong(format!("{} cannot be read: {error}", path.display())),
        })?;
        let found = serde_json::from_str::<Manifest>(&text).ok();
        let found = found.filter(|found| (1..=found.runs).contains(&found.chunks));
        let manifest = found.ok_or_else(|| wrong(format!("{} is not the plan of a sweep", path.display())))?;
        if manifest.hash() != manifest.sha256 {
            let message = format!("{} was changed: its hash differs", path.display());
            return Err(Error::usage(message, "restore it, or remove it and run the sweep again, which writes it"));
        }
        Ok(manifest)
    }

    /// Of everything that gives the table its rows and columns; the path is for messages only.
    fn hash(&self) -> String {
        let manifest = Manifest { path: String::new(), sha256: String::new(), ..self.clone() };
        hash(&serde_json::to_string(&manifest).expect("it consists of texts and numbers"))
    }

    /// Whether a folder has one.
    pub fn is_in(folder: &Path) -> bool {
        folder.join(NAME).exists()
    }

    /// All chunks.
    pub fn all_chunks(&self) -> impl Iterator<Item = Chunk> + Clone + use<> {
        let of = self.chunks;
        (1..=of).map(move |number| Chunk { number, of })
    }

    /// The text of the sweep.
    pub(crate) fn source(&self) -> Source {
        Source { path: self.path.clone(), text: self.text.clone() }
    }

    /// The header of a chunk that this process makes.
    pub(crate) fn header(&self, plan: &SweepPlan, chunk: Chunk) -> Header {
        let functions = plan.functions().map(str::to_owned);
        let (first, runs) = (chunk.runs(self.runs).start, chunk.count(self.runs));
        Header { digests: self.digests.clone(), functions, chunk, first, runs }
    }

    /// Whether a chunk with this header belongs to the sweep; if not, why.
    pub(crate) fn check_header(&self, header: &Header) -> Result<(), String> {
        let version = format!("it was made by version {}", header.digests.shadowstep);
        let sentences = [version, "it is of another sweep".to_owned(), format!("it {OTHER_TABLES}")];
        self.digests.difference(&header.digests, sentences).map_or(Ok(()), Err)
    }

    fn check(&self, own: &Manifest, chunks_given: bool, folder: &Path) -> Result<(), Error> {
        let shown = folder.display();
        let (version, own_version) = (&self.digests.shadowstep, &own.digests.shadowstep);
        let sentences = [
            format!("{shown} is of version {version} of shadowstep, not of {own_version}"),
            format!("{shown} is of another sweep, or of this one before it was changed"),
            format!("{shown} {OTHER_TABLES}"),
        ];
        if let Some(message) = self.digests.difference(&own.digests, sentences) {
            return Err(Error::usage(message, "give another folder, or replace what this one has with `force`"));
        }
        if chunks_given && self.chunks != own.chunks {
            let message = format!("{shown} has {} chunks, not {}", self.chunks, own.chunks);
            return Err(Error::usage(message, format!("give it {} chunks, or another folder", self.chunks)));
        }
        Ok(())
    }

    /// Writes the file; one that is there stays, unless it is replaced: of several processes that begin at the same time,
    /// the first one writes it.
    fn write(&self, folder: &Path, replaces: bool) -> Result<(), Error> {
        let path = folder.join(NAME);
        if path.exists() && !replaces {
            return Ok(());
        }
        put(&path, replaces, |file| {
            serde_json::to_writer_pretty(&mut *file, &Manifest { sha256: self.hash(), ..self.clone() })?;
            writeln!(file)
        })
    }
}

/// A number of chunks that a sweep can have.
pub(crate) fn check_chunks(chunks: u64, runs: u64) -> Result<(), Error> {
    if chunks > runs {
        let message = format!("{runs} runs cannot be divided into {chunks} chunks");
        return Err(Error::usage(message, format!("use at most {runs} chunks")));
    }
    let least = runs.div_ceil(MOST_RUNS_OF_CHUNK);
    if chunks < least {
        let message =
            format!("{chunks} chunks of {runs} runs are too long: a chunk has at most {MOST_RUNS_OF_CHUNK} runs");
        return Err(Error::usage(message, format!("use at least {least} chunks")));
    }
    Ok(())
}
