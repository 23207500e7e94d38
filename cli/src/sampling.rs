//! `shadowstep sampling`: schemes for Hamiltonian Monte Carlo, on a Gaussian target.

use std::path::Path;

use clap::Args;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use shadowstep::tables::shipped_names;
use shadowstep_analysis::gaussian::Gaussian;
use shadowstep_scenes::Error;
use shadowstep_scenes::library;
use shadowstep_scenes::sampling::{SamplingRecord, SamplingTarget, Wanted, is_suited};
use shadowstep_schemes::document::read_text;
use shadowstep_schemes::symbolic::decimal::significant;

use crate::output::Output;
use crate::quantity::{number, whole};
use crate::readable::{rounded, table, wrapped};
use crate::report::{self, Status};

const EXAMPLES: &str = "\
Examples:
  shadowstep sampling
  shadowstep sampling bcss3 mine.toml --dimension 1000 --acceptance 0.8
  shadowstep sampling --frequencies 1/3,1,2.5 --time 4";

const MORE: &str = "\
H = p^2/2 + U with a Gaussian exp(-U) is a sum of oscillators: along a direction with standard deviation σ, ω = 1/σ. \
Its results are exact; other targets have other errors. docs/sampling.md describes them.";

/// Schemes for Hamiltonian Monte Carlo on a Gaussian.
///
/// Of each scheme: step, error of the energy, acceptance and cost.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// Shipped schemes, such as bcss3, or files of tables
    ///
    /// The default is all shipped schemes that are symmetric and not processed.
    #[arg(value_name = "NAME|FILE")]
    schemes: Vec<String>,
    /// A Gaussian with the frequencies 1/D, 2/D, …, 1
    ///
    /// D is its dimension.
    #[arg(long, value_name = "D", default_value_t = 100, value_parser = |text: &str| whole(text, 1..=1_000_000))]
    dimension: u32,
    /// A Gaussian with these frequencies: 1/3,1,2.5 or a file
    ///
    /// They are numbers with commas, or a file of numbers.
    #[arg(long, value_name = "Ω,…|FILE", conflicts_with = "dimension")]
    frequencies: Option<String>,
    /// The length of trajectories [default: a quarter of the longest period]
    #[arg(long, value_name = "TIME")]
    time: Option<String>,
    /// The acceptance, such as 0.65 [default: that of the least cost]
    #[arg(long, value_name = "RATE")]
    acceptance: Option<String>,
    /// The number of steps of a trajectory
    ///
    /// Without this flag, a number of steps is sought that gives the acceptance.
    #[arg(long, value_name = "N", conflicts_with = "acceptance", value_parser = |text: &str| whole(text, 1..=1_000_000_000))]
    steps: Option<u32>,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
}

/// Computes the proposals of each scheme and lists them, the least cost first.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let target = target(arguments)?;
    let mut records = records(arguments, &target)?;
    records.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let text = || format!("{}\n{}", table_of(&records), legend(&target));
    Output::stdout().records_or_text(arguments.json, &records, text)?;
    Ok(Status::Success)
}

fn target(arguments: &Arguments) -> Result<SamplingTarget, Error> {
    let given = |flag: &str, text: &Option<String>| text.as_ref().map(|text| double(flag, text)).transpose();
    let gaussian = match &arguments.frequencies {
        None => Gaussian::spread(arguments.dimension),
        Some(text) => Gaussian::new(frequencies(text)?)
            .map_err(|error| Error::usage(format!("--frequencies {text}: {error}"), "write --frequencies 1,2.5"))?,
    };
    let condition = match (arguments.steps, given("--acceptance", &arguments.acceptance)?) {
        (Some(steps), _) => Wanted::Steps(steps.into()),
        (None, Some(rate)) => Wanted::Acceptance(rate),
        (None, None) => Wanted::LeastCost,
    };
    SamplingTarget::new(gaussian, given("--time", &arguments.time)?, condition)
}

