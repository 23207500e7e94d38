//! Runs the program and reads its output.

use assert_cmd::Command;
use serde_json::Value;

/// How a run of the program ended.
pub(crate) struct Finished {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// Runs `shadowstep` with these words, separated by blanks.
pub(crate) fn shadowstep(words: &str) -> Finished {
    let output = Command::cargo_bin("shadowstep").unwrap().args(words.split_whitespace()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Finished { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

/// As [`shadowstep`]; it must succeed with nothing on stderr.
pub(crate) fn quietly(words: &str) -> String {
    let result = shadowstep(words);
    assert_eq!((result.code, result.err.as_str()), (0, ""), "{words}");
    result.out
}

/// The objects of lines of JSON.
pub(crate) fn objects(lines: &str) -> Vec<Value> {
    lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The text of a field.
pub(crate) fn text<'a>(object: &'a Value, field: &str) -> &'a str {
    object[field].as_str().unwrap_or_else(|| panic!("{field} is no text in {object}"))
}
