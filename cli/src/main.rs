//! `shadowstep`: the energy drift of splitting schemes, and the schemes themselves, from the command line.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`arguments`] | the flags and their help |
//! | [`quantity`], [`selection`] | exact numbers; arguments → problem, schemes and steps: the runs to make |
//! | [`drift`], [`trace`] | the runs: one line a run, or one line a step |
//! | [`scene`] | runs that a file describes |
//! | [`figures`] | the figures of the paper, and ours |
//! | [`schemes`], [`problems`] | what can be run |
//! | [`readable`], [`output`], [`progress`] | tables, lines and bars |
//! | [`complaint`], [`interrupt`] | messages on stderr and exit codes; Ctrl-C |

mod arguments;
mod complaint;
mod drift;
mod figures;
mod interrupt;
mod output;
mod problems;
mod progress;
mod quantity;
mod readable;
mod scene;
mod schemes;
mod selection;
mod trace;

use std::process::ExitCode;

use clap::Parser;

use arguments::{Arguments, Command, SchemesCommand};
use complaint::{Complaint, Ending, tell};
use shadowstep_scenes::{arithmetic, estimator, library, propagator, run, steps};

fn main() -> ExitCode {
    let ending = obey(&Arguments::parse().command).unwrap_or_else(|complaint| tell(&complaint));
    ExitCode::from(ending as u8)
}

fn obey(command: &Command) -> Result<Ending, Complaint> {
    match command {
        Command::Drift(arguments) => drift::drift(arguments),
        Command::Trace(arguments) => trace::trace(arguments),
        Command::Run(arguments) => scene::run(arguments),
        Command::Scene { explain: true, .. } => scene::explain(),
        Command::Scene { name, explain: false } => scene::template(name.as_deref()),
        Command::Figures(arguments) => figures::figures(arguments),
        Command::Problems { name, json } => problems::problems(name.as_deref(), *json),
        Command::Schemes { list, command: None } => schemes::list(list),
        Command::Schemes { command: Some(SchemesCommand::Show { name, json }), .. } => schemes::show(name, *json),
        Command::Schemes { command: Some(SchemesCommand::Check { files }), .. } => schemes::check(files),
        Command::Schemes { command: Some(SchemesCommand::Polish(arguments)), .. } => schemes::polish(arguments),
    }
}
