//! `hamiltonian`: an H(q, p) whose parts have no known flows, in M. Tao's extended phase space.
//!
//! Beside q, p there are x, y, which begin there too, and H(q, y) + H(x, p) + ω(|q − x|² + |p − y|²)/2 has three parts:
//! in the first q and y stay, in the second x and p, and the third is a rotation. Where q = x and p = y both are the
//! motion of H; the third part holds them together.
//!
//! Source: M. Tao, Phys. Rev. E 94 (2016) 043303.

use shadowstep_schemes::document::Text;
use shadowstep_schemes::symbolic::{ExpressionKind, parse};

use super::explicit_time::TIME;
use super::given::Given;
use super::many_parts::{self, Copies};
use super::reader::Reader;
use super::variables::{self, SECOND};
use crate::scene::{Formula, System};

/// The key of H.
pub(super) const HAMILTONIAN: &str = "hamiltonian";

/// The system of this H and ω.
pub(super) fn system(reader: &mut Reader<'_>, given: &Given<'_, '_>, hamiltonian: &Text) -> Option<System> {
    given.state.refuse_velocities(reader, "H is given by its formula");
    let parameters = given.own_parameters(reader);
    let (coupling, _) = reader.value(&given.problem, "coupling")?;
    let (coordinates, momenta) = variables::names(given)?;
    let known = [&coordinates[..], &momenta, &[TIME.to_owned()]].concat();
    if let Err(error) = Formula::potential(&hamiltonian.value, &known, &parameters) {
        let help = "H is a smooth formula in the coordinates, the momenta, the time t and the parameters";
        return reader.toml.wrong(&hamiltonian.place(&error.range()), error.to_string(), help);
    }
    let pairs = coordinates.iter().zip(&momenta);
    let distance = |name: &String| format!("({name} - {name}{SECOND})^2");
    let distances: Vec<_> = pairs.map(|(q, p)| format!("{} + {}", distance(q), distance(p))).collect();
    let with = |value: String| {
        let mut part = hamiltonian.clone();
        part.value = value;
        part
    };
    let formulas = vec![
        with(second(&hamiltonian.value, &momenta)),
        with(second(&hamiltonian.value, &coordinates)),
        with(format!("({})/2*({})", coupling.value, distances.join(" + "))),
    ];
    many_parts::of_formulas(reader, given, formulas, parameters, Copies::Two)
}

/// The formula with the second copies of these variables.
fn second(formula: &str, variables: &[String]) -> String {
    let mut places = Vec::new();
    if let Ok(syntax) = parse(formula) {
        syntax.visit(&mut |part| {
            if let ExpressionKind::Name(name) = &part.kind
                && variables.contains(name)
            {
                // with the parentheses around it
                let begin = part.range.start + formula[part.range.clone()].find(name.as_str()).unwrap_or(0);
                places.push(begin + name.len());
            }
        });
    }
    places.sort_unstable();
    let mut text = formula.to_owned();
    places.into_iter().rev().for_each(|end| text.insert_str(end, SECOND));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use shadowstep::tables::{Faults, Source};

    fn read(problem: &str) -> Result<Scene, Faults> {
        let text = format!(
            "[problem]\n{problem}\ncoordinates = [\"x\", \"y\"]\n[initial]\nq = [1, \"1/2\"]\np = [\"1/3\", 0]\n\
             [run]\nscheme = \"yoshida4\"\nstep = \"1/100\"\nsteps = 10\ndigits = 30\n[output]\nenergy = true"
        );
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    #[test]
    fn variables_get_their_second_copies() {
        let [x, p] = ["x", "px"].map(|name| vec![name.to_owned()]);
        assert_eq!(second("(x)^2*px + exp(-x*px)*xx", &x), "(x_2)^2*px + exp(-x_2*px)*xx");
        assert_eq!(second("(x)^2*px + exp(-x*px)*xx", &p), "(x)^2*px_2 + exp(-x*px_2)*xx");
    }

    #[test]
    fn copies_begin_where_the_variables_do() {
        let scene = read("hamiltonian = \"(x^2 + 1)*(px^2 + py^2*y) + cos(t)\"\ncoupling = \"40/2\"").unwrap();
        assert_eq!(
            scene.system.parts.hamiltonian().unwrap(),
            "((x^2 + 1)*(px_2^2 + py_2^2*y) + cos(t)) + ((x_2^2 + 1)*(px^2 + py^2*y_2) + cos(t)) + \
             ((40/2)/2*((x - x_2)^2 + (px - px_2)^2 + (y - y_2)^2 + (py - py_2)^2) + pt)"
        );
        assert_eq!(scene.system.coordinates, ["x", "y", "x_2", "y_2", "t"]);
        let texts: Vec<_> = scene.system.q.iter().chain(&scene.system.p).map(|x| x.value.to_string()).collect();
        assert_eq!(texts, ["1", "1/2", "1", "1/2", "0", "1/3", "0", "1/3", "0", "0"]);
    }
}
