//! `shadowstep work-precision`: what each scheme pays for an error on a problem, from its stability limit down to
//! round-off.

mod table;

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use shadowstep_scenes::library::{NamedScheme, scheme_from};
use shadowstep_scenes::propagator::for_system;
use shadowstep_scenes::steps::MOST_STEPS;
use shadowstep_scenes::{Error, System};
use shadowstep_schemes::symbolic::nearest;
use shadowstep_studies::work_precision::files::{Title, write, written};
use shadowstep_studies::work_precision::length::counts;
use shadowstep_studies::work_precision::schemes::Group;
use shadowstep_studies::work_precision::series::StepRange;
use shadowstep_studies::work_precision::study::Request;

use crate::headings::{OUTPUT, SCHEMES};
use crate::invocation;
use crate::output::Output;
use crate::posed::{PosedArguments, PosedProblem, fitted};
use crate::quantity;
use crate::report::{self, Status};
use crate::terminal::{Terminal, study_in};
use table::readable;

const EXAMPLES: &str = "\
Examples:
  shadowstep work-precision kepler --until 100 --out kepler
  shadowstep work-precision mine.toml --schemes +mine-4.toml --out mine
  shadowstep work-precision henon-heiles --until 100 --schemes all --out all";

const MORE: &str = "  \
  shadowstep work-precision --potential \"x^4/4\" --q x=1 --p 0 --until 50 \\
      --digits 40 --out quartic

DIR gets work-precision.csv and work-precision.jsonl, charts as SVG, report.html, and plot.py, which draws the CSV as \
PDF by Matplotlib (PGF with xelatex).

Results are saved in DIR/results.jsonl one by one. After Ctrl-C (exit code 3) the same command computes only what is missing.

Errors of positions are |q - q_ref|. The reference q_ref is the exact flow where it is known, else a run of a scheme \
of order 10 with more digits, whose \
own error is estimated. Times are those of the bare steps of tables that are read at run time, in one thread.";

/// Speed against error: what each scheme pays for an error.
///
/// The schemes run one problem, from their stability limit down to round-off.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n{MORE}"))]
pub(crate) struct Arguments {
    #[command(flatten)]
    posed: PosedArguments,
    /// Shipped or custom schemes, such as +mine.toml [default: a dozen]
    ///
    /// Custom schemes are files of tables; +mine.toml adds one to the default schemes. `all` are those of the catalogue
    /// that are valid for the kinetic energy, as the default ones are. `near-integrable` are those with orders for A +
    /// εB.
    #[arg(long, value_name = "NAME|FILE,…", value_delimiter = ',', help_heading = SCHEMES)]
    schemes: Vec<String>,
    /// Exact step sizes, such as 1/10,1/20 [default: a range for each scheme]
    ///
    /// The end time must be a multiple of each. In transformed time they are any steps of s. The default range goes
    /// from the stability limit down to round-off, at equal numbers of evaluations for all schemes.
    #[arg(long, aliases = ["h", "dt"], value_name = "H,…", value_delimiter = ',', allow_hyphen_values = true, help_heading = SCHEMES)]
    step: Vec<String>,
    /// Numbers of steps in place of sizes: 100,200,400
    #[arg(long, value_name = "N,…", value_delimiter = ',', allow_hyphen_values = true, conflicts_with = "step", help_heading = SCHEMES)]
    steps: Vec<String>,
    /// The time for the runs of a scheme
    ///
    /// It cannot be used with --step or --steps.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value = "2",
        value_parser = seconds,
        conflicts_with_all = ["step", "steps"],
        help_heading = SCHEMES,
    )]
    seconds: f64,
    /// The folder for charts, data and results
    #[arg(long, value_name = "DIR", help_heading = OUTPUT)]
    out: PathBuf,
    /// Replaces files in --out that are not from this program
    #[arg(long, help_heading = OUTPUT)]
    force: bool,
}

/// The reference may take this multiple of the time of a scheme.
const REFERENCE: f64 = 10.0;

