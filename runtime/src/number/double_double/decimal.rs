//! Decimal text.

use shadowstep_symbolic::decimal::{from_text, to_significant};

use super::DoubleDouble;
use super::nearest::nearest;
use crate::Rational;
use crate::number::Real;

/// A text of this many digits survives being read and printed.
const SURVIVING_DIGITS: usize = 31;

/// The shortest text that reads back.
pub(super) fn text(x: DoubleDouble) -> String {
    let (high, low) = x.parts();
    if high == 0.0 || !high.is_finite() {
        return high.to_text();
    }
    let [high, low] = [high, low].map(|part| Rational::from_float(part).expect("a finite number"));
    let exact = high + low;
    let reads_back = |digits: usize| {
        let text = to_significant(&exact, digits);
        (nearest(&from_text(&text).expect("a number")) == x).then_some(text)
    };
    let mut enough = SURVIVING_DIGITS;
    while reads_back(enough).is_none() {
        enough *= 2; // all digits do; few are needed unless the low part is 0 or far below
    }
    let mut too_few = if enough == SURVIVING_DIGITS { enough - 1 } else { enough / 2 };
    while enough - too_few > 1 {
        let middle = too_few.midpoint(enough);
        *(if reads_back(middle).is_some() { &mut enough } else { &mut too_few }) = middle;
    }
    laid_out(&reads_back(enough).expect("it does"))
}

/// A decimal number in the layout that Rust has for an `f64`.
fn laid_out(text: &str) -> String {
    let (sign, size) = text.split_at(usize::from(text.starts_with('-')));
    let (mantissa, exponent) = size.split_once('e').unwrap_or((size, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let all = format!("{whole}{fraction}");
    let digits = all.trim_start_matches('0');
    let exponent: i32 = exponent.parse().expect("an exponent");
    // 0.digits 10^point
    let point = exponent + whole.len() as i32 - (all.len() - digits.len()) as i32;
    let digits = digits.trim_end_matches('0');
    let count = digits.len() as i32;
    match point {
        _ if !(-3..=16).contains(&point) => {
            let (first, rest) = digits.split_at(1);
            let dot = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{dot}{rest}e{}", point - 1)
        }
        _ if point >= count => format!("{sign}{digits}{}.0", "0".repeat((point - count) as usize)),
        1.. => format!("{sign}{}.{}", &digits[..point as usize], &digits[point as usize..]),
        _ => format!("{sign}0.{}{digits}", "0".repeat(point.unsigned_abs() as usize)),
    }
}
