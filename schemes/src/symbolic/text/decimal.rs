//! Rationals as text and back, and rounding to significant digits.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use crate::symbolic::number::ratio::Ratio;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::number::rounding::{self, Direction};
use crate::symbolic::text::literal;

/// The largest denominator of a number that is written as a fraction rather than as a decimal.
const LARGEST_SHORT_DENOMINATOR: u32 = 10_000;

/// The most decimal places of a number that is written as a decimal.
const MOST_PLACES: u64 = 400;

/// A text that is not an integer, a fraction or a decimal.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not a number: write an integer, a decimal such as -0.25 or a fraction such as 7/24")]
pub struct NotANumber {
    /// The text.
    pub text: String,
}

crate::debug_as_text!(NotANumber);

/// Writes a rational with all its digits, such as `3`, `-7/24` or `0.6756035959798288170238437`.
///
/// Denominators up to 10000 stay fractions. Among the others, numbers with at most 400 decimal places
/// become decimals. `from_text` reads the text back to the same number, and so does
/// [`exact`](crate::symbolic::exact()) up to the length it allows.
pub fn to_text(value: &Rational) -> String {
    let short = value.denom() <= &BigInt::from(LARGEST_SHORT_DENOMINATOR);
    match twos_and_fives(value.denom()) {
        Some((twos, fives)) if !short => {
            let places = twos.max(fives);
            let units = (value.numer() * rounding::power_of_five(places - fives)) << (places - twos);
            let digits = units.magnitude().to_string();
            let exponent = digits.len() as i64 - 1 - places as i64;
            format!("{}{}", sign(value), plain(&digits, exponent))
        }
        _ => value.to_string(),
    }
}

/// Reads an optional sign and an integer, a decimal, or a fraction of two of these; all exactly.
///
/// # Errors
/// [`NotANumber`] if the text is anything else, also if it divides by zero or has an exponent
/// beyond 10000.
///
/// ```
/// use shadowstep_schemes::symbolic::{Rational, decimal};
/// assert_eq!(decimal::from_text("-7/24").unwrap(), Rational::new((-7).into(), 24.into()));
/// assert!(decimal::from_text("sqrt(2)").is_err());
/// ```
pub fn from_text(text: &str) -> Result<Rational, NotANumber> {
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (numerator, denominator) = unsigned.split_once('/').unwrap_or((unsigned, "1"));
    match (whole_literal(numerator), whole_literal(denominator)) {
        (Some(n), Some(d)) if !d.is_zero() => Ok(if negative { -n / d } else { n / d }),
        _ => Err(NotANumber { text: text.to_string() }),
    }
}

/// Rounds to significant decimal digits (at least one), half to even.
pub fn round_significant(value: &impl Ratio, digits: u32) -> Rational {
    rounding::to_places(value, rounding::places(value, digits), Direction::Nearest)
}

/// Writes a number rounded to significant digits, for messages: `0.593812`, `6.3e-16`.
///
/// Rounds as `round_significant` and omits zeros at the end; scientific outside 1e-4..1e9.
pub fn to_significant(value: &impl Ratio, digits: usize) -> String {
    if value.numer().is_zero() {
        return "0".to_string();
    }
    let places = rounding::places(value, u32::try_from(digits).unwrap_or(u32::MAX));
    let all = rounding::units(value, places, Direction::Nearest).magnitude().to_string();
    let exponent = all.len() as i64 - 1 - places;
    let digits = all.trim_end_matches('0');
    let body =
        if (-4..9).contains(&exponent) { plain(digits, exponent) } else { format!("{}e{exponent}", plain(digits, 0)) };
    format!("{}{body}", sign(value))
}

/// Writes a number of double precision with this number of significant digits, zeros at the end included, for messages
/// and tables whose numbers are of any size: `2.100`, `0.01234`, `1.235e-7`. Scientific outside 1e-4..1e6.
pub fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    // infinities and NaN have no exponent
    match scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok()) {
        Some(exponent @ -4..6) => {
            let places = (digits as i32 - 1 - exponent).max(0) as usize;
            format!("{value:.places$}")
        }
        _ => scientific,
    }
}

fn sign(value: &impl Ratio) -> &'static str {
    if value.numer().is_negative() { "-" } else { "" }
}

/// The number d.ddd * 10^exponent without an exponent.
fn plain(digits: &str, exponent: i64) -> String {
    let zeros = |count: i64| "0".repeat(count as usize);
    let whole = exponent + 1;
    let missing = whole - digits.len() as i64;
    if whole <= 0 {
        format!("0.{}{digits}", zeros(-whole))
    } else if missing >= 0 {
        format!("{digits}{}", zeros(missing))
    } else {
        let (before, after) = digits.split_at(whole as usize);
        format!("{before}.{after}")
    }
}

/// The exponents of 2 and 5 of a denominator without other factors; `None` also of one that needs more than
/// [`MOST_PLACES`].
fn twos_and_fives(denominator: &BigInt) -> Option<(u64, u64)> {
    let twos = denominator.trailing_zeros().unwrap_or(0);
    let (rest, fives) = rounding::without_fives(denominator >> twos, MOST_PLACES);
    (rest.is_one() && twos <= MOST_PLACES).then_some((twos, fives))
}

/// The value of a text that is one literal from end to end.
fn whole_literal(text: &str) -> Option<Rational> {
    let whole = !text.is_empty() && literal::length(text) == text.len();
    whole.then(|| literal::value(text)).flatten()
}
