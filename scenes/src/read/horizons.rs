//! Tables of vectors of JPL's Horizons, in CSV: the position and velocity of a body at the first time.
//!
//! Source: <https://ssd.jpl.nasa.gov/horizons/manual.html>, "Vector table".

use shadowstep::{Rational, exact};
use shadowstep_schemes::document::{Text, read_text};

use super::elements::Vector;
use super::reader::Reader;

/// The most bytes of a table.
const LARGEST_FILE: u64 = 64 << 20;

/// The columns of position and velocity.
const COLUMNS: [&str; 6] = ["X", "Y", "Z", "VX", "VY", "VZ"];

/// The units of a table, in metres and seconds.
const UNITS: [(&str, &str, &str); 3] =
    [("AU-D", "149597870700", "86400"), ("KM-S", "1000", "1"), ("KM-D", "1000", "86400")];

/// The first vector of a table.
#[derive(Clone, Debug)]
pub(super) struct HorizonsVector {
    /// The body, for messages.
    target: String,
    /// What states of one system have in common, as the table has it: names and values.
    common: [(&'static str, String); 3],
    /// Position and velocity, in metres and seconds.
    state: [Vector; 2],
}

/// The units of a system in metres and seconds.
#[derive(Clone, Debug)]
pub(super) struct LengthAndTime {
    pub(super) length: Rational,
    pub(super) time: Rational,
}

impl HorizonsVector {
    /// The first vector of the file that a key names, relative to the folder of the scene; a fault has the line of the file.
    pub(super) fn open(reader: &mut Reader<'_>, name: &Text) -> Option<HorizonsVector> {
        let path = reader.toml.source.folder().join(&name.value);
        let text = match read_text(&path, LARGEST_FILE) {
            Ok(text) => text,
            Err(error) => {
                let message = format!("{} cannot be read: {error}", path.display());
                return reader.toml.wrong(&name.at, message, "give a table of vectors of JPL's Horizons in CSV");
            }
        };
        match HorizonsVector::read(&text) {
            Ok(vector) => {
                reader.files.push(text);
                Some(vector)
            }
            Err((line, message)) => {
                let help = "ask Horizons for EPHEM_TYPE=VECTORS, CSV_FORMAT=YES, VEC_TABLE=2";
                reader.toml.wrong(&name.at, format!("{}:{line}: {message}", path.display()), help)
            }
        }
    }

    fn read(text: &str) -> Result<HorizonsVector, (usize, String)> {
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        let last = lines.len().max(1);
        let begin = lines.iter().position(|line| *line == "$$SOE");
        let begin = begin.ok_or((last, "this file has no line $$SOE, which begins a table of Horizons".to_owned()))?;
        let value = |name: &str| {
            let found = lines[..begin].iter().find_map(|line| {
                let (key, value) = line.split_once(':')?;
                (key.trim() == name).then(|| value.split('{').next().unwrap_or(value).trim().to_owned())
            });
            found.ok_or_else(|| (begin + 1, format!("the head has no line `{name}`")))
        };
        let units = value("Output units")?;
        let place = |name: &str| lines.iter().position(|line| line.starts_with(name)).map_or(begin, |line| line) + 1;
        let (_, length, time) = UNITS.iter().find(|(name, ..)| *name == units).ok_or_else(|| {
            (place("Output units"), format!("the units are {units:?}, not AU-D, KM-S or KM-D of vectors"))
        })?;
        let output = value("Output type")?;
        if !output.starts_with("GEOMETRIC") {
            return Err((place("Output type"), format!("the vectors are {output:?}, not geometric")));
        }
        let row = lines.get(begin + 1).ok_or((last, "the table has no row".to_owned()))?;
        let header = lines[..begin].iter().rev().find(|line| line.starts_with("JDTDB,"));
        let header = header.ok_or((begin + 2, "this table is not CSV of vectors".to_owned()))?;
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let cells: Vec<&str> = row.split(',').map(str::trim).collect();
        let (length, time) = (number(length), number(time));
        let of = |column: &str| {
            let cell = names.iter().position(|name| *name == column).and_then(|place| cells.get(place));
            let cell = cell.ok_or_else(|| (begin + 2, format!("the table has no {column}")))?;
            let unit = if column.starts_with('V') { &length / &time } else { length.clone() };
            let value = exact(cell).map_err(|_| (begin + 2, format!("{column} is {cell:?}, which is not a number")))?;
            Ok::<_, (usize, String)>(value * unit)
        };
        let [x, y, z, vx, vy, vz] = COLUMNS.map(of);
        Ok(HorizonsVector {
            target: value("Target body name")?,
            common: [
                ("centre", value("Center body name")?),
                ("reference frame", value("Reference frame")?),
                ("epoch", cells[0].to_owned()),
            ],
            state: [[x?, y?, z?], [vx?, vy?, vz?]],
        })
    }

    /// Position and velocity in the units of a system.
    pub(super) fn in_units(&self, LengthAndTime { length, time }: &LengthAndTime) -> [Vec<Rational>; 2] {
        let [position, velocity] = &self.state;
        let speed = length / time;
        [position.iter().map(|x| x / length).collect(), velocity.iter().map(|v| v / &speed).collect()]
    }

    /// In what two tables differ that states of one system have in common.
    pub(super) fn differs(&self, other: &HorizonsVector) -> Option<String> {
        let differing = self.common.iter().zip(&other.common).find(|((_, one), (_, other))| one != other);
        differing.map(|((name, own), (_, theirs))| {
            format!("the {name} of {} is {theirs}, and that of {} {own}", other.target, self.target)
        })
    }
}

fn number(text: &str) -> Rational {
    exact(text).expect("units are exact numbers")
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use shadowstep::Number;
    use shadowstep::tables::Faults;

    use crate::{Error, Scene};

    /// As Horizons writes it, with other numbers.
    fn table(target: &str, centre: &str, units: &str, row: &str) -> String {
        format!(
            "*******\nTarget body name: {target}                     {{source: DE441}}\nCenter body name: {centre}   {{source: DE441}}\n\
             Start time      : A.D. 2000-Jan-01 12:00:00.0000 TDB\nOutput units    : {units}\nOutput type     : GEOMETRIC cartesian states\n\
             Output format   : 2 (position and velocity)\nReference frame : Ecliptic of J2000.0\n*******\n\
             \u{20}           JDTDB,            Calendar Date (TDB),       X,      Y,      Z,     VX,     VY,    VZ,\n*******\n$$SOE\n\
             2451545.000000000, A.D. 2000-Jan-01 12:00:00.0000, {row},\n2451546.000000000, later, 9, 9, 9, 9, 9, 9,\n$$EOE\n"
        )
    }

    const EARTH: &str = "-1.495978707E+08,  7.479893535E+07, 1.495978707E+05, 1.731456836805555E+01, 0.000000000000000E+00, -1.731456836805555E+00";

    fn scene(folder: &Path, problem: &str, earth: &str) -> Result<Scene, Vec<String>> {
        let path = folder.join("scene.toml");
        let text = format!(
            "[problem]\n{problem}\n[[body]]\nmass = 1\nhorizons = \"sun.txt\"\n[[body]]\nmass = 0.001\n{earth}\n\
             [run]\nscheme = \"yoshida4\"\nstep = 1\nsteps = 2\ndigits = \"double\"\n[output]\nfile = \"out.csv\"\nenergy = true\n"
        );
        fs::write(&path, text).unwrap();
        Scene::open(&path).map_err(|error| match error {
            Error::Faults(Faults(faults)) => {
                faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, fault.message)).collect()
            }
            other => panic!("{other}"),
        })
    }

