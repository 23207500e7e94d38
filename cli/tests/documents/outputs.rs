//! Random outputs of a system: the section \[output\].

use crate::maker::{Maker, System};

/// Formulas of columns and conditions.
pub(crate) const FORMULAS: [&str; 11] =
    ["X", "P*X", "E", "t", "X^2 + Y^2", "sqrt(1 + X^2)", "E - P^2/2", "A*X", "kinetic", "virial + X", "1/X"];

const OF_ORBITS: [&str; 7] =
    ["distance(B, C)", "e(C)", "a(C, B)", "i(C, jacobi)", "M(C, barycentre)", "node(C)", "pericentre(C, B) + X"];

impl Maker {
    /// A formula of a column.
    pub(crate) fn column(&mut self, system: &System) -> String {
        let [body, other] = [0, 1].map(|place| system.bodies.get(place).cloned());
        match (body, other) {
            (Some(body), Some(other)) if self.once_in(3) => {
                self.one(&OF_ORBITS).replace('B', &body).replace('C', &other).replace('X', &system.coordinates[0])
            }
            _ => {
                let mut template = self.one(&FORMULAS);
                let has_parts = self.mentions("potential") || self.mentions("pair") || self.once_in(20);
                while !has_parts && (template.contains("kinetic") || template.contains("virial")) {
                    template = self.one(&FORMULAS);
                }
                self.filled(template, system)
            }
        }
    }

    /// The section \[output\], with a file or without.
    pub(crate) fn output(&mut self, system: &System, is_ensemble: bool) {
        self.heading("[output]");
        let formats: &[&str] = if is_ensemble {
            &["csv"]
        } else if self.is_double {
            &["csv", "jsonl", "npy"]
        } else {
            &["csv", "jsonl"]
        };
        let format = if self.once_in(20) { "npy" } else { self.one(formats) };
        let has_file = is_ensemble || self.once_in(2);
        if has_file {
            self.text("file", &format!("out.{format}"));
            self.maybe(if is_ensemble { 30 } else { 3 }, "checkpoint", &["2", "\"1 min\"", "1", "\"2 s\"", "\"1 h\""]);
        }
        if self.once_in(12) {
            let format = if has_file { self.one(formats) } else { self.one(&["csv", "jsonl"]) };
            self.text("format", format);
        }
        let every = ["1", "2", "7"];
        if is_ensemble {
            self.key("energy", "true");
        } else {
            self.one_or_table("energy", 2, "true", &[("every", &every)]);
        }
        let has_section = self.trajectory(system, is_ensemble, &every);
        if !has_section || self.once_in(20) {
            self.modified_energy(is_ensemble, &every);
        }
        if !is_ensemble || self.once_in(20) {
            self.series(&every);
        }
        if !is_ensemble || self.once_in(20) {
            self.columns(system);
        }
        if !is_ensemble && self.once_in(6) {
            self.one_or_table("chaos", 1, "true", &[("every", &every)]);
        }
        let has_elements = !is_ensemble && !system.bodies.is_empty() && self.once_in(3);
        if has_elements || self.once_in(80) {
            let centres = ["\"heliocentric\"", "\"jacobi\"", "\"barycentric\""];
            self.one_or_table("elements", 1, "true", &[("every", &every), ("centre", &centres)]);
        }
        let summary = self.one(&["", "", "", "", "true", "false"]);
        if summary == "false" && !self.mentions("extremes") || summary == "true" {
            self.key("summary", summary);
        }
        self.maybe(if summary == "false" { 40 } else { 10 }, "windows", &["2000", "16", "256"]);
        if has_file && self.once_in(if is_ensemble { 40 } else { 5 }) {
            self.plot(system);
        }
    }

    /// Once in this number of times a key with this value, or a table with some of these keys.
    fn one_or_table(&mut self, name: &str, times: usize, value: &str, table: &[(&str, &[&str])]) {
        if !self.once_in(times) {
        } else if self.once_in(2) {
            self.key(name, value);
        } else {
            for (key, values) in self.some(table) {
                let value = self.one(values);
                self.key(&format!("{name}.{key}"), value);
            }
        }
    }