/// Makes the runs, and writes charts and data.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let mut posed = PosedProblem::read(&arguments.posed)?;
    let schemes = schemes(&arguments.schemes, &posed)?;
    let range = range(arguments, &mut posed)?;
    let problem = posed.problem();
    let reference_time = Duration::from_secs_f64(REFERENCE * arguments.seconds);
    let study = |folder: &Path, terminal: &mut Terminal| {
        Request::new(problem, &schemes, range, reference_time, folder).study(terminal)
    };
    let (study, status) = study_in(Some(&arguments.out), arguments.force, written(), study)?;
    let (title, command) = (posed.title(), invocation::command());
    let title = Title { title: &title, hamiltonian: &posed.described.hamiltonian, command: &command };
    let report = write(&study, title, &arguments.out)?;
    Output::stdout().text(format_args!("{}{}\n", readable(&posed, &study), report.display()))?;
    Ok(status)
}

pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (1e-3..=1e6).contains(&seconds) => Ok(seconds),
        _ => Err("write a number of seconds from 0.001 to 1000000".to_owned()),
    }
}

/// The schemes, each once, that are valid for the system and have the digits of the runs, with steps that begin as
/// those of the scene.
pub(crate) fn schemes(words: &[String], posed: &PosedProblem) -> Result<Vec<NamedScheme>, Error> {
    let system = &posed.described.system;
    let mut schemes: Vec<NamedScheme> = Vec::new();
    let mut add = |scheme: NamedScheme| {
        if !schemes.iter().any(|other| other.name == scheme.name) {
            scheme.note().iter().for_each(report::note);
            schemes.push(scheme);
        }
    };
    if words.iter().all(|word| word.starts_with('+')) {
        Group::Default.schemes(system, posed.arithmetic, posed.first)?.into_iter().for_each(&mut add);
    }
    for word in words {
        let word = word.strip_prefix('+').unwrap_or(word);
        if word.trim().is_empty() {
            return Err(Error::usage("--schemes has an empty value", "write --schemes yoshida4,+mine.toml"));
        }
        match Group::of_word(word) {
            Some(group) => group.schemes(system, posed.arithmetic, posed.first)?.into_iter().for_each(&mut add),
            None => {
                let scheme =
                    scheme_from(word, Path::new(""), posed.first).map_err(|error| near_group(word, error.into()))?;
                add(valid(scheme, system, posed)?);
            }
        }
    }
    Ok(schemes)
}

/// An unknown scheme may be a misspelt group.
fn near_group(word: &str, error: Error) -> Error {
    match nearest(word, Group::NAMED.map(|(name, _)| name)) {
        Some(group) => {
            Error::usage(format!("there is no scheme `{word}`"), format!("did you mean the group `{group}`?"))
        }
        None => error,
    }
}

/// The scheme with steps for the system, whose weights have the digits of the runs.
fn valid(scheme: NamedScheme, system: &System, posed: &PosedProblem) -> Result<NamedScheme, Error> {
    fitted(for_system(scheme, system)?, posed.arithmetic)
}

/// The steps: those of a flag, or chosen for each scheme.
fn range(arguments: &Arguments, posed: &mut PosedProblem) -> Result<StepRange, Error> {
    let Arguments { step, steps, seconds, .. } = arguments;
    match (&step[..], &steps[..]) {
        ([], []) => Ok(StepRange::Automatic { seconds: *seconds, target: None }),
        ([], numbers) => {
            let mut counts =
                numbers.iter().map(|text| number_of_steps(text, numbers)).collect::<Result<Vec<_>, _>>()?;
            counts.sort_unstable();
            counts.dedup();
            Ok(StepRange::Given(counts))
        }
        (sizes, _) => {
            let sizes = sizes.iter().map(|text| quantity::step_size("--step", text)).collect::<Result<Vec<_>, _>>()?;
            Ok(StepRange::Given(counts(&sizes, &posed.until, posed.length.as_mut())?))
        }
    }
}

/// A number of steps, one of several.
fn number_of_steps(text: &str, all: &[String]) -> Result<u64, Error> {
    text.parse().ok().filter(|number| (1..=MOST_STEPS).contains(number)).ok_or_else(|| {
        let hint = format!("write step sizes with --step {}, numbers of steps such as --steps 100,200", all.join(","));
        Error::usage(format!("--steps {text} is not a number of steps from 1 to 1e10"), hint)
    })
}
