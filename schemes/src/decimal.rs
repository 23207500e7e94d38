//! A decimal as it is printed: its value, its places and its digits.

use num_bigint::BigInt;
use num_traits::Zero;

use crate::symbolic::Rational;
use crate::symbolic::decimal::from_text;

/// A decimal such as `-0.25` or `1.5e-3`, which may be a rounded number.
///
/// ```
/// use shadowstep_schemes::decimal::PrintedDecimal;
///
/// let decimal = PrintedDecimal::of("-0.0135").unwrap();
/// assert_eq!((decimal.places, decimal.significant), (4, 3));
/// assert!(PrintedDecimal::of("2").is_none() && PrintedDecimal::of("0.0").is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedDecimal {
    /// Its value.
    pub value: Rational,
    /// Decimal places behind the point; less than 0 for `1.5e20`.
    pub places: i64,
    /// Digits from the first that is not 0.
    pub significant: u32,
}

impl PrintedDecimal {
    /// The decimal that a text is; `None` for a whole number, for 0 and for all else.
    pub fn of(text: &str) -> Option<PrintedDecimal> {
        let text = text.trim();
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (_, fraction) = mantissa.split_once('.')?;
        let value = from_text(&text.replace('_', "")).ok().filter(|value| !value.is_zero())?;
        let count = |text: &str| text.bytes().filter(u8::is_ascii_digit).count();
        let places = count(fraction) as i64 - exponent.parse::<i64>().ok()?;
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        Some(PrintedDecimal { value, places, significant: digits.trim_start_matches('0').len() as u32 })
    }

    /// One unit of its last place: 10^(−places).
    pub fn unit(&self) -> Rational {
        let power = Rational::from_integer(BigInt::from(10).pow(self.places.unsigned_abs() as u32));
        if self.places < 0 { power } else { power.recip() }
    }
}
