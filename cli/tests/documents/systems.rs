//! Random systems: the sections \[problem\], \[initial\] and \[time\]; those of bodies and pairs are beside.

use shadowstep::problems::{PROBLEMS, Problem};

use crate::maker::{Maker, System};

/// Schemes for every T(p), also with more parts.
pub(crate) const GENERAL: [&str; 9] = [
    "stormer-verlet",
    "yoshida4",
    "symplectic-euler",
    "ruth3",
    "blanes-moan-s6",
    "suzuki4",
    "blanes6-7",
    "escorihuela4-6",
    "own-scheme.toml",
];

/// Schemes for three parts and more.
pub(crate) const MANY_PARTS: [&str; 6] =
    ["stormer-verlet", "yoshida4", "symplectic-euler", "ruth3", "blanes-moan-s6", "own-scheme.toml"];

/// Schemes for quadratic T, with gradient kicks, and processed.
pub(crate) const QUADRATIC: [&str; 10] = [
    "stormer-verlet",
    "blanes-moan-srkn6b",
    "chin-4a",
    "takahashi-imada",
    "bcm-rkn4-2",
    "wisdom-kernel-3",
    "omelyan-4mn3f1gp",
    "escorihuela6-8",
    "yoshida4",
    "own-scheme.toml",
];

/// Schemes for slow forces, fast ones and T.
pub(crate) const NESTED: [&str; 3] = ["r-respa-4", "r-respa-8", "nested-s6"];

const NAMES: [&[&str]; 5] = [&["x"], &["x", "y"], &["x", "y", "z"], &["u", "v"], &["theta"]];

/// Names that have another meaning somewhere.
const TAKEN: [&[&str]; 5] = [&["n"], &["t", "x"], &["energy"], &["E"], &["h", "total"]];

pub(crate) const POTENTIALS: [&str; 24] = [
    "A*X^2/2",
    "X^2/2",
    "X^4/4",
    "cos(X)",
    "-exp(-X^2 - Y^2)",
    "-1/sqrt(X^2 + Y^2 + 1/10)",
    "-A/sqrt(X^2 + Y^2)",
    "X^2*Y",
    "Y^3/3",
    "log(2 + X^2)",
    "A*X*Y",
    "sqrt(1 + X^2)",
    "X",
    "3",
    "sin(X - Y)^2",
    "atan(X)",
    "tanh(X)^2",
    "cosh(X)",
    "50*X^2",
    "X^2*Y^2/4",
    "1/X",
    "0*X",
    "(X^2 + Y^2)^(3/2)",
    "A^2*X^2*exp(Y)/9",
];

/// Those that are negative, for transformed time.
const NEGATIVE: [&str; 4] = ["-1/sqrt(X^2 + Y^2)", "-A^2/sqrt(X^2 + Y^2)", "-exp(-X^2)", "-1/sqrt(1 + X^2)"];

const DRIVEN: [&str; 4] = ["X*sin(t)/2", "cos(X - t)", "exp(-t/5)*X^2", "t"];

const KINETICS: [&str; 8] =
    ["P^2/2 + R^2/2", "P^2/3 + P*R/4", "sqrt(1 + P^2 + R^2)", "P^4/4", "A*P^2/2", "cosh(P)", "P", "-P^2/2"];

const PARTS: [&str; 14] = [
    "(P^2 + R^2)/2",
    "Y*P - X*R",
    "-1/sqrt(X^2 + Y^2 + A^2)",
    "(X^2 + P^2)/2 + (X^2 + P^2)^2/8",
    "-P*R",
    "-X*Y",
    "cos(X) + cos(Y)",
    "X*P",
    "P^2/X^2/2",
    "X^2*P^2/8",
    "A*X^4/4",
    "X*sin(t)",
    "exp(-t)*P^2/2",
    "X^2*P",
];

const HAMILTONIANS: [&str; 6] =
    ["(X^2 + 1)*(P^2 + A)/2", "P^2/2/(1 + X^2)", "sqrt(1 + P^2 + X^2*R^2)", "X*P", "cos(X)*cos(P)", "(X^2 + P^2)^2"];

