//! Comments, wrapped, and numbers of things.

/// The most columns of a comment.
const WIDTH: usize = 100;

/// Text for a comment: one line, without what continues a line.
pub(crate) fn plain(text: &str) -> String {
    text.chars()
        .map(|c| {
            if c.is_control() {
                ' '
            } else if c == '\\' {
                '/'
            } else {
                c
            }
        })
        .collect()
}

/// Lines as comments; long ones are wrapped.
pub(crate) fn commented(sign: &str, lines: &[String]) -> Vec<String> {
    let wrap = |line: &String| wrapped(&plain(line), WIDTH - sign.len());
    // in the first lines of a file Python reads `coding:` as a command
    let is_python = sign == "#";
    let harmless = |line: String| {
        if is_python { line.replace("coding:", "coding :").replace("coding=", "coding =") } else { line }
    };
    lines.iter().flat_map(wrap).map(|line| format!("{sign} {}", harmless(line)).trim_end().to_owned()).collect()
}

/// A line as several, broken at blanks.
fn wrapped(line: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in line.split_whitespace() {
        let last = lines.last_mut().expect("there is a line");
        if last.is_empty() {
            last.push_str(word);
        } else if last.chars().count() + 1 + word.chars().count() > width {
            lines.push(word.to_owned());
        } else {
            last.push(' ');
            last.push_str(word);
        }
    }
    lines
}
