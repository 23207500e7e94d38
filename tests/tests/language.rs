//! Protects plain language: the phrases that the page of language forbids are in no comment, on no page, in no Python
//! file and in no template.

use std::path::{Path, PathBuf};
use std::{fs, io};

/// A phrase that is wrong wherever it stands, in lower case, and what to write instead.
struct Forbidden {
    phrase: String,
    instead: String,
}

/// The list of the page: lines such as ``- `so many`: a number of``.
fn forbidden(page: &str) -> Vec<Forbidden> {
    let (_, list) = page.split_once("\n## Not to be used\n").expect("the page has the list");
    let list = list.split_once("\n## ").map_or(list, |(list, _)| list);
    let lines = list.lines().filter_map(|line| line.strip_prefix("- `")?.split_once("`: "));
    lines.map(|(phrase, instead)| Forbidden { phrase: phrase.to_lowercase(), instead: instead.to_owned() }).collect()
}

/// Whether a text has the phrase as whole words.
fn has(text: &str, phrase: &str) -> bool {
    let text = text.to_lowercase();
    let is_outside = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    text.match_indices(phrase).any(|(at, _)| {
        is_outside(text[..at].chars().next_back()) && is_outside(text[at + phrase.len()..].chars().next())
    })
}

/// The comment of a line of Rust. A `//` within a text counts as one, unless it follows a colon as in an address.
fn comment(line: &str) -> Option<&str> {
    line.match_indices("//").find(|(at, _)| !line[..*at].ends_with(':')).map(|(at, _)| &line[at..])
}

/// `line: phrase; write …` for each phrase in the prose of a file.
fn faults(text: &str, is_rust: bool, forbidden: &[Forbidden]) -> Vec<String> {
    let lines = (1..).zip(text.lines()).filter_map(|(number, line)| {
        let prose = if is_rust { comment(line)? } else { line };
        Some((number, prose))
    });
    let faults = lines.flat_map(|(number, prose)| {
        let found = forbidden.iter().filter(|Forbidden { phrase, .. }| has(prose, phrase));
        found.map(move |Forbidden { phrase, instead }| format!("{number}: \"{phrase}\"; write {instead}"))
    });
    faults.collect()
}

/// Of Rust the comments are compared, of the others everything; `jl` to `tex` are the templates of emitted code.
const ENDINGS: [&str; 8] = ["rs", "md", "py", "ipynb", "jl", "h", "F90", "tex"];

/// All files below a folder with one of these endings, without build folders and hidden ones.
pub(crate) fn files(folder: &Path, into: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if !name.starts_with('.') && !["target", "corpus", "node_modules"].contains(&name.as_str()) {
                files(&path, into)?;
            }
        } else if path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known)) {
            into.push(path);
        }
    }
    Ok(())
}

#[test]
fn no_forbidden_phrase_is_used() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project");
    let page = root.join("docs/language.md");
    let forbidden = forbidden(&fs::read_to_string(&page).unwrap());
    assert!(forbidden.len() >= 5, "the page has a list");
    let mut all = Vec::new();
    files(root, &mut all).unwrap();
    assert!(all.len() > 500, "the files of the project");
    let exempt = [page, root.join("CHANGELOG.md"), root.join("tests/tests/language.rs")];
    let mut found = Vec::new();
    for path in all.into_iter().filter(|path| !exempt.contains(path)) {
        let is_rust = path.extension().is_some_and(|ending| ending == "rs");
        let name = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        let text = fs::read_to_string(&path).unwrap();
        found.extend(faults(&text, is_rust, &forbidden).into_iter().map(|fault| format!("{name}:{fault}")));
    }
    assert!(found.is_empty(), "see docs/language.md:\n{}", found.join("\n"));
}

#[test]
fn a_fault_is_found_where_it_stands() {
    let list = forbidden(
        "# Page\n\n## Not to be used\n\n- `so many`: a number of\n- `Likewise`: in the same way\n\n## Style\n- `x`: y\n",
    );
    assert_eq!(list.len(), 2);
    let rust = "let so_many = 1; // Of so many steps\nlet text = \"so many\";\n/// The same, likewise.\n// so manyfold";
    assert_eq!(
        faults(rust, true, &list),
        ["1: \"so many\"; write a number of", "3: \"likewise\"; write in the same way"]
    );
    assert_eq!(faults("So many\nhttps://so many", false, &list).len(), 2);
    assert!(faults("see https://example.org/so many", true, &list).is_empty());
}

/// Lines of rustdoc with formulas in which Markdown takes a backslash: `\,` would be a comma.
fn lost_backslashes(text: &str) -> impl Iterator<Item = usize> {
    let is_lost =
        |line: &str| line.as_bytes().windows(2).any(|pair| pair[0] == b'\\' && b",;!:{}_|".contains(&pair[1]));
    let of_docs = |line: &str| ["///", "//!"].iter().any(|mark| line.trim_start().starts_with(mark));
    let lines = text.lines().enumerate();
    lines.filter(move |(_, line)| of_docs(line) && line.contains('$') && is_lost(line)).map(|(number, _)| number + 1)
}

#[test]
fn formulas_of_rustdoc_keep_their_backslashes() {
    assert_eq!(lost_backslashes("//! $a \\, b$\n/// $a \\thinspace b$\nlet a = \"$\\,\";").collect::<Vec<_>>(), [1]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project");
    let mut all = Vec::new();
    files(root, &mut all).unwrap();
    for path in all.into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs")) {
        let lost: Vec<_> = lost_backslashes(&fs::read_to_string(&path).unwrap()).collect();
        assert!(lost.is_empty(), "{}: lines {lost:?}: write \\thinspace in place of \\,", path.display());
    }
}

/// Lines of Rust that need no scrolling: rustfmt breaks code at 120 columns, but neither comments nor texts.
#[test]
fn lines_of_sources_have_at_most_140_characters() {
    const MOST: usize = 140;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the tests are in a folder of the project");
    let mut all = Vec::new();
    files(root, &mut all).unwrap();
    let mut long = Vec::new();
    for path in all.iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs")) {
        let text = fs::read_to_string(path).unwrap();
        let lines = (1..).zip(text.lines()).filter(|(_, line)| line.chars().count() > MOST);
        long.extend(lines.map(|(number, _)| format!("{}:{number}", path.display())));
    }
    assert!(long.is_empty(), "more than {MOST} characters:\n{}", long.join("\n"));
}
