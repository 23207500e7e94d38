//! Tables of vectors of JPL's Horizons, in CSV: the position and velocity of a body at the first time.
//!
//! Source: <https://ssd.jpl.nasa.gov/horizons/manual.html>, "Vector table".

use shadowstep::{Rational, exact};
use shadowstep_schemes::document::{Source, Text, read_text};

use super::elements::Vector;
use super::reader::Reader;
use super::units::LengthAndTime;
use crate::Note;

/// The most bytes of a table.
const LARGEST_FILE: u64 = 64 << 20;

/// The columns of position and velocity.
const COLUMNS: [&str; 6] = ["X", "Y", "Z", "VX", "VY", "VZ"];

/// Bodies that are not the Sun, whatever their mass.
const PLANETS: [&str; 10] =
    ["mercury", "venus", "earth", "moon", "mars", "jupiter", "saturn", "uranus", "neptune", "pluto"];

/// The units of a table.
const UNITS: [(&str, &str, &str); 3] = [("AU-D", "AU", "day"), ("KM-S", "km", "s"), ("KM-D", "km", "day")];

/// The first vector of a table.
#[derive(Clone, Debug)]
pub(super) struct HorizonsVector {
    /// The body, for messages.
    target: String,
    /// The body that is at rest at the origin, as the table has it.
    centre: String,
    /// What states of one system have in common, as the table has it: names and values.
    common: [(&'static str, String); 4],
    /// Position and velocity, in metres and seconds.
    state: [Vector; 2],
}

impl HorizonsVector {
    /// The first vector of the file that a key names, relative to the folder of the scene; a fault has the line of the
    /// file.
    pub(super) fn open(reader: &mut Reader<'_>, name: &Text) -> Option<HorizonsVector> {
        let path = reader.path(name)?;
        let text = match read_text(&path, LARGEST_FILE) {
            Ok(text) => text,
            Err(error) => {
                let message = format!("{} cannot be read: {error}", path.display());
                return reader.toml.wrong(&name.at, message, "give a table of vectors of JPL's Horizons in CSV");
            }
        };
        match HorizonsVector::read(&text) {
            Ok(vector) => {
                if let Some(forces) = forces_left_out(&text) {
                    let target = vector.target.clone();
                    reader.notes.push(Note::ForcesLeftOut { target, forces });
                }
                reader.files.push(Source { path: name.value.clone(), text });
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
        let given = |name: &str| {
            lines[..begin].iter().find_map(|line| {
                let (key, value) = line.split_once(':')?;
                (key.trim() == name).then(|| value.split('{').next().unwrap_or(value).trim().to_owned())
            })
        };
        let value = |name: &str| given(name).ok_or_else(|| (begin + 1, format!("the head has no line `{name}`")));
        let units = value("Output units")?;
        let place = |name: &str| lines.iter().position(|line| line.starts_with(name)).map_or(begin, |line| line) + 1;
        let (_, length, time) = UNITS.iter().find(|(name, ..)| *name == units).ok_or_else(|| {
            (place("Output units"), format!("the units are {units:?}, not AU-D, KM-S or KM-D of vectors"))
        })?;
        let output = value("Output type")?;
        if !output.starts_with("GEOMETRIC") {
            return Err((place("Output type"), format!("the vectors are {output:?}, not geometric")));
        }
        // states relative to a place on a body turn with it
        if let Some(site) = given("Center-site name").filter(|site| site != "BODY CENTER") {
            let message = format!("the states are relative to the site {site:?}, not to the centre of a body");
            return Err((place("Center-site name"), message));
        }
        let row = lines.get(begin + 1).ok_or((last, "the table has no row".to_owned()))?;
        let header = lines[..begin].iter().rev().find(|line| line.starts_with("JDTDB,"));
        let header = header.ok_or((begin + 2, "this table is not CSV of vectors".to_owned()))?;
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let cells: Vec<&str> = row.split(',').map(str::trim).collect();
        let LengthAndTime { length, time } =
            LengthAndTime::named(length, time).expect("the units are those of systems, too");
        let of = |column: &str| {
            let cell = names.iter().position(|name| *name == column).and_then(|place| cells.get(place));
            let cell = cell.ok_or_else(|| (begin + 2, format!("the table has no {column}")))?;
            let unit = if column.starts_with('V') { &length / &time } else { length.clone() };
            let value = exact(cell).map_err(|_| (begin + 2, format!("{column} is {cell:?}, which is not a number")))?;
            Ok::<_, (usize, String)>(value * unit)
        };
        let [x, y, z, vx, vy, vz] = COLUMNS.map(of);
        let centre = value("Center body name")?;
        Ok(HorizonsVector {
            target: value("Target body name")?,
            common: [
                ("centre", centre.clone()),
                ("reference frame", value("Reference frame")?),
                // tables of earlier versions have the frame in two lines
                ("coordinate system", given("Coordinate systm").unwrap_or_default()),
                ("epoch", cells[0].to_owned()),
            ],
            centre,
            state: [[x?, y?, z?], [vx?, vy?, vz?]],
        })
    }

    /// Position and velocity in the units of a system.
    pub(super) fn in_units(&self, LengthAndTime { length, time }: &LengthAndTime) -> [Vec<Rational>; 2] {
        let [position, velocity] = &self.state;
        let speed = length / time;
        [position.iter().map(|x| x / length).collect(), velocity.iter().map(|v| v / &speed).collect()]
    }

    /// The centre, if it is not the central body of this name: one that is not named after a planet can be the Sun, and
    /// no body is at a barycentre.
    pub(super) fn other_centre(&self, name: Option<&str>) -> Option<&str> {
        let centre = self.centre.split(" (").next().unwrap_or(&self.centre);
        let name = name.unwrap_or("sun").replace('_', " ").to_lowercase();
        let is_centre = name == centre.to_lowercase() || centre == "Sun" && !PLANETS.contains(&name.as_str());
        (!is_centre).then_some(&self.centre)
    }

    /// In what two tables differ that states of one system have in common.
    pub(super) fn differs(&self, other: &HorizonsVector) -> Option<String> {
        let differing = self.common.iter().zip(&other.common).find(|((_, one), (_, other))| one != other);
        differing.map(|((name, own), (_, theirs))| {
            format!("the {name} of {} is {theirs}, and that of {} {own}", other.target, self.target)
        })
    }
}

/// The forces besides gravity that the table's orbit has, as its head gives them: those of comets and asteroids.
fn forces_left_out(text: &str) -> Option<String> {
    let head = text.split("$$SOE").next()?;
    let after = head.to_ascii_lowercase().rfind("non-gravitational")?;
    // "A1= 1.0E-9  A2=-3.6E-11", beside other lines
    let numbers = head[after..].replace('=', " = ");
    let words: Vec<&str> = numbers.split_whitespace().collect();
    let found = words.windows(3).filter(|words| words[1] == "=" && ["AMRAT", "A1", "A2", "A3"].contains(&words[0]));
    let found = found.filter(|words| words[2].parse().is_ok_and(|value: f64| value != 0.0));
    let found: Vec<String> = found.map(|words| format!("{} = {}", words[0], words[2])).collect();
    (!found.is_empty()).then(|| found.join(", "))
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
            "*******\nTarget body name: {target}                     {{source: DE441}}\nCenter body name: {centre}   \
                {{source: DE441}}\n\
             Start time      : A.D. 2000-Jan-01 12:00:00.0000 TDB\nOutput units    : {units}\nOutput type     : \
             GEOMETRIC cartesian states\n\
             Output format   : 2 (position and velocity)\nReference frame : Ecliptic of J2000.0\n*******\n\
             \u{20}           JDTDB,            Calendar Date (TDB),       X,      Y,      Z,     VX,     VY,    \
             VZ,\n*******\n$$SOE\n\
             2451545.000000000, A.D. 2000-Jan-01 12:00:00.0000, {row},\n2451546.000000000, later, 9, 9, 9, 9, 9, \
             9,\n$$EOE\n"
        )
    }

    /// The heads that Horizons writes above vectors, of versions from 2012 on. Lines with a `?` say what the numbers are.
    const HEAD: &str = "\
= Ephemeris / API_USER Mon Nov  1 10:00:00 2026 Pasadena, USA      / Horizons
? Target body name: Earth (399)                     {source: DE441}
? Center body name: Sun (10)                        {source: DE441}
= Center-site name: BODY CENTER
= Start time      : A.D. 2000-Jan-01 12:00:00.0000 TDB
= Stop  time      : A.D. 2000-Jan-02 12:00:00.0000 TDB
= Step-size       : 1440 minutes
= Target pole/equ : ITRF93                          {East-longitude positive}
= Target radii    : 6378.137, 6378.137, 6356.752 km {Equator_a, b, pole_c}
= Target primary  : Sun
= Center geodetic : 0.0, 0.0, 0.0                   {E-lon(deg),Lat(deg),Alt(km)}
= Center cylindric: 0.0, 0.0, 0.0                   {E-lon(deg),Dxy(km),Dz(km)}
= Center pole/equ : ITRF93                          {East-longitude positive}
= Center radii    : 695700.0, 695700.0, 695700.0 km {Equator_a, b, pole_c}
= Small perturbers: Yes                             {source: SB441-N16}
= Small-body perts: Yes                             {source: SB431-N16}
? Output units    : AU-D
= Calendar mode   : Mixed Julian/Gregorian
? Output type     : GEOMETRIC cartesian states
= Output format   : 3 (position, velocity, LT, range, range-rate)
= EOP file        : eop.261030.p270126
= EOP coverage    : DATA-BASED 1962-JAN-20 TO 2026-OCT-30.
? Reference frame : Ecliptic of J2000.0
? Coordinate systm: Ecliptic and Mean Equinox of Reference Epoch
";

    const EARTH: &str = "-1.495978707E+08,  7.479893535E+07, 1.495978707E+05, 1.731456836805555E+01, \
        0.000000000000000E+00, -1.731456836805555E+00";

    fn scene(folder: &Path, problem: &str, earth: &str) -> Result<Scene, Vec<String>> {
        let path = folder.join("scene.toml");
        let text = format!(
            "[problem]\n{problem}\n[[body]]\nmass = 1\nhorizons = \"sun.txt\"\n[[body]]\nmass = 0.001\n{earth}\n\
             [run]\nscheme = \"yoshida4\"\nstep = 1\nsteps = 2\ndigits = \"double\"\n[output]\nfile \
             = \"out.csv\"\nenergy = true\n"
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
        let numbers = |values: &[shadowstep_schemes::symbolic::Exact]| {
            values.iter().map(|x| f64::from_rational(&x.value, &())).collect::<Vec<_>>()
        };
        assert_eq!(numbers(&scene.system.q), [0.0, 0.0, 0.0, -1.0, 0.5, 0.001]);
        let p = numbers(&scene.system.p);
        // 1731.4568… km/s are an astronomical unit a day
        assert!((p[2] - 5e-4).abs() < 1e-18 && (p[3] - 1e-5).abs() < 1e-17 && (p[5] + 1e-6).abs() < 1e-18, "{p:?}");
    }

    /// The head without a line.
    fn without(line: &str) -> String {
        let head: String = HEAD.lines().map(|line| line[2..].to_owned() + "\n").collect();
        let row = "2451545.000000000, A.D. 2000-Jan-01 12:00:00.0000, 1,0,0,0,0.017,0,\n$$EOE\n";
        format!("{head}JDTDB, Calendar Date (TDB), X, Y, Z, VX, VY, VZ,\n$$SOE\n{row}").replace(line, "")
    }

    #[test]
    fn lines_of_a_head_that_say_nothing_of_the_numbers_change_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        let file = "horizons = \"earth.txt\"";
        write("sun.txt", &without("").replace("Earth (399)", "Sun (10)").replace("1,0,0,0,0.017,0", "0,0,0,0,0,0"));
        write("earth.txt", &without(""));
        let known = scene(folder.path(), UNITS, file).unwrap();
        for (mark, line) in HEAD.lines().map(|line| line.split_at(2)) {
            write("earth.txt", &without(line));
            match scene(folder.path(), UNITS, file) {
                Ok(scene) => {
                    assert!(mark == "= ", "{line}");
                    assert_eq!((&scene.system.q, &scene.system.p), (&known.system.q, &known.system.p));
                }
                Err(_) => assert!(mark == "? ", "{line}"),
            }
        }
    }

    /// Without a state the first body is at the centre of the tables: of the Sun and the Earth, relative to the
    /// barycentre, it is neither.
    #[test]
    fn the_central_body_is_that_of_the_tables() {
        let folder = tempfile::tempdir().unwrap();
        for (name, centre, is_right) in [
            ("", "Sun (10)", true),
            ("name = \"sun\"", "Sun (10)", true),
            ("name = \"star\"", "Sun (10)", true),
            ("name = \"earth\"", "Earth (399)", true),
            ("name = \"earth\"", "Sun (10)", false),
            ("name = \"sun\"", "Earth (399)", false),
            ("", "Earth (399)", false),
            ("", "Solar System Barycenter (0)", false),
            ("name = \"sun\"", "Solar System Barycenter (0)", false),
            ("name = \"jupiter\"", "Jupiter Barycenter (5)", false),
        ] {
            fs::write(folder.path().join("planet.txt"), table("Mars (499)", centre, "AU-D", "1,0,0,0,0.01,0")).unwrap();
            let text = |central: &str| {
                let other = if name.is_empty() { "" } else { "name = \"mars\"" };
                format!(
                    "[problem]\n{UNITS}\n[[body]]\nmass = 1\n{name}\n{central}\n[[body]]\nmass = \
                        0.001\n{other}\nhorizons = \"planet.txt\"\n\
                     [run]\nscheme = \"yoshida4\"\nstep = 1\nsteps = 2\ndigits = \"double\"\n[output]\nenergy = true\n"
                )
            };
            let read = |central: &str| {
                let path = folder.path().join("scene.toml");
                fs::write(&path, text(central)).unwrap();
                Scene::open(&path)
            };
            let fault = format!("the states are relative to {centre}, where the first body would be");
            match read("") {
                Ok(_) => assert!(is_right, "{name} {centre}"),
                Err(error) => assert!(!is_right && error.to_string().contains(&fault), "{name} {centre}: {error}"),
            }
            fs::write(folder.path().join("own.txt"), table("Sun (10)", centre, "AU-D", "0.01,0,0,0,0,0")).unwrap();
            read("horizons = \"own.txt\"").unwrap();
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
        let run = || scene(folder.path(), UNITS, "a = 1").unwrap().run_to_file(crate::FileOptions::default(), &mut ());
        write("0");
        assert!(matches!(run(), Ok(crate::Outcome::Complete { .. })));
        assert_eq!(run().unwrap(), crate::Outcome::AlreadyComplete);
        write("1");
        assert!(run().unwrap_err().to_string().contains("was made with a different file sun.txt"));
    }
}
