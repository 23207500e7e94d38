//! A command in a folder of its own, with its files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::commands::Disturbed;
use crate::shim::shim;

/// The contents of files by their names.
pub(crate) type Files = BTreeMap<String, String>;

/// A command in its folder.
pub(crate) struct Work {
    command: Disturbed,
    pub(crate) folder: TempDir,
}

impl Work {
    pub(crate) fn new(command: Disturbed) -> Self {
        let folder = TempDir::new().unwrap();
        if !command.scene.is_empty() {
            fs::write(folder.path().join("scene.toml"), command.scene).unwrap();
        }
        Work { command, folder }
    }

    /// The program, with nothing on stdout and its messages kept.
    pub(crate) fn program(&self) -> Command {
        let mut program = Command::new(env!("CARGO_BIN_EXE_shadowstep"));
        program.args(self.command.words.replace("FOLDER", &self.path()).split_whitespace());
        program.stdout(Stdio::null()).stderr(Stdio::piped());
        program
    }

    /// The program with a fault of the shim.
    pub(crate) fn with_fault(&self, settings: &[(&str, String)]) -> Command {
        let mut program = self.program();
        program.env("LD_PRELOAD", shim()).envs(settings.iter().map(|(name, value)| (*name, value)));
        program
    }

    fn path(&self) -> String {
        self.folder.path().display().to_string()
    }

    /// All files, also in folders. Of saved outcomes the order and the times differ from run to run.
    pub(crate) fn files(&self) -> Files {
        self.files_in(self.folder.path())
    }

    fn files_in(&self, folder: &Path) -> Files {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
        let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut found: Files = files.iter().map(|path| (name(path), self.content(path))).collect();
        folders.iter().for_each(|folder| found.extend(self.files_in(folder)));
        found
    }

    fn content(&self, path: &Path) -> String {
        let text = fs::read_to_string(path).unwrap().replace(&self.path(), "FOLDER");
        if !path.ends_with("results.jsonl") {
            return text;
        }
        let mut lines: Vec<_> = text.lines().map(|line| line.split(",\"seconds\"").next().unwrap()).collect();
        lines.sort_unstable();
        lines.join("\n")
    }

    /// Nothing is there but what belongs to an unfinished command, and no file has its name before it is complete.
    pub(crate) fn check(&self, whole: &Files, when: &str) {
        for (name, content) in self.files() {
            let is_unfinished = name == "results.jsonl"
                // a chunk of a sweep or its plan, with a random ending
                || [".partial-", ".new-"].iter().any(|part| name.contains(part))
                || [".partial", ".checkpoint", ".checkpoint.new", ".shadowstep-partial"]
                    .iter()
                    .any(|end| name.ends_with(end));
            let is_whole = whole.get(&name) == Some(&content);
            assert!(is_unfinished || is_whole, "{} {when}: {name} is not complete", self.command.name);
        }
    }

    /// As [`check`](Work::check), and nothing is left that cannot be resumed.
    pub(crate) fn check_without_litter(&self, whole: &Files, when: &str) {
        self.check(whole, when);
        let files = self.files();
        let names: Vec<&String> = files.keys().collect();
        let has = |end: &str| names.iter().any(|name| name.ends_with(end));
        // the last checkpoint stays beside a complete file
        let resumes = |name: &String| name.ends_with(".checkpoint") && whole.get(name) != files.get(name);
        let is_clean = !has(".new")
            && !names.iter().any(|name| name.contains(".new-"))
            && !has(".shadowstep-partial")
            && (!has(".partial") || has(".checkpoint"))
            && (has(".partial") || !names.iter().any(|name| resumes(name)));
        assert!(is_clean, "{} {when}: {names:?}", self.command.name);
    }

    /// Undisturbed now, the command comes to the files of a run that never was disturbed.
    pub(crate) fn completes(&self, whole: &Files, when: &str) {
        let output = self.program().output().unwrap();
        let (name, err) = (self.command.name, message(&output));
        assert!(output.status.success(), "{name} {when}: {err}");
        let files = self.files();
        assert_eq!(files.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>(), "{name} {when}");
        for (file, content) in &files {
            assert!(content == &whole[file], "{name} {when}: {file} has other bytes");
        }
    }
}

pub(crate) fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A command that was not disturbed.
#[derive(Clone, Debug)]
pub(crate) struct Undisturbed {
    pub(crate) files: Files,
    pub(crate) time: Duration,
    /// How many calls change files.
    pub(crate) calls: u64,
}

/// What a command does undisturbed.
pub(crate) fn undisturbed(command: Disturbed) -> Undisturbed {
    static KNOWN: Mutex<BTreeMap<&str, Undisturbed>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.entry(command.name).or_insert_with(|| Undisturbed::of(command)).clone()
}

impl Undisturbed {
    fn of(command: Disturbed) -> Self {
        let (work, counts) = (Work::new(command), TempDir::new().unwrap());
        let path = counts.path().join("calls");
        let begin = Instant::now();
        let output = work.with_fault(&[("FAULT_COUNT", path.display().to_string())]).output().unwrap();
        let time = begin.elapsed();
        assert!(output.status.success(), "{}: {}", command.name, message(&output));
        Undisturbed { files: work.files(), time, calls: fs::read_to_string(path).unwrap().parse().unwrap() }
    }
}
