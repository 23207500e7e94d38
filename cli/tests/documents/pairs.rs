//! Random systems of pairs: sums over all, up to a cutoff, and chains.

use crate::maker::{Maker, System};
use crate::systems::{NESTED, QUADRATIC};

const PAIRS: [&str; 9] = [
    "-1/sqrt(r2)",
    "-g*m_i*m_j/sqrt(r2)",
    "-1/sqrt(r2 + 1/10)",
    "r2/2",
    "exp(-r2)",
    "1/r2^6 - 1/r2^3",
    "m_i*m_j*r2^2/9",
    "g*exp(-sqrt(r2))/sqrt(r2)",
    "(sqrt(r2) - 1)^2/2",
];

/// Those that are negative, for transformed time.
const ATTRACTIONS: [&str; 3] = ["-1/sqrt(r2)", "-g*m_i*m_j/sqrt(r2)", "-1/sqrt(r2 + 1/10)"];

const SPRINGS: [&str; 6] = ["d^2/2", "d^2/2 + d^3/12", "50*d^2 + d^4", "exp(-d) + d", "cos(d)", "g*d^2/2"];

impl Maker {
    pub(crate) fn pairs(&mut self) -> System {
        self.heading("[problem]");
        let mut pair = if self.has_time { self.one(&ATTRACTIONS) } else { self.one(&PAIRS) }.to_owned();
        let (count, dimensions) = (2 + self.below(4), 1 + self.below(3));
        let has_masses = pair.contains("m_i") || self.once_in(5);
        if has_masses && self.once_in(2) {
            self.key("bodies.count", count);
            self.text("bodies.m", "1 + i/32");
        } else if has_masses {
            let masses = self.masses(count);
            self.key("bodies.m", masses);
        } else {
            self.key("bodies", count);
        }
        if pair.contains("g*") {
            let value = if self.once_in(8) { self.number() } else { "1".to_owned() };
            self.key("parameters.g", value);
        }
        if self.once_in(5) && !self.has_time {
            pair += &format!(" + {}", self.one(&PAIRS[2..6]));
        }
        self.text("pair", &pair);
        self.key("dimensions", dimensions);
        let is_chain = self.once_in(6);
        if is_chain {
            self.maybe(
                1,
                "neighbours",
                if has_masses { &["\"free\"", "\"periodic\""] } else { &["\"free\"", "\"periodic\"", "\"fixed\""] },
            );
        }
        self.maybe(20, "parts", &["\"linear\"", "\"kinetic-potential\""]);
        match self.below(5) {
            _ if is_chain && !self.once_in(12) => {}
            0 => self.maybe(1, "cutoff", &["2", "\"5/2\"", "0.9"]),
            1 => {
                self.maybe(1, "cutoff.at", &["2", "\"5/2\""]);
                self.maybe(1, "cutoff.from", &["1", "\"3/2\""]);
                self.maybe(1, "cutoff.derivatives", &["1", "3", "8"]);
            }
            _ => {}
        }
        let has_cutoff = self.mentions("cutoff");
        if has_cutoff && self.once_in(2) {
            let side = if self.once_in(2) {
                "5".to_owned()
            } else {
                format!("[{}]", ["5", "\"11/2\"", "6"][..dimensions].join(", "))
            };
            self.key("box", side);
        }
        let has_slow = self.once_in(if self.has_time { 40 } else { 8 });
        if has_slow && !is_chain {
            self.maybe(1, "slow", &["\"-1/sqrt(r2 + 1)\"", "\"1/(4 + r2)\""]);
        }
        self.masses_of_bodies(has_masses, count);
        self.bodies_at(count, dimensions);
        let names = |momentum: &str| -> Vec<String> {
            let axes = ["x", "y", "z"];
            if dimensions == 1 {
                let axis = if momentum.is_empty() { "q" } else { "p" };
                return (1..=count).map(|body| format!("{axis}{body}")).collect();
            }
            (1..=count)
                .flat_map(|body| axes[..dimensions].iter().map(move |axis| format!("{momentum}{axis}{body}")))
                .collect()
        };
        let schemes: &[&str] = if has_slow { &NESTED } else { &QUADRATIC };
        System { coordinates: names(""), momenta: names("p"), step: "1/50", schemes, ..System::default() }
    }

    fn masses_of_bodies(&mut self, has_masses: bool, count: usize) {
        match self.below(4) {
            0 if has_masses => self.text("masses", "m"),
            1 => {
                let masses = self.masses(count);
                self.key("masses", masses);
            }
            _ => {}
        }
    }

    /// Bodies on a lattice with small displacements.
    fn bodies_at(&mut self, count: usize, dimensions: usize) {
        self.heading("[initial]");
        let mut list = |scale: usize| {
            let mut place = |body: usize, axis: usize| {
                let lattice = scale * if axis == 0 { body } else { body * body % (axis + 2) };
                format!("\"{lattice} + {}/40\"", self.below(9))
            };
            let bodies: Vec<String> = (0..count)
                .map(|body| {
                    let places: Vec<String> = (0..dimensions).map(|axis| place(body, axis)).collect();
                    if dimensions == 1 { places[0].clone() } else { format!("[{}]", places.join(", ")) }
                })
                .collect();
            format!("[{}]", bodies.join(", "))
        };
        let (q, p) = (list(1), list(0));
        self.key("q", q);
        let momentum = self.one(&["p", "v"]);
        self.key(momentum, p);
    }

    pub(crate) fn chain(&mut self) -> System {
        self.heading("[problem]");
        let (pair, count) = (self.one(&SPRINGS), 2 + self.below(5));
        self.text("pair", pair);
        self.key("bodies", count);
        if pair.contains("g*") {
            let value = if self.once_in(8) { self.number() } else { "1".to_owned() };
            self.key("parameters.g", value);
        }
        self.maybe(2, "neighbours", &["\"free\"", "\"fixed\"", "\"periodic\""]);
        self.maybe(4, "parts", &["\"linear\"", "\"kinetic-potential\""]);
        self.maybe(10, "dimensions", &["1"]);
        let has_slow = self.once_in(6);
        if has_slow {
            self.maybe(1, "slow", &["\"1/(4 + d^2)\"", "\"q1^4/4\""]);
        }
        self.heading("[initial]");
        self.text("q", "sin(i*pi/6)");
        let momenta = self.numbers(count);
        self.key("p", momenta);
        let names = |name: &str| (1..=count).map(|body| format!("{name}{body}")).collect();
        let schemes: &[&str] = if has_slow { &NESTED } else { &QUADRATIC };
        System { coordinates: names("q"), momenta: names("p"), step: "1/20", schemes, ..System::default() }
    }
}
