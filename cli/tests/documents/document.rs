//! Documents: files in TOML with what is done with them, line by line, so that lines can be left out.

use std::collections::BTreeSet;
use std::fmt::{self, Display, Formatter};
use std::fs;
use std::path::Path;

/// The file that commands are given.
pub(crate) const NAME: &str = "document.toml";

/// Files, of which the first is [`NAME`], and the commands that are given in their folder, one after the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Document {
    pub(crate) files: Vec<File>,
    pub(crate) commands: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct File {
    pub(crate) name: String,
    pub(crate) lines: Vec<String>,
}

impl File {
    pub(crate) fn new(name: &str, text: &str) -> File {
        File { name: name.to_owned(), lines: text.lines().map(str::to_owned).collect() }
    }
}

impl Document {
    pub(crate) fn write(&self, folder: &Path) {
        for file in &self.files {
            fs::write(folder.join(&file.name), file.lines.join("\n") + "\n").unwrap();
        }
    }

    /// Its keys with their sections and values: `cutoff.at = 2` of \[problem\] is `cutoff` of `problem`, and `at` of
    /// `problem.cutoff`.
    pub(crate) fn keys(&self) -> BTreeSet<(String, String, String)> {
        let mut keys = BTreeSet::new();
        for file in self.files.iter().filter(|file| file.name.ends_with(".toml")) {
            let mut section = String::new();
            for line in &file.lines {
                if line.starts_with('[') {
                    section = line.trim_matches(['[', ']']).to_owned();
                } else if let Some((path, value)) = line.split_once(" = ") {
                    let mut within = section.clone();
                    for name in path.split('.') {
                        keys.insert((within.clone(), name.to_owned(), value.to_owned()));
                        within = if within.is_empty() { name.to_owned() } else { format!("{within}.{name}") };
                    }
                }
            }
        }
        keys
    }

    /// Leaves out lines and commands one at a time while the document still fails.
    pub(crate) fn minimised(mut self, fails: impl Fn(&Document) -> bool) -> Document {
        loop {
            let shorter = self.shorter().find(&fails);
            match shorter {
                Some(shorter) => self = shorter,
                None => return self,
            }
        }
    }

    /// The documents with one command, file or line less.
    fn shorter(&self) -> impl Iterator<Item = Document> {
        let changed = |change: &dyn Fn(&mut Document)| {
            let mut document = self.clone();
            change(&mut document);
            document
        };
        let commands =
            (0..self.commands.len()).rev().map(move |at| changed(&|document| drop(document.commands.remove(at))));
        let files = (1..self.files.len()).map(move |at| changed(&|document| drop(document.files.remove(at))));
        let places =
            self.files.iter().enumerate().flat_map(|(file, of)| (0..of.lines.len()).map(move |line| (file, line)));
        let lines = places.map(move |(file, line)| changed(&|document| drop(document.files[file].lines.remove(line))));
        commands.chain(files).chain(lines)
    }
}

impl Display for Document {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.commands.iter().try_for_each(|command| writeln!(f, "# shadowstep {command}"))?;
        self.files.iter().try_for_each(|file| writeln!(f, "# {}:\n{}", file.name, file.lines.join("\n")))
    }
}
