//! The file of outcomes: a header, and one line per calculation that is done.
//!
//! A line is written as soon as its calculation is done, so that all lines but the last are complete however the
//! program ends. It has a hash, so that a damaged one is refused. The process holds a lock on the file, which the
//! system releases when the process ends.

use std::collections::HashMap;
use std::fmt::Display;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use shadowstep_scenes::lock::{LockError, open_locked};
use shadowstep_scenes::not_written;

use crate::threads::compute;
use crate::{Calculation, Error, Observer};

/// The most bytes of the file.
const LARGEST: u64 = 1 << 30;

/// What helps after an outcome could not be written.
const MISSING: &str = "run the command again: it computes what is not saved yet";

/// The name of the file in its folder.
const NAME: &str = "results.jsonl";

/// The outcomes in a folder by the JSON of their calculations.
#[derive(Debug)]
pub struct Store {
    path: PathBuf,
    file: File,
    outcomes: HashMap<String, String>,
}

impl Drop for Store {
    /// A program that this process starts at this moment may have the open file, and with it the lock, for a while.
    fn drop(&mut self) {
        drop(self.file.unlock());
    }
}

/// The first line: the version of the program.
#[derive(Deserialize)]
struct Header {
    shadowstep: String,
}

#[derive(Deserialize)]
struct Line {
    task: Value,
    outcome: Value,
}

impl Store {
    /// Opens `results.jsonl` in a folder, which is created if it does not exist.
    ///
    /// A file of another version of the program is renamed. An incomplete last line, from an interrupted program, is
    /// dropped.
    /// # Errors
    /// Another process has the file; a line is not an outcome of a calculation.
    pub fn open(folder: &Path, observer: &mut dyn Observer) -> Result<Store, Error> {
        Store::open_as(folder, env!("CARGO_PKG_VERSION"), observer)
    }

    /// Whether a folder has such a file.
    pub(crate) fn is_in(folder: &Path) -> bool {
        folder.join(NAME).exists()
    }

    fn open_as(folder: &Path, version: &str, observer: &mut dyn Observer) -> Result<Store, Error> {
        fs::create_dir_all(folder).map_err(|error| cannot(folder, &error))?;
        let path = folder.join(NAME);
        let mut file = locked(&path)?;
        let mut bytes = Vec::new();
        if file.metadata()?.len() > LARGEST {
            return Err(foreign(&path, &format!("it is longer than {} MiB", LARGEST >> 20)));
        }
        (&file).take(LARGEST).read_to_end(&mut bytes)?;
        let header = format!("{}\n", json!({ "shadowstep": version }));
        // the program ended within its first line
        if header.as_bytes().starts_with(&bytes) && bytes.len() < header.len() {
            let written = file.set_len(0).and_then(|()| file.write_all(header.as_bytes()));
            written.map_err(|error| not_written(&path, error, MISSING))?;
            return Ok(Store { path, file, outcomes: HashMap::new() });
        }
        let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let text = std::str::from_utf8(&bytes[..whole]).map_err(|_| foreign(&path, "it is not UTF-8 text"))?;
        let (first, lines) = text.split_once('\n').unwrap_or(("", ""));
        let found: Header =
            serde_json::from_str(first).map_err(|_| foreign(&path, "its first line is not the program's"))?;
        if found.shadowstep != version {
            let aside = unused(folder, &found.shadowstep);
            fs::rename(&path, &aside).map_err(|error| cannot(&path, &error))?;
            observer.note(&format!(
                "{} is of version {}, not of {version}: it was renamed to {}, and everything is computed again",
                path.display(),
                found.shadowstep,
                aside.display()
            ));
            drop(file);
            return Store::open_as(folder, version, observer);
        }
        let mut outcomes = HashMap::new();
        for (n, line) in lines.lines().enumerate() {
            if !is_sealed(line) {
                return Err(damaged(&path, n + 2, "its hash is missing or another"));
            }
            let Line { task, outcome } = serde_json::from_str(line).map_err(|error| damaged(&path, n + 2, error))?;
            outcomes.insert(task.to_string(), outcome.to_string());
        }
        file.set_len(whole as u64)?;
        Ok(Store { path, file, outcomes })
    }

    /// Makes the calculations whose outcomes the store lacks, the most expensive first, and returns all outcomes in the
    /// order of the calculations; `None` for one that fails, which is reported to the observer and stops no other.
    ///
    /// It uses all threads of the current rayon pool: one per core, or the number of `RAYON_NUM_THREADS` or of the
    /// caller's pool. Outcomes are always read back from their JSON, so that they depend neither on the threads nor on
    /// earlier calls.
    ///
    /// # Errors
    /// A store that cannot be written; an observer that stops the computation.
    pub fn compute<C: Calculation>(
        &mut self,
        calculations: &[C],
        observer: &mut dyn Observer,
    ) -> Result<Vec<Option<C::Outcome>>, Error> {
        let mut failures = Vec::new();
        let outcomes = self.outcomes(calculations, &mut failures, observer)?;
        failures.iter().for_each(|error| observer.failed(error));
        Ok(outcomes)
    }

