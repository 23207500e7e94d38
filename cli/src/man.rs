//! `shadowstep man`: the help of all commands as pages of `man`.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use shadowstep_scenes::{Error, not_written};

use crate::invocation;
use crate::report::Status;

const EXAMPLE: &str = "\
Example:
  shadowstep man --out ~/.local/share/man/man1 && man shadowstep-drift";

/// Writes the pages of man: shadowstep.1, and one of each command.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The folder of the pages
    ///
    /// It is made if it is missing. Pages that are there are replaced.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Writes the pages.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let out = &arguments.out;
    fs::create_dir_all(out)
        .and_then(|()| clap_mangen::generate_to(invocation::commands(), out))
        .map_err(|error| not_written(out, error, "run it again"))?;
    Ok(Status::Success)
}
