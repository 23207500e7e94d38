//! Exact numbers in flags: `--step 1/10`, `--set x=1/2`.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use shadowstep::problems::ProblemError;
use shadowstep::{Rational, StepSize};
use shadowstep_scenes::arithmetic::NUMBER_EXAMPLES;
use shadowstep_scenes::readable::{LONGEST_NUMBER, shortened};
use shadowstep_scenes::steps;
use shadowstep_scenes::{Error, System};
use shadowstep_schemes::symbolic::{Budget, evaluate_within, parse};

/// Digits of irrational numbers in flags.
const DIGITS: u32 = 300;

thread_local! {
    /// How much computing the numbers of a command line may take together.
    static BUDGET: Budget = Budget::default();
}

/// The number of a flag.
pub(crate) fn number(flag: &str, text: &str) -> Result<Rational, Error> {
    exact(text).map_err(|error| {
        let place = character(text, error.range().start);
        Error::usage(format!("{flag} `{text}`, character {place}: {error}"), NUMBER_EXAMPLES)
    })
}

/// The step size of a flag.
pub(crate) fn step_size(flag: &str, text: &str) -> Result<StepSize, Error> {
    StepSize::try_from(number(flag, text)?)
        .map_err(|zero| Error::usage(format!("{flag} {text}: {zero}"), "write a step size such as 1/10"))
}

/// How many steps of size h, with its text, end at or before the time of --until; `None` where time is transformed, as
/// they have to be made to count them.
pub(crate) fn steps(h: (&StepSize, &str), until: &Rational, system: &System) -> Result<Option<u64>, Error> {
    let ends = (until, &*shortened(until, LONGEST_NUMBER));
    let count = match system.transformed_time() {
        Some(_) => steps::check_physical_end(h, ends, system.rate_at_start()).map(|()| None),
        None => steps::count(h, ends).map(Some),
    };
    count.map_err(|none| match none.is_of_time() {
        true => Error::usage(format!("--{none}"), "write a time such as --until 100"),
        false => Error::usage(none.to_string(), none.hint()),
    })
}

fn exact(text: &str) -> Result<Rational, shadowstep_schemes::symbolic::Error> {
    let expression = parse(text)?;
    Ok(BUDGET.with(|budget| evaluate_within(&expression, &BTreeMap::new(), DIGITS, budget))?.value)
}

/// A whole number of a flag, within a range.
///
/// # Errors
/// The end of clap's message about the flag.
pub(crate) fn whole(text: &str, range: RangeInclusive<u32>) -> Result<u32, String> {
    match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        _ if text.parse::<i128>().is_ok() => {
            Err(format!("{text} is out of range: write a whole number from {} to {}", range.start(), range.end()))
        }
        _ => Err(format!("write a whole number from {} to {}", range.start(), range.end())),
    }
}

/// `name=expression` in two; the expression is evaluated where its names are known.
pub(crate) fn assignment(text: &str) -> Result<(String, String), Error> {
    let Some((name, expression)) = text.split_once('=') else {
        let hint = "write a name and a value: --set x=1/2; a comma begins another one, and the decimal point is `.`";
        return Err(Error::usage(format!("--set {text} has no `=`"), hint));
    };
    if name.trim().is_empty() {
        return Err(Error::usage(format!("--set {text} has no name before its `=`"), "write --set x=1/2"));
    }
    if let Err(error) = parse(expression) {
        let place = character(expression, error.range.start);
        return Err(Error::usage(format!("--set {text}: `{expression}`, character {place}: {error}"), NUMBER_EXAMPLES));
    }
    Ok((name.trim().to_owned(), expression.trim().to_owned()))
}

/// The error of a problem or of a value of `--set`.
pub(crate) fn problem_error(error: ProblemError) -> Error {
    match error {
        ProblemError::UnknownProblem { name, hint } => Error::usage(format!("there is no problem `{name}`"), hint),
        ProblemError::UnknownParameter { problem, name, hint } => {
            // a list of known names needs no other one
            let is_guess = hint.ends_with('?');
            let list = format!("`shadowstep problems {problem}` lists what can be set");
            let hint = if is_guess { format!("{hint} {list}") } else { hint };
            Error::usage(format!("{problem} has no parameter or initial value `{name}`"), hint)
        }
        ProblemError::SetTwice { name } => Error::usage(format!("`{name}` is set twice"), "keep one"),
        ProblemError::NoValue { name, text, why } => {
            Error::usage(format!("--set {name}={text}: {why}"), NUMBER_EXAMPLES)
        }
        ProblemError::OutOfRange { name, text, range } => {
            Error::usage(format!("--set {name}={text} is out of range"), range)
        }
    }
}

/// The number of a character, from 1.
fn character(text: &str, byte: usize) -> usize {
    text.char_indices().take_while(|(at, _)| *at < byte).count() + 1
}
