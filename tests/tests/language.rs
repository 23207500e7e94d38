//! Protects the language of comments and pages: none has a phrase that `docs/language.md` lists as not to be used.

use std::fs;
use std::path::{Path, PathBuf};

/// Sources whose comments still have such phrases, as paths from the root of the repository. Remove a line when its folder or file is clean.
const NOT_YET: [&str; 18] = [
    "cli",
    "figures",
    "report",
    "runtime/src/many_parts.rs",
    "runtime/src/maps.rs",
    "runtime/src/motion.rs",
    "runtime/src/motion",
    "runtime/src/scheme_maps.rs",
    "runtime/src/summation",
    "runtime/src/system.rs",
    "runtime/src/transformed_time",
    "runtime/src/wisdom_holman",
    "scenes",
    "scheme-macros",
    "stability",
    "sweeps",
    "work-precision",
    // a page that `stability` writes
    "docs/stability.md",
];

/// Pages that quote such phrases: the list itself, and what was written before it.
const QUOTING: [&str; 2] = ["docs/language.md", "CHANGELOG.md"];

/// Folders whose contents are not the project's own text.
const NOT_OURS: [&str; 2] = ["target", "corpus"];

struct Phrase {
    words: Vec<String>,
    instead: String,
}

impl Phrase {
    /// A phrase in lower case is also found at the beginning of a sentence, one with capitals only as it is.
    fn is_at(&self, words: &[(usize, &str)]) -> bool {
        let last = self.words.len() - 1;
        words.len() > last
            && self.words.iter().zip(words).enumerate().all(|(i, (own, &(_, word)))| {
                let word = if i == 0 { word.trim_start_matches(is_punctuation) } else { word };
                let word = if i == last { word.trim_end_matches(is_punctuation) } else { word };
                own == word || (!own.contains(char::is_uppercase) && own.eq_ignore_ascii_case(word))
            })
    }
}

fn is_punctuation(c: char) -> bool {
    !c.is_alphanumeric()
}

/// The lines `- "phrase" → what to write instead` of the section `## Not to be used`.
fn phrases(page: &str) -> Vec<Phrase> {
    let lines = page.lines().skip_while(|line| *line != "## Not to be used").skip(1);
    let listed = lines.take_while(|line| !line.starts_with("## ")).filter_map(|line| line.strip_prefix("- \""));
    listed
        .map(|line| {
            let (phrase, instead) = line.split_once("\" → ").unwrap_or_else(|| panic!("no arrow: {line}"));
            let words: Vec<_> = phrase.split_whitespace().map(str::to_owned).collect();
            assert!(!words.is_empty(), "no phrase: {line}");
            Phrase { words, instead: instead.to_owned() }
        })
        .collect()
}

/// The length of the comment, the literal or the character that a Rust source begins with.
fn token(source: &str) -> usize {
    let up_to = |begin: usize, end: &str| source[begin..].find(end).map_or(source.len(), |at| begin + at + end.len());
    if source.starts_with("//") {
        return source.find('\n').unwrap_or(source.len());
    }
    if source.starts_with("/*") {
        return up_to(2, "*/");
    }
    if let Some(after) = source.strip_prefix('r') {
        let hashes = after.len() - after.trim_start_matches('#').len();
        if after[hashes..].starts_with('"') {
            return up_to(hashes + 2, &format!("\"{}", "#".repeat(hashes)));
        }
    }
    if source.starts_with('"') {
        let mut is_escaped = false;
        for (at, c) in source.char_indices().skip(1) {
            match c {
                _ if is_escaped => is_escaped = false,
                '\\' => is_escaped = true,
                '"' => return at + 1,
                _ => {}
            }
        }
        return source.len();
    }
    if source.starts_with("'\\") {
        return up_to(3, "'");
    }
    if source.starts_with("'\"'") {
        return 3;
    }
    source.chars().next().map_or(0, char::len_utf8)
}

/// The comments of a Rust source with their lines. Literals are skipped, as they may contain `//`.
fn comments(source: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let (mut rest, mut line) = (source, 1);
    while !rest.is_empty() {
        let (first, after) = rest.split_at(token(rest));
        if first.starts_with("//") {
            found.push((line, first.trim_start_matches(['/', '!'])));
        }
        line += first.matches('\n').count();
        rest = after;
    }
    found
}

