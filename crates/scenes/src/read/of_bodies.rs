//! `central` and `external`: energies of each body of a planetary system, beside the attraction.

use shadowstep::systems::formula::RelativeTo;
use shadowstep_schemes::document::Text;
use shadowstep_schemes::symbolic::Exact;

use super::explicit_time;
use super::given::Given;
use super::reader::Reader;
use crate::scene::{EnergyOfBodies, Formula};

/// The names in these formulas besides parameters: the coordinates come last, of which there may be fewer.
const NAMES: [&str; 6] = ["m", "m0", "r", "x", "y", "z"];

/// The energies of a number of bodies, some of them particles of mass 0, in a number of dimensions.
pub(super) fn energies(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    bodies: (usize, usize, usize),
    parameters: &[(String, Exact)],
) -> Option<Vec<EnergyOfBodies>> {
    let texts = ["central", "external"].map(|key| given.problem.text(key));
    let texts = [texts[0].as_ref(), texts[1].as_ref()];
    explicit_time::refuse(reader, given, texts, "the energy of a body beside the attraction")?;
    let before = reader.toml.faults.len();
    let mut energies = Vec::new();
    for (text, relative_to) in texts.into_iter().zip([RelativeTo::FirstBody, RelativeTo::Origin]) {
        let Some(text) = text else { continue };
        let names = &NAMES[..NAMES.len() - 3 + bodies.2];
        refuse_names(reader, given, (text, names), parameters);
        if reader.toml.faults.len() > before {
            return None;
        }
        match Formula::of_bodies(&text.value, relative_to, bodies, parameters) {
            Ok(formula) => {
                reader.refuse_numbers(text, &formula.meaning().numbers());
                energies.push(formula);
            }
            Err(error) => {
                let help = format!("it is a smooth formula in {} and the parameters", names.join(", "));
                return reader.toml.wrong(&text.place(&error.range()), error.to_string(), help);
            }
        }
    }
    (reader.toml.faults.len() == before).then_some(energies)
}

/// Refuses parameters, or axes of a sweep, with a name that a formula of bodies has already.
fn refuse_names(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    (formula, names): (&Text, &[&str]),
    parameters: &[(String, Exact)],
) {
    for (name, _) in parameters.iter().filter(|(name, _)| names.contains(&name.as_str())) {
        let own = given.parameters.iter().find(|(own, _)| own.value == *name);
        let at = own.map_or(&formula.at, |(own, _)| &own.at);
        let message = format!("`{name}` is a parameter, and a name of the bodies in `central` and `external`");
        let help = format!("give the parameter another name; {} are those of bodies", names.join(", "));
        reader.toml.fault(at, message, help);
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::observer::testing::{read, rows};

    const RUN: &str = "[run]\nscheme = \"yoshida8-d\"\nstep = \"1/50\"\nsteps = 100\ndigits = 40\n[output]\nenergy = \
        true\ntrajectory = true";

    /// Two planets in the plane, with these lines in [problem].
    fn scene(problem: &str) -> String {
        format!(
            "[problem]\n{problem}\n[[body]]\nmass = 1\n[[body]]\nmass = 0.1\nq = [2, 0]\nv = [0, 0.6]\n\
             [[body]]\nmass = 0.01\nq = [0, 4]\nv = [-0.5, 0]\n{RUN}"
        )
    }

    /// The numbers of the last row.
    fn end(text: &str) -> Vec<f64> {
        rows(&read(text)).pop().unwrap().iter().map(|number| number.parse().unwrap()).collect()
    }

    #[test]
    fn steps_are_those_of_one_formula() {
        let own = "central = \"-3*(g*m0)^2*m/(c^2*r^2)\"\nexternal = \"k*m*(x^2/2 + r^4*y/50)\"\nparameters = { g = \
            1, c = 5, k = \"1/20\" }";
        let pairs = "-0.1/sqrt((x1 - x2)^2 + (y1 - y2)^2) - 0.01/sqrt((x1 - x3)^2 + (y1 - y3)^2) - 0.001/sqrt((x2 - \
            x3)^2 + (y2 - y3)^2)";
        let central = "-0.3/(c^2*((x1 - x2)^2 + (y1 - y2)^2)) - 0.03/(c^2*((x1 - x3)^2 + (y1 - y3)^2))";
        let tide = |body: u8| format!("(x{body}^2/2 + (x{body}^2 + y{body}^2)^2*y{body}/50)");
        let formula = format!(
            "[problem]\npotential = \"{pairs} {central} + k*({} + 0.1*{} + 0.01*{})\"\nparameters = {{ c = 5, k \
                = \"1/20\" }}\n\
             coordinates = [\"x1\", \"y1\", \"x2\", \"y2\", \"x3\", \"y3\"]\nmasses = [1, 1, 0.1, 0.1, 0.01, 0.01]\n\
             [initial]\nq = [0, 0, 2, 0, 0, 4]\nv = [0, 0, 0, 0.6, -0.5, 0]\n{RUN}",
            tide(1),
            tide(2),
            tide(3)
        );
        let expected = end(&formula);
        let distance = |found: &[f64]| found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let plain = distance(&end(&scene(own)));
        let of_parts = distance(&end(&scene(&format!("parts = \"wisdom-holman\"\n{own}"))));
        println!("{plain:e} {of_parts:e}");
        // the same steps; and others, whose errors are not these
        assert!(plain < 1e-15 && of_parts < 1e-11, "{plain:e}, {of_parts:e}");
    }
}
