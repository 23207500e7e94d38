//! `shadowstep search`: from stages and an order to proved schemes that make an error, or another measure, least.

mod files;
mod rows;

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Deserialize, Serialize};
use shadowstep_analysis::polish::{MOST_POLISHED_DIGITS, NotPolished};
use shadowstep_analysis::search::{Candidate, Request, Search};
use shadowstep_scenes::Error;
use shadowstep_schemes::document::{LARGEST_TABLE, read_text};
use shadowstep_schemes::{Source, shipped};
use shadowstep_studies::files::write_file;
use shadowstep_studies::{Calculation, Continues, Store};

use crate::output::Output;
use crate::quantity::whole;
use crate::readable::table;
use crate::report::{self, Status};
use crate::terminal::{Terminal, study_in};
use rows::{Row, header, published, row};

const EXAMPLE: &str = "\
Example: rkn4.toml has
  order = 4
  kinetic = \"quadratic\"           # or \"any\"
  stages = [5, 6]                 # forces a step, or steps of `base`
  minimise = \"effective-error\"    # one measure, or several

This command writes rkn4-1.toml, rkn4-2.toml, …, the best first:
  shadowstep search rkn4.toml --out rkn4";

const MORE: &str = "\
Several measures are added with weights:
  minimise = { effective-error = 1, largest-weight = 0.1 \
}

Measures:
  effective-error
  instability              forces per unit of hω at the limit of \
stability
  phase-error
  sampling-error
  largest-weight
  negative-weights

Other keys:
  front = \
[\"effective-error\", \"instability\"]
                           in place of `minimise`: keeps the schemes that \
no
                           other surpasses in all of these measures
  name, base = \"stormer-verlet\", first = \
\"drift\", symmetric = false,
  gradient_kicks = true, near_integrable = [8, 4], largest_weight = 1,
  starts = 100, \
seed = 1, keep = 3
  processor = 6            stages of the post-map of a processed scheme, \
whose
                           order is the one after processing
  closed_gaps = 1          intervals of \
instability near hω = π, 2π, …

DIR gets the tables, search.csv with what each start found, search.svg with the \
shipped schemes beside them, and report.html. Starts are saved one by one in results.jsonl: after Ctrl-C (exit code \
3) the same command computes only what is missing.

The exit code is 1 if no start met the conditions.";

/// Searches for schemes of an order with the least error.
///
/// It finds weights that meet the order conditions and make an error, or another measure, least.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE, after_long_help = format!("{EXAMPLE}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// The file of the search, such as rkn4.toml
    ///
    /// It states what the schemes shall be, and what shall be small.
    #[arg(value_name = "FILE")]
    file: String,
    /// Random starts for each number of stages
    ///
    /// This number is used in place of the one in the file.
    #[arg(long, value_name = "N", value_parser = |text: &str| whole(text, 1..=1_000_000))]
    starts: Option<u32>,
    /// The seed of the random numbers
    ///
    /// This seed is used in place of the one in the file.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Decimal digits of the tables [default: up to 300]
    ///
    /// The default is as many as can be, at most 300.
    #[arg(long, value_name = "DIGITS", value_parser = |text: &str| whole(text, 20..=MOST_POLISHED_DIGITS))]
    digits: Option<u32>,
    /// The folder for tables, charts and results
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replaces files in --out that are not from this program
    #[arg(long)]
    force: bool,
}

