//! Decimal text: read and written with one correct rounding, however large the exponents are.
//!
//! A number times a power of ten is computed to some more limbs than are needed, and to twice as many as long as its
//! error leaves the rounding open.

use crate::natural;
use crate::{EXPONENTS, Limbs};
use std::cmp::Ordering;
use std::f64::consts::LOG10_2;
use std::fmt;
use std::str::FromStr;

/// m 2^exponent, which is too large or too small by less than 2^error 2^exponent; exact where there is no error.
struct Scaled {
    m: Vec<u64>,
    exponent: i64,
    error: Option<u64>,
}

/// n 10^k 2^exponent, to at least this number of limbs.
fn scaled(n: &[u64], k: i64, exponent: i64, limbs: usize) -> Scaled {
    let (power, power_exponent, power_is_exact) = power_of_five(k.unsigned_abs(), limbs);
    let (m, exponent, is_exact) = if k >= 0 {
        (natural::product(n, &power), exponent + k + power_exponent, power_is_exact)
    } else {
        let wanted = 64 * limbs as u64 + natural::bits(&power);
        let shift = wanted.saturating_sub(natural::bits(n));
        let (m, is_exact) = natural::quotient(&natural::shift_up(n, shift), &power);
        (m, exponent + k - power_exponent - shift as i64, power_is_exact && is_exact)
    };
    // the power errs by less than 2^34 parts of 2^(64 limbs − 64), the quotient by a unit
    let error = (natural::bits(&m) + 36).saturating_sub(64 * limbs as u64 - 64) + 1;
    Scaled { m, exponent, error: (!is_exact).then_some(error) }
}

/// 5^k, k < 2^31, and whether it is exact: m 2^exponent with m of at most this number of limbs, too small by less than
/// 2^34 parts of 2^(64 limbs − 64), as each of some 60 roundings is raised to at most the power k.
fn power_of_five(k: u64, limbs: usize) -> (Vec<u64>, i64, bool) {
    let (mut m, mut exponent, mut is_exact) = (vec![1], 0, true);
    for bit in (0..64 - k.leading_zeros()).rev() {
        m = natural::product(&m, &m);
        exponent *= 2;
        if k >> bit & 1 != 0 {
            natural::multiply_and_add(&mut m, 5, 0);
        }
        if m.len() > limbs {
            let excess = m.len() - limbs;
            is_exact &= m[..excess].iter().all(|limb| *limb == 0);
            m.drain(..excess);
            exponent += 64 * excess as i64;
        }
    }
    (m, exponent, is_exact)
}

impl Scaled {
    /// The integer nearest to m / 2^shift, ties to even; none where the error leaves that open.
    fn rounded(&self, shift: u64) -> Option<Vec<u64>> {
        let (whole, _) = natural::shift_down(&self.m, shift);
        let half = shift.checked_sub(1)?;
        // twice the distance to a tie
        let (above, is_exact) = natural::shift_down(&self.m, half);
        let is_half_or_more = above.first().is_some_and(|limb| limb & 1 != 0);
        if let Some(error) = self.error {
            let near = natural::shift_down(&self.m, error + 1).0;
            let distance = half.checked_sub(error + 1).filter(|bits| *bits > 1)?;
            // all bits from the tie's down to the error are 0, or but for the first 1
            let low = low_bits(&near, distance);
            if is_half_or_more && low.iter().all(|limb| *limb == 0) || !is_half_or_more && is_all_ones(&low, distance) {
                return None;
            }
        }
        let odd = whole.first().is_some_and(|limb| limb & 1 != 0);
        let up = is_half_or_more && (!is_exact || self.error.is_some() || odd);
        let mut rounded = whole;
        if up {
            add_one(&mut rounded);
        }
        Some(rounded)
    }
}