impl Maker {
    /// A system of any kind.
    pub(crate) fn system(&mut self) -> System {
        type Kind = fn(&mut Maker) -> System;
        let separable: [Kind; 5] = [Maker::shipped, Maker::formula, Maker::formula, Maker::pairs, Maker::bodies];
        let others: [Kind; 5] = [Maker::bodies, Maker::parts, Maker::not_separable, Maker::magnetic, Maker::chain];
        self.has_time = self.once_in(if self.names.contains(&"x0") { 60 } else { 8 });
        let has_other = if self.has_time { self.once_in(12) } else { self.once_in(2) };
        let kind = if has_other { self.one(&others) } else { self.one(&separable) };
        let mut system = kind(self);
        if self.has_time {
            system.schemes = &MANY_PARTS;
            self.heading("[time]");
            let transform = self.one(&["logarithmic", "power"]);
            self.text("transform", transform);
            if (transform == "power") != self.once_in(20) {
                let exponent = self.one(&["\"-1/2\"", "\"1/3\"", "2", "-3", "\"3/32\""]);
                self.key("exponent", exponent);
            }
        }
        system
    }

    fn shipped(&mut self) -> System {
        let problem = if self.has_time && !self.once_in(8) { Problem::Kepler } else { self.one(PROBLEMS) };
        let (description, name) = (problem.description(), problem.name());
        self.heading("[problem]");
        self.text("name", name);
        let has_planets = matches!(name, "outer-solar-system" | "figure-eight");
        let parts: &[&str] = if has_planets {
            &["\"wisdom-holman\"", "\"wisdom-holman-heliocentric\"", "\"kinetic-potential\""]
        } else {
            &["\"linear\"", "\"kinetic-potential\""]
        };
        self.maybe(if self.has_time { 20 } else { 3 }, "parts", parts);
        for parameter in description.parameters {
            if self.once_in(4) {
                let close = format!("\"({})*101/100\"", parameter.default);
                let value = if self.once_in(8) { self.number() } else { close };
                self.key(&format!("parameters.{}", parameter.name), value);
            }
        }
        let initial = (description.initial)();
        if initial.positions.len() <= 4 && self.once_in(4) {
            self.initial(initial.positions.len(), &["q", "p"]);
        }
        let names = |of: &[(String, String)]| of.iter().take(4).map(|(name, _)| name.clone()).collect();
        let bodies = if has_planets { vec!["1".to_owned(), "2".to_owned()] } else { Vec::new() };
        let (coordinates, momenta) = (names(&initial.positions), names(&initial.momenta));
        System { coordinates, momenta, bodies, step: description.step, schemes: &QUADRATIC, ..System::default() }
    }

    /// Coordinates and parameters of formulas, with their keys.
    fn names(&mut self, names: &[&[&str]]) -> System {
        let names = if self.once_in(30) { self.one(&TAKEN) } else { self.one(names) };
        let quoted = |names: &[String]| format!("[\"{}\"]", names.join("\", \""));
        let coordinates: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        self.key("coordinates", quoted(&coordinates));
        let momenta = if self.once_in(6) {
            let momenta: Vec<String> = (1..=names.len()).map(|number| format!("P{number}")).collect();
            self.key("momenta", quoted(&momenta));
            momenta
        } else {
            names.iter().map(|name| format!("p{name}")).collect()
        };
        let parameters: Vec<String> = ["a", "b", "E"][..self.below(3)].iter().map(|name| (*name).to_owned()).collect();
        System { coordinates, momenta, parameters, step: "1/10", schemes: &GENERAL, ..System::default() }
    }

    /// The values of the parameters that formulas have; there are no others.
    fn parameters(&mut self, system: &mut System) {
        let used = |name: &String| self.mentions(name);
        system.parameters = system.parameters.iter().filter(|name| used(name)).cloned().collect();
        for name in &system.parameters {
            let value =
                if self.once_in(8) { self.number() } else { self.one(&["1", "\"1/3\"", "2", "0.7"]).to_owned() };
            self.key(&format!("parameters.{name}"), value);
        }
    }

