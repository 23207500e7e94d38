//! Pages that are generated, and kept true.

use std::path::Path;
use std::{env, fs};

/// A file of the project, by its path from the root.
///
/// # Panics
/// If it cannot be read.
pub fn project_file(path: &str) -> String {
    let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    fs::read_to_string(&whole).unwrap_or_else(|error| panic!("{}: {error}", whole.display()))
}

/// A page, such as `docs/schemes.md`, is what is generated; with `UPDATE_DOCS=1` in the environment it becomes that.
///
/// # Panics
/// If it is not, with the first line that differs.
pub fn assert_page(path: &str, generated: &str) {
    if env::var_os("UPDATE_DOCS").is_some() {
        let whole = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
        fs::write(&whole, generated).unwrap_or_else(|error| panic!("{}: {error}", whole.display()));
    }
    let page = project_file(path);
    let (mut found, mut expected) = (page.lines(), generated.lines());
    for number in 1.. {
        match (found.next(), expected.next()) {
            (None, None) => break,
            (found, expected) => assert_eq!(
                found, expected,
                "{path}, line {number}, left, is no longer what is generated; write it again with UPDATE_DOCS=1"
            ),
        }
    }
}

/// The fenced blocks of a page: the language and the text.
pub fn blocks(page: &str) -> Vec<(&str, String)> {
    let mut lines = page.lines();
    let mut blocks = Vec::new();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let text = lines.by_ref().take_while(|line| *line != "```").map(|line| format!("{line}\n"));
            blocks.push((language, text.collect()));
        }
    }
    blocks
}

/// The table of this name among the blocks of a page.
pub fn table(page: &str, name: &str) -> Option<String> {
    let begin = format!("name = \"{name}\"\n");
    blocks(page)
        .into_iter()
        .find(|(language, text)| *language == "toml" && text.starts_with(&begin))
        .map(|(_, text)| text)
}

/// The page with the messages that its blocks of text have to be: of the table above, and of the first line so far.
pub fn with_messages(page: &str, message: impl Fn(&str, &str) -> String) -> String {
    let (mut all, mut table) = (String::new(), String::new());
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        all += &format!("{line}\n");
        let block = |lines: &mut std::str::Lines<'_>| -> String {
            lines.take_while(|line| *line != "```").map(|line| format!("{line}\n")).collect()
        };
        match line {
            "```toml" => {
                table = block(&mut lines);
                all += &format!("{table}```\n");
            }
            "```text" => all += &format!("{}\n```\n", message(&table, block(&mut lines).lines().next().unwrap_or(""))),
            _ => {}
        }
    }
    all
}
