//! The flags of `drift` and `trace`: what is run, and how.

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule};
use shadowstep_scenes::arithmetic::{Arithmetic, DEFAULT_DIGITS, MOST_DIGITS};

use crate::output::OutputArguments;
use crate::quantity::whole;

/// What is run, and how.
#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) system: SystemArguments,
    /// Shipped schemes or files of tables, such as yoshida4,mine.toml; `shadowstep schemes` lists the shipped ones.
    /// exact-flow is the exact solution, known for harmonic-oscillator, pendulum and kepler; on it an estimator shows its own
    /// error
    #[arg(long = "scheme", value_name = "NAME|FILE,…", required = true, value_delimiter = ',')]
    pub(crate) schemes: Vec<String>,
    /// Step sizes, exact, such as 1/10,0.05; of a scene with [time], in the fictitious time s
    #[arg(long = "step", value_name = "H,…", required = true, value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) steps: Vec<String>,
    /// The time at which runs end, exact, such as 100; of a scene with [time], the fictitious time s
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(crate) until: String,
    /// Decimal digits of all numbers, such as 50
    #[arg(long, default_value_t = DEFAULT_DIGITS, value_name = "DIGITS", value_parser = |text: &str| whole(text, 1..=MOST_DIGITS))]
    pub(crate) digits: u32,
    /// MPFR's numbers, also for up to 307 digits, for which numbers of some limbs of 64 bits take less time
    #[arg(long)]
    pub(crate) mpfr: bool,
    #[command(flatten)]
    pub(crate) numbers: NumberArguments,
    /// How the modified energy is estimated
    #[arg(long, value_name = "NAME", default_value = EstimatorSettings::NAMES[0], value_parser = words(EstimatorSettings::NAMES, EstimatorSettings::SUMMARIES))]
    pub(crate) estimator: String,
    /// The m of D_m, at most 1000, or the k of E_k, at most 256, such as 40; or auto for the best one of each state
    #[arg(long, default_value = "auto", value_name = "M|K|auto", value_parser = order)]
    pub(crate) order: OrderChoice,
    /// The largest m or k that --order auto tries, such as 100 [default: 200 of m, 64 of k]
    #[arg(long, value_name = "M|K", value_parser = |text: &str| whole(text, 2..=HIGHEST_ORDER))]
    pub(crate) max_order: Option<u32>,
    /// Where --order auto stops trying m. Moan and Niesen's rule for an early stop is printed with <=; `early` has < instead
    /// [default: full]
    #[arg(long, value_name = "WHEN", value_parser = words(StoppingRule::NAMES, StoppingRule::SUMMARIES).try_map(|word| word.parse::<StoppingRule>()))]
    pub(crate) stop: Option<StoppingRule>,
    /// Which m is the best for --order auto [default: least, which reproduces the results of Moan & Niesen]
    #[arg(long, value_name = "RULE", value_parser = words(SelectionRule::NAMES, SelectionRule::SUMMARIES).try_map(|word| word.parse::<SelectionRule>()))]
    pub(crate) rule: Option<SelectionRule>,
    /// Target error for --estimator bilinear --order auto, such as 1e-20: the least k of 2, 4, 8, 16, … and the largest one
    /// that meets it is used. If none meets it, the most accurate is used, and its estimated error is reported
    /// [default: the best of them for each state]
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    pub(crate) accuracy: Option<String>,
    /// No summary of a run: the error of H, the modified energy, close encounters, the verdict on the step size
    #[arg(long)]
    pub(crate) no_summary: bool,
    /// Exit code 1 if the verdict on a run is worse than fine
    #[arg(long, conflicts_with = "no_summary")]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
}

/// A number type that has a flag in place of digits.
#[derive(Debug, Args)]
pub(crate) struct NumberArguments {
    /// Double precision (f64) instead of the digits
    #[arg(long, conflicts_with_all = ["digits", "mpfr"])]
    double: bool,
    /// Double precision in which positions and momenta are sums with remainders: less round-off in long runs, for up to half more time
    #[arg(long, conflicts_with_all = ["digits", "mpfr", "double"])]
    compensated: bool,
    /// Numbers that are sums of two doubles, about 32 digits, for 4 to 9 times the time of double precision
    #[arg(long, conflicts_with_all = ["digits", "mpfr", "double", "compensated"])]
    double_double: bool,
}

impl NumberArguments {
    /// The number type, if there is a flag.
    pub(crate) fn arithmetic(&self) -> Option<Arithmetic> {
        let flags = [
            (self.double, Arithmetic::DOUBLE),
            (self.compensated, Arithmetic::COMPENSATED),
            (self.double_double, Arithmetic::DOUBLE_DOUBLE),
        ];
        flags.into_iter().find_map(|(given, arithmetic)| given.then_some(arithmetic))
    }
}

/// The system: a shipped problem, that of a scene, or a formula.
#[derive(Debug, Args)]
pub(crate) struct SystemArguments {
    /// A shipped problem, such as kepler, or a scene's file, such as mine.toml, of which [problem] and [initial] are used;
    /// `shadowstep problems` lists the shipped ones
    #[arg(value_name = "PROBLEM|SCENE", required_unless_present_any = ["problem", "potential"])]
    name: Option<String>,
    /// The same as PROBLEM|SCENE
    #[arg(long, value_name = "NAME|FILE", conflicts_with = "name")]
    problem: Option<String>,
    /// A parameter or initial value of a shipped problem, or a parameter of --potential, exact, such as eccentricity=1/3 or
    /// "px=sqrt(2)/2"
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',')]
    pub(crate) set: Vec<String>,
    /// U(q), a smooth formula in the coordinates of --q, in place of --problem: "-1/sqrt(x^2 + y^2)"
    #[arg(long, value_name = "FORMULA", conflicts_with_all = ["name", "problem"], requires_all = ["q", "p"], allow_hyphen_values = true)]
    pub(crate) potential: Option<String>,
    /// The coordinates of --potential at t = 0: x=0.4,y=0
    #[arg(
        long,
        value_name = "NAME=VALUE,…",
        value_delimiter = ',',
        requires = "potential",
        allow_hyphen_values = true
    )]
    pub(crate) q: Vec<String>,
    /// The momenta at t = 0, in the order of the coordinates: 0,2 or px=0,py=2
    #[arg(
        long,
        value_name = "[NAME=]VALUE,…",
        value_delimiter = ',',
        requires = "potential",
        allow_hyphen_values = true
    )]
    pub(crate) p: Vec<String>,
    /// The masses of the coordinates [default: all are 1]
    #[arg(long, value_name = "VALUE,…", value_delimiter = ',', requires = "potential", allow_hyphen_values = true)]
    pub(crate) masses: Vec<String>,
}

impl SystemArguments {
    /// The name of a shipped problem or the path of a scene.
    pub(crate) fn problem(&self) -> Option<&String> {
        self.name.as_ref().or(self.problem.as_ref())
    }
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
