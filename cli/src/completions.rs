//! `shadowstep completions`: what shells complete. Their scripts ask the program, which knows its names.

use std::env;
use std::ffi::{OsStr, OsString};
use std::io::Write;

use clap::builder::PossibleValuesParser;
use clap::{Arg, Args, Command};
use clap_complete::CompletionCandidate;
use clap_complete::engine::{ArgValueCompleter, PathCompleter, ValueCompleter};
use clap_complete::env::{CompleteEnv, Shells};
use shadowstep::problems::{PROBLEMS, problem};
use shadowstep_scenes::{Error, SHIPPED_SCENES};
use shadowstep_schemes::shipped_names;

use crate::output::Output;
use crate::report::Status;

const EXAMPLE: &str = "\
Examples:
  shadowstep completions bash \\
      > ~/.local/share/bash-completion/completions/shadowstep
  shadowstep completions zsh > _shadowstep      # in a folder of $fpath
  shadowstep completions fish > ~/.config/fish/completions/shadowstep.fish";

/// By this variable a script tells the program for which shell it completes.
const VARIABLE: &str = "SHADOWSTEP_COMPLETE";

const SHELLS: Shells<'_> = Shells::builtins();

/// Writes the script by which a shell completes commands.
///
/// It completes commands, flags, and the names of problems, scenes, schemes and charts, by calling `shadowstep`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The shell
    #[arg(value_parser = PossibleValuesParser::new(SHELLS.names()))]
    shell: String,
}

/// Writes the script to stdout.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let mut script = Vec::new();
    let shell = SHELLS.completer(&arguments.shell).expect("it is one of the shells");
    shell.write_registration(VARIABLE, "shadowstep", "shadowstep", "shadowstep", &mut script)?;
    if shell.name() == "zsh" {
        // the first time that a file of $fpath is called, it completes as well
        script.extend(b"\n[[ $funcstack[1] == _shadowstep ]] && _clap_dynamic_completer_shadowstep \"$@\"\n");
    }
    let mut output = Output::stdout();
    output.write_all(&script)?;
    output.finish()?;
    Ok(Status::Success)
}

/// Whether a script of a shell has called the program, which it answers then.
pub(crate) fn answer(arguments: &[OsString], commands: fn() -> Command) -> bool {
    env::var_os(VARIABLE).is_some()
        && CompleteEnv::with_factory(|| with_names(commands()))
            .var(VARIABLE)
            .try_complete(arguments, env::current_dir().ok().as_deref())
            .unwrap_or_else(|error| error.exit())
}

/// The command with the names that its arguments can have.
fn with_names(command: Command) -> Command {
    let of = command.get_name().to_owned();
    command.mut_args(|argument| names_of(&of, argument)).mut_subcommands(with_names)
}

fn names_of(command: &str, argument: Arg) -> Arg {
    let value = argument.get_value_names().and_then(|names| names.first()).map(ToString::to_string).unwrap_or_default();
    let (names, has_files): (fn() -> Vec<String>, bool) = match (command, argument.get_id().as_str()) {
        ("scene", "name") => (scenes, false),
        ("problems", "name") => (problems, false),
        (_, "problem") => (problems, true),
        _ if value == "PROBLEM|SCENE" => (problems, true),
        (_, "scheme" | "schemes") | ("show" | "prove", "name") => (schemes, true),
        (_, "plot_of") => (charts, false),
        _ => return argument,
    };
    argument.add(ArgValueCompleter::new(move |text: &OsStr| {
        let begin = text.to_string_lossy();
        let begun = names().into_iter().filter(|name| name.starts_with(&*begin)).map(CompletionCandidate::new);
        let files = if has_files { PathCompleter::file().complete(text) } else { Vec::new() };
        begun.chain(files).collect()
    }))
}

fn problems() -> Vec<String> {
    PROBLEMS.iter().map(|problem| problem.name().to_owned()).collect()
}

fn scenes() -> Vec<String> {
    let shipped = SHIPPED_SCENES.iter().flat_map(|(_, scenes)| scenes.iter()).map(|scene| scene.name.to_owned());
    problems().into_iter().chain(shipped).collect()
}

fn schemes() -> Vec<String> {
    shipped_names().into_iter().map(str::to_owned).collect()
}

/// The charts of the shipped problem that the command line names, or of any.
fn charts() -> Vec<String> {
    let problem = env::args().find_map(|word| problem(&word).ok());
    let positions = problem.map_or(Vec::new(), |problem| (problem.description().initial)().positions);
    let orbits = positions.windows(2).map(|pair| format!("orbit={}:{}", pair[0].0, pair[1].0));
    ["energies", "distance"].map(str::to_owned).into_iter().chain(orbits).collect()
}
