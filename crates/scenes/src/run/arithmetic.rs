//! The arithmetic of a run: its number type, the one place that dispatches on number types, and its sums.

use shadowstep::Rational;
use shadowstep::number::{LimbCount, Precision, PrecisionError};
use shadowstep_schemes::counted;
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::{round_significant, to_significant, to_text};

/// Digits beyond those of the run to which exact values are computed, so that rounding them once more does not show.
pub const GUARD_DIGITS: u32 = 20;

/// Irrational values are not computed to more digits.
pub const MOST_VALUE_DIGITS: u32 = shadowstep_schemes::symbolic::MOST_EVALUATED_DIGITS;

/// The most digits of a run.
pub const MOST_DIGITS: u32 = 100_000;

/// How exact numbers are written.
pub const NUMBER_EXAMPLES: &str = "write an exact number, such as 1/10, 0.05, 1e-3 or sqrt(2)/20";

/// What else helps where a scheme's weights have too few digits.
pub(crate) const OTHER_SCHEME: &str = "a scheme whose weights are fractions";

/// The digits of a run in words or numbers, as records and metadata have them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(untagged)]
pub enum DigitsLabel {
    /// A number type with a name, such as `double`.
    Name(&'static str),
    /// Decimal digits.
    Digits(u32),
}

/// The arithmetic of a run: its number type, and how positions and momenta are added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arithmetic {
    numbers: Numbers,
    compensated: bool,
}

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Double precision, `f64`.
    Double,
    /// Sums of two doubles: [`DoubleDouble`](shadowstep::number::DoubleDouble).
    DoubleDouble,
    /// Decimal digits, and the numbers that have them.
    Digits(u32, Digits),
}

/// Numbers of many digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// This number of limbs of 64 bits: [`AnyLimbs`](shadowstep::number::AnyLimbs).
    Limbs(LimbCount),
    /// MPFR's numbers: `Float`.
    #[cfg(feature = "mpfr")]
    Mpfr(Precision),
}

/// Calls a macro with the types of these numbers.
macro_rules! number_types {
    ($of:ident) => {
        $of!(f64, shadowstep::number::DoubleDouble, shadowstep::number::AnyLimbs);
        #[cfg(feature = "mpfr")]
        $of!(shadowstep::number::Float);
    };
}

pub(crate) use number_types;

/// The most digits that numbers of limbs have in a run; references to compare with may have one limb more.
const MOST_LIMBS: usize = 16;

impl Numbers {
    fn digits(self) -> u32 {
        match self {
            Numbers::Double => 16,
            Numbers::DoubleDouble => 32,
            Numbers::Digits(digits, _) => digits,
        }
    }

    /// How many times the operations of `f64` cost more in it, approximately.
    pub fn cost(self) -> f64 {
        match self {
            Numbers::Double => 1.0,
            Numbers::DoubleDouble => 6.0,
            Numbers::Digits(digits, _) => 30.0 + f64::from(digits).powf(1.5) / 20.0,
        }
    }

    fn described(self) -> String {
        match self {
            Numbers::Double => "double precision".to_owned(),
            Numbers::DoubleDouble => "double-double precision".to_owned(),
            Numbers::Digits(digits, _) => counted(digits, "digit"),
        }
    }
}

/// What helps where a number overflows or underflows in double precision.
pub(crate) const ANY_SIZE: &str = "write digits = 16 in [run] for numbers of any size";

impl Arithmetic {
    /// Double precision.
    pub const DOUBLE: Self = Arithmetic::plain(Numbers::Double);

    /// Double precision with [compensated sums](shadowstep::systems::summation::Compensated).
    pub const COMPENSATED: Self = Arithmetic { numbers: Numbers::Double, compensated: true };

    /// Sums of two doubles.
    pub const DOUBLE_DOUBLE: Self = Arithmetic::plain(Numbers::DoubleDouble);

