//! The flags of `drift` and `trace`: what is run, and how.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule};
use shadowstep_scenes::arithmetic::{DEFAULT_DIGITS, MOST_DIGITS};

/// What is run, and how.
#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// The problem, such as kepler; `shadowstep problems` lists them
    #[arg(long, value_name = "NAME")]
    pub(crate) problem: String,
    /// A parameter or initial value, exact, such as eccentricity=1/3 or "px=sqrt(2)/2"; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub(crate) set: Vec<String>,
    /// Shipped schemes or files of tables, such as yoshida4,mine.toml; `shadowstep schemes` lists the shipped ones.
    /// exact-flow is the exact solution, known for harmonic-oscillator, pendulum and kepler; on it an estimator shows its own
    /// error
    #[arg(long = "scheme", value_name = "NAME|FILE,…", required = true, value_delimiter = ',')]
    pub(crate) schemes: Vec<String>,
    /// Step sizes, exact, such as 1/10,0.05
    #[arg(long = "step", value_name = "H,…", required = true, value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) steps: Vec<String>,
    /// The time at which runs end, exact, such as 100
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(crate) until: String,
    /// Decimal digits of all numbers, such as 50
    #[arg(long, default_value_t = DEFAULT_DIGITS, value_name = "DIGITS", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_DIGITS)))]
    pub(crate) digits: u32,
    /// Double precision (f64) instead of --digits
    #[arg(long, conflicts_with = "digits")]
    pub(crate) double: bool,
    /// How the modified energy is estimated
    #[arg(long, value_name = "NAME", default_value = EstimatorSettings::NAMES[0], value_parser = words(EstimatorSettings::NAMES, EstimatorSettings::SUMMARIES))]
    pub(crate) estimator: String,
    /// The m of D_m or the k of E_k, such as 40, or auto for the best one of each state
    #[arg(long, default_value = "auto", value_name = "M|K|auto", value_parser = order)]
    pub(crate) order: OrderChoice,
    /// The largest m or k that --order auto tries, such as 100 [default: 200 of m, 64 of k]
    #[arg(long, value_name = "M|K", value_parser = clap::value_parser!(u32).range(2..=i64::from(HIGHEST_ORDER)))]
    pub(crate) max_order: Option<u32>,
    /// Where --order auto stops trying m: at the largest, or early, where the errors rise [default: full]
    #[arg(long, value_name = "WHEN", value_parser = words(StoppingRule::NAMES, StoppingRule::SUMMARIES).try_map(|word| word.parse::<StoppingRule>()))]
    pub(crate) stop: Option<StoppingRule>,
    /// Which m is the best for --order auto [default: least, which reproduces the results of Moan & Niesen]
    #[arg(long, value_name = "RULE", value_parser = words(SelectionRule::NAMES, SelectionRule::SUMMARIES).try_map(|word| word.parse::<SelectionRule>()))]
    pub(crate) rule: Option<SelectionRule>,
    /// Target error for --estimator bilinear --order auto, such as 1e-20; the smallest k that meets it is used. Where none
    /// does, the best k is used, and the estimates show it [default: the best k of each state]
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    pub(crate) accuracy: Option<String>,
    /// Writes to a file, such as out.json, which gets its name when it is complete
    #[arg(long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OrderChoice {
    Auto,
    Fixed(u32),
}

/// The words that a flag accepts, each with its help.
fn words(names: &'static [&'static str], help: &'static [&'static str]) -> PossibleValuesParser {
    names.iter().zip(help).map(|(name, help)| PossibleValue::new(name).help(help)).collect::<Vec<_>>().into()
}

fn order(text: &str) -> Result<OrderChoice, String> {
    match text.parse() {
        _ if text == "auto" => Ok(OrderChoice::Auto),
        Ok(m) if (1..=HIGHEST_ORDER).contains(&m) => Ok(OrderChoice::Fixed(m)),
        _ => Err(format!("write a number from 1 to {HIGHEST_ORDER}, or auto")),
    }
}
