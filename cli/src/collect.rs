//! `shadowstep collect`: the chunks of a sweep → a table and a picture.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use shadowstep_scenes::{Error, shell_word};
use shadowstep_studies::sweeps::{Collected, Missing, TableFormat, collect};

use crate::output::Output;
use crate::report::{self, Status};
use crate::terminal::Terminal;

const EXAMPLE: &str = "\
If chunks are missing, the exit code is 1, and their numbers are written to stdout as `sbatch --array=` takes them:
  sbatch --array=$(shadowstep collect DIR) SCRIPT";

/// Checks the chunks of a sweep; writes its table and picture.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The folder of `shadowstep sweep FILE --out DIR`
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The format of the table
    #[arg(long, value_enum, default_value_t = Format::Csv)]
    format: Format,
}

/// The format of a table.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Format {
    /// results.csv
    Csv,
    /// results.parquet
    #[cfg(feature = "parquet")]
    Parquet,
}

/// Collects the chunks.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let mut terminal = Terminal::listen("the same command collects the results");
    collected(&arguments.folder, arguments.format, &mut terminal)
}

/// Collects the chunks of a folder and writes the names of the files, or the numbers of the missing chunks.
pub(crate) fn collected(folder: &Path, format: Format, terminal: &mut Terminal) -> Result<Status, Error> {
    let format = match format {
        Format::Csv => TableFormat::Csv,
        #[cfg(feature = "parquet")]
        Format::Parquet => TableFormat::Parquet,
    };
    let mut output = Output::stdout();
    match collect(folder, format, terminal)? {
        Collected::Complete { files, runs, failed, notes } => {
            notes.iter().for_each(report::note);
            files.iter().try_for_each(|file| writeln!(output, "{}", file.display()))?;
            output.finish()?;
            let failures = if failed > 0 { format!(", {failed} of them failed") } else { String::new() };
            report::note(format_args!("{runs} runs{failures}"));
            Ok(Status::Success)
        }
        Collected::Incomplete { missing, removed } => {
            for file in removed {
                report::note(format_args!("{} is removed: chunks of it are missing now", file.display()));
            }
            writeln!(output, "{}", missing.list())?;
            output.finish()?;
            Ok(incomplete(folder, &missing))
        }
    }
}

fn incomplete(folder: &Path, missing: &Missing) -> Status {
    for (chunk, why) in &missing.unusable {
        report::note(format_args!("chunk {chunk} cannot be used: {why}"));
    }
    let (count, list) = (missing.chunks.len(), missing.list());
    let chunks = if count == 1 { "1 chunk is".to_owned() } else { format!("{count} chunks are") };
    let hint = format!("compute them: `shadowstep sweep FILE --out {}`, or with --chunk", shell_word(folder));
    report::negative_answer(format_args!("{chunks} missing or cannot be used: {list}"), hint)
}
