//! The result of polishing: a table with new decimals, or the reason why there is none.

use shadowstep_schemes::Proved;
use shadowstep_schemes::document::Faults;
use shadowstep_schemes::symbolic::Rational;

/// A polished table.
#[derive(Clone, Debug)]
pub struct Polished {
    /// Its text.
    pub text: String,
    /// What was proved of it.
    pub proved: Proved,
    /// Its decimals, in the order of the text.
    pub weights: Vec<PolishedWeight>,
    /// Whether the conditions are polynomials in the γ's of a composition.
    pub in_gamma: bool,
    /// How many conditions were evaluated.
    pub conditions: usize,
    /// The condition number of their derivatives (rows of length 1) along the decimals that were solved for.
    pub condition_number: f64,
    /// log10 of how far a condition is from what is needed, at most, with the printed decimals.
    pub residual_printed: f64,
    /// The same with the polished ones.
    pub residual: f64,
    /// Sentences on what else is to be known of the table.
    pub notes: Vec<String>,
}

/// A decimal before and after.
#[derive(Clone, Debug)]
pub struct PolishedWeight {
    /// The constant's name, or the place such as `kick[2]`.
    pub name: String,
    /// Its name in the polished table.
    pub constant: String,
    /// The printed value.
    pub printed: Rational,
    /// Its significant digits.
    pub printed_digits: u32,
    /// The polished value.
    pub polished: Rational,
    /// How many of the printed digits are right: the most leading ones of which the last is off by half a unit at most,
    /// as rounding leaves it (and a tenth of that more, as a rounding of a rounding does).
    pub right: u32,
    /// How it was found.
    pub role: Role,
}

/// How a decimal was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The conditions determine it.
    Solved,
    /// The conditions determine it; it is written as a formula, so that a sum is exactly 1.
    Formula,
    /// It stays as printed, as requested.
    Held,
    /// It stays as printed, because the conditions leave some decimals free.
    Free,
}

/// Why a table was not polished.
#[derive(Clone, Debug, thiserror::Error)]
pub enum NotPolished {
    /// The table has faults, or no place for what is to be written.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// A request that makes no sense for the table.
    #[error("{message}")]
    Request {
        /// What is wrong.
        message: String,
        /// What would be right.
        hint: String,
    },
    /// No values near the printed ones meet the conditions, or they are not determined well enough.
    #[error("{message}")]
    Unsolved {
        /// What happened, with numbers.
        message: String,
        /// What may be the reason.
        hint: String,
    },
}
