//! How many steps a run has.

use num_traits::{Signed, ToPrimitive, Zero};
use shadowstep::Rational;
use shadowstep_symbolic::decimal::to_significant;

use crate::complaint::remark;
use crate::readable::shortened;

/// More steps than anyone can wait for.
pub(crate) const MOST_STEPS: u64 = 10_000_000_000;

/// Why there is no such number.
pub(crate) struct NoSteps {
    pub(crate) sentence: String,
    pub(crate) hint: String,
    /// Which of the two is to blame.
    pub(crate) blamed: Blamed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Blamed {
    Step,
    Until,
}

/// How many steps of size h end at or before `until`, both with their texts; `dashes` stand before the names of flags.
pub(crate) fn count(
    (h, step): (&Rational, &str),
    (until, end): (&Rational, &str),
    dashes: &str,
) -> Result<u64, NoSteps> {
    let refuse = |blamed, sentence: String, hint: &str| Err(NoSteps { sentence, hint: hint.to_owned(), blamed });
    if h.is_zero() {
        return refuse(Blamed::Step, format!("{dashes}step {step} is zero"), "a step has a size, such as 1/10");
    }
    if until.is_zero() {
        let hint = format!("write a time such as {dashes}until 100");
        return refuse(Blamed::Until, format!("{dashes}until {end} leaves no time for a step"), &hint);
    }
    let count = (until / h).floor();
    if count.is_negative() {
        let sentence = format!("steps of {step} never come to {dashes}until {end}: their signs differ");
        return refuse(Blamed::Step, sentence, "both are positive, or both negative to go back in time");
    }
    match count.to_u64() {
        Some(0) => {
            let sentence = format!("{dashes}step {step} is longer than the run until {end}");
            refuse(Blamed::Step, sentence, "use a shorter step")
        }
        Some(steps) if steps <= MOST_STEPS => Ok(steps),
        _ => refuse(
            Blamed::Step,
            format!("steps of {step} until {end} are {} steps", to_significant(&count, 3)),
            "more than 1e10 are not run: use a longer step or a shorter time",
        ),
    }
}

/// Tells where a run ends that does not end at `until`.
pub(crate) fn remark_on_end(h: &Rational, steps: u64, until: &Rational) {
    let end = h * Rational::from_integer(steps.into());
    if end != *until {
        let (until, h, end) = (shortened(until, 20), shortened(h, 20), to_significant(&end, 12));
        remark(format_args!("{until} is not a multiple of {h}: the run ends at n = {steps}, t = {end}"));
    }
}
