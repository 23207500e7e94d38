//! The exact step size of a scheme.

use std::convert::Infallible;

use num_traits::{Signed, Zero};
use shadowstep_schemes::symbolic::decimal::{to_significant, to_text};
use thiserror::Error;

use crate::{Rational, exact};

/// A step size h, an exact rational of a size from 1e-300 to 1e300; a negative one steps backwards in time.
///
/// | made from | means |
/// | --- | --- |
/// | `"1/20"`, `"0.05"`, `"1/(2 + 2^(1/3))"` | the value of the formula; an irrational one is rounded once to 300 digits |
/// | `0.05_f64` | the double itself, which is 0.05000000000000000277… |
/// | a [`Rational`] | itself |
///
/// `"0.05"` and `0.05` differ as the decimal and the double nearest to it do. In `f64` both give weights that
/// differ by at most their rounding; with more digits `0.05` is a step size that differs from 1/20 in the 18th digit.
///
/// ```
/// use shadowstep::StepSize;
///
/// let exact = StepSize::try_from("1/20")?;
/// assert_eq!(exact, StepSize::try_from("0.05")?);
/// assert_ne!(exact, StepSize::try_from(0.05)?);
/// assert_eq!(StepSize::try_from(2)?, StepSize::try_from("2")?);
/// let error = StepSize::try_from(0.0).unwrap_err();
/// assert_eq!(error.to_string(), "the step size must be nonzero");
/// assert_eq!(format!("{error:?}"), error.to_string()); // as `unwrap` prints it
/// # Ok::<(), shadowstep::StepSizeError>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct StepSize(Rational);

/// The longest text that is shown in full.
const LONGEST: usize = 40;

/// A value that is not a valid step size.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum StepSizeError {
    /// h = 0.
    #[error("the step size must be nonzero")]
    Zero,
    /// An infinite step size, or NaN.
    #[error("the step size must be finite, not {0}")]
    NotFinite(String),
    /// A size that is 0 or infinite in `f64`, or nearly.
    #[error("the step size must have a size from 1e-300 to 1e300")]
    BeyondRange,
    /// A text without an exact value.
    #[error("the step size `{text}` is not a valid number: {error}")]
    NotANumber {
        /// The text.
        text: String,
        /// Why it has no value.
        error: shadowstep_schemes::symbolic::Error,
    },
}

shadowstep_schemes::debug_as_text!(StepSizeError);

impl StepSize {
    /// The exact value.
    pub fn exact(&self) -> &Rational {
        &self.0
    }

    /// 2h
    pub(crate) fn doubled(&self) -> StepSize {
        StepSize(&self.0 * Rational::from_integer(2.into()))
    }
}

/// The exact value where it is short, else its first digits.
impl std::fmt::Debug for StepSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match to_text(&self.0) {
            text if text.len() <= LONGEST => write!(f, "StepSize({text})"),
            _ => write!(f, "StepSize(≈ {})", to_significant(&self.0, 20)),
        }
    }
}

impl std::fmt::Display for StepSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&to_text(&self.0))
    }
}

impl TryFrom<Rational> for StepSize {
    type Error = StepSizeError;
    fn try_from(h: Rational) -> Result<Self, StepSizeError> {
        let size = h.abs();
        let largest = Rational::from_integer(10.into()).pow(300);
        match () {
            () if h.is_zero() => Err(StepSizeError::Zero),
            () if size > largest || size < largest.recip() => Err(StepSizeError::BeyondRange),
            () => Ok(StepSize(h)),
        }
    }
}

impl TryFrom<&Rational> for StepSize {
    type Error = StepSizeError;
    fn try_from(h: &Rational) -> Result<Self, StepSizeError> {
        h.clone().try_into()
    }
}

impl TryFrom<f64> for StepSize {
    type Error = StepSizeError;
    fn try_from(h: f64) -> Result<Self, StepSizeError> {
        Rational::from_float(h).ok_or_else(|| StepSizeError::NotFinite(h.to_string()))?.try_into()
    }
}

impl TryFrom<i32> for StepSize {
    type Error = StepSizeError;
    fn try_from(h: i32) -> Result<Self, StepSizeError> {
        Rational::from_integer(h.into()).try_into()
    }
}

impl TryFrom<&str> for StepSize {
    type Error = StepSizeError;
    fn try_from(text: &str) -> Result<Self, StepSizeError> {
        let value = exact(text).map_err(|error| StepSizeError::NotANumber { text: text.to_owned(), error })?;
        value.try_into()
    }
}

impl From<&StepSize> for StepSize {
    fn from(h: &StepSize) -> Self {
        h.clone()
    }
}

/// A [`StepSize`] is made from a step size without an error.
impl From<Infallible> for StepSizeError {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}
