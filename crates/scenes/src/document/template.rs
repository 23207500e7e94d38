//! A scene for each shipped problem, with what its keys mean.

use shadowstep::problems::Description;

use crate::document::keys::{INITIAL, OUTPUT, PROBLEM, RUN};
use crate::document::schema::Section;
use crate::texts::readable::wrapped;

/// Lines of a scene; optional keys are commented out.
struct Lines(String);

impl Lines {
    fn section(&mut self, section: &Section) {
        self.0 += &format!("\n{}\n", section.heading);
    }

    /// A key with what it means.
    fn key(&mut self, section: &Section, name: &str, value: Option<&str>) {
        let key = section.find(name).expect("only keys that there are");
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
    lines.section(&PROBLEM);
    lines.key(&PROBLEM, "name", Some(&format!("\"{name}\"")));
    for parameter in problem.parameters {
        lines.0 += &wrapped(&format!("{}: {}; {}.", parameter.name, parameter.meaning, parameter.range), "# ");
        lines.0 += &format!("parameters.{} = \"{}\"\n", parameter.name, parameter.default);
    }
    lines.section(&INITIAL);
    let initial = (problem.initial)();
    for (key, values) in [("q", initial.positions), ("p", initial.momenta)] {
        let texts: Vec<String> = values.iter().map(|(_, value)| format!("\"{value}\"")).collect();
        lines.key(&INITIAL, key, Some(&format!("[{}]", texts.join(", "))));
    }
    lines.section(&RUN);
    lines.key(&RUN, "scheme", Some("\"yoshida4\""));
    lines.key(&RUN, "step", Some(&format!("\"{}\"", problem.step)));
    lines.key(&RUN, "until", Some(&format!("\"{}\"", problem.until)));
    lines.key(&RUN, "digits", Some("\"double\""));
    lines.section(&OUTPUT);
    lines.key(&OUTPUT, "file", Some(&format!("\"{name}.csv\"")));
    lines.key(&OUTPUT, "energy", Some("{ every = 10 }"));
    lines.key(&OUTPUT, "modified_energy", Some("{ order = \"auto\", max_order = 100 }"));
    lines.key(&OUTPUT, "trajectory", None);
    lines.key(&OUTPUT, "checkpoint", Some("\"1 min\""));
    lines.0
}
