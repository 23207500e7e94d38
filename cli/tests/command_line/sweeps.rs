//! `shadowstep sweep` and `shadowstep collect`: chunks in any order and by any number of processes come to the files of
//! a sweep that nothing disturbed.

mod chunks;
mod collected;
#[cfg(unix)]
mod disturbed;
mod values;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

use crate::program::Finished;

/// 60 short runs, none of which fails.
const SWEEP: &str = r#"
[problem]
name = "kepler"
parameters.eccentricity = "e"
[run]
scheme = "$scheme"
step = "h"
until = 3
digits = "double"
[output]
trajectory = { every = 20 }
[axes]
scheme = ["stormer-verlet", "ruth3"]
e = "0 … 4/5 in 2 steps"
h = "1/10 … 1/100 in 9 steps of 1/h"
[keep]
values = ["energy_error", "steps"]
first_time = { near = "x^2 + y^2 < 1/2" }
at_end = { L = "x*py - y*px" }
rows = true
"#;

/// A table of a scheme.
const TABLE: &str = r#"name = "mine"
order = 2
kinetic = "any"
symmetric = true
reference = "L. Verlet"
[composition]
base = "stormer-verlet"
gamma = ["1"]
"#;

/// A folder with sweep.toml and mine.toml.
fn folder(sweep: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("sweep.toml"), sweep).unwrap();
    fs::write(folder.path().join("mine.toml"), TABLE).unwrap();
    folder
}

/// The program in a folder, which is no task of an array.
fn program(folder: &Path, words: &str) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
    program.args(words.split_whitespace()).current_dir(folder);
    for name in ["ID", "COUNT", "MIN", "MAX"] {
        program.env_remove(format!("SLURM_ARRAY_TASK_{name}"));
    }
    program.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    program
}

fn finished(output: &Output) -> Finished {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    Finished { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) }
}

fn run(folder: &Path, words: &str) -> Finished {
    finished(&program(folder, words).output().unwrap())
}

/// As [`run`]; it must succeed.
fn succeeds(folder: &Path, words: &str) -> Finished {
    let result = run(folder, words);
    assert_eq!(result.code, 0, "{words}: {}{}", result.out, result.err);
    result
}

/// All files of a folder and its folders.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap()) {
        let name = entry.file_name().into_string().unwrap();
        match entry.file_type().unwrap().is_dir() {
            true => {
                found.extend(files(&entry.path()).into_iter().map(|(file, bytes)| (format!("{name}/{file}"), bytes)))
            }
            false => drop(found.insert(name, fs::read(entry.path()).unwrap())),
        }
    }
    found
}

/// The same files with the same bytes.
fn assert_same(found: &Path, wanted: &BTreeMap<String, Vec<u8>>, when: &str) {
    let found = files(found);
    assert_eq!(found.keys().collect::<Vec<_>>(), wanted.keys().collect::<Vec<_>>(), "{when}");
    for (name, bytes) in &found {
        assert!(bytes == &wanted[name], "{when}: {name} has other bytes");
    }
}

/// What a sweep gives that nothing disturbs.
fn undisturbed(sweep: &str) -> BTreeMap<String, Vec<u8>> {
    let folder = folder(sweep);
    succeeds(folder.path(), "sweep sweep.toml --out out");
    files(&folder.path().join("out"))
}

/// The rows of a table without its head, as fields.
fn rows(folder: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(folder.join("out/results.csv")).unwrap();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let row = |row: csv::StringRecord| names.iter().map(str::to_owned).zip(row.iter().map(str::to_owned)).collect();
    reader.records().map(|found| row(found.unwrap())).collect()
}