    fn modified_energy(&mut self, is_ensemble: bool, every: &[&str]) {
        match self.below(6) {
            _ if is_ensemble && !self.once_in(12) => self.maybe(2, "modified_energy.order", &["2", "4", "8"]),
            0 => self.key("modified_energy", "true"),
            1 | 2 => {
                self.maybe(2, "modified_energy.every", every);
                let estimator = self.one(&["bilinear", "central"]);
                self.text("modified_energy.estimator", estimator);
                if self.once_in(2) {
                    self.maybe(1, "modified_energy.order", &["2", "4", "8", "40"]);
                    self.maybe(20, "modified_energy.max_order", &["6"]);
                    self.maybe(20, "modified_energy.accuracy", &["1e-8"]);
                    return;
                }
                self.maybe(3, "modified_energy.order", &["\"auto\"", "\"auto\"", "\"auto\"", "1", "3"]);
                self.maybe(3, "modified_energy.max_order", &["6", "12", "100"]);
                if estimator == "central" {
                    self.maybe(4, "modified_energy.stop", &["\"full\"", "\"early\"", "\"printed\""]);
                    self.maybe(4, "modified_energy.rule", &["\"least\"", "\"robust\""]);
                } else {
                    self.maybe(4, "modified_energy.accuracy", &["1e-8", "1e-20"]);
                }
            }
            _ => {}
        }
    }

    /// The series of the modified Hamiltonian.
    fn series(&mut self, every: &[&str]) {
        if self.once_in(8) {
            let grade = if self.once_in(30) { "10" } else { self.one(&["2", "4", "3", "[2, 4]", "6", "[1, 2, 3]"]) };
            if self.once_in(2) {
                self.key("modified_hamiltonian", grade);
            } else {
                self.key("modified_hamiltonian.grade", grade);
                self.maybe(2, "modified_hamiltonian.every", every);
            }
        }
    }

    /// Positions and momenta, or those at a section: whether it is one.
    fn trajectory(&mut self, system: &System, is_ensemble: bool, every: &[&str]) -> bool {
        match self.below(5) {
            _ if is_ensemble && !self.once_in(20) => false,
            0..3 => {
                self.one_or_table("trajectory", 1, "true", &[("every", every)]);
                false
            }
            3 => {
                let template = self.one(&["X", "P", "X - Y", "X*P", "X^2 + Y^2 - 1", "A - X"]);
                let section = self.filled(template, system);
                self.text("trajectory.section", &section);
                self.maybe(2, "trajectory.direction", &["\"up\"", "\"down\"", "\"both\""]);
                true
            }
            _ => false,
        }
    }

    fn columns(&mut self, system: &System) {
        for (key, names) in [("values", ["r", "column", "energy_2"]), ("extremes", ["r", "least", "s"])] {
            if self.once_in(4) {
                for name in self.some(&names) {
                    let formula = self.column(system);
                    self.text(&format!("{key}.{name}"), &formula);
                }
                if key == "values" {
                    self.maybe(3, "values.every", &["1", "3"]);
                }
            }
        }
    }

    /// Charts, most of which have their columns.
    fn plot(&mut self, system: &System) {
        let has_states = self.mentions("trajectory") && !self.mentions("section");
        let mut charts = Vec::new();
        if self.mentions("energy") || self.once_in(20) {
            charts.push("energies".to_owned());
        }
        if has_states || self.once_in(20) {
            charts.extend([format!("orbit={}:{}", system.coordinates[0], system.momenta[0]), "distance".to_owned()]);
        }
        if has_states && !system.bodies.is_empty() || self.once_in(40) {
            charts.extend(["orbit=x:y", "distance=1:2", "distance=1"].map(str::to_owned));
        }
        if charts.is_empty() {
            return;
        }
        if charts[0] == "energies" && self.once_in(3) {
            self.text("plot", "out.svg");
            return;
        }
        self.text("plot.file", "out.svg");
        let charts = self.some(&charts);
        self.key("plot.of", format!("[\"{}\"]", charts.join("\", \"")));
    }
}
