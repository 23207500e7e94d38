//! Source code of others → the splitting schemes in it: which order each has, which shipped scheme it is, and what is
//! wrong with it.
//!
//! | module | what it does |
//! | --- | --- |
//! | `language` | the ending of a file → its language |
//! | `token`, `cursor` | text → numbers, names, symbols, comments |
//! | `expression`, `numbers` | tokens → formulas → exact numbers with the decimals that they print |
//! | `left`, `loops` | what is given a value; loops that append |
//! | `list`, `lists`, `groups` | statements → lists of numbers with their names; constants with an index |
//! | `claims` | names and comments → the order that is claimed |
//! | `roles` | list → compositions, kicks and drifts, halves of palindromes |
//! | `recognised` | the readings of all lists → those that are schemes, or nearly |
//! | `verdict` | such a reading → a table, which is proved as every table is → what is true and what is wrong |
//!
//! ```
//! use shadowstep_analysis::sources::{Language, check};
//!
//! let found = check("w1 = 1/(2 - 2**(1/3))\nw = [w1, 1 - 2*w1, w1]", Language::Python);
//! let verdict = &found.verdicts[0];
//! assert_eq!((verdict.name.as_str(), verdict.line, verdict.orders), ("w", 2, [4, 4]));
//! assert_eq!(verdict.likeness.as_ref().unwrap().known.name, "yoshida4");
//! assert!(verdict.faults.is_empty());
//! ```

mod claims;
mod cursor;
mod expression;
mod groups;
mod language;
mod left;
mod list;
mod lists;
mod loops;
mod numbers;
mod recognised;
mod roles;
mod token;
mod verdict;

pub use language::Language;
pub use verdict::Verdict;

/// What was found in a source.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The lists that are schemes, in their order.
    pub verdicts: Vec<Verdict>,
    /// The number of lists that are not.
    pub skipped: usize,
}

/// The splitting schemes in a source.
pub fn check(text: &str, language: Language) -> Checked {
    let found = lists::lists(text, language);
    let (recognised, skipped) = recognised::recognised(text, &found);
    Checked { verdicts: recognised.iter().map(Verdict::of).collect(), skipped }
}
