//! A fault in a formula is one sentence with its place, however H is split.

use shadowstep::tables::{Faults, Source};
use shadowstep_scenes::Scene;

const RUN: &str =
    "[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nsteps = 3\ndigits = \"double\"\n[output]\nenergy = true\n";
const LOGARITHMIC: &str = "[time]\ntransform = \"logarithmic\"\n";
const POWER: &str = "[time]\ntransform = \"power\"\nexponent = \"-1/2\"\n";
const LINEAR: &str = "parts = \"linear\"\n";

/// Lines of \[problem\] and sections after it: each kind of split that a word or a section asks for.
const SPLITS: [(&str, &str); 6] = [
    ("", ""),
    ("parts = \"kinetic-potential\"\n", ""),
    (LINEAR, ""),
    ("parts = \"wisdom-holman\"\n", ""),
    ("", LOGARITHMIC),
    ("", POWER),
];

/// The faults, each as `line:column: sentence`.
fn faults(text: &str) -> Vec<String> {
    match Scene::read(Source { path: "test.toml".to_owned(), text: text.to_owned() }) {
        Err(Faults(faults)) => {
            faults.iter().map(|fault| format!("{}:{}: {}", fault.line, fault.column, fault.message)).collect()
        }
        Ok(_) => Vec::new(),
    }
}

#[test]
fn in_every_split_a_faulty_formula_has_its_place() {
    let initial = "[initial]\nq = [1, 0]\np = [0, 1]\n";
    let bodies = "[initial]\nq = [0, 0, 1, 0]\np = [0, 0, 0, 1]\n";
    let coordinates = "coordinates = [\"x\", \"y\"]";
    let systems = [
        (format!("potential = \"x^2 + z\"\n{coordinates}"), initial, "2:20: unknown name `z`"),
        (format!("potential = \"x^2 + (y\"\n{coordinates}"), initial, "2:20: unexpected end"),
        (format!("potential = \"abs(x)\"\n{coordinates}"), initial, "2:14: `abs` is not smooth"),
        (
            format!("{coordinates}\npotential = \"-1/sqrt(1 + x^2 + y^2)\"\nkinetic = \"px^2 + y\""),
            initial,
            "4:19: unknown name `y`",
        ),
        ("pair = \"-1/sqrt(r2) + x\"\nbodies = 2\ndimensions = 2".to_owned(), bodies, "2:23: unknown name `x`"),
        ("pair = \"-1/sqrt(r2\"\nbodies = 2\ndimensions = 2".to_owned(), bodies, "2:16: unexpected end"),
        (
            "pair = \"-1/sqrt(r2)\"\nbodies = 1\ndimensions = 2".to_owned(),
            "[initial]\nq = [0, 1]\np = [0, 1]\n",
            "3:10: one body",
        ),
        ("pair = \"-m_i/sqrt(r2)\"\nbodies = 2\ndimensions = 2".to_owned(), bodies, "2:10: unknown name `m_i`"),
    ];
    for (problem, initial, fault) in &systems {
        for (parts, section) in SPLITS {
            let text = format!("[problem]\n{problem}\n{parts}{initial}{section}{RUN}");
            let found = faults(&text);
            assert!(found.len() == 1 && found[0].starts_with(fault), "{text}\n{found:?}");
        }
    }
}

#[test]
fn so_has_a_faulty_part_of_many() {
    let initial = "[initial]\nq = [1, 0]\np = [0, 1]\n";
    let coordinates = "coordinates = [\"x\", \"y\"]";
    for (parts, fault) in [
        ("[\"px^2\", \"x + z\", \"py^2\"]", "2:23: unknown name `z`"),
        ("[\"px^2\", \"(x\", \"py^2\"]", "2:19: unexpected end"),
    ] {
        for section in ["", LOGARITHMIC] {
            let found = faults(&format!("[problem]\nparts = {parts}\n{coordinates}\n{initial}{section}{RUN}"));
            assert!(found.len() == 1 && found[0].starts_with(fault), "{found:?}");
        }
    }
}

#[test]
fn so_has_a_parameter_with_a_name_of_the_bodies_energy() {
    let bodies = "[[body]]\nmass = 1\n[[body]]\nmass = 0.1\na = 1\n";
    for name in ["r2", "m_i", "m_j"] {
        for (parts, section) in SPLITS {
            let found =
                faults(&format!("[problem]\nparameters = {{ g = 1, {name} = 2 }}\n{parts}{bodies}{section}{RUN}"));
            assert!(found.len() == 1 && found[0].starts_with(&format!("2:23: with [[body]], `{name}`")), "{found:?}");
        }
    }
}

/// A text and a list for each body are for bodies only.
#[test]
fn so_has_a_state_of_bodies_beside_a_list_of_parts() {
    for q in ["\"i\"", "[[1], [0]]"] {
        let problem = "parts = [\"px^2\", \"cos(x)\"]\ncoordinates = [\"x\"]\nmomenta = [\"px\"]\n";
        let found = faults(&format!("[problem]\n{problem}[initial]\nq = {q}\np = [0]\n{RUN}"));
        let is_of_q = |fault: &String| fault.starts_with("6:") && fault.ends_with("this value is of the wrong kind");
        assert!(!found.is_empty() && found.iter().all(is_of_q), "{q}: {found:?}");
    }
}
