//! Schemes: the shipped ones, all about one, and the proof of a person's own.

mod check;
mod list;
mod show;

pub(crate) use check::check;
pub(crate) use list::list;
pub(crate) use show::show;

use shadowstep_schemes::scheme::Held;

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
