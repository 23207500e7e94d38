//! `shadowstep completions`: what shells complete.

use std::io::Write;

use clap::Args;
use clap_complete::Shell;
use shadowstep_scenes::Error;

use crate::invocation;
use crate::output::Output;
use crate::report::Status;

const EXAMPLE: &str = "\
Examples:
  shadowstep completions bash \\
      > ~/.local/share/bash-completion/completions/shadowstep
  shadowstep completions zsh > _shadowstep      # in a folder of $fpath
  shadowstep completions fish > ~/.config/fish/completions/shadowstep.fish";

/// Writes the script by which a shell completes commands.
///
/// It completes the commands and flags of this program.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The shell
    shell: Shell,
}

/// Writes the script to stdout.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut invocation::commands(), "shadowstep", &mut script);
    let mut output = Output::stdout();
    output.write_all(&script)?;
    output.finish()?;
    Ok(Status::Success)
}
