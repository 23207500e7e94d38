//! `shadowstep schemes`: the shipped schemes; everything about one; the proof of custom tables, and their digits.

mod analysis;
mod check;
mod columns;
mod from;
mod list;
mod plot;
mod polish;
mod prove;
mod record;
mod show;

use clap::{Args, Subcommand};

use crate::report::Status;
use shadowstep_scenes::Error;

const EXAMPLES: &str = "\
Examples:
  shadowstep schemes --order 4 --for quadratic --sort effective-error
  shadowstep schemes mine.toml --order 4";

/// Lists the shipped schemes; shows one; checks a custom table.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(flatten)]
    list: list::Arguments,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Show(show::Arguments),
    Check(check::Arguments),
    Polish(polish::Arguments),
    Prove(prove::Arguments),
}

/// Lists the schemes, or runs a subcommand.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    match &arguments.command {
        None => list::execute(&arguments.list),
        Some(Command::Show(arguments)) => show::execute(arguments),
        Some(Command::Check(arguments)) => check::execute(arguments),
        Some(Command::Polish(arguments)) => polish::execute(arguments),
        Some(Command::Prove(arguments)) => prove::execute(arguments),
    }
}