    const UNITS: &str = "units = { length = \"AU\", time = \"day\", mass = \"solar\" }";

    #[test]
    fn states_are_those_of_the_first_row_in_the_units_of_the_scene() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("sun.txt"), table("Sun (10)", "Sun (10)", "AU-D", "0,0,0,0,0,0.5E-3")).unwrap();
        fs::write(folder.path().join("earth.txt"), table("Earth (399)", "Sun (10)", "KM-S", EARTH)).unwrap();
        let scene = scene(folder.path(), UNITS, "horizons = \"earth.txt\"").unwrap();
        let numbers = |values: &[shadowstep_symbolic::Exact]| {
            values.iter().map(|x| f64::from_rational(&x.value, &())).collect::<Vec<_>>()
        };
        assert_eq!(numbers(&scene.system.q), [0.0, 0.0, 0.0, -1.0, 0.5, 0.001]);
        let p = numbers(&scene.system.p);
        // 1731.4568… km/s are an astronomical unit a day
        assert!((p[2] - 5e-4).abs() < 1e-18 && (p[3] - 1e-5).abs() < 1e-17 && (p[5] + 1e-6).abs() < 1e-18, "{p:?}");
    }

    #[test]
    fn other_files_are_refused_with_their_line() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
        write("sun.txt", table("Sun (10)", "Sun (10)", "AU-D", "0,0,0,0,0,0"));
        let file = "horizons = \"earth.txt\"";
        for (problem, table, fault) in [
            (
                UNITS,
                table("Earth", "Solar System Barycenter (0)", "AU-D", EARTH),
                "8:12: the centre of Sun (10) is Sun (10), and that of Earth Solar System Barycenter (0)",
            ),
            (
                UNITS,
                table("Earth", "Sun (10)", "AU-D, deg", EARTH),
                "earth.txt:5: the units are \"AU-D, deg\", not AU-D, KM-S or KM-D of vectors",
            ),
            (UNITS, table("Earth", "Sun (10)", "AU-D", "1, x"), "earth.txt:13: Y is \"x\", which is not a number"),
            (UNITS, table("Earth", "Sun (10)", "AU-D", "1, 2"), "earth.txt:13: Z is \"\", which is not a number"),
            (UNITS, "notes".to_owned(), "earth.txt:1: this file has no line $$SOE, which begins a table of Horizons"),
            (
                UNITS,
                table("Earth", "Sun (10)", "AU-D", EARTH).replace("JDTDB,", "JDTDB"),
                "earth.txt:13: this table is not CSV of vectors",
            ),
            (
                UNITS,
                table("Earth", "Sun (10)", "AU-D", EARTH).replace("GEOMETRIC", "ASTROMETRIC"),
                "earth.txt:6: the vectors are \"ASTROMETRIC cartesian states\", not geometric",
            ),
            (
                "parameters = { g = 1 }",
                table("Earth", "Sun (10)", "AU-D", EARTH),
                "5:12: a table of Horizons requires units",
            ),
        ] {
            write("earth.txt", table);
            let faults = scene(folder.path(), problem, file).map(drop).unwrap_err();
            assert!(faults[0].ends_with(fault), "{faults:?} for {fault}");
        }
        for (earth, fault) in [
            ("horizons = \"mars.txt\"", "cannot be read"),
            ("horizons = \"earth.txt\"\na = 4", "8:12: this body has a table of Horizons and another state"),
        ] {
            let faults = scene(folder.path(), UNITS, earth).map(drop).unwrap_err();
            assert!(faults.iter().any(|found| found.contains(fault)), "{faults:?} for {fault}");
        }
    }

    /// The text of the scene is as before, but not what it means.
    #[test]
    fn a_changed_table_is_another_scene() {
        let folder = tempfile::tempdir().unwrap();
        let write = |x: &str| {
            fs::write(folder.path().join("sun.txt"), table("Sun (10)", "Sun (10)", "AU-D", &format!("{x},0,0,0,0,0")))
                .unwrap()
        };
        let run = || {
            scene(folder.path(), UNITS, "a = 1").unwrap().run_to_file(crate::FileOptions::default(), &mut ()).unwrap()
        };
        write("0");
        assert!(matches!(run(), crate::Outcome::Complete { .. }));
        assert_eq!(run(), crate::Outcome::AlreadyComplete);
        write("1");
        assert!(matches!(run(), crate::Outcome::Complete { .. }));
    }
}
