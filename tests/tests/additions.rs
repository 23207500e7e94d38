//! Protects the table "How to add …" of CONTRIBUTING.md: something small of each kind, a file each in `tests/additions`,
//! touches the files that its row names, all of them and no others. `make additions` compiles them, all at once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{env, fs};

use serde::Deserialize;

/// Something of a kind.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Addition {
    /// How its row begins.
    row: String,
    /// Files with their texts.
    #[serde(default)]
    new: BTreeMap<String, String>,
    /// Files that are copies of others but for some words.
    #[serde(default)]
    copy: BTreeMap<String, (String, Vec<[String; 2]>)>,
    /// What stands in a file once, with what then stands there.
    #[serde(default)]
    change: BTreeMap<String, Vec<[String; 2]>>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// All additions with the names of their files.
fn additions() -> Vec<(String, Addition)> {
    let files = fs::read_dir(root().join("tests/additions")).unwrap().map(|entry| entry.unwrap());
    let mut all: Vec<_> = files
        .map(|file| {
            let name = file.file_name().into_string().unwrap();
            let addition = toml::from_str(&fs::read_to_string(file.path()).unwrap());
            (name.clone(), addition.unwrap_or_else(|error| panic!("{name}: {error}")))
        })
        .collect();
    all.sort_by(|(a, _), (b, _)| a.cmp(b));
    all
}

impl Addition {
    fn touched(&self) -> impl Iterator<Item = &String> {
        self.new.keys().chain(self.copy.keys()).chain(self.change.keys())
    }

    /// Makes it, on top of files that others have changed.
    fn apply(&self, name: &str, files: &mut BTreeMap<String, String>) {
        let copies = self.copy.iter().map(|(path, (source, words))| {
            (path, words.iter().fold(read(source), |text, [old, new]| text.replace(old, new)))
        });
        for (path, text) in self.new.iter().map(|(path, text)| (path, text.clone())).chain(copies) {
            assert!(!root().join(path).exists(), "{name}: {path} is there already");
            assert!(files.insert(path.clone(), text).is_none(), "{name}: another addition has {path}");
        }
        for (path, changes) in &self.change {
            let text = files.entry(path.clone()).or_insert_with(|| read(path));
            for [old, new] in changes {
                assert_eq!(text.matches(old).count(), 1, "{name}: how often is {old:?} in {path}?");
                *text = text.replace(old, new);
            }
        }
    }
}

/// The rows of the table.
fn rows() -> Vec<String> {
    let page = read("CONTRIBUTING.md");
    let table = page.split("## How to add …").nth(1).and_then(|rest| rest.split("\n## ").next()).unwrap();
    table.lines().filter(|line| line.starts_with("| ")).skip(2).map(str::to_owned).collect()
}

/// The files that a row names; commands write what stands after that word.
fn named(row: &str) -> Vec<&str> {
    let by_hand = row.split(" writes ").next().unwrap();
    let quoted = by_hand.split('`').skip(1).step_by(2);
    quoted.filter(|text| !text.contains(' ') && (text.contains('/') || text.ends_with(".md"))).collect()
}

/// Whether a name in a row, of a file or a folder, or with NAME for any name and EXT for any ending, is that of a file.
fn is_name_of(name: &str, path: &str) -> bool {
    let Some((before, after)) = name.split_once("NAME") else {
        return path == name || (name.ends_with('/') && path.starts_with(name));
    };
    let Some(rest) = path.strip_prefix(before) else { return false };
    match after.strip_suffix("EXT") {
        Some(_) => rest.contains('.') && !rest.contains('/'),
        None => rest.strip_suffix(after).is_some_and(|name| !name.contains('/')),
    }
}

#[test]
fn additions_touch_the_files_that_their_rows_name() {
    let (rows, additions) = (rows(), additions());
    let mut files = BTreeMap::new();
    for (name, addition) in &additions {
        addition.apply(name, &mut files);
        let row = rows.iter().find(|row| row[2..].starts_with(&addition.row));
        let named = named(row.unwrap_or_else(|| panic!("{name}: there is no row `{}`", addition.row)));
        for path in addition.touched() {
            assert!(named.iter().any(|name| is_name_of(name, path)), "the row `{}` lacks {path}", addition.row);
        }
        for name in named {
            assert!(addition.touched().any(|path| is_name_of(name, path)), "{}: nothing is in {name}", addition.row);
        }
    }
    for row in &rows {
        assert!(
            additions.iter().any(|(_, addition)| row[2..].starts_with(&addition.row)),
            "nothing is added as in {row}"
        );
    }
}

/// Copies a folder, without what is built and without hidden files; files that are the same stay.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(|entry| entry.unwrap()) {
        let (name, path) = (entry.file_name(), entry.path());
        if name == "target" || name.to_str().is_some_and(|name| name.starts_with('.')) {
            continue;
        }
        match entry.file_type().unwrap() {
            kind if kind.is_dir() => copy(&path, &to.join(name)),
            kind if kind.is_file() => write(&to.join(name), &fs::read(path).unwrap()),
            _ => {}
        }
    }
}

/// Writes what is not there, so that cargo checks no more than it has to.
fn write(path: &Path, content: &[u8]) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    if fs::read(path).ok().as_deref() != Some(content) {
        fs::write(path, content).unwrap();
    }
}

#[test]
#[ignore = "checks the whole workspace once more: `make additions`"]
fn all_additions_compile_together() {
    let folder = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from).join("additions");
    let sources = folder.join("sources");
    let mut files = BTreeMap::new();
    additions().iter().for_each(|(name, addition)| addition.apply(name, &mut files));
    copy(&root(), &sources);
    files.iter().for_each(|(path, text)| write(&sources.join(path), text.as_bytes()));
    let mut cargo = std::process::Command::new(env!("CARGO"));
    cargo.args(["check", "--workspace", "--all-targets", "--features", "mpfr", "--locked"]).current_dir(&sources);
    assert!(cargo.env("CARGO_TARGET_DIR", folder.join("target")).status().unwrap().success());
}
