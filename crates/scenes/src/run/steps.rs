//! The number of steps of a run.

use num_traits::{Signed, ToPrimitive, Zero};
use shadowstep::{Rational, StepSize};
use shadowstep_schemes::symbolic::decimal::to_significant;
use thiserror::Error;

/// The most steps of a run: more would take years.
pub const MOST_STEPS: u64 = 10_000_000_000;

/// A step size and an end of the run that give no valid number of steps.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StepsError {
    /// The run ends where it begins.
    #[error("until {until}: the time must be nonzero")]
    NoTime {
        /// The time.
        until: String,
    },
    /// The step size and the time have different signs.
    #[error("steps of {h} never reach the time {until}: the signs differ")]
    NeverReached {
        /// The step size.
        h: String,
        /// The time.
        until: String,
    },
    /// The run ends within the first step.
    #[error("a step of {h} is longer than the run until {until}")]
    LongerThanRun {
        /// The step size.
        h: String,
        /// The time.
        until: String,
    },
    /// Of steps of a fictitious time more than [`MOST_STEPS`], even if physical time runs a million times as fast as at
    /// the start.
    #[error("steps of {h} until {until} are {count} steps at the rate of physical time at the start")]
    TooSlow {
        /// The step size.
        h: String,
        /// The time.
        until: String,
        /// The number of steps at that rate, to 3 digits.
        count: String,
    },
    /// More than [`MOST_STEPS`].
    #[error("steps of {h} until {until} are {count} steps")]
    TooMany {
        /// The step size.
        h: String,
        /// The time.
        until: String,
        /// The number of steps, to 3 digits.
        count: String,
    },
}

impl StepsError {
    /// What would be right.
    pub fn hint(&self) -> &'static str {
        match self {
            StepsError::NoTime { .. } => "write a time such as 100",
            StepsError::NeverReached { .. } => {
                "use positive values for both, or negative values for both to go back in time"
            }
            StepsError::LongerThanRun { .. } => "use a smaller step size",
            StepsError::TooSlow { .. } => {
                "give an earlier time: the limit is 1e10 steps, and rates change by less along orbits"
            }
            StepsError::TooMany { .. } => "the limit is 1e10 steps: use a larger step size or a shorter time",
        }
    }

    /// Whether the time is wrong, and not the step size.
    pub fn is_of_time(&self) -> bool {
        matches!(self, StepsError::NoTime { .. })
    }
}

/// The digits to which an irrational value, such as 2π, is known; it is rounded to some more.
const KNOWN_DIGITS: usize = 250;

/// The nearest whole number.
fn whole(x: &Rational) -> Rational {
    (x + Rational::new(1.into(), 2.into())).floor()
}

/// Whether two values are the same, as far as irrational ones are known: 60 times 2π/60 and 2π, which are rounded.
pub fn nearly_equal(a: &Rational, b: &Rational) -> bool {
    let known = num_traits::pow(Rational::from_integer(10.into()), KNOWN_DIGITS);
    a == b || (a - b).abs() * known <= b.abs()
}

/// The number of steps of size h that end at or before `until`, both with their texts for messages.
///
/// ```
/// use shadowstep::{StepSize, exact};
/// use shadowstep_scenes::steps::count;
///
/// let (h, until) = (StepSize::try_from("1/10").unwrap(), exact("1.25").unwrap());
/// assert_eq!(count((&h, "1/10"), (&until, "1.25")).unwrap(), 12);
/// let (h, until) = (StepSize::try_from("2*pi/60").unwrap(), exact("2*pi").unwrap());
/// assert_eq!(count((&h, "2*pi/60"), (&until, "2*pi")).unwrap(), 60);
/// ```
///
/// # Errors
/// A time of 0, different signs, a step longer than the run, more than [`MOST_STEPS`].
pub fn count((h, step): (&StepSize, &str), (until, end): (&Rational, &str)) -> Result<u64, StepsError> {
    if until.is_zero() {
        return Err(StepsError::NoTime { until: end.to_owned() });
    }
    let quotient = until / h.exact();
    let whole = whole(&quotient);
    let count = if nearly_equal(&whole, &quotient) { whole } else { quotient.floor() };
    let steps = count.to_u64();
    if let Some(steps @ 1..=MOST_STEPS) = steps {
        return Ok(steps);
    }
    let (h, until) = (step.to_owned(), end.to_owned());
    Err(match steps {
        _ if count.is_negative() => StepsError::NeverReached { h, until },
        Some(0) => StepsError::LongerThanRun { h, until },
        _ => StepsError::TooMany { h, until, count: to_significant(&count, 3) },
    })
}

/// How many times as fast as at the start physical time may run on the whole, from s.
const FASTEST: f64 = 1e6;

/// Whether a run with steps of a fictitious time can end at this physical time: the signs must agree, as time grows
/// with s, and the steps must not be far too many at the [rate](crate::System::rate_at_start) dt/ds of the start, where
/// it is known.
///
/// # Errors
/// A time of 0, different signs, a time that is too far away.
pub fn check_physical_end(
    (h, step): (&StepSize, &str),
    (until, end): (&Rational, &str),
    rate: Option<f64>,
) -> Result<(), StepsError> {
    let compared = if until.is_zero() { until.clone() } else { h.exact().abs() * until.signum() };
    count((h, step), (&compared, end))?;
    let quotient = until / h.exact();
    let allowed = rate.and_then(|rate| Rational::from_float(rate * FASTEST * MOST_STEPS as f64));
    match (allowed, rate.and_then(Rational::from_float)) {
        (Some(allowed), Some(rate)) if quotient > allowed => {
            let (h, until) = (step.to_owned(), end.to_owned());
            // a rate below the smallest double is 0
            let count = if rate.is_zero() { "over 1e300".to_owned() } else { to_significant(&(quotient / rate), 3) };
            Err(StepsError::TooSlow { h, until, count })
        }
        _ => Ok(()),
    }
}
