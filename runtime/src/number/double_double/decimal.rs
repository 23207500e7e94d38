//! Decimal text.

use std::cmp::Ordering;

use num_bigint::{BigInt, BigUint};
use num_traits::float::FloatCore;
use num_traits::{One, Pow};

use super::DoubleDouble;
use crate::number::Real;

/// A text of this many digits survives being read and printed.
const SURVIVING_DIGITS: i64 = 31;
/// Nearly all numbers have at most this number of digits; others have a low part of 0, or one that is far below the
/// high part.
const USUAL_DIGITS: i64 = 36;

/// The shortest text that reads back.
pub(super) fn text(x: DoubleDouble) -> String {
    let (high, low) = x.parts();
    if high == 0.0 || !high.is_finite() {
        return high.to_text();
    }
    let negative = high < 0.0;
    let value = if negative { Exact::of(-high, -low) } else { Exact::of(high, low) };
    let (digits, point) = value.shortest();
    laid_out(negative, &digits, point)
}

/// A positive double-double, and which numbers are read as it: in multiples of a power of two, `unit`.
struct Exact {
    units: BigInt,
    unit: i64,
    /// The distances to the least and the greatest number that are read as it.
    below: BigInt,
    above: BigInt,
    /// Whether these themselves are: ties go to the even low part.
    includes_ends: bool,
    /// x = 0.d₁d₂… 10^point
    point: i64,
}

impl Exact {
    fn of(high: f64, low: f64) -> Exact {
        let part = |x: f64| {
            let (mantissa, exponent, sign) = FloatCore::integer_decode(x);
            (BigInt::from(mantissa) * sign, i64::from(exponent))
        };
        let parts = [high, low, low.next_down(), low.next_up()].map(part);
        let exponents = parts.iter().filter(|(mantissa, _)| *mantissa != BigInt::ZERO).map(|(_, exponent)| *exponent);
        // the middle between two neighbours is a multiple of half the unit of the lower one
        let unit = exponents.min().expect("the high part is not 0") - 1;
        let [high_units, low_units, before, after] =
            parts.map(|(mantissa, exponent)| mantissa << (exponent - unit).max(0));
        let (mut below, mut above): (BigInt, BigInt) = ((&low_units - before) >> 1u8, (after - &low_units) >> 1u8);
        // half-way to the next high part, numbers beyond have that one, and a low part of the other sign
        if -low == (high - high.next_down()) / 2.0 {
            below.clone_from(&above);
        } else if low == (high.next_up() - high) / 2.0 {
            above.clone_from(&below);
        }
        let units = high_units + low_units;
        let point = point(&units, unit, high);
        Exact { units, unit, below, above, includes_ends: low.to_bits().is_multiple_of(2), point }
    }

    /// The digits d₁d₂… of 0.d₁d₂… 10^point: correctly rounded to as few digits as read back.
    fn shortest(&self) -> (String, i64) {
        if let Some(found) = (SURVIVING_DIGITS..=USUAL_DIGITS).find_map(|count| self.rounded(count)) {
            return found;
        }
        let (mut too_few, mut enough) = (USUAL_DIGITS, 2 * USUAL_DIGITS);
        while self.rounded(enough).is_none() {
            (too_few, enough) = (enough, 2 * enough); // all digits are enough
        }
        while enough - too_few > 1 {
            let middle = too_few.midpoint(enough);
            *(if self.rounded(middle).is_some() { &mut enough } else { &mut too_few }) = middle;
        }
        self.rounded(enough).expect("these were enough")
    }

    /// Rounded to this number of digits, if that reads back.
    fn rounded(&self, count: i64) -> Option<(String, i64)> {
        let (above, below) = scales(self.unit, count - self.point);
        let exact = &self.units * &above;
        let rounded = nearest_integer(&exact, &below);
        let error = &rounded * below - exact;
        let reads_back = match error.sign() {
            num_bigint::Sign::NoSign => true,
            num_bigint::Sign::Plus => is_within(&error, &(&self.above * above), self.includes_ends),
            num_bigint::Sign::Minus => is_within(&-error, &(&self.below * above), self.includes_ends),
        };
        reads_back.then(|| {
            let digits = rounded.to_string();
            let point = self.point + digits.len() as i64 - count;
            (digits, point)
        })
    }
}

fn is_within(error: &BigInt, most: &BigInt, inclusive: bool) -> bool {
    error < most || inclusive && error == most
}

/// 2^unit 10^places as a fraction.
fn scales(unit: i64, places: i64) -> (BigInt, BigInt) {
    // 2^places is a shift
    let (five, two) = (BigInt::from(Pow::pow(BigUint::from(5u8), places.unsigned_abs())), unit + places);
    let shift = |x: BigInt, by: i64| x << by.max(0);
    match places {
        0.. => (shift(five, two), shift(BigInt::one(), -two)),
        _ => (shift(BigInt::one(), two), shift(five, -two)),
    }
}

/// The integer nearest to a / b, ties to even.
fn nearest_integer(a: &BigInt, b: &BigInt) -> BigInt {
    let (whole, rest) = (a / b, a % b);
    let is_odd = whole.bit(0);
    match (rest << 1u8).cmp(b) {
        Ordering::Less => whole,
        Ordering::Equal if !is_odd => whole,
        _ => whole + 1u8,
    }
}

/// The point of x = units 2^unit = 0.d₁d₂… 10^point; `high` is near to x.
fn point(units: &BigInt, unit: i64, high: f64) -> i64 {
    // off by one at powers of ten; subnormal numbers have logarithms, too
    let mut point = high.log10().floor() as i64 + 1;
    let reaches = |point: i64| {
        let (above, below) = scales(unit, -point);
        units * above >= below
    };
    while reaches(point) {
        point += 1;
    }
    while !reaches(point - 1) {
        point -= 1;
    }
    point
}

/// 0.digits 10^point in the layout that Rust has for an `f64`.
fn laid_out(negative: bool, digits: &str, point: i64) -> String {
    let sign = if negative { "-" } else { "" };
    let digits = digits.trim_end_matches('0');
    match usize::try_from(point) {
        _ if !(-3..=16).contains(&point) => {
            let (first, rest) = digits.split_at(1);
            let dot = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{dot}{rest}e{}", point - 1)
        }
        Ok(point) if point >= digits.len() => format!("{sign}{digits:0<point$}.0"),
        Ok(point) if point > 0 => format!("{sign}{}.{}", &digits[..point], &digits[point..]),
        _ => format!("{sign}0.{}{digits}", "0".repeat(point.unsigned_abs() as usize)),
    }
}
