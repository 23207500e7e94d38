//! Tables made by a test and what the compiler reports about them.

use shadowstep_schemes::{Faults, Proved, Source, read, shipped};

use crate::pages::project_file;

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

/// The table is accepted, with these orders for every T(p) and for quadratic T.
#[track_caller]
pub fn assert_orders(text: &str, general: u32, quadratic: u32) {
    let proved = judge(text).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!((proved.proof.general.order, proved.proof.quadratic.order), (general, quadratic));
}

/// A table with the decimals that its paper prints, of `crates/analysis/tests/published`.
pub fn printed(name: &str) -> String {
    project_file(&format!("crates/analysis/tests/published/{name}.toml"))
}

/// The same with a claim of this number of digits.
pub fn printed_with_digits(name: &str, digits: u32) -> String {
    printed(name).replacen("\nkinetic", &format!("\ndigits = {digits}\nkinetic"), 1)
}
