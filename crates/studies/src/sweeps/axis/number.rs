//! Numbers of axes: exact values of texts.

use std::collections::BTreeMap;

use shadowstep::Rational;
use shadowstep_schemes::document::{Reader, Text};
use shadowstep_schemes::symbolic::decimal::{from_text, round_significant};
use shadowstep_schemes::symbolic::{Budget, Error, Exact, evaluate, evaluate_within, parse};

/// Irrational values are rounded to this many digits, and are exact from there on.
const DIGITS: u32 = 30;

/// How numbers are written.
pub(crate) const NUMBERS: &str = "1, 0.05, or in quotes \"1/10\" or \"sqrt(2)/20\"";

/// The most characters of a number, as of a formula.
const LONGEST: usize = 10_000;

/// The value of a number or of a formula without names.
pub(super) fn evaluated(text: &str) -> Result<Rational, Error> {
    if text.len() <= LONGEST
        && let Ok(value) = from_text(text)
    {
        return Ok(value);
    }
    let expression = parse(text)?;
    let exact = evaluate_within(&expression, &BTreeMap::new(), DIGITS + 5, &Budget::default())?;
    Ok(if exact.rounded { round_significant(&exact.value, DIGITS) } else { exact.value })
}

/// The value of a formula in exact numbers to this many digits; `None` where they are too large or too small for it.
pub(super) fn formula(formula: &str, names: &[(&str, &Rational)], digits: u32) -> Option<Rational> {
    let exact = |value: &Rational| Exact { value: value.clone(), rounded: false };
    let names = names.iter().map(|(name, value)| ((*name).to_owned(), exact(value))).collect();
    let expression = parse(formula).expect("the formula is well formed");
    Some(evaluate(&expression, &names, digits).ok()?.value)
}

/// a^(1 − part) b^part of positive a and b to this many digits; `None` where they are too large or too small for it.
pub(super) fn geometric(a: &Rational, b: &Rational, part: &Rational, digits: u32) -> Option<Rational> {
    formula("exp(log(a) + log(r)*k)", &[("a", a), ("r", &(b / a)), ("k", part)], digits)
}

/// The value of a part of a text.
pub(crate) fn number(reader: &mut Reader<'_>, text: &Text) -> Option<Rational> {
    match evaluated(&text.value) {
        Ok(value) => Some(value),
        Err(error) => {
            reader.wrong(&text.place(&error.range()), error.to_string(), format!("write a number: {NUMBERS}"))
        }
    }
}
