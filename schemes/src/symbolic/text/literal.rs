//! Unsigned decimal literals such as `1_000`, `.5` and `2.5E+7`: their length and their value.

use num_bigint::BigInt;

use crate::symbolic::number::rational::Rational;
use crate::symbolic::number::rounding::at_places;

/// The largest magnitude of a literal's exponent, which limits the memory of its digits.
pub(crate) const LARGEST_EXPONENT: i64 = 10_000;

/// The length of the literal at the start of `text`; zero if there is none.
pub(crate) fn length(text: &str) -> usize {
    let whole = digits(text);
    let mut end = whole;
    if text[end..].starts_with('.') {
        let fraction = digits(&text[end + 1..]);
        if whole + fraction == 0 {
            return 0;
        }
        end += 1 + fraction;
    }
    if end > 0 { end + exponent(&text[end..]) } else { 0 }
}

/// The exact value of a whole literal; `None` if its exponent exceeds [`LARGEST_EXPONENT`].
pub(crate) fn value(literal: &str) -> Option<Rational> {
    let literal = literal.replace('_', "");
    let (mantissa, exponent) = literal.split_once(['e', 'E']).unwrap_or((&literal, "0"));
    let exponent: i64 = exponent.parse().ok()?;
    // not by |exponent|, which overflows for the least i64
    if !(-LARGEST_EXPONENT..=LARGEST_EXPONENT).contains(&exponent) {
        return None;
    }
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let units: BigInt = format!("{whole}{fraction}").parse().ok()?;
    Some(at_places(units, fraction.len() as i64 - exponent))
}

/// The length of a run of digits, with single underscores allowed between them.
fn digits(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut end = 0;
    while is_digit(end) || (end > 0 && bytes.get(end) == Some(&b'_') && is_digit(end - 1) && is_digit(end + 1)) {
        end += 1;
    }
    end
}

/// The length of an exponent part; zero if no digits follow the `e`: then it is the start of a name.
fn exponent(text: &str) -> usize {
    let Some(rest) = text.strip_prefix(['e', 'E']) else {
        return 0;
    };
    let unsigned = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    match digits(unsigned) {
        0 => 0,
        count => text.len() - unsigned.len() + count,
    }
}
