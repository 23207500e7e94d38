//! The flags of `drift` and `trace`: what is run, and how.

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use shadowstep::shadow::{EstimatorSettings, HIGHEST_ORDER, SelectionRule, StoppingRule};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::{Arithmetic, MOST_DIGITS};

use crate::headings::{ESTIMATOR, NUMBERS, OUTPUT, PROBLEM, SCHEMES};
use crate::output::OutputArguments;
use crate::quantity::whole;

/// What is run, and how.
#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) system: SystemArguments,
    /// Shipped or custom schemes: yoshida4,mine.toml
    ///
    /// `shadowstep schemes` lists the shipped ones; custom schemes are files of tables. exact-flow is the exact
    /// solution, known for harmonic-oscillator, pendulum and kepler; on it an estimator shows its own error.
    #[arg(long = "scheme", value_name = "NAME|FILE,…", required = true, value_delimiter = ',', help_heading = SCHEMES)]
    pub(crate) schemes: Vec<String>,
    /// Exact step sizes, such as 1/10,0.05
    ///
    /// Of a scene with [time], they are steps of the fictitious time s.
    #[arg(
        long = "step",
        aliases = ["h", "dt"],
        value_name = "H,…",
        required = true,
        value_delimiter = ',',
        allow_hyphen_values = true,
        help_heading = SCHEMES,
    )]
    pub(crate) sizes: Vec<String>,
    /// The exact time at which runs end, such as 100
    ///
    /// Of a scene with [time], it is a physical time as well.
    #[arg(long, value_name = "T", allow_hyphen_values = true, help_heading = SCHEMES)]
    pub(crate) until: String,
    #[command(flatten)]
    pub(crate) numbers: NumberArguments,
    #[command(flatten)]
    pub(crate) estimator: EstimatorArguments,
    /// No summary of a run
    ///
    /// A summary has the error of H, the modified energy, close encounters, and the verdict on the step size.
    #[arg(long, help_heading = OUTPUT)]
    pub(crate) no_summary: bool,
    /// Exit code 1 unless bounded or round-off
    #[arg(long, conflicts_with = "no_summary", help_heading = OUTPUT)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) output: OutputArguments,
}

/// How the modified energy is estimated.
#[derive(Debug, Args)]
#[command(next_help_heading = ESTIMATOR)]
pub(crate) struct EstimatorArguments {
    /// How the modified energy is estimated
    #[arg(
        long,
        value_name = "NAME",
        default_value = EstimatorSettings::NAMES[0],
        value_parser = words(EstimatorSettings::NAMES, EstimatorSettings::SUMMARIES),
    )]
    pub(crate) estimator: String,
    /// The k of E_k or m of D_m, such as 24, or auto
    ///
    /// k is at most 256, m at most 1000. auto takes for each state the best of k = 2, 4, 8, …, or of all m.
    #[arg(long, default_value = "auto", value_name = "K|M|auto", value_parser = order)]
    pub(crate) order: OrderChoice,
    /// Largest k or m of auto [default: 64 of k, 200 of m]
    ///
    /// It is the largest that --order auto tries, such as 100.
    #[arg(long, value_name = "K|M", value_parser = |text: &str| whole(text, 2..=HIGHEST_ORDER))]
    pub(crate) max_order: Option<u32>,
    /// Where --order auto stops trying m [default: full]
    ///
    /// It requires --estimator central. Moan and Niesen's rule for an early stop is printed with <=; `early` has <
    /// instead.
    #[arg(
        long,
        value_name = "WHEN",
        value_parser = words(StoppingRule::NAMES, StoppingRule::SUMMARIES)
            .try_map(|word| word.parse::<StoppingRule>()),
    )]
    pub(crate) stop: Option<StoppingRule>,
    /// Which m is the best for --order auto [default: least]
    ///
    /// It requires --estimator central. `least` reproduces the results of Moan and Niesen.
    #[arg(
        long,
        value_name = "RULE",
        value_parser = words(SelectionRule::NAMES, SelectionRule::SUMMARIES)
            .try_map(|word| word.parse::<SelectionRule>()),
    )]
    pub(crate) rule: Option<SelectionRule>,
    /// Target error of E_k with --order auto, such as 1e-20
    ///
    /// Of k = 2, 4, 8, 16, … and the largest k, the least one that meets the target error is
    /// used. If none meets it, the most accurate is used, and its estimated error is reported. Without this flag the
    /// best of them is used for each state.
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    pub(crate) accuracy: Option<String>,
}

