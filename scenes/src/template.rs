//! A scene for each shipped problem, with what its keys mean.

use shadowstep::problems::Description;

use crate::keys;
use crate::readable::wrapped;

/// Lines of a scene; optional keys are commented out.
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

/// The text of a scene that runs a shipped problem, with the meanings of its keys as comments.
pub(crate) fn template(problem: &Description) -> String {
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
    lines.key("run", "digits", Some("\"double\""));
    lines.section("output");
    lines.key("output", "file", Some(&format!("\"{name}.csv\"")));
    lines.key("output", "energy", Some("{ every = 10 }"));
    lines.key("output", "modified_energy", Some("{ order = \"auto\", max_order = 100 }"));
    lines.key("output", "trajectory", None);
    lines.key("output", "checkpoint", Some("\"1 min\""));
    lines.0
}
