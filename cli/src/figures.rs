//! `shadowstep figures`: the figures of Moan and Niesen's paper, and additional ones.

use std::path::{Path, PathBuf};

use clap::Args;
use shadowstep_studies::Error;
use shadowstep_studies::figures::{Request, reproduce, written};

use crate::output::Output;
use crate::report::Status;
use crate::terminal::{Terminal, study_in};

const EXAMPLES: &str = "\
Examples:
  shadowstep figures --quick --out figures
  shadowstep figures kepler-schemes kepler-orders --out figures";

const MORE: &str = "\
Results are saved in DIR/results.jsonl one by one. After Ctrl-C (exit code 3) the same command computes only what is \
missing.

All cores are used, or the number in RAYON_NUM_THREADS; results do not depend on it. If figures are named, \
the report keeps the others whose results are in DIR already.";

/// Computes the figures of Moan and Niesen's paper, and others.
///
/// It writes charts, data and a report.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// Only these figures, such as kepler-schemes; all, if none is named
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// The folder for report, charts, data and results
    ///
    /// They are report.html, SVG and CSV files, and results.jsonl.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Coarser grids
    #[arg(long)]
    quick: bool,
    /// Replaces files in --out that are not from this program
    #[arg(long)]
    force: bool,
}

/// Computes what is missing, and writes charts, data and the report.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let Arguments { names, quick, out, force } = arguments;
    let study = |folder: &Path, terminal: &mut Terminal| {
        reproduce(&Request { names: names.clone(), quick: *quick, folder: folder.to_owned() }, terminal)
    };
    let (summary, status) = study_in(Some(out), *force, written(), study)?;
    Output::stdout().text(format_args!("{}\n{}\n", summary.report.display(), summary.verdicts))?;
    Ok(status)
}
