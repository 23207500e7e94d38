//! Tables of rules: from evidence, which is numbers with their errors, to a verdict and its sentence.
//!
//! | table | evidence | thresholds, with their reasons |
//! | --- | --- | --- |
//! | `monitor/rules.rs`, of windows | what the windows of a monitor show | `monitor/thresholds.rs` |
//! | `monitor/rules.rs`, of a run | what H of all states shows besides | the same |
//! | `recorded/rules.rs` | what the states of another program show | `recorded/thresholds.rs` |
//!
//! Here are the thresholds that tables have in common.

/// A row of a table: the verdict, if its condition holds, and its sentence, in which names in braces stand for numbers.
pub(super) struct Rule<E, V>(pub(super) fn(&E) -> Option<V>, pub(super) &'static str);

impl<E, V> Rule<E, V> {
    /// The verdict and the sentence of the first row whose condition holds.
    pub(super) fn first(rules: &[Self], evidence: &E) -> Option<(V, &'static str)> {
        rules.iter().find_map(|Rule(verdict, sentence)| Some((verdict(evidence)?, *sentence)))
    }
}

/// A sentence with what its names stand for.
pub(super) fn filled(sentence: &str, named: impl Fn(&str) -> String) -> String {
    let mut parts = sentence.split('{');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (name, rest) in parts.filter_map(|part| part.split_once('}')) {
        text += &named(name);
        text += rest;
    }
    text
}

/// The energy error is too large from this part of the mean kinetic energy on: between 0.3, up to which runs of ten times
/// the length count as bounded, and 0.6, from which on they count as lost (`docs/monitor.md`).
pub const KINETIC_LIMIT: f64 = 0.4;

/// An estimate may be wrong by this many times its error: up to 1.75 times where the steps resolve the motion, and 3.5
/// times once in double precision (the table of the module `shadow`).
pub(super) const ERROR_FACTOR: i32 = 3;