    /// The outcome of one calculation, which is made if the store lacks it.
    ///
    /// # Errors
    /// As above; the failure of the calculation.
    pub(crate) fn compute_one<C: Calculation>(
        &mut self,
        calculation: C,
        observer: &mut dyn Observer,
    ) -> Result<C::Outcome, Error> {
        let mut failures = Vec::new();
        let mut outcomes = self.outcomes(&[calculation], &mut failures, observer)?;
        match failures.pop() {
            Some(error) => Err(error),
            None => Ok(outcomes.pop().flatten().expect("what does not fail has an outcome")),
        }
    }

    /// All outcomes if the store has them; nothing is computed.
    pub fn kept<C: Calculation>(&self, calculations: &[C]) -> Option<Vec<C::Outcome>> {
        calculations.iter().map(|calculation| self.kept_one::<C>(&key(calculation).ok()?)).collect()
    }

    /// One outcome if the store has it; in another form it is none.
    fn kept_one<C: Calculation>(&self, key: &str) -> Option<C::Outcome> {
        serde_json::from_str(self.outcomes.get(key)?).ok()
    }

    /// The outcomes; adds the failures in the order of the calculations.
    fn outcomes<C: Calculation>(
        &mut self,
        calculations: &[C],
        failures: &mut Vec<Error>,
        observer: &mut dyn Observer,
    ) -> Result<Vec<Option<C::Outcome>>, Error> {
        let keys = calculations.iter().map(key).collect::<Result<Vec<_>, _>>()?;
        // equal calculations are made at the first of their places
        let first: HashMap<&str, usize> =
            keys.iter().enumerate().rev().map(|(place, key)| (key.as_str(), place)).collect();
        let is_due =
            |place: &usize| first[keys[*place].as_str()] == *place && self.kept_one::<C>(&keys[*place]).is_none();
        let due: Vec<usize> = (0..keys.len()).filter(is_due).collect();
        let mut keep = |place: usize, outcome, took| self.keep(&keys[place], outcome, took);
        let failed = compute(calculations, &due, &mut keep, observer)?;
        let outcome = |key: &String| match failed.iter().any(|(place, _)| *place == first[key.as_str()]) {
            true => None,
            false => self.kept_one::<C>(key),
        };
        let outcomes = keys.iter().map(outcome).collect();
        failures.extend(failed.into_iter().map(|(_, error)| error));
        Ok(outcomes)
    }

    /// Adds an outcome, also to the file. After an error, the last line of the file may be incomplete.
    fn keep(&mut self, task: &str, outcome: String, took: Duration) -> Result<(), Error> {
        let seconds = (took.as_secs_f64() * 1e3).round() / 1e3;
        // one write, so that only the system can split it
        let task_and_outcome = format!("{{\"task\":{task},\"outcome\":{outcome}");
        let hash = hash(&task_and_outcome);
        let line = format!("{task_and_outcome}{BEFORE_HASH}{hash}\",\"seconds\":{seconds}}}\n");
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.sync_data());
        written.map_err(|error| not_written(&self.path, error, MISSING))?;
        self.outcomes.insert(task.to_owned(), outcome);
        Ok(())
    }
}

/// The JSON of a calculation; a `Value` is written in one way only.
fn key<C: Serialize>(calculation: &C) -> Result<String, Error> {
    Ok(serde_json::to_value(calculation)?.to_string())
}

/// The file, locked for this process; writes append to it.
fn locked(path: &Path) -> Result<File, Error> {
    open_locked(path, OpenOptions::new().read(true).append(true).create(true)).map_err(|error| match error {
        LockError::Taken => {
            let message = format!("another process uses {}", path.display());
            Error::usage(message, "wait until that process ends, or give another folder")
        }
        LockError::Io(error) => cannot(path, &error),
    })
}

/// An unused file name: `results-0.1.0.jsonl`, `results-0.1.0-2.jsonl`, …
fn unused(folder: &Path, version: &str) -> PathBuf {
    let plain: String =
        version.chars().map(|c| if c.is_ascii_alphanumeric() || "._-+".contains(c) { c } else { '_' }).collect();
    let mut path = folder.join(format!("results-{plain}.jsonl"));
    let mut n = 1;
    while path.exists() {
        n += 1;
        path = folder.join(format!("results-{plain}-{n}.jsonl"));
    }
    path
}

fn cannot(path: &Path, error: &std::io::Error) -> Error {
    let message = format!("{} cannot be written: {error}", path.display());
    Error::usage(message, "give a folder that you can write to")
}

fn foreign(path: &Path, why: &str) -> Error {
    let message = format!("{} is not a file of outcomes: {why}", path.display());
    Error::usage(message, "give another folder, or remove the file")
}

/// What is between an outcome and its hash.
const BEFORE_HASH: &str = ",\"sha256\":\"";

/// Whether the hash of a line is that of its task and outcome.
fn is_sealed(line: &str) -> bool {
    line.rsplit_once(BEFORE_HASH).is_some_and(|(task_and_outcome, rest)| rest.starts_with(&hash(task_and_outcome)))
}

/// The first half of the SHA-256, in hexadecimal digits.
fn hash(text: &str) -> String {
    Sha256::digest(text)[..16].iter().map(|byte| format!("{byte:02x}")).collect()
}

fn damaged(path: &Path, line: usize, error: impl Display) -> Error {
    let message = format!("{}:{line}: not an outcome of a task: {error}", path.display());
    Error::usage(message, "delete the line; its task is then computed again")
}

#[cfg(test)]
mod tests;
