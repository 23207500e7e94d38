//! Files are created and replaced in one way, `WholeFile`, or opened by `open_locked` and `open_itself`; what does it
//! otherwise has a reason.

use std::fs;
use std::path::{Path, PathBuf};

/// What creates, replaces or removes files or folders.
const CALLS: [&str; 11] = [
    "fs::write(",
    "fs::copy(",
    "fs::rename(",
    "File::create",
    "OpenOptions::new",
    "create_dir",
    "hard_link(",
    "tempfile_in(",
    "NamedTempFile::new",
    "tempdir(",
    ".persist",
];

/// The same in Python.
const CALLS_OF_PYTHON: [&str; 8] =
    ["\"wb\"", ", \"w\")", ", \"w\",", "write_text", "write_bytes", "os.replace", "mkdir", "tempfile."];

/// Files that have such calls, and why.
const REASONS: [(&str, &str); 8] = [
    ("crates/scenes/src/files/whole_file.rs", "it is the way"),
    (
        "crates/scenes/src/results/resumable.rs",
        "what is resumed has names that are known, and is opened by open_locked; a checkpoint is a new file",
    ),
    (
        "crates/studies/src/store.rs",
        "outcomes are appended, by open_locked; a folder that the user names; another version's file is renamed",
    ),
    (
        "crates/studies/src/sweeps/chunk.rs",
        "several processes write a chunk: new files of random names; folders that are not links",
    ),
    ("crates/studies/src/sweeps/partial.rs", "as chunk.rs"),
    ("cli/src/man.rs", "a folder that the user names"),
    ("cli/src/terminal.rs", "a new folder among the temporary ones of the system"),
    ("python/shadowstep/work_precision.py", "a new folder among the temporary ones of the system"),
];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match entry.is_dir() {
            true => files(&entry, found),
            false => found.push(entry),
        }
    }
}

/// The lines of a program without tests and comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    let end = text.find("#[cfg(test)]\nmod").or(text.find("#[cfg(all(test")).unwrap_or(text.len());
    text[..end]
        .lines()
        .filter(|line| !["//", "#", ">>>", "..."].iter().any(|begin| line.trim_start().starts_with(begin)))
}

#[test]
fn files_are_written_in_one_way() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut all = Vec::new();
    let folders = [root.to_owned(), root.join("crates")];
    let crates = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    crates
        .filter(|folder| folder.join("src").is_dir() && !folder.ends_with("tests"))
        .for_each(|folder| files(&folder.join("src"), &mut all));
    files(&root.join("python/shadowstep"), &mut all);
    let mut writers = Vec::new();
    for path in all.iter().filter(|path| !path.ends_with("tests.rs")) {
        let calls: &[&str] = match path.extension().and_then(|ending| ending.to_str()) {
            Some("rs") => &CALLS,
            Some("py") => &CALLS_OF_PYTHON,
            _ => continue,
        };
        let text = fs::read_to_string(path).unwrap();
        if code(&text)
            .map(|line| line.replace("WholeFile::create", ""))
            .any(|line| calls.iter().any(|call| line.contains(call)))
        {
            writers.push(path.strip_prefix(root).unwrap().display().to_string());
        }
    }
    writers.sort();
    let mut known = REASONS.map(|(path, _)| path.to_owned());
    known.sort();
    assert_eq!(writers, known);
}
