//! Random sweeps: axes, what is kept, pictures.

use crate::document::{File, NAME};
use crate::maker::{Maker, System};
use crate::schema::kept_values;

/// The names of axes, which are those in the explanation of the keys: a list of numbers, words, a range, random draws.
const AXES: [&str; 4] = ["e", "scheme", "h", "phase"];

impl Maker {
    /// A sweep that is computed and collected.
    pub(crate) fn sweep(&mut self) {
        let mut axes = self.some(&AXES);
        if !axes.contains(&"h") && !axes.contains(&"scheme") {
            axes.push("h");
        }
        self.names = axes.iter().copied().filter(|axis| ["e", "phase"].contains(axis)).collect();
        let system = self.system();
        let has = |axis: &str| axes.contains(&axis);
        self.run(&system, has("scheme").then_some("$scheme"), has("h").then_some("h"));
        if self.once_in(2) {
            self.output(&system, false);
        }
        // an axis that nothing uses is refused
        axes.retain(|axis| ["h", "scheme"].contains(axis) || self.used.contains(axis) || self.once_in(40));
        let has = |axis: &str| axes.contains(&axis);
        let mut top = Vec::new();
        if self.once_in(3) {
            let scene = std::mem::take(&mut self.document.files[0].lines);
            self.document.files.push(File { name: "scene.toml".to_owned(), lines: scene });
            top.push("scene = \"scene.toml\"".to_owned());
        }
        // axes of two values
        if has("e") && has("scheme") && self.once_in(2) {
            top.push("zip = [[\"e\", \"scheme\"]]".to_owned());
        }
        self.document.files[0].lines.splice(0..0, top);
        self.heading("[axes]");
        for axis in &axes {
            self.axis(axis, &system);
        }
        let values = self.keep(&system);
        if self.once_in(2) {
            self.picture(&axes, &values);
        }
        let format = self.one(&["", "", " --format parquet"]);
        let commands = [format!("sweep {NAME} --out out{format}"), format!("collect out{format}")];
        self.document.commands = if self.once_in(4) { commands.to_vec() } else { commands[..1].to_vec() };
    }

    fn axis(&mut self, name: &str, system: &System) {
        let step = system.step;
        let value = match name {
            "e" => self.one(&["[\"1/3\", 0.5]", "[0, 1]", "[0.25, \"1/2\"]"]).to_owned(),
            "scheme" => {
                let [first, second] = [self.one(system.schemes), self.one(system.schemes)]
                    .map(|name| name.replace("own-scheme.toml", "ruth3"));
                format!("[\"{first}\", \"{second}\"]")
            }
            "h" => self
                .one(&[
                    "[\"H\", \"(H)/2\"]",
                    "\"H ... (H)/4 in 3 values\"",
                    "\"H … (H)/4 in 2 steps of 1/h\"",
                    "\"H … (H)/4 in 3 values of log(h)\"",
                ])
                .replace('H', step),
            _ => {
                let draws = self.one(&["uniform = [0, \"1/2\"]", "log = [\"1/10\", 1]", "normal = [1, 0.1]"]);
                format!("{{ draws = 3, {draws}, seed = 1 }}")
            }
        };
        self.key(name, value);
    }

    /// The section \[keep\]; the values of runs.
    fn keep(&mut self, system: &System) -> Vec<String> {
        self.heading("[keep]");
        let needs_estimates = |value: &String| ["drift", "permanent"].iter().any(|need| value.starts_with(need));
        let may_have_all = self.mentions("modified_energy") || self.once_in(20);
        let values: Vec<String> =
            kept_values().into_iter().filter(|value| may_have_all || !needs_estimates(value)).collect();
        let values = self.some(&values);
        let values = if self.once_in(2) { values } else { values[..1].to_vec() };
        self.key("values", format!("[\"{}\"]", values.join("\", \"")));
        self.maybe(3, "state", &["true", "false"]);
        self.maybe(if self.mentions("output") { 5 } else { 80 }, "rows", &["true", "false"]);
        for key in ["at_end", "min", "max"] {
            if self.once_in(4) {
                let formula = self.column(system);
                self.text(&format!("{key}.{key}_1"), &formula);
            }
        }
        if self.once_in(4) {
            let template = self.one(&["X > 1/2", "X*P < 0", "E > 1000", "t > 1"]);
            let condition = self.filled(template, system);
            self.text("first_time.escape", &condition);
            self.maybe(2, "stop", &["[\"escape\"]"]);
        }
        values
    }

    /// The section \[picture\].
    fn picture(&mut self, axes: &[&str], values: &[String]) {
        self.heading("[picture]");
        let fitting = [("x", "h"), ("y", "e"), ("curves", "scheme"), ("panels", "scheme")];
        for (key, fits) in fitting {
            if self.once_in(4) {
                let axis = if axes.contains(&fits) && !self.once_in(4) { fits } else { self.one(axes) };
                self.text(key, axis);
            }
        }
        if self.once_in(3) {
            let value = if self.once_in(12) { "drift".to_owned() } else { self.one(values) };
            self.text("value", &value);
        }
        self.maybe(3, "of_several", &["\"mean\"", "\"largest\"", "\"least\""]);
        self.maybe(3, "scale", &["\"linear\"", "\"log\""]);
        self.maybe(5, "range", &["[1, 100]", "[0, 1]", "[1e-12, 1]"]);
        self.maybe(5, "title", &["\"Errors\"", "\"<&>\"", "\"a: b\""]);
        self.maybe(5, "label", &["\"|H - H(0)|\"", "\"µ\""]);
    }
}