fn low_bits(x: &[u64], bits: u64) -> Vec<u64> {
    let limbs = bits.div_ceil(64) as usize;
    let mut low: Vec<u64> = (0..limbs).map(|i| x.get(i).copied().unwrap_or(0)).collect();
    if !bits.is_multiple_of(64) {
        low[limbs - 1] &= (1 << (bits % 64)) - 1;
    }
    low
}

fn is_all_ones(low: &[u64], bits: u64) -> bool {
    low.iter().map(|limb| u64::from(limb.count_ones())).sum::<u64>() == bits
}

fn add_one(x: &mut Vec<u64>) {
    for limb in &mut *x {
        let carries;
        (*limb, carries) = limb.overflowing_add(1);
        if !carries {
            return;
        }
    }
    x.push(1);
}

impl<const L: usize> Limbs<L> {
    /// How many decimal digits of a text survive being read and written: ⌊(64 L − 1) log₁₀2⌋.
    pub const DIGITS: u32 = ((64 * L as u64 - 1) * 30_102_999_566 / 100_000_000_000) as u32;

    /// The decimal digits d₁d₂… of |x| = 0.d₁d₂… 10^point, correctly rounded to `count` significant ones, and the
    /// point; none of 0, infinities and NaN.
    ///
    /// ```
    /// use shadowstep_limbs::Limbs;
    ///
    /// let third = Limbs::<2>::from(200).over_integer(3);
    /// assert_eq!(third.to_digits(5), Some(("66667".to_owned(), 2)));
    /// ```
    pub fn to_digits(&self, count: u32) -> Option<(String, i64)> {
        let (integer, point) = self.integer_of_digits(count.max(1))?;
        Some((natural::digits(integer), point))
    }

    /// 10^(count − point) |x|, rounded to an integer of `count` digits, and the point.
    fn integer_of_digits(&self, count: u32) -> Option<(Vec<u64>, i64)> {
        let (significand, exponent) = (self.to_f64_exponent().0.abs(), self.exponent()?);
        let size = significand.log10() + f64::from(exponent) * LOG10_2;
        let mut point = size.floor() as i64 + 1; // off by one at powers of ten
        loop {
            let integer = self.times_power_of_ten(i64::from(count) - point);
            match natural::digits(integer.clone()).len().cmp(&(count as usize)) {
                Ordering::Equal => return Some((integer, point)),
                Ordering::Less => point -= 1,
                Ordering::Greater => point += 1,
            }
        }
    }

    /// The integer nearest to 10^k |x|, for a finite number other than 0.
    fn times_power_of_ten(&self, k: i64) -> Vec<u64> {
        let exponent = i64::from(self.exponent) - 64 * L as i64;
        let mut limbs = L + 2;
        loop {
            let scaled = scaled(&self.mantissa, k, exponent, limbs);
            // room for a rounding: at least a limb below the point
            let room = (scaled.exponent + 64).max(0) as u64;
            let shifted = Scaled {
                m: natural::shift_up(&scaled.m, room),
                exponent: scaled.exponent - room as i64,
                error: scaled.error.map(|error| error + room),
            };
            if let Some(integer) = shifted.rounded(shifted.exponent.unsigned_abs()) {
                return integer;
            }
            limbs *= 2;
        }
    }

    /// The shortest decimal text that reads back as the same number, laid out as Rust does for an `f64`: `0.1`,
    /// `-1.25e-30`, `NaN`, `inf`.
    ///
    /// ```
    /// use shadowstep_limbs::Limbs;
    ///
    /// let tenth = Limbs::<7>::from(1).over_integer(10);
    /// assert_eq!(tenth.to_text(), "0.1");
    /// ```
    pub fn to_text(&self) -> String {
        if !self.is_regular() {
            return format!("{:?}", self.to_f64());
        }
        // a text that is at most this long survives: if there is one for this number, it comes back, with zeros behind
        // it
        for count in Self::DIGITS.. {
            let (integer, point) = self.integer_of_digits(count).expect("finite and not 0");
            let mut next = integer.clone();
            add_one(&mut next); // below a power of two the numbers are closer, and what is nearest may not read back
            for candidate in [integer, next] {
                if Self::from_scaled(self.negative, &candidate, point - i64::from(count)) == *self {
                    let digits = natural::digits(candidate);
                    let point = point + digits.len() as i64 - i64::from(count);
                    return laid_out(self.negative, &digits, point);
                }
            }
        }
        unreachable!("some number of digits is enough")
    }

