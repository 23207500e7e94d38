//! The flags and their help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use shadowstep_schemes::polish::MOST_DIGITS as MOST_TABLE_DIGITS;
use shadowstep_schemes::proof::HIGHEST_ORDER;

use crate::arithmetic::{DEFAULT_DIGITS, MOST_DIGITS};
use crate::estimator::HIGHEST_ORDER as HIGHEST_ESTIMATOR_ORDER;

const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  the answer is no: a checked table has faults, a table cannot be polished
  2  wrong usage: an unknown flag, name or file, a number out of range, a fault in a scene
  3  a run failed: a state or an energy was not finite, the output could not be written, or it was interrupted";

const DRIFT_EXAMPLE: &str = "\
Example:
  shadowstep drift --problem kepler --set eccentricity=0.3 --scheme stormer-verlet,yoshida4 \\
      --step 1/10,1/20 --until 100 --digits 60 --order auto";

const FIGURES_EXAMPLE: &str = "\
Examples:
  shadowstep figures --quick --out figures
  shadowstep figures kepler-schemes kepler-orders --out figures
What is computed stays in DIR/results.jsonl: an interrupted run goes on where it stopped. All cores are used, or as many
as RAYON_NUM_THREADS says; results do not depend on that. Where only some figures are named, the report keeps those whose
results are in DIR already.";

const TRACE_EXAMPLE: &str = "\
Example:
  shadowstep trace --problem pendulum --scheme yoshida4 --step 1/10 --until 20 --digits 40 --csv > pendulum.csv

A line has n, t, energy, modified_energy, estimate and order: the m or k used. The estimate is of the error of modified_energy, and
of the right size also near close encounters. Where none can be relied on, with --order 1, it is empty, in JSON null.";

const LIST_EXAMPLE: &str = "\
Example:
  shadowstep schemes --order 4 --for quadratic --sort effective-error";

const CHECK_EXAMPLE: &str = "\
Example:
  shadowstep schemes check mine.toml";

const POLISH_EXAMPLE: &str = "\
Example:
  shadowstep schemes polish printed.toml --digits 300 --output polished.toml

Decimals that stand alone move, as constants or in the lists of weights; fractions and formulas stay as they are. If the
conditions leave some decimals free, these stay as printed, and the report on stderr names them.";

const RUN_EXAMPLE: &str = "\
Example:
  shadowstep scene kepler > scene.toml
  shadowstep run scene.toml

A run that was stopped goes on from its last checkpoint when its scene is run again.";

const SCENE_EXAMPLE: &str = "\
Example:
  shadowstep scene kepler > scene.toml";

/// Splitting schemes and their modified energy, in any precision.
#[derive(Debug, Parser)]
#[command(name = "shadowstep", version, after_help = EXIT_CODES, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// The drift of the modified energy: one run per scheme and step.
    #[command(after_help = DRIFT_EXAMPLE)]
    Drift(DriftArguments),
    /// Energy and modified energy at each step of one run.
    #[command(after_help = TRACE_EXAMPLE)]
    Trace(TraceArguments),
    /// Runs a scene: a file that says what is run and what is written.
    #[command(after_help = RUN_EXAMPLE)]
    Run(SceneRunArguments),
    /// Writes a scene to begin with; lists the problems that have one; explains the keys of scenes.
    #[command(after_help = SCENE_EXAMPLE)]
    Scene {
        /// The problem, such as kepler
        name: Option<String>,
        /// Says what every key of a scene means
        #[arg(long, conflicts_with = "name")]
        explain: bool,
    },
    /// Lists the schemes that come along; shows one; checks a table of yours.
    #[command(args_conflicts_with_subcommands = true, after_help = LIST_EXAMPLE)]
    Schemes {
        #[command(flatten)]
        list: ListArguments,
        #[command(subcommand)]
        command: Option<SchemesCommand>,
    },
    /// Computes the figures of Moan and Niesen's paper, and ours: pictures, data, and a report.
    #[command(after_help = FIGURES_EXAMPLE)]
    Figures(FiguresArguments),
    /// Lists the problems with their parameters and initial states.
    Problems {
        /// One problem only, such as kepler
        name: Option<String>,
        /// One JSON object a line
        #[arg(long)]
        json: bool,
    },
}