    fn formula(&mut self) -> System {
        self.heading("[problem]");
        let mut system = self.names(&NAMES);
        let mut potential = if self.has_time { self.sum(&NEGATIVE, &system) } else { self.sum(&POTENTIALS, &system) };
        if self.once_in(if self.has_time { 20 } else { 6 }) {
            potential = format!("{potential} + {}", self.sum(&DRIVEN, &system));
        }
        self.text("potential", &potential);
        let rare = if self.has_time { 4 } else { 1 };
        self.maybe(8 * rare, "parts", &["\"linear\"", "\"kinetic-potential\""]);
        if self.once_in(10 * rare) {
            let slow = self.sum(&POTENTIALS, &system);
            self.text("slow", &slow);
            system.schemes = &NESTED;
        }
        let has_kinetic = self.once_in(4 * rare);
        if has_kinetic {
            let kinetic = self.sum(&KINETICS, &system);
            let kinetic = if self.once_in(8) { format!("exp(-t/3)*({kinetic})") } else { kinetic };
            self.text("kinetic", &kinetic);
        } else if self.once_in(3) {
            let masses = self.masses(system.coordinates.len());
            self.key("masses", masses);
        }
        if !has_kinetic && system.schemes.len() == GENERAL.len() && self.once_in(2) {
            system.schemes = &QUADRATIC;
        }
        self.parameters(&mut system);
        self.initial(system.coordinates.len(), if has_kinetic { &["q", "p"] } else { &["q", "v"] });
        system
    }

    /// Masses are positive, but for a few.
    pub(crate) fn masses(&mut self, count: usize) -> String {
        let masses: Vec<&str> = (0..count)
            .map(|_| if self.once_in(40) { "0" } else { self.one(&["1", "2", "\"1/100\"", "\"sqrt(3)\""]) })
            .collect();
        format!("[{}]", masses.join(", "))
    }

    /// The section \[initial\], with all keys.
    fn initial(&mut self, dimension: usize, keys: &[&str]) {
        self.heading("[initial]");
        for key in keys {
            let numbers = self.numbers(dimension);
            self.key(key, numbers);
        }
    }

    fn parts(&mut self) -> System {
        self.heading("[problem]");
        let mut system = self.names(&NAMES);
        let parts: Vec<String> = (0..2 + self.below(3))
            .map(|_| {
                let template = self.one(&PARTS);
                format!("\"{}\"", self.filled(template, &system))
            })
            .collect();
        self.key("parts", format!("[{}]", parts.join(", ")));
        self.parameters(&mut system);
        self.initial(system.coordinates.len(), &["q", "p"]);
        System { step: "1/50", schemes: &MANY_PARTS, ..system }
    }

    fn not_separable(&mut self) -> System {
        self.heading("[problem]");
        let mut system = self.names(&NAMES);
        let hamiltonian = self.sum(&HAMILTONIANS, &system);
        self.text("hamiltonian", &hamiltonian);
        let coupling = if self.once_in(20) { "0" } else { self.one(&["5", "\"20\"", "1"]) };
        self.key("coupling", coupling);
        self.parameters(&mut system);
        self.initial(system.coordinates.len(), &["q", "p"]);
        System { step: "1/50", schemes: &MANY_PARTS, ..system }
    }

    fn magnetic(&mut self) -> System {
        self.heading("[problem]");
        let mut system = self.names(&NAMES[1..4]);
        let potential = self.sum(&POTENTIALS, &system);
        self.text("potential", &potential);
        let dimension = system.coordinates.len();
        let constant = self.once_in(2);
        let field: Vec<String> = (0..dimension)
            .map(|place| {
                let (next, sign) = (&system.coordinates[(place + 1) % dimension], if place == 0 { "-" } else { "" });
                let template = if constant { "N/2" } else { self.one(&["N^3/12", "cos(t)*N/2", "sin(N)", "0", "N/3"]) };
                format!("\"{sign}{}\"", template.replace('N', next))
            })
            .collect();
        self.key("vector_potential", format!("[{}]", field.join(", ")));
        if self.once_in(3) {
            let masses = self.masses(dimension);
            self.key("masses", masses);
        }
        self.parameters(&mut system);
        let velocity = self.one(&["p", "v"]);
        self.initial(dimension, &["q", velocity]);
        System { schemes: &MANY_PARTS, ..system }
    }
}