    /// Those that have names instead of digits, in scenes and records.
    pub const NAMED: &'static [(&'static str, Self)] =
        &[("double", Self::DOUBLE), ("compensated", Self::COMPENSATED), ("double-double", Self::DOUBLE_DOUBLE)];

    const fn plain(numbers: Numbers) -> Self {
        Arithmetic { numbers, compensated: false }
    }

    /// The number type.
    pub fn numbers(self) -> Numbers {
        self.numbers
    }

    /// Its significant decimal digits, rounded up.
    pub fn digits(self) -> u32 {
        self.numbers.digits()
    }

    /// Its name or digits in records and metadata.
    pub fn label(self) -> DigitsLabel {
        let named = Arithmetic::NAMED.iter().find(|(_, named)| *named == self);
        named.map_or(DigitsLabel::Digits(self.digits()), |(word, _)| DigitsLabel::Name(word))
    }

    /// Its description: `double precision`, `120 digits`.
    pub fn described(self) -> String {
        self.numbers.described() + if self.compensated { ", compensated sums" } else { "" }
    }

    /// Whether q and p are sums with remainders.
    pub fn is_compensated(self) -> bool {
        self.compensated
    }

    /// Whether numbers have more digits than double precision.
    pub fn is_longer_than_double(self) -> bool {
        self.numbers != Numbers::Double
    }

    /// Numbers with this many decimal digits: of the fewest limbs that have them, beyond 307 digits MPFR's.
    ///
    /// # Errors
    /// More digits than MPFR has, or than 307 without the feature `mpfr`.
    pub fn with_digits(digits: u32) -> Result<Self, DigitsError> {
        let precision = Precision::digits(digits)?;
        match LimbCount::of_bits(precision.in_bits()).filter(|count| count.get() <= MOST_LIMBS) {
            Some(count) => Ok(Arithmetic::plain(Numbers::Digits(digits, Digits::Limbs(count)))),
            None => Arithmetic::with_mpfr(digits),
        }
    }

    /// MPFR's numbers with this many decimal digits.
    ///
    /// # Errors
    /// More digits than MPFR has; always without the feature `mpfr`.
    pub(crate) fn with_mpfr(digits: u32) -> Result<Self, DigitsError> {
        let precision = Precision::digits(digits)?;
        #[cfg(feature = "mpfr")]
        return Ok(Arithmetic::plain(Numbers::Digits(digits, Digits::Mpfr(precision))));
        #[cfg(not(feature = "mpfr"))]
        Err(DigitsError::NeedsMpfr(precision.in_digits()))
    }

    /// MPFR's numbers if `mpfr` is true, else [`with_digits`](Arithmetic::with_digits).
    ///
    /// # Errors
    /// More digits than MPFR has; without the feature `mpfr` all of its numbers.
    pub fn of_digits(digits: u32, mpfr: bool) -> Result<Self, DigitsError> {
        if mpfr { Arithmetic::with_mpfr(digits) } else { Arithmetic::with_digits(digits) }
    }

    /// The number of limbs of 64 bits; `None` of other number types.
    pub(crate) fn limbs(self) -> Option<usize> {
        match self.numbers {
            Numbers::Digits(_, Digits::Limbs(count)) => Some(count.get()),
            _ => None,
        }
    }

    /// The digits to which exact values of the run are computed.
    pub fn value_digits(self) -> u32 {
        self.digits() + GUARD_DIGITS
    }

    /// Whether a value is exact, or has the digits that a run needs.
    pub fn has_digits_of(self, value: &Exact) -> bool {
        !value.rounded || self.value_digits() <= MOST_VALUE_DIGITS
    }

    /// The number of this [text](Arithmetic::text).
    pub(crate) fn number(self, exact: &Exact) -> Rational {
        match exact.rounded {
            true => round_significant(&exact.value, self.value_digits()),
            false => exact.value.clone(),
        }
    }

    /// The exact text of a value that is given to the run, or the digits of an irrational one.
    pub(crate) fn text(self, exact: &Exact) -> String {
        match exact.rounded {
            true => to_significant(&exact.value, self.value_digits() as usize),
            false => to_text(&exact.value),
        }
    }
}

/// Digits that numbers cannot have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DigitsError {
    /// No number type has them.
    #[error(transparent)]
    Precision(#[from] PrecisionError),
    /// MPFR has them.
    #[error(
        "{0} digits need MPFR, which this program was built without; it has up to {most} digits",
        most = Precision::of_limbs(MOST_LIMBS).in_digits()
    )]
    NeedsMpfr(u32),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_sums_have_the_names_of_records() {
        let labels =
            |arithmetic: Arithmetic| (serde_json::json!(arithmetic.label()).to_string(), arithmetic.described());
        for ((word, arithmetic), described) in Arithmetic::NAMED.iter().zip([
            "double precision",
            "double precision, compensated sums",
            "double-double precision",
        ]) {
            assert_eq!(labels(*arithmetic), (format!("\"{word}\""), described.to_owned()));
        }
        assert_eq!(labels(Arithmetic::with_digits(30).unwrap()), ("30".to_owned(), "30 digits".to_owned()));
        assert!(Arithmetic::COMPENSATED.is_compensated() && !Arithmetic::COMPENSATED.is_longer_than_double());
        assert!(!Arithmetic::DOUBLE_DOUBLE.is_compensated() && Arithmetic::DOUBLE_DOUBLE.is_longer_than_double());
    }
}
