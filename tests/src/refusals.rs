//! Tables made by a test and what the compiler reports about them.

use shadowstep_schemes::{Faults, Proved, Source, read, shipped};

/// Reads a custom table, whose base may be a shipped one.
///
/// # Errors
/// All its faults.
pub fn judge(text: &str) -> Result<Proved, Faults> {
    judge_named("mine.toml", text)
}

/// The same for a table in a file of this name.
///
/// # Errors
/// All its faults.
pub fn judge_named(path: &str, text: &str) -> Result<Proved, Faults> {
    let source = Source { path: path.to_owned(), text: text.to_owned() };
    read(&source, &|base, _| shipped(base))
}

/// The table is refused with this whole message, as a user sees it.
#[track_caller]
pub fn assert_refused(text: &str, message: &str) {
    let faults = judge(text).map(|proved| proved.proof).expect_err("this table must be refused");
    assert_message(&faults.to_string(), message);
}

/// Compares messages, blank lines at the ends of the expected one apart.
#[track_caller]
pub fn assert_message(found: &str, expected: &str) {
    assert_eq!(found, expected.trim_matches('\n'), "\n{found}\n");
}

/// The table is accepted, with these orders for every T(p) and for quadratic T.
#[track_caller]
pub fn assert_orders(text: &str, general: u32, quadratic: u32) {
    let proved = judge(text).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((proved.proof.general.order, proved.proof.quadratic.order), (general, quadratic));
}