    /// The number nearest to ± n 10^k.
    fn from_scaled(negative: bool, n: &[u64], k: i64) -> Self {
        let size = natural::bits(n) as f64 * LOG10_2 + k as f64;
        if n.is_empty() || size < -f64::from(EXPONENTS) {
            return Limbs { negative, ..Self::ZERO };
        }
        if size > f64::from(EXPONENTS) {
            return Limbs { negative, ..Self::INFINITY };
        }
        let mut limbs = L + 2;
        loop {
            let mut scaled = scaled(n, k, 0, limbs);
            let room = (64 * (L as u64 + 2)).saturating_sub(natural::bits(&scaled.m));
            scaled.m = natural::shift_up(&scaled.m, room);
            scaled.exponent -= room as i64;
            scaled.error = scaled.error.map(|error| error + room);
            let shift = natural::bits(&scaled.m) - 64 * L as u64;
            if let Some(mantissa) = scaled.rounded(shift) {
                return Self::from_magnitude(negative, &mantissa, scaled.exponent + shift as i64, false);
            }
            limbs *= 2;
        }
    }
}

/// 0.digits 10^point, without zeros at the end.
fn laid_out(negative: bool, digits: &str, point: i64) -> String {
    let digits = digits.trim_end_matches('0');
    let sign = if negative { "-" } else { "" };
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

impl<const L: usize> fmt::Display for Limbs<L> {
    /// The shortest text that reads back; `{:.20}` has 20 significant digits, correctly rounded.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match f.precision().and_then(|count| self.to_digits(count as u32)) {
            Some((digits, point)) => laid_out(self.negative, &digits, point),
            None => self.to_text(),
        };
        f.pad_integral(true, "", &text)
    }
}

/// A text that is not a decimal number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct ParseError;

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("expected a decimal number such as -1.25e-30, or NaN, inf, -inf")
    }
}

/// Its text, which `unwrap` prints.
impl fmt::Debug for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for ParseError {}

impl<const L: usize> FromStr for Limbs<L> {
    type Err = ParseError;

    /// The nearest number, ties to even.
    fn from_str(text: &str) -> Result<Self, ParseError> {
        let (negative, unsigned) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        match unsigned {
            "inf" => return Ok(Limbs { negative, ..Self::INFINITY }),
            "NaN" => return Ok(Self::NAN),
            _ => {}
        }
        let (significand, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
        let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
        let is_number = |text: &str| text.bytes().all(|c| c.is_ascii_digit());
        if whole.len() + fraction.len() == 0 || !is_number(whole) || !is_number(fraction) {
            return Err(ParseError);
        }
        let mut n = Vec::new();
        for digit in whole.bytes().chain(fraction.bytes()) {
            natural::multiply_and_add(&mut n, 10, u64::from(digit - b'0'));
        }
        let exponent = read_exponent(exponent)?.saturating_sub(fraction.len() as i64);
        Ok(Self::from_scaled(negative, &n, exponent))
    }
}

/// An exponent, of a magnitude of at most 10^15, which is beyond the exponents of all numbers.
fn read_exponent(text: &str) -> Result<i64, ParseError> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|c| c.is_ascii_digit()) {
        return Err(ParseError);
    }
    let most = 10i64.pow(15);
    let magnitude =
        digits.trim_start_matches('0').parse::<i64>().unwrap_or(if digits.len() > 15 { most } else { 0 }).min(most);
    Ok(if text.starts_with('-') { -magnitude } else { magnitude })
}
