//! A scene for each shipped problem, with what its keys mean.

use std::io::Write;

use shadowstep::problems::{Description, PROBLEMS, problem};

use crate::complaint::{Complaint, Ending};
use crate::output::Output;
use crate::readable::wrapped;
use crate::scene::keys;

/// Prints the scene of a problem, or the names of all.
pub(crate) fn template(name: Option<&str>) -> Result<Ending, Complaint> {
    let text = match name {
        Some(name) => scene(problem(name)?.description()),
        None => list(),
    };
    let mut output = Output::open(None, "")?;
    write!(output, "{text}")?;
    output.finish()?;
    Ok(Ending::Done)
}

fn list() -> String {
    let line = |problem: &Description| format!("  {:<20}  {}\n", problem.name, problem.title);
    let names: String = PROBLEMS.iter().map(|problem| line(problem.description())).collect();
    format!(
        "There is a scene for each of these problems:\n{names}\
         `shadowstep scene kepler > scene.toml` writes one, `shadowstep run scene.toml` runs it, and \
         `shadowstep scene --explain` says what all keys mean.\n"
    )
}

/// Lines of a scene; values that hold anyway are commented out.
struct Lines(String);

impl Lines {
    fn section(&mut self, name: &str) {
        self.0 += &format!("\n[{name}]\n");
    }

    /// A key with what it means.
    fn key(&mut self, section: &str, name: &str, value: Option<&str>) {
        let key = keys::find(section, name).expect("only keys that there are");
        self.0 += &wrapped(key.meaning, "# ");
        self.0 += &match value {
            Some(value) => format!("{name} = {value}\n"),
            None => format!("# {name} = {}\n", key.example),
        };
    }
}

fn scene(problem: &Description) -> String {
    let Description { name, title, hamiltonian, source, .. } = problem;
    let mut lines = Lines(wrapped(&format!("{title}: H = {hamiltonian}"), "# "));
    lines.0 += &wrapped(&format!("Source: {source}"), "# ");
    lines.section("problem");
    lines.key("problem", "name", Some(&format!("\"{name}\"")));
    for parameter in problem.parameters {
        lines.0 += &wrapped(&format!("{}: {}; {}.", parameter.name, parameter.meaning, parameter.range), "# ");
        lines.0 += &format!("parameters.{} = \"{}\"\n", parameter.name, parameter.default);
    }
    lines.section("initial");
    let initial = (problem.initial)();
    for (key, values) in [("q", initial.positions), ("p", initial.momenta)] {
        let texts: Vec<String> = values.iter().map(|(_, value)| format!("\"{value}\"")).collect();
        lines.key("initial", key, Some(&format!("[{}]", texts.join(", "))));
    }
    lines.section("run");
    lines.key("run", "scheme", Some("\"yoshida4\""));
    lines.key("run", "step", Some(&format!("\"{}\"", problem.step)));
    lines.key("run", "until", Some(&format!("\"{}\"", problem.until)));
    lines.key("run", "digits", Some("120"));
    lines.section("output");
    lines.key("output", "file", Some(&format!("\"{name}.csv\"")));
    lines.key("output", "energy", Some("{ every = 10 }"));
    lines.key("output", "modified_energy", Some("{ order = \"auto\", max_order = 100 }"));
    lines.key("output", "trajectory", None);
    lines.key("output", "checkpoint", Some("\"1 min\""));
    lines.0
}
