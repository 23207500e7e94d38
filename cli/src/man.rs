//! `shadowstep man`: the help of all commands as pages of `man`.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use clap_mangen::Man;
use shadowstep_scenes::{Error, WholeFile, not_written};

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
    fs::create_dir_all(out).map_err(|error| not_written(out, error, "run it again"))?;
    let mut program = invocation::commands().disable_help_subcommand(true);
    program.build();
    pages(&program, out)?;
    Ok(Status::Success)
}

/// The pages of the commands of a command, and its own.
fn pages(command: &clap::Command, out: &Path) -> Result<(), Error> {
    for command in command.get_subcommands().filter(|command| !command.is_hide_set()) {
        pages(command, out)?;
    }
    let page = Man::new(command.clone());
    let mut text = Vec::new();
    page.render(&mut text)?;
    let mut file = WholeFile::create(&out.join(page.get_filename()), "the page")?;
    file.write_all(&text)?;
    file.finish()
}