/// The number type.
#[derive(Debug, Args)]
#[command(next_help_heading = NUMBERS)]
pub(crate) struct NumberArguments {
    /// Decimal digits, such as 50 [default: double precision]
    ///
    /// All numbers of a run have them. `advise`, `chaos` and `work-precision` have those of [run] in a scene by
    /// default.
    #[arg(long, value_name = "DIGITS", value_parser = |text: &str| whole(text, 1..=MOST_DIGITS))]
    digits: Option<u32>,
    /// MPFR's numbers, also for up to 307 digits
    ///
    /// For up to 307 digits, numbers of 64-bit limbs are the default; they take less time.
    #[arg(long, requires = "digits")]
    mpfr: bool,
    /// Double precision (f64), also where a scene has digits
    #[arg(long, conflicts_with_all = ["digits", "mpfr"])]
    double: bool,
    /// Double precision with less round-off in long runs
    ///
    /// Positions and momenta are sums with remainders. A run takes up to half more time.
    #[arg(long, conflicts_with_all = ["digits", "mpfr", "double"])]
    compensated: bool,
    /// Sums of two doubles, about 32 digits
    ///
    /// They take 4 to 9 times the time of double precision.
    #[arg(long, conflicts_with_all = ["digits", "mpfr", "double", "compensated"])]
    double_double: bool,
}

impl NumberArguments {
    /// The number type, if there is a flag.
    pub(crate) fn arithmetic(&self) -> Result<Option<Arithmetic>, Error> {
        if let Some(digits) = self.digits {
            let arithmetic = Arithmetic::of_digits(digits, self.mpfr);
            return arithmetic.map(Some).map_err(|error| Error::usage(error.to_string(), "use --digits 120"));
        }
        let flags = [
            (self.double, Arithmetic::DOUBLE),
            (self.compensated, Arithmetic::COMPENSATED),
            (self.double_double, Arithmetic::DOUBLE_DOUBLE),
        ];
        Ok(flags.into_iter().find_map(|(given, arithmetic)| given.then_some(arithmetic)))
    }
}

/// The system: a shipped problem, that of a scene, or a formula.
#[derive(Debug, Args)]
#[command(next_help_heading = PROBLEM)]
pub(crate) struct SystemArguments {
    /// A problem, such as kepler, or the file of a scene
    ///
    /// `shadowstep problems` lists the shipped problems. Of a scene, such as mine.toml, [problem] and [initial] are
    /// used.
    #[arg(display_order = 0, value_name = "PROBLEM|SCENE", required_unless_present_any = ["problem", "potential"])]
    name: Option<String>,
    /// The same as PROBLEM|SCENE
    #[arg(long, value_name = "NAME|FILE", conflicts_with = "name", display_order = 1)]
    problem: Option<String>,
    /// Parameters and initial values: eccentricity=1/3
    ///
    /// Values are exact, such as "px=sqrt(2)/2". They belong to parameters and initial values of a shipped problem, or
    /// to parameters of --potential.
    #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',')]
    pub(crate) set: Vec<String>,
    /// U(q) in place of a problem: "-1/sqrt(x^2 + y^2)"
    ///
    /// It is a smooth formula in the coordinates of --q.
    #[arg(long, value_name = "FORMULA", conflicts_with_all = ["name", "problem"], requires_all = ["q", "p"], allow_hyphen_values = true)]
    pub(crate) potential: Option<String>,
    /// Coordinates of --potential at t = 0: x=0.4,y=0
    #[arg(
        long,
        value_name = "NAME=VALUE,…",
        value_delimiter = ',',
        requires = "potential",
        allow_hyphen_values = true
    )]
    pub(crate) q: Vec<String>,
    /// Momenta of --potential: 0,2 or px=0,py=2
    ///
    /// They are those at t = 0, in the order of the coordinates, or with names in any order.
    #[arg(
        long,
        value_name = "[NAME=]VALUE,…",
        value_delimiter = ',',
        requires = "potential",
        allow_hyphen_values = true
    )]
    pub(crate) p: Vec<String>,
    /// Masses of the coordinates [default: all are 1]
    #[arg(long, value_name = "VALUE,…", value_delimiter = ',', requires = "potential", allow_hyphen_values = true)]
    pub(crate) masses: Vec<String>,
}

impl SystemArguments {
    /// The name of a shipped problem or the path of a scene.
    pub(crate) fn problem(&self) -> Option<&String> {
        self.name.as_ref().or(self.problem.as_ref())
    }
}

/// The usage of a command with [`RunArguments`], in two lines.
pub(crate) fn usage(command: &str) -> String {
    format!(
        "shadowstep {command} [OPTIONS] [PROBLEM|SCENE]\n           --scheme <NAME|FILE,…> --step <H,…> --until <T>"
    )
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OrderChoice {
    Auto,
    Fixed(u32),
}

/// The words that a flag accepts, each with its help.
pub(crate) fn words(names: &'static [&'static str], help: &'static [&'static str]) -> PossibleValuesParser {
    names.iter().zip(help).map(|(name, help)| PossibleValue::new(name).help(help)).collect::<Vec<_>>().into()
}

fn order(text: &str) -> Result<OrderChoice, String> {
    match text.parse() {
        _ if text == "auto" => Ok(OrderChoice::Auto),
        Ok(m) if (1..=HIGHEST_ORDER).contains(&m) => Ok(OrderChoice::Fixed(m)),
        _ => Err(format!("write a number from 1 to {HIGHEST_ORDER}, or auto")),
    }
}
