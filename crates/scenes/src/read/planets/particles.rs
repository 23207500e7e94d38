//! `particles` in [problem]: bodies of mass 0, a line each of a file of CSV.

use shadowstep::tables::Source;
use shadowstep_schemes::document::{Placed, Text, read_text};

use super::body::{ANGLES_AND_SHAPE, GivenBody};
use crate::document::keys::BODY;
use crate::read::reader::Reader;

/// The most bytes of a file.
const LARGEST_FILE: u64 = 256 << 20;

/// The most particles.
const MOST_PARTICLES: usize = 1_000_000;

/// The columns of positions and of velocities.
const COORDINATES: [[&str; 3]; 2] = [["x", "y", "z"], ["vx", "vy", "vz"]];

const HELP: &str = "the first line has the names of the columns: x, y, z, vx, vy, vz, or a, e, i, node, pericentre, \
    and M or lambda; and name, if they have names";

/// The particles of a file of this name, its path relative to the folder of the scene; its faults are reported.
pub(super) fn of_file(reader: &mut Reader<'_>, name: &Text) -> Option<Vec<GivenBody>> {
    let path = reader.path(name)?;
    let shown = path.display().to_string();
    let text = match read_text(&path, LARGEST_FILE) {
        Ok(text) => text,
        Err(error) => return reader.toml.wrong(&name.at, format!("{shown} cannot be read: {error}"), HELP),
    };
    match read(&text, name) {
        Ok(mut bodies) => {
            bodies.iter_mut().for_each(|body| body.line.iter_mut().for_each(|line| *line = format!("{shown}:{line}")));
            reader.files.push(Source { path: name.value.clone(), text });
            Some(bodies)
        }
        Err((line, message)) => reader.toml.wrong(&name.at, format!("{shown}:{line}: {message}"), HELP),
    }
}

/// The bodies of a text, or the line of a fault.
fn read(text: &str, file: &Text) -> Result<Vec<GivenBody>, (u64, String)> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let unreadable = |error: csv::Error| {
        (
            error.position().map_or(1, csv::Position::line),
            "this is not a line of CSV with as many cells as the first one".to_owned(),
        )
    };
    let names: Vec<String> = reader.headers().map_err(unreadable)?.iter().map(str::to_owned).collect();
    let known = || COORDINATES.iter().flatten().chain(&ANGLES_AND_SHAPE).chain(&["a", "name"]);
    // no line is shown of a file that is not a table of particles
    if !names.iter().any(|name| known().any(|known| known == name)) {
        return Err((1, "the first line does not have the names of columns of particles".to_owned()));
    }
    if let Some(unknown) = names.iter().find(|name| !known().any(|known| known == name)) {
        let is_word = unknown.chars().all(|c| c.is_alphanumeric() || "_-. ".contains(c));
        let shown = if is_word { format!("`{unknown}`") } else { "a text that is not a name".to_owned() };
        return Err((1, format!("{shown} is not a column of particles")));
    }
    refuse_conflicts(&names)?;
    let mut bodies = Vec::new();
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        if bodies.len() == MOST_PARTICLES {
            return Err((line, format!("there are more than {MOST_PARTICLES} particles")));
        }
        let cell = |name: &str| {
            let place = names.iter().position(|known| known == name)?;
            record.get(place).map(|cell| Text::at(cell, file.at.clone()))
        };
        let vector = |axes: [&str; 3]| {
            let value: Vec<_> = axes.into_iter().map_while(cell).collect();
            (!value.is_empty()).then(|| Placed { value, at: file.at.clone() })
        };
        let mass = Some(Text::at("0", file.at.clone()));
        let line = Some(line.to_string());
        bodies.push(GivenBody { mass, line, ..GivenBody::of(cell, COORDINATES.map(vector), &file.at) });
    }
    if bodies.is_empty() { Err((1, "there is no particle".to_owned())) } else { Ok(bodies) }
}

