//! The number of steps of a run.

use num_traits::{Signed, ToPrimitive, Zero};
use shadowstep::Rational;
use shadowstep_symbolic::decimal::to_significant;
use thiserror::Error;

/// The most steps of a run: more would take years.
pub const MOST_STEPS: u64 = 10_000_000_000;

/// A step size and an end of the run that give no valid number of steps.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}\n  hint: {hint}")]
pub struct StepsError {
    /// What is wrong, one sentence.
    pub message: String,
    /// What would be right.
    pub hint: String,
    /// Which of the two is wrong.
    pub wrong: WrongValue,
}

/// The value that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrongValue {
    /// The step size.
    Step,
    /// The time at which the run ends.
    Until,
}

/// The number of steps of size h that end at or before `until`, both with their texts. Messages write `dashes` before the
/// names `step` and `until`: `--` for flags.
///
/// ```
/// use shadowstep::exact;
/// use shadowstep_scenes::steps::count;
///
/// let (h, until) = (exact("1/10").unwrap(), exact("1.25").unwrap());
/// assert_eq!(count((&h, "1/10"), (&until, "1.25"), "").unwrap(), 12);
/// ```
///
/// # Errors
/// A step or time of 0, different signs, a step longer than the run, more than [`MOST_STEPS`].
pub fn count((h, step): (&Rational, &str), (until, end): (&Rational, &str), dashes: &str) -> Result<u64, StepsError> {
    let refuse = |wrong, message: String, hint: &str| Err(StepsError { message, hint: hint.to_owned(), wrong });
    if h.is_zero() {
        return refuse(
            WrongValue::Step,
            format!("{dashes}step {step}: the step size must be nonzero"),
            "write a step size such as 1/10",
        );
    }
    if until.is_zero() {
        let hint = format!("write a time such as {dashes}until 100");
        return refuse(WrongValue::Until, format!("{dashes}until {end}: the time must be nonzero"), &hint);
    }
    let count = (until / h).floor();
    if count.is_negative() {
        let message = format!("steps of {step} never reach {dashes}until {end}: the signs differ");
        return refuse(
            WrongValue::Step,
            message,
            "use positive values for both, or negative values for both to go back in time",
        );
    }
    match count.to_u64() {
        Some(0) => {
            let message = format!("{dashes}step {step} is longer than the run until {end}");
            refuse(WrongValue::Step, message, "use a smaller step size")
        }
        Some(steps) if steps <= MOST_STEPS => Ok(steps),
        _ => refuse(
            WrongValue::Step,
            format!("steps of {step} until {end} are {} steps", to_significant(&count, 3)),
            "the limit is 1e10 steps: use a larger step size or a shorter time",
        ),
    }
}