/// The lines of a page without blocks of code, which are quotations.
fn lines_of_text(page: &str) -> Vec<(usize, &str)> {
    let mut is_code = false;
    let lines = page.lines().enumerate().filter(|(_, line)| {
        let is_fence = line.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_code && !is_fence
    });
    lines.map(|(index, line)| (index + 1, line)).collect()
}

/// The phrases in a text, also across the end of a line: the line, and the phrase.
fn findings<'a>(text: &[(usize, &str)], phrases: &'a [Phrase]) -> Vec<(usize, &'a Phrase)> {
    let words: Vec<_> =
        text.iter().flat_map(|(number, line)| line.split_whitespace().map(move |word| (*number, word))).collect();
    let mut found = Vec::new();
    for (at, (number, _)) in words.iter().enumerate() {
        let here = phrases.iter().filter(|phrase| phrase.is_at(&words[at..]));
        found.extend(here.map(|phrase| (*number, phrase)));
    }
    found
}

/// The Rust sources and pages in a folder and below, but for hidden folders.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() {
            if !name.starts_with('.') && !NOT_OURS.contains(&name.as_str()) {
                files(&path, found);
            }
        } else if name.ends_with(".rs") || name.ends_with(".md") {
            found.push(path);
        }
    }
}

#[test]
fn phrases_are_found_in_comments_only() {
    let page = "## Style\n- \"fine\" → not in the list\n## Not to be used\nOf each the alternatives:\n\
                - \"so many\" → \"every n\"\n- \"Those of\" → the noun\n## Other\n- \"other\" → nothing\n";
    let phrases = phrases(page);
    assert_eq!(phrases.len(), 2);
    let lines = |text: &[(usize, &str)]| -> Vec<(usize, String)> {
        findings(text, &phrases).iter().map(|(line, phrase)| (*line, phrase.words.join(" "))).collect()
    };
    let faulty = "//! After (so many) steps.\nfn f() {} // it is so\n// many years\n/// Those of the kernel.\n";
    let expected = [(1, "so many"), (2, "so many"), (4, "Those of")].map(|(line, words)| (line, words.to_owned()));
    assert_eq!(lines(&comments(faulty)), expected);
    let right = "/// Also so manyfold; the weights are those of Yoshida.\nconst A: &str = \"// so \\\" many so many\";\n\
                 const B: [char; 2] = ['\"', '\\''];\nconst C: &str = r#\"// so many\"#; // every n steps\nlet so = many;\n";
    assert_eq!(comments(right).iter().map(|(line, _)| *line).collect::<Vec<_>>(), [1, 4]);
    assert!(lines(&comments(right)).is_empty());
    assert_eq!(lines(&lines_of_text("so\n```text\nso many\n```\nSo many\n")), [(5, "so many".to_owned())]);
}

#[test]
fn comments_and_pages_have_none_of_the_phrases() {
    let root = fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).expect("the root exists");
    let phrases = phrases(&fs::read_to_string(root.join("docs/language.md")).expect("the page exists"));
    assert!(!phrases.is_empty(), "docs/language.md has the list");
    let mut all = Vec::new();
    files(&root, &mut all);
    all.sort();
    assert!(all.len() > 500, "the sources are found: {}", all.len());
    let mut shown = String::new();
    for file in &all {
        let path = file.strip_prefix(&root).expect("it is below the root");
        let is_page = path.extension().is_some_and(|extension| extension == "md");
        let is_below = |folder: &&str| path.starts_with(folder);
        if QUOTING.iter().any(is_below) || NOT_YET.iter().any(is_below) {
            continue;
        }
        let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let text = if is_page { lines_of_text(&text) } else { comments(&text) };
        for (line, Phrase { words, instead }) in findings(&text, &phrases) {
            shown += &format!("{}:{line}: not \"{}\", but {instead}\n", path.display(), words.join(" "));
        }
    }
    assert!(shown.is_empty(), "docs/language.md has phrases that are not to be used:\n{shown}");
}