/// Which schemes are listed, and in which order.
#[derive(Debug, Args)]
pub(crate) struct ListArguments {
    /// Only schemes of this order, such as 6
    #[arg(long, value_name = "ORDER", value_parser = clap::value_parser!(u32).range(1..=i64::from(HIGHEST_ORDER)))]
    pub(crate) order: Option<u32>,
    /// Only schemes for these kinetic energies, with the orders and effective errors for them in --order and --sort
    #[arg(long = "for", value_name = "KINETIC")]
    pub(crate) kinetic: Option<KineticChoice>,
    /// What comes first
    #[arg(long, value_name = "KEY", default_value = "order")]
    pub(crate) sort: SortKey,
    /// One JSON object a line
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KineticChoice {
    /// Every T(p): schemes that need a quadratic one are left out
    Any,
    /// T = ½pᵀM⁻¹p: all schemes
    Quadratic,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SortKey {
    /// The lowest order, then the smallest effective error: it compares schemes of one order only
    EffectiveError,
    /// The largest stability limit
    Stability,
    /// The fewest force evaluations a step
    Evaluations,
    /// The alphabet
    Name,
    /// The lowest order, then the fewest force evaluations
    Order,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SchemesCommand {
    /// Everything that is known about a scheme.
    Show {
        /// A shipped scheme, such as yoshida4, or a table's file, such as mine.toml
        #[arg(value_name = "NAME|FILE")]
        name: String,
        /// One JSON object with every digit of the weights
        #[arg(long)]
        json: bool,
    },
    /// Proves what tables claim; exit code 1 if one has faults.
    #[command(after_help = CHECK_EXAMPLE)]
    Check {
        /// The tables
        #[arg(required = true, value_name = "FILE")]
        files: Vec<String>,
    },
    /// Solves a table's order conditions from its printed decimals, to many digits; exit code 1 if that cannot be.
    #[command(after_help = POLISH_EXAMPLE)]
    Polish(PolishArguments),
}

#[derive(Debug, Args)]
pub(crate) struct PolishArguments {
    /// The table
    #[arg(value_name = "FILE")]
    pub(crate) file: String,
    /// Decimal digits to which the conditions shall hold [default: as many as can be, at most 300]
    #[arg(long, value_name = "DIGITS", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_TABLE_DIGITS)))]
    pub(crate) digits: Option<u32>,
    /// Decimals that stay as printed: constants, or places such as kick[2], drift[3], gamma[1]
    #[arg(long, value_name = "NAME", num_args = 1.., value_delimiter = ',')]
    pub(crate) free: Vec<String>,
    /// The cubes of the kicks must sum to 0 too: kicks are themselves split, as in heliocentric coordinates
    #[arg(long)]
    pub(crate) split_kicks: bool,
    /// Writes to a file, such as polished.toml, under a temporary name until all is done
    #[arg(long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct DriftArguments {
    #[command(flatten)]
    pub(crate) run: RunArguments,
    /// Leaves out what the estimator shows on the exact flow, where that is known: it takes longer than a run in double precision
    #[arg(long)]
    pub(crate) no_control: bool,
    /// One JSON object per run, a line each, in place of the table
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct FiguresArguments {
    /// Only these figures, such as kepler-schemes; all, if none is named
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,
    /// The folder for report.html, SVG and CSV files, and for what is already computed
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// A thinned grid: every figure in less than a minute in all, on two cores
    #[arg(long)]
    pub(crate) quick: bool,
}

#[derive(Debug, Args)]
pub(crate) struct TraceArguments {
    #[command(flatten)]
    pub(crate) run: RunArguments,
    /// One JSON object per step, a line each (so it is without --csv)
    #[arg(long)]
    pub(crate) json: bool,
    /// CSV with a header
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    /// Positions and momenta too
    #[arg(long)]
    pub(crate) states: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SceneRunArguments {
    /// The scene's file, such as scene.toml
    #[arg(value_name = "FILE")]
    pub(crate) scene: String,
    /// Begins again where there is a checkpoint to go on from
    #[arg(long)]
    pub(crate) restart: bool,
}

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
    /// exact-flow is the solution itself, for harmonic-oscillator, pendulum and kepler: on it an estimator shows its own error
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
    #[arg(long, value_name = "NAME", default_value = "central")]
    pub(crate) estimator: EstimatorChoice,
    /// The m of the central differences D_m or the k of E_k, such as 40, or auto for the best one of each state
    #[arg(long, default_value = "auto", value_name = "M|K|auto", value_parser = order)]
    pub(crate) order: OrderChoice,
    /// The largest m or k that --order auto tries, such as 100 [default: 200 of m, 64 of k]
    #[arg(long, value_name = "M|K", value_parser = clap::value_parser!(u32).range(2..=i64::from(HIGHEST_ESTIMATOR_ORDER)))]
    pub(crate) max_order: Option<u32>,
    /// When --order auto stops trying m: at the largest, or early, where the errors rise [default: full]
    #[arg(long, value_name = "WHEN")]
    pub(crate) stop: Option<StopChoice>,
    /// Which m is the best for --order auto [default: least, by which the results of Moan & Niesen are found again]
    #[arg(long, value_name = "RULE")]
    pub(crate) rule: Option<RuleChoice>,
    /// The largest error wanted of --estimator bilinear --order auto, which takes the least k for it, such as 1e-20; the
    /// estimates tell where it is missed [default: the best that can be had]
    #[arg(long, value_name = "ERROR", allow_hyphen_values = true)]
    pub(crate) accuracy: Option<String>,
    /// Writes to a file, such as out.json, under a temporary name until all is done
    #[arg(long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OrderChoice {
    Auto,
    Fixed(u32),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum EstimatorChoice {
    /// Central differences D_m of the states: 2m + 1 of them, order 2m
    Central,
    /// Products of the states in pairs: E_k from k + 1 of them, order 2k; for an odd k between two states
    Bilinear,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StopChoice {
    Full,
    Early,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RuleChoice {
    /// That with the least term |T_m - T_(m-1)|
    Least,
    /// That with the least largest of ten terms about it, which none makes small by chance; on no orbit measured worse
    Robust,
}

fn order(text: &str) -> Result<OrderChoice, String> {
    match text.parse() {
        _ if text == "auto" => Ok(OrderChoice::Auto),
        Ok(m) if (1..=HIGHEST_ESTIMATOR_ORDER).contains(&m) => Ok(OrderChoice::Fixed(m)),
        _ => Err(format!("write a number from 1 to {HIGHEST_ESTIMATOR_ORDER}, or auto")),
    }
}
