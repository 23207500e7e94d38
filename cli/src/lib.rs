//! `shadowstep`: the energy drift of splitting schemes, and the schemes themselves, from the command line.
//!
//! A command is a file with its flags, `Arguments`, and its function, `execute`. It is registered by its `mod` line and
//! its line of the list `commands!`.
//!
//! | module | what it is |
//! | --- | --- |
//! | `drift`, `trace` | runs of problems: one line a run, or one line a step |
//! | `run`, `scene` | runs that a file describes; such files |
//! | `schemes`, `problems` | what can be run |
//! | `modified` | the modified Hamiltonian of a scheme as a series and as a formula |
//! | `search` | new schemes, from stages and an order |
//! | `sampling` | schemes for Hamiltonian Monte Carlo |
//! | `emit` | schemes as code for other ecosystems |
//! | `work_precision`, `advise` | speed against error; a scheme and a step size for a tolerance |
//! | `chaos` | indicators of chaos along a run |
//! | `sweep`, `collect` | many runs of a scene; their results |
//! | `stability` | hard cases |
//! | `figures` | the figures of the paper, and additional ones |
//! | `completions`, `man` | what shells complete; pages of man |
//! | `headings`, `run_arguments`, `quantity` | the headings of help; the flags of runs; exact numbers |
//! | `selection`, `system`, `posed` | flags → schemes and steps; flags → the system; with end and number type |
//! | `plot` | charts of runs |
//! | `readable`, `output`, `progress`, `terminal` | tables, lines and bars |
//! | `invocation` | how the program was called |
//! | `report`, `colour`, `interrupt` | messages on stderr and the exit status; colours; Ctrl-C |

mod advise;
mod chaos;
mod collect;
mod completions;
mod drift;
mod emit;
mod figures;
mod man;
mod modified;
mod problems;
mod run;
mod sampling;
mod scene;
mod schemes;
mod search;
mod stability;
mod sweep;
mod trace;
mod work_precision;

mod colour;
mod headings;
mod interrupt;
mod invocation;
mod output;
mod plot;
mod posed;
mod progress;
mod quantity;
mod readable;
mod report;
mod run_arguments;
mod selection;
mod system;
mod terminal;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{CommandFactory, Parser, Subcommand};
use shadowstep_scenes::{Error, outside};

use report::Status;

/// Makes the enum of all commands from one list `Variant: module`.
macro_rules! commands {
    ($($Name:ident: $module:ident,)+) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($Name($module::Arguments),)+
        }

        impl Command {
            fn execute(&self) -> Result<Status, Error> {
                match self { $(Command::$Name(arguments) => $module::execute(arguments),)+ }
            }
        }
    };
}

commands! {
    Drift: drift,
    Trace: trace,
    Run: run,
    Scene: scene,
    Schemes: schemes,
    Modified: modified,
    Search: search,
    Sampling: sampling,
    Emit: emit,
    WorkPrecision: work_precision,
    Advise: advise,
    Chaos: chaos,
    Sweep: sweep,
    Collect: collect,
    Stability: stability,
    Figures: figures,
    Problems: problems,
    Completions: completions,
    Man: man,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  success
  1  negative answer: a checked table has faults, a table cannot be polished,
     no scheme meets a tolerance, no start of a search meets the conditions, a
     hard case differs from theory, chunks of a sweep are missing; with
     --strict, a verdict other than bounded and round-off
  2  usage error: an unknown flag, name or file, a number out of range, a
     fault in a scene
  3  a run failed: a state or an energy was not finite, the output could not
     be written, or it was interrupted";

/// The version, with the commit where `build.rs` knows it.
const VERSION: &str = env!("SHADOWSTEP_VERSION");

/// Splitting schemes and their modified energy, in any precision.
#[derive(Debug, Parser)]
#[command(name = "shadowstep", version = VERSION, max_term_width = 80, after_help = EXIT_CODES, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Lets scenes name files outside of their folders
    ///
    /// Without it, the files that a scene or a sweep names, to read or to write, lie in its own folder or below.
    #[arg(long, global = true, hide_short_help = true)]
    allow_outside: bool,
}

/// All commands with their flags and help.
pub fn commands() -> clap::Command {
    Arguments::command()
}

/// Runs the program with its arguments, of which the first is its name; gives its exit code. Wrong arguments, `--help`
/// and `--version` end the process. `program` is its path, for job scripts, where another program contains it.
pub fn main(arguments: impl IntoIterator<Item = OsString>, program: Option<PathBuf>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if completions::answer(&arguments, commands) {
        return Status::Success as u8;
    }
    invocation::keep(&arguments, program, commands);
    let Arguments { command, allow_outside } = Arguments::parse_from(arguments);
    if allow_outside {
        outside::allow_outside();
    }
    command.execute().unwrap_or_else(|error| report::error(&error)) as u8
}
