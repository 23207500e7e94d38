//! `shadowstep scene`: scenes to begin with, and what their keys mean.

use clap::Args;
use shadowstep::problems::PROBLEMS;
use shadowstep_scenes::{Error, SHIPPED_SCENES, scene_text};

use crate::output::Output;
use crate::readable::wrapped;
use crate::report::Status;

const EXAMPLE: &str = "\
Example:
  shadowstep scene kepler > scene.toml";

/// Writes a scene to begin with, or explains the keys of scenes.
///
/// The scene is that of a problem, or a shipped one. Without a name, all are listed.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The problem or shipped scene, such as kepler
    ///
    /// Shipped scenes have names such as eight-planets or pythagorean-70.
    name: Option<String>,
    /// Explains every key of a scene
    #[arg(long, conflicts_with = "name")]
    explain: bool,
    /// Writes the JSON Schema of scenes, for editors
    #[arg(long, conflicts_with_all = ["name", "explain"])]
    schema: bool,
}

/// Prints the scene of a problem, the names of all, or what the keys mean.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let text = match &arguments.name {
        _ if arguments.explain => shadowstep_scenes::explain(),
        _ if arguments.schema => shadowstep_scenes::scene_schema(),
        Some(name) => scene_text(name)?,
        None => list(),
    };
    Output::stdout().text(text)?;
    Ok(Status::Success)
}

fn list() -> String {
    let line = |name: &str, title: &str| format!("  {name:<20}  {title}\n");
    let problems = PROBLEMS.iter().map(|problem| problem.description());
    let names: String = problems.map(|problem| line(problem.name, problem.title)).collect();
    let shipped = SHIPPED_SCENES.iter().map(|(what, scenes)| {
        let lines: String = scenes.iter().map(|scene| line(scene.name, scene.title)).collect();
        format!("of {what}:\n{lines}")
    });
    let shipped: String = shipped.collect();
    let how = "`shadowstep scene kepler > scene.toml` writes one, `shadowstep run scene.toml` runs it, and \
               `shadowstep scene --explain` explains all keys.";
    format!("There is a scene for each of these problems:\n{names}{shipped}{}", wrapped(how, ""))
}
