//! Random planetary systems: `[[body]]`.

use crate::document::File;
use crate::maker::{Maker, System};
use crate::systems::{GENERAL, QUADRATIC};

const BESIDE: [&str; 5] =
    ["m*z^2/20", "-3*(g*m0)^2*m/(100*r^2)", "g*m0*m/(50*r^3)*(3*z^2/r^2 - 1)", "m*(x^2 + y^2)/1000", "m*tide*x"];

/// The head of a table of vectors of Horizons, to its first row.
const HORIZONS: &str = "\
*******
Target body name: TARGET                     {source: DE441}
Center body name: Sun (10)   {source: DE441}
Start time      : A.D. 2000-Jan-01 12:00:00.0000 TDB
Output units    : AU-D
Output type     : GEOMETRIC cartesian states
Output format   : 2 (position and velocity)
Reference frame : Ecliptic of J2000.0
*******
            JDTDB,            Calendar Date (TDB),       X,      Y,      Z,     VX,     VY,    VZ,
*******
$$SOE
2451545.000000000, A.D. 2000-Jan-01 12:00:00.0000, ROW,
$$EOE
";

/// Units with a distance in them, and a step size for orbits of such distances.
const UNITS: [([&str; 3], &str, &str); 5] = [
    (["AU", "day", "solar"], "1", "5"),
    (["AU", "day", "solar"], "1", "5"),
    (["km", "s", "earth"], "10^4", "200"),
    (["m", "year", "jupiter"], "10^9", "1/2000"),
    (["AU", "year", "kg"], "1", "1/20"),
];

const PARTICLES: [&str; 4] = [
    "x,y,z,vx,vy,vz\n0.7,0.1,0,0,1.1,0.02\n1.7,0,0.2,0,0.7,0\n",
    "name,a,e,i,node,pericentre,M\npallas,0.7,0.1,3,10,20,30\njuno,2.7,0.2,5,0,1,200\n",
    "a,lambda\n0.6,20\n",
    "a,e,M\n-2,1.5,10\n",
];

impl Maker {
    pub(crate) fn bodies(&mut self) -> System {
        self.heading("[problem]");
        let has_units = self.once_in(4);
        let (units, unit_of_orbits, step) = self.one(&UNITS);
        if has_units {
            for (name, unit) in ["length", "time", "mass"].into_iter().zip(units) {
                self.text(&format!("units.{name}"), unit);
            }
        } else {
            self.key("parameters.g", "1");
        }
        let splits = ["kinetic-potential", "wisdom-holman", "wisdom-holman-heliocentric", "wisdom-holman-heliocentric"];
        let parts = if self.has_time { splits[0] } else { self.one(&splits) };
        self.text("parts", parts);
        if parts == "wisdom-holman-heliocentric" && self.once_in(2) {
            self.maybe(1, "encounters.within", &["0.3", "\"3/2\"", "1e-3"]);
            self.maybe(2, "encounters.substeps", &["1", "8"]);
        }
        self.maybe(4, "elements", &["\"heliocentric\"", "\"jacobi\""]);
        self.maybe(3, "barycentric", &["true", "false"]);
        let mut has_tide = false;
        for key in ["central", "external"] {
            if self.once_in(if parts.ends_with("heliocentric") { 40 } else { 3 }) {
                let formula = self.one(&BESIDE);
                self.text(key, formula);
                if formula.contains("tide") && !has_tide {
                    self.key("parameters.tide", "\"1/1000\"");
                    has_tide = true;
                }
            }
        }
        if self.once_in(if self.has_time { 40 } else { 5 }) {
            self.text("particles", "particles.csv");
            let table = self.one(&PARTICLES);
            self.document.files.push(File::new("particles.csv", table));
        }
        let bodies = self.planets(has_units.then_some(unit_of_orbits));
        let names = |momentum: &str| -> Vec<String> {
            let name = |axis: &str, body: &String| {
                let joint = if body.parse::<u32>().is_ok() { "" } else { "_" };
                format!("{momentum}{axis}{joint}{body}")
            };
            bodies.iter().flat_map(|body| ["x", "y", "z"].map(|axis| name(axis, body))).collect()
        };
        let (coordinates, momenta) = (names(""), names("p"));
        let schemes: &'static [&str] = match parts {
            "wisdom-holman" => {
                &["abah864", "wisdom-kernel-3", "saba2", "wisdom-corrector-3", "yoshida4", "stormer-verlet", "bcr764"]
            }
            "kinetic-potential" => &QUADRATIC,
            _ => &GENERAL,
        };
        let step = if has_units { step } else { "1/20" };
        System { coordinates, momenta, bodies, step, schemes, ..System::default() }
    }

    /// The sections of bodies; their names.
    fn planets(&mut self, unit: Option<&str>) -> Vec<String> {
        let (count, named) = (2 + self.below(4), self.once_in(2));
        let light = self.below(3).min(count - 2);
        let has_light = self.once_in(if self.has_time { 20 } else { 2 });
        let horizons = unit.is_some() && self.once_in(3);
        for body in 0..count {
            self.heading("[[body]]");
            if named {
                self.text("name", ["sun", "mars", "venus", "moon", "io"][body]);
            }
            match body {
                0 => self.key("mass", "1"),
                _ if has_light && body + light >= count => self.key("mass", "0"),
                _ => self.maybe(1, "mass", &["\"1/100\"", "1e-3", "\"1/3000\"", "1e-40"]),
            }
            if horizons {
                self.vectors(body);
            } else if body == 0 {
                if self.once_in(5) {
                    self.maybe(1, "q", &["[0, 0, 0]", "[1, 0, \"1/3\"]"]);
                    self.maybe(1, "v", &["[0, 0, 0]", "[0.1, 0, 0]"]);
                }
            } else {
                self.orbit(body, unit.unwrap_or("1"));
            }
        }
        let numbered = (1..=count).map(|body| body.to_string());
        if named {
            ["sun", "mars", "venus", "moon", "io"][..count].iter().map(|name| (*name).to_owned()).collect()
        } else {
            numbered.collect()
        }
    }

    fn vectors(&mut self, body: usize) {
        let file = format!("body-{body}.txt");
        self.text("horizons", &file);
        let (target, row) = match body {
            0 => ("Sun (10)".to_owned(), "0, 0, 0, 0, 0, 0".to_owned()),
            _ => (format!("Planet {body}"), format!("{body}, 0.1, 0, 0, 0.017, 0.001")),
        };
        self.document.files.push(File::new(&file, &HORIZONS.replace("TARGET", &target).replace("ROW", &row)));
    }

    fn orbit(&mut self, body: usize, unit: &str) {
        if unit == "1" && self.once_in(4) {
            self.key("q", format!("[{body}, 0, \"1/10\"]"));
            self.key("v", format!("[0, \"1/sqrt({body})\", 0]"));
            return;
        }
        if self.once_in(9) {
            self.text("a", &format!("-2*{unit}"));
            self.key("e", "1.5");
        } else {
            self.text("a", &format!("{body}*{unit}"));
            self.maybe(2, "e", &["0", "\"1/10\"", "0.99", "0.3"]);
        }
        self.maybe(3, "i", &["0", "5", "90", "180", "\"17/3\""]);
        self.maybe(4, "node", &["10", "-86"]);
        self.maybe(4, "pericentre", &["10", "200"]);
        let anomaly = self.one(&["M", "M", "lambda"]);
        self.maybe(2, anomaly, &["0", "20", "180", "359.5"]);
    }
}
