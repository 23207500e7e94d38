//! Wrong inputs of all kinds with their messages and exit codes, in snapshots that people read: each message states what
//! is wrong, where, and what would be right. The inputs are in `messages/*.txt`, where a line adds one. Marked by ✓ are
//! right ones beside them, with their notes, by ≡ those of which all that is written is shown.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use rayon::prelude::*;
use tempfile::TempDir;

use crate::scenes::names;

/// A command with a title, in a folder with these files, and its mark.
struct Case {
    title: String,
    files: Vec<(String, Vec<u8>)>,
    words: Vec<String>,
    mark: Mark,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    Wrong,
    Right,
    Shown,
}

/// 300 of them, which no message repeats.
fn zeros() -> String {
    "0".repeat(300)
}

/// The cases of a text. Below a heading `== …` is a file, or a case a line: a command, flags that replace or complete
/// those of a command, or parts of a file with their replacements, where ⏎ ends a line and ∅ is nothing; ⓪ is zeros.
fn cases(text: &str) -> Vec<Case> {
    let text = text.replace('⓪', &zeros());
    let (mut files, mut cases) = (Vec::<(String, String)>::new(), Vec::new());
    for section in format!("\n{text}").split("\n== ").skip(1) {
        let (heading, content) = section.split_once('\n').unwrap_or((section, ""));
        let lines = content.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        let lines = lines.map(|line| match line.split_once(' ') {
            Some(("✓", line)) => (line, Mark::Right),
            Some(("≡", line)) => (line, Mark::Shown),
            _ => (line, Mark::Wrong),
        });
        let mut add = |title: &str, files: &[(String, String)], words: &str, mark| {
            let files = files.iter().map(|(name, text)| (name.clone(), text.clone().into_bytes())).collect();
            let words = words.split_whitespace().map(str::to_owned).collect();
            cases.push(Case { title: title.to_owned(), files, words, mark });
        };
        match heading.split_once(' ').unwrap_or((heading, "")) {
            ("file", name) => {
                files.retain(|(known, _)| known != name);
                files.push((name.to_owned(), format!("{content}\n")));
            }
            ("commands", _) => lines.for_each(|(words, mark)| add(words, &files, words, mark)),
            ("flags", command) => lines.for_each(|(flags, mark)| {
                let words = completed(command.trim_start_matches("of "), flags);
                add(&words, &files, &words, mark);
            }),
            (_, of) => lines.for_each(|(change, mark)| {
                let (name, command) = of.trim_start_matches("of ").split_once(": ").unwrap();
                let place = files.iter().position(|(known, _)| known == name).unwrap();
                let mut changed = files.clone();
                change.split(" ;; ").for_each(|change| replace(&mut changed[place].1, change));
                add(change, &changed, command, mark);
            }),
        }
    }
    cases
}

/// A command with other flags, which replace its own.
fn completed(command: &str, flags: &str) -> String {
    let (name, own) =
        command.split_once(" -").map_or((command, String::new()), |(name, own)| (name, format!(" -{own}")));
    let has = |flag: &str| flags.split(' ').any(|word| word == flag || flag == "--problem" && word == "--potential");
    let kept = own.split(" --").skip(1).filter(|flag| !has(&format!("--{}", flag.split(' ').next().unwrap())));
    kept.map(|flag| format!(" --{flag}")).fold(name.to_owned(), |command, flag| command + &flag) + " " + flags
}

fn replace(text: &mut String, change: &str) {
    if let Some((part, replacement)) = change.split_once(" → ") {
        let [part, replacement] = [part, replacement].map(|text| text.replace('⏎', "\n").replace('∅', ""));
        assert!(text.contains(&part), "{part}");
        *text = text.replacen(&part, &replacement, 1);
    }
}