/// Makes the starts that the folder lacks, writes the best tables, and what they are beside the shipped schemes.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let source = text(&arguments.file)?;
    let mut request = Request::read(&source)?;
    request.starts = arguments.starts.map_or(request.starts, |starts| starts as usize);
    request.seed = arguments.seed.unwrap_or(request.seed);
    let search = Search::new(request, &of_library)?;
    let written = files::written(&search.request.name);
    let starts = |folder: &Path, terminal: &mut Terminal| starts(&search, folder, terminal);
    let (candidates, status) = study_in(Some(&arguments.out), arguments.force, written, starts)?;
    let best = search.best(&candidates);
    if best.is_empty() {
        let message = format!("none of {} starts met the conditions", search.starts());
        return Ok(report::negative_answer(message, "give more stages or more starts, or a larger largest_weight"));
    }
    let mut rows = Vec::new();
    for (n, candidate) in (1..).zip(&best) {
        let name = format!("{}-{n}", search.request.name);
        match search.table(candidate, &name, arguments.digits, &of_library) {
            Ok(polished) => {
                write_file(&arguments.out, &format!("{name}.toml"), &polished.text)?;
                rows.push(Row { is_new: true, ..row(&search, name, &polished.proved) });
            }
            Err(NotPolished::Faults(faults)) => return Err(faults.into()),
            Err(error @ (NotPolished::Request { .. } | NotPolished::Unsolved { .. })) => {
                report::note(format_args!("{name} has no table: {error}"));
            }
        }
    }
    rows.extend(published(&search));
    let report = files::write(&search, &candidates, &rows, &arguments.out)?;
    let header = header(&search.request);
    let columns = header.len();
    let table = table(header, rows.iter().map(Row::cells).collect(), 1..columns);
    Output::stdout().text(format_args!("{table}\n{}\n", report.display()))?;
    Ok(status)
}

/// The text of the file of a search.
fn text(path: &str) -> Result<Source, Error> {
    let hint = "give the path of a file of a search: shadowstep search --help shows one";
    let text = read_text(path, LARGEST_TABLE).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Error::usage(format!("there is no file {path}"), hint),
        ErrorKind::InvalidData => Error::usage(format!("{path} is not a text in UTF-8"), hint),
        _ => Error::usage(format!("{path} cannot be read: {error}"), hint),
    })?;
    Ok(Source { path: path.to_owned(), text })
}

/// Bases are shipped: the tables are read in other folders too.
fn of_library(base: &str, _: &Source) -> Option<Source> {
    shipped(base)
}

/// What the starts found, those that met the conditions.
fn starts(search: &Search, folder: &Path, terminal: &mut Terminal) -> Result<Vec<Candidate>, Error> {
    let mut store = Store::open(folder, terminal)?;
    let form = form(&search.request);
    let all: Vec<_> = (0..search.starts()).map(|start| Start { form: &form, start, search }).collect();
    let outcomes = store.compute(&all, terminal)?.into_iter().enumerate();
    let candidate = |(start, candidate): (usize, Option<Option<Found>>)| {
        let Found { weights, values, goal } = candidate??;
        Some(Candidate { start, weights, values, goal })
    };
    Ok(outcomes.filter_map(candidate).collect())
}

/// What decides about what a start finds, as a text.
fn form(request: &Request) -> String {
    let Request { order, kinetic, stages, base, first, symmetric, gradient_kicks, near_integrable, .. } = request;
    let Request { processor, closed_gaps, largest_weight, goal, seed, starts, .. } = request;
    let scheme = (order, kinetic, base, first, symmetric, gradient_kicks, near_integrable, processor);
    format!("{scheme:?} {:?}", (stages, closed_gaps, largest_weight, goal, seed, starts))
}

/// A random start.
#[derive(Serialize)]
struct Start<'a> {
    form: &'a str,
    start: usize,
    #[serde(skip)]
    search: &'a Search,
}

/// Where it ended.
#[derive(Serialize, Deserialize)]
struct Found {
    weights: Vec<f64>,
    values: Vec<f64>,
    goal: f64,
}

impl Calculation for Start<'_> {
    type Outcome = Option<Found>;
    type Shared = ();

    fn cost(&self) -> f64 {
        (self.search.stages(self.start) as f64).powi(3)
    }

    fn compute(&self, (): &(), continues: Continues<'_>) -> Result<Option<Found>, Error> {
        let candidate = self.search.start_while(self.start, &|| continues(0.5));
        let is_finite = |candidate: &Candidate| {
            candidate.goal.is_finite() && candidate.values.iter().all(|value| value.is_finite())
        };
        Ok(candidate.filter(is_finite).map(|Candidate { weights, values, goal, .. }| Found { weights, values, goal }))
    }
}