fn double(flag: &str, text: &str) -> Result<f64, Error> {
    Ok(number(flag, text)?.to_f64().unwrap_or(f64::NAN))
}

/// The numbers of a list, or of a file with blanks, commas and lines between them.
fn frequencies(text: &str) -> Result<Vec<f64>, Error> {
    const LARGEST: u64 = 1 << 26;
    let path = Path::new(text);
    if !path.exists() {
        let number = |part: &str| {
            double("--frequencies", part.trim()).map_err(|_| {
                let message = format!("--frequencies {text}: `{part}` is not a number, and there is no file `{text}`");
                Error::usage(message, "write numbers with commas, such as 1/3,1,2.5, or the name of a file of numbers")
            })
        };
        return text.split(',').map(number).collect();
    }
    let content = read_text(path, LARGEST)
        .map_err(|error| Error::usage(format!("{text} cannot be read: {error}"), "name a file of numbers"))?;
    let mut numbers = Vec::new();
    for (line, content) in content.lines().enumerate() {
        for word in content.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty()) {
            numbers.push(word.parse().map_err(|_| {
                let column = content[..word.as_ptr() as usize - content.as_ptr() as usize].chars().count() + 1;
                let message = format!("{text}:{}:{column}: `{word}` is not a number", line + 1);
                Error::usage(message, "write numbers with blanks, commas or lines between them")
            })?);
        }
    }
    Ok(numbers)
}

/// The schemes that are named, or all that are suited.
fn records(arguments: &Arguments, target: &SamplingTarget) -> Result<Vec<SamplingRecord>, Error> {
    if arguments.schemes.is_empty() {
        let all: Vec<_> = shipped_names().into_iter().map(library::scheme).collect::<Result<_, _>>()?;
        return all.par_iter().filter(|named| is_suited(named)).map(|named| target.record(named)).collect();
    }
    let named: Vec<_> = arguments.schemes.iter().map(|word| library::scheme(word)).collect::<Result<_, _>>()?;
    named.iter().filter_map(library::NamedScheme::note).for_each(|note| report::note(&note));
    named.iter().map(|named| target.record(named)).collect()
}

fn table_of(records: &[SamplingRecord]) -> String {
    let header = ["order", "step", "steps", "gradi-\nents", "error", "any\nlength", "accept-\nance", "cost", "scheme"];
    let row = |record: &SamplingRecord| {
        [
            record.order.to_string(),
            significant(record.step, 4),
            record.steps.to_string(),
            record.gradients.to_string(),
            format!("{:.2e}", record.error),
            format!("{:.2e}", record.largest_error),
            significant(record.acceptance, 3),
            significant(record.cost, 4),
            record.scheme.clone(),
        ]
    };
    table(header, records.iter().map(row).collect(), 0..8)
}

fn legend(target: &SamplingTarget) -> String {
    let frequencies = target.gaussian().frequencies();
    let slowest = frequencies.iter().copied().fold(f64::INFINITY, f64::min);
    let [slowest, fastest, time] =
        [slowest, target.gaussian().fastest(), target.time()].map(|value| rounded(&value.to_string(), 6));
    let of = match frequencies.len() {
        1 => format!("one oscillator of frequency {slowest}"),
        many => format!("{many} oscillators with frequencies from {slowest} to {fastest}"),
    };
    let chosen = match target.wanted() {
        Wanted::LeastCost => "The number of steps has the least cost.".to_owned(),
        Wanted::Acceptance(rate) => format!("The least number of steps with an acceptance of at least {rate}."),
        Wanted::Steps(_) => String::new(),
    };
    let text = format!(
        "Trajectories of length {time} of {of}. {chosen}\nerror: the mean of ΔH in equilibrium, in units of the \
         temperature; any length: its maximum over all numbers of such steps; cost: gradients per accepted \
         trajectory, Hessian–vector products of gradient kicks counted as such."
    );
    wrapped(&text, "")
}