/// Texts that are none, or large: none of them may need much time or memory.
fn large(sweep: &str) -> Vec<Case> {
    const E: &str = "e = [0, \"1/2\"]";
    const RANGE: &str = "1/10 … 1/40 in 3 steps of 1/h";
    let with = |part: &str, replacement: String| sweep.replacen(part, &replacement, 1).into_bytes();
    let repeated = |part: &str, count: usize| part.repeat(count);
    let ones = repeated("1", 1_000_000);
    [
        ("not UTF-8", vec![0xff, 0xfe, 0]),
        ("a zero", vec![0]),
        ("a number of 10⁶ digits", with(E, format!("e = [0.{ones}]"))),
        ("a range from a number of 10⁶ digits", with(RANGE, format!("0.{ones} … 1 in 2 steps"))),
        ("draws below a number of 10⁶ digits", {
            with(E, format!("e = {{ draws = 2, uniform = [0, 0.{ones}], seed = 1 }}"))
        }),
        ("10⁵ lists in lists", with(E, format!("e = {}{}", repeated("[", 100_000), repeated("]", 100_000)))),
        ("10⁵ brackets", with(E, format!("e = [\"{}1{}\"]", repeated("(", 100_000), repeated(")", 100_000)))),
        ("10⁵ brackets in a condition", with("x^2 + y^2 <", format!("{}x <", repeated("(", 100_000)))),
        ("10⁵ tables in tables", with(E, format!("e.{}f = 1", repeated("e.", 100_000)))),
        ("a list of 10⁷ members", with(E, format!("e = [{}]", repeated("1,", 10_000_000)))),
        ("10⁴ axes", with(E, (0..10_000).map(|k| format!("e{k} = [0]\n")).collect())),
        ("10⁴ formulas", with("L = ", (0..10_000).map(|k| format!("L{k} = \"x\", ")).collect::<String>() + "L = ")),
        ("10⁵ zips", with("[problem]", format!("zip = [{}]\n[problem]", repeated("[\"e\"], ", 100_000)))),
    ]
    .map(|(title, text)| Case {
        title: title.to_owned(),
        files: vec![("sweep.toml".to_owned(), text)],
        words: ["sweep", "sweep.toml", "--out", "out"].map(str::to_owned).to_vec(),
        mark: Mark::Wrong,
    })
    .into()
}

/// What the program writes, with its exit code and the files that it leaves; of what is right the notes, or all.
fn answer(case: &Case) -> String {
    let folder = TempDir::new().unwrap();
    case.files.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
    let mut command = Command::cargo_bin("shadowstep").unwrap();
    let output = command.args(&case.words).current_dir(folder.path()).output().unwrap();
    let path = folder.path().to_string_lossy();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().replace(&*path, "FOLDER");
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    let code = output.status.code().unwrap();
    if code == 0 {
        let notes = if case.mark == Mark::Shown { Some(0) } else { out.find("note: ") };
        return format!("▶ {}\n✓\n{}{err}", case.title, notes.map_or("", |place| &out[place..]));
    }
    format!("▶ {}\nexit code {code}{}\n{out}{err}", case.title, left(folder.path(), &case.files))
}

/// The files beside those that were there, none of which is changed.
fn left(folder: &Path, files: &[(String, Vec<u8>)]) -> String {
    let is_kept = |(name, text): &(String, Vec<u8>)| fs::read(folder.join(name)).unwrap() == *text;
    assert!(files.iter().all(is_kept), "a file is changed");
    let new: Vec<String> =
        names(folder).into_iter().filter(|name| files.iter().all(|(known, _)| known != name)).collect();
    if new.is_empty() { String::new() } else { format!(", left: {}", new.join(", ")) }
}

/// The longest run of digits of an answer, without its title and the line of a file that it quotes.
fn longest_number(answer: &str) -> usize {
    let own = answer.lines().skip(1).filter(|line| !line.contains(" | "));
    own.flat_map(|line| line.split(|c: char| !c.is_ascii_digit()).map(str::len)).max().unwrap_or(0)
}

#[test]
#[cfg(feature = "mpfr")]
fn messages_and_exit_codes() {
    insta::glob!("messages/*.txt", |path| {
        let mut cases = cases(&fs::read_to_string(path).unwrap());
        if path.ends_with("sweep.txt") {
            let valid = cases.iter().find(|case| case.mark == Mark::Right).expect("the sweep itself is right");
            cases.extend(large(std::str::from_utf8(&valid.files[0].1).unwrap()));
        }
        let answers: Vec<String> = cases.par_iter().map(answer).collect();
        let is_right = |answer: &str| answer.contains("\n✓\n");
        let unexpected =
            cases.iter().zip(&answers).filter(|(case, answer)| is_right(answer) == (case.mark == Mark::Wrong));
        let unexpected: Vec<_> = unexpected.map(|(_, answer)| answer).collect();
        assert!(unexpected.is_empty(), "{unexpected:#?}");
        let wrong = cases.iter().zip(&answers).filter(|(case, _)| case.mark == Mark::Wrong);
        wrong.for_each(|(_, answer)| assert!(longest_number(answer) <= 40, "{answer}"));
        insta::assert_snapshot!(answers.join("\n").replace(&zeros(), "⓪"));
    });
}