/// Refuses columns without those that they need, or with others that they exclude, as the keys of bodies do.
fn refuse_conflicts(names: &[String]) -> Result<(), (u64, String)> {
    let has_any = |columns: &[&str]| columns.iter().any(|column| names.iter().any(|name| name == column));
    let has = |key: &str| match key {
        "q" => has_any(&COORDINATES[0]),
        "v" => has_any(&COORDINATES[1]),
        column => has_any(&[column]),
    };
    for key in BODY.keys.iter().filter(|key| has(key.name)) {
        if let Some(other) = key.excludes.iter().find(|other| has(other)) {
            return Err((1, format!("{other} and {} are both given", key.name)));
        }
        if let Some(need) = key.needs.iter().find(|need| !has(need)) {
            return Err((1, format!("{} requires {need}", key.name)));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use shadowstep::tables::{Faults, Source};

    use crate::Scene;

    const BODIES: &str =
        "[[body]]\nname = \"sun\"\nmass = 1\n[[body]]\nname = \"jupiter\"\nmass = 0.001\na = 5\ne = 0.05\n";
    const RUN: &str = "[run]\nscheme = \"saba4\"\nstep = \"1/2\"\nsteps = 40\ndigits = \"double\"\n[output]\n\
                       trajectory = { every = 20 }\nmodified_energy = { order = 4, every = 20 }\nenergy = { every = 20 }\n";

    /// A scene in a folder, with these lines in [problem], more bodies, and a file.
    fn read(problem: &str, bodies: &str, file: &str) -> Result<Scene, Vec<String>> {
        read_with(problem, bodies, file, RUN)
    }

    fn read_with(problem: &str, bodies: &str, file: &str, run: &str) -> Result<Scene, Vec<String>> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("particles.csv"), file).unwrap();
        let path = folder.path().join("scene.toml").display().to_string();
        let text = format!("[problem]\nparameters = {{ g = 40 }}\n{problem}\n{BODIES}{bodies}{run}");
        Scene::read(Source { path, text }).map_err(|Faults(faults)| {
            let folder = format!("{}/", folder.path().display());
            let text = |message: &str| message.replace(&folder, "");
            faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, text(&fault.message))).collect()
        })
    }

    /// The rows, by column.
    fn rows(scene: &Scene) -> Vec<(String, Vec<String>)> {
        let mut rows = Vec::new();
        scene.run_into(&mut rows, &mut ()).unwrap();
        let text = String::from_utf8(rows).unwrap();
        let mut lines =
            text.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').map(str::to_owned));
        let names: Vec<String> = lines.next().unwrap().collect();
        let rows: Vec<Vec<String>> = lines.map(Iterator::collect).collect();
        names.into_iter().enumerate().map(|(c, name)| (name, rows.iter().map(|row| row[c].clone()).collect())).collect()
    }

    const PARTS: [&str; 3] = ["", "parts = \"wisdom-holman\"", "parts = \"wisdom-holman-heliocentric\""];

    #[test]
    fn particles_of_a_file_are_bodies_of_mass_0() {
        let file = "# of the main belt\nname, a, e, M\nceres, 2.77, 0.08, 1/3\nvesta, 2.36, 0.09, 20\n";
        let bodies = "[[body]]\nname = \"ceres\"\nmass = 0\na = 2.77\ne = 0.08\nM = \"1/3\"\n[[body]]\nname \
            = \"vesta\"\nmass = 0\na = 2.36\ne = 0.09\nM = 20\n";
        for parts in PARTS {
            let of_file = rows(&read(&format!("{parts}\nparticles = \"particles.csv\""), "", file).unwrap());
            assert_eq!(of_file, rows(&read(parts, bodies, "").unwrap()), "{parts}");
            // the modified energy and all else is that of the others
            let alone = rows(&read(parts, "", "").unwrap());
            assert_eq!(of_file.len(), alone.len() + 12);
            for column in &alone {
                assert!(of_file.contains(column), "{parts}: {column:?}");
            }
        }
        // rows that have estimates, which are of states before the present one
        let run = RUN.replace("modified_energy = { order = 4, every = 20 }\n", "");
        let [plain, estimated] = [&run, RUN].map(|run| rows(&read_with(PARTS[1], bodies, "", run).unwrap()));
        assert!(plain.iter().all(|column| estimated.contains(column)) && plain.len() + 3 == estimated.len());
        let file = "x,y,z,vx,vy,vz\n2.5,0,0.1,0,4,0\n0,2.5,0,\"-4\",0,0\n";
        let all = rows(&read("particles = \"particles.csv\"", "", file).unwrap());
        let first = |name: &str| all.iter().find(|(column, _)| column == name).map(|(_, rows)| rows[0].as_str());
        assert_eq!(
            (first("x_particle1"), first("py_particle1"), first("px_particle2")),
            (Some("2.5"), Some("4.0"), Some("-4.0"))
        );
    }

    /// In metadata too, though momenta are divided by it; also where all other masses are 1.
    #[test]
    fn particles_have_the_mass_0() {
        let particle = "[[body]]\nname = \"a\"\nmass = 0\na = 2\n";
        for parts in PARTS {
            let masses = read(parts, particle, "").unwrap().metadata()["masses"].clone();
            assert_eq!(masses, serde_json::json!(["1", "1", "1", "0.001", "0.001", "0.001", "0", "0", "0"]), "{parts}");
        }
        let text = format!("[problem]\nparameters = {{ g = 1 }}\n{}{RUN}", BODIES.replace("0.001", "1") + particle);
        let scene = Scene::read(Source { path: "scene.toml".to_owned(), text }).unwrap();
        assert_eq!(scene.metadata()["masses"], serde_json::json!(["1", "1", "1", "1", "1", "1", "0", "0", "0"]));
    }

    /// Elements about the centre, the velocity for the momentum, and no orbit about a particle.
    #[test]
    fn particles_have_elements() {
        let particle = "[[body]]\nname = \"a\"\nmass = 0\na = 2\ne = 0.3\nM = 40\n";
        for parts in PARTS {
            let text = |values: &str| {
                let source = format!(
                    "[problem]\nparameters = {{ g = 40 }}\n{parts}\n{BODIES}{particle}{RUN}values = {{ {values} }}\n"
                );
                Scene::read(Source { path: "scene.toml".to_owned(), text: source })
            };
            let all = rows(&text("a = \"a(a)\", e = \"e(a, jacobi)\", m = \"M(a)\"").unwrap());
            let first = |name: &str| {
                all.iter().find(|(column, _)| column == name).map(|(_, rows)| rows[0].parse::<f64>().unwrap()).unwrap()
            };
            assert!((first("a") - 2.0).abs() < 1e-14 && (first("m") - 40.0).abs() < 1e-12, "{parts}");
            // about the centre of mass of the Sun and Jupiter
            assert!((first("e") - 0.3).abs() < 0.05 && first("e") != 0.3, "{parts}");
        }
    }
}
