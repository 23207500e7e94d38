//! Schemes: the shipped ones, all about one, the proof of a person's own, and its digits.

mod analysis;
mod check;
mod list;
mod polish;
mod show;

pub(crate) use check::check;
pub(crate) use list::list;
pub(crate) use polish::polish;
pub(crate) use show::show;

use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::table::Table;

/// How many digits of the weights are right; `None` for all.
fn digits(held: Held) -> Option<u32> {
    match held {
        Held::Exactly => None,
        Held::Digits(digits) => Some(digits),
    }
}

/// As people read it.
fn digits_text(digits: Option<u32>) -> String {
    digits.map_or_else(|| "exact".to_owned(), |digits| digits.to_string())
}

/// Other names under which the scheme is known: none that a table could tell.
fn aliases(_table: &Table) -> Vec<String> {
    Vec::new()
}

/// The orders for near-integrable problems: none that a table could claim.
fn near_integrable(_table: &Table) -> Vec<u32> {
    Vec::new()
}
