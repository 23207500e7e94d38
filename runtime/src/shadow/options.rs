//! The options that select an estimator, as flags, scenes and JSON name them.

use std::fmt;
use std::str::FromStr;

use num_traits::Signed;
use thiserror::Error;

use crate::Rational;
use crate::shadow::differences::{SelectionRule, StoppingRule};

/// Above this order of central differences the exact weights take longer than any run.
pub const HIGHEST_ORDER: u32 = 1000;

/// The power of ten of the largest valid target error.
const LARGEST_ACCURACY: i32 = 100;

/// Options that select an estimator; omitted ones have their defaults.
///
/// The fields have the names of the keys of a scene and, with hyphens, of the flags.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EstimatorOptions {
    /// The m of D_m or the k of E_k; `None` for the best one of each state (`auto`).
    pub order: Option<u32>,
    /// The largest order that is tried.
    pub max_order: Option<u32>,
    /// Where the search for the best m ends.
    pub stop: Option<StoppingRule>,
    /// Which m is the best.
    pub rule: Option<SelectionRule>,
    /// The target error, in the units of the energy: the smallest k that meets it is used.
    pub accuracy: Option<Rational>,
}

impl EstimatorOptions {
    /// Names and values of the options that are set, in the order of the fields.
    pub fn names(&self) -> Vec<&'static str> {
        let all = [
            ("order", self.order.is_some()),
            ("max_order", self.max_order.is_some()),
            ("stop", self.stop.is_some()),
            ("rule", self.rule.is_some()),
            ("accuracy", self.accuracy.is_some()),
        ];
        all.into_iter().filter(|(_, is_set)| *is_set).map(|(name, _)| name).collect()
    }
}

/// Two options that exclude each other.
#[derive(Clone, PartialEq, Eq, Error)]
#[error("{option} requires {setting} = {required}, not {setting} = {found}")]
pub struct OptionConflict {
    /// The option that cannot be used: `max_order`, `stop`, `rule` or `accuracy`.
    pub option: &'static str,
    /// The option that it depends on: `estimator` or `order`.
    pub setting: &'static str,
    /// The value of that one which it requires.
    pub required: &'static str,
    /// The value that it has.
    pub found: String,
}

shadowstep_schemes::debug_as_text!(OptionConflict);

/// A target error that is not valid: it is absolute, in the units of the energy.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum AccuracyError {
    /// 0 or negative.
    #[error("is not a valid target error: it must be positive")]
    NotPositive,
    /// Larger than any energy.
    #[error("is above 1e100, an error larger than any energy")]
    TooLarge,
}

shadowstep_schemes::debug_as_text!(AccuracyError);

/// Checks a target error.
///
/// # Errors
/// One that is not positive, or above 1e100.
pub fn check_accuracy(accuracy: &Rational) -> Result<(), AccuracyError> {
    let largest = Rational::from_integer(10.into()).pow(LARGEST_ACCURACY);
    match () {
        () if !accuracy.is_positive() => Err(AccuracyError::NotPositive),
        () if *accuracy > largest => Err(AccuracyError::TooLarge),
        () => Ok(()),
    }
}

/// A word that is not a value of an option.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
#[error("expected {}", listed(.known))]
pub struct UnknownWord {
    /// The values that exist.
    pub known: &'static [&'static str],
}

shadowstep_schemes::debug_as_text!(UnknownWord);

/// `a, b or c`
fn listed(words: &[&str]) -> String {
    match words {
        [first @ .., before, last] => {
            first.iter().map(|word| format!("{word}, ")).collect::<String>() + &format!("{before} or {last}")
        }
        _ => words.concat(),
    }
}

impl StoppingRule {
    /// The words for them.
    pub const NAMES: &'static [&'static str] = &["full", "early", "printed"];

    /// Where each of them stops.
    pub const SUMMARIES: &'static [&'static str] = &[
        "At the largest m",
        "At the first m >= 13 whose term is larger than the eleven before it: the paper's rule, with < where the \
            paper prints <=",
        "The paper's rule with <=, as it is printed: at the first ripple of the terms. On Kepler's problem, e = 0.6, \
         h = 1/20, it gives 27 times the drift of the full search, where `early` gives 1.2 times",
    ];

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            StoppingRule::Full => "full",
            StoppingRule::Early => "early",
            StoppingRule::Printed => "printed",
        }
    }
}

impl SelectionRule {
    /// The words for them.
    pub const NAMES: &'static [&'static str] = &["least", "robust"];

    /// What each of them selects.
    pub const SUMMARIES: &'static [&'static str] = &[
        "The smallest term |T_m - T_(m-1)|",
        "The smallest maximum of ten neighbouring terms, which guards against a term that is small by chance",
    ];

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            SelectionRule::Least => "least",
            SelectionRule::Robust => "robust",
        }
    }
}

impl fmt::Display for StoppingRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for StoppingRule {
    type Err = UnknownWord;
    fn from_str(word: &str) -> Result<Self, UnknownWord> {
        match word {
            "full" => Ok(StoppingRule::Full),
            "early" => Ok(StoppingRule::Early),
            "printed" => Ok(StoppingRule::Printed),
            _ => Err(UnknownWord { known: Self::NAMES }),
        }
    }
}

impl fmt::Display for SelectionRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SelectionRule {
    type Err = UnknownWord;
    fn from_str(word: &str) -> Result<Self, UnknownWord> {
        match word {
            "least" => Ok(SelectionRule::Least),
            "robust" => Ok(SelectionRule::Robust),
            _ => Err(UnknownWord { known: Self::NAMES }),
        }
    }
}
