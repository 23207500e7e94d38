//! `vector_potential`: charges in a magnetic field, H = Σ (p_i − A_i)²/(2 m_i) + U with p = m v + A.
//!
//! Where the sum is a quadratic form, as in a constant field, it is one part: a rotation. Otherwise each summand is a
//! part, whose flow has a formula where A_i does not depend on q_i: then p_i − A_i is constant along it.

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep::systems::many_parts::PartError;
use shadowstep_schemes::document::{Placed, Text};
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_text;

use super::explicit_time::{MOMENTUM, TIME};
use super::given::Given;
use super::many_parts::Copies;
use super::reader::Reader;
use super::{kinetic, many_parts, variables};
use crate::scene::{Formula, System};

/// The key.
pub(super) const KEY: &str = "vector_potential";

/// The system of this potential and these A_i, one for each coordinate, times the charge.
pub(super) fn system(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    potential: Text,
    field: &Placed<Vec<Text>>,
) -> Option<System> {
    let parameters = given.own_parameters(reader);
    let (coordinates, momenta) = variables::names(given)?;
    if field.value.len() != coordinates.len() {
        let message = "this list needs a component for each coordinate";
        return reader.wrong_count(&field.at, message, (field.value.len(), coordinates.len()));
    }
    let masses = match &given.masses {
        Some(numbers) => {
            let masses = numbers.values(reader, coordinates.len())?;
            kinetic::masses(reader, numbers, masses.clone());
            Some(masses)
        }
        None => None,
    };
    let summands = summands(&field.value, &momenta, masses.as_deref());
    let parts = parts(reader, (coordinates, momenta), &parameters, (&field.value, summands))?;
    let formulas = parts.into_iter().chain([potential]).collect();
    let mut system = many_parts::of_formulas(reader, given, formulas, parameters, Copies::One(masses.as_deref()))?;
    if given.state.has_velocities() {
        add_field(reader, &mut system, &field.value)?;
    }
    Some(system)
}

/// (p_i − A_i)²/(2 m_i) of each coordinate, at the place of A_i.
fn summands(field: &[Text], momenta: &[String], masses: Option<&[Exact]>) -> Vec<Text> {
    let summand = |(i, (component, momentum)): (usize, (&Text, &String))| {
        let twice = masses.map_or_else(|| "2".to_owned(), |masses| format!("(2*{})", to_text(&masses[i].value)));
        let mut summand = component.clone();
        summand.value = format!("({momentum} - ({}))^2/{twice}", component.value);
        summand
    };
    field.iter().zip(momenta).enumerate().map(summand).collect()
}

/// The parts of T: one, if its flow is that of a quadratic form, else one for each coordinate.
fn parts(
    reader: &mut Reader<'_>,
    (mut coordinates, mut momenta): (Vec<String>, Vec<String>),
    parameters: &[(String, Exact)],
    (field, summands): (&[Text], Vec<Text>),
) -> Option<Vec<Text>> {
    let names = coordinates.clone();
    coordinates.push(TIME.to_owned());
    momenta.push(MOMENTUM.to_owned());
    let before = reader.toml.faults.len();
    for component in field {
        if let Err(error) = Formula::potential(&component.value, &coordinates, parameters) {
            let help = "a component of A is a smooth formula in the coordinates, the time t and the parameters";
            reader.toml.fault(&component.place(&error.range()), error.to_string(), help);
        }
    }
    if reader.toml.faults.len() > before {
        return None;
    }
    let mut all = summands[0].clone();
    all.value = summands.iter().map(|summand| summand.value.as_str()).collect::<Vec<_>>().join(" + ");
    if Formula::part(&all.value, (&coordinates, &momenta), parameters).is_ok() {
        return Some(vec![all]);
    }
    for (summand, name) in summands.iter().zip(&names) {
        if let Err(PartError::NoFlow(_)) = Formula::part(&summand.value, (&coordinates, &momenta), parameters) {
            let message = format!("this component of A depends on {name}, its own coordinate");
            let help = "use another gauge: A + grad f is the same field; a constant field may have any linear A \
                without constant terms";
            reader.toml.fault(&summand.at, message, help);
        }
    }
    (reader.toml.faults.len() == before).then_some(summands)
}

/// p = m v + A of the initial velocities.
fn add_field(reader: &mut Reader<'_>, system: &mut System, field: &[Text]) -> Option<()> {
    let known = reader.known.clone();
    let problem = &mut system.problem;
    let start = problem.coordinates.iter().cloned().zip(problem.q.iter().cloned());
    reader.known.extend(start.chain([(TIME.to_owned(), Exact { value: Rational::zero(), rounded: false })]));
    let values: Vec<_> = field.iter().map(|component| reader.evaluate(component)).collect();
    reader.known = known;
    for (p, value) in problem.p.iter_mut().zip(values) {
        let value = value?;
        p.value += value.value;
        p.rounded |= value.rounded;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use crate::run::start::Begin;
    use crate::scene::Scene;
    use shadowstep::tables::{Faults, Source};
    use shadowstep::{Carried, Integrator as _};

    fn read(field: &str, more: &str, run: &str) -> Result<Scene, Faults> {
        let text = format!(
            "[problem]\npotential = \"0\"\nvector_potential = {field}\ncoordinates = [\"x\", \"y\"]\nparameters = {{ \
                b = \"3/2\" }}\n{more}\n\
             [initial]\nq = [2, 1]\nv = [\"1/2\", 0]\n[run]\nscheme = \"stormer-verlet\"\nstep \
             = \"1/2\"\n{run}\ndigits = 30\n[output]\nenergy = true"
        );
        Scene::read(Source { path: "test.toml".to_owned(), text })
    }

    /// A charge in a constant field goes round a circle with the frequency b/m, whatever the step is: about (2, 1 − m
    /// v/b).
    #[test]
    fn a_constant_field_is_a_rotation_in_every_gauge() {
        for gauge in ["[\"-b*y/2\", \"b*x/2\"]", "[\"-b*y\", \"0\"]", "[\"-b*y + x\", \"y\"]"] {
            let scene = read(gauge, "masses = [2, 2]", "steps = 7").unwrap();
            let steps = scene.steps_from(Begin::InitialState);
            let mut integrator = scene.system.integrator::<f64>(steps, scene.system.start(&()), &()).unwrap();
            (0..7).for_each(|_| integrator.step(Carried::Nothing));
            let (sine, cosine) = 2.625_f64.sin_cos();
            let turned = [2.0 + sine * 2.0 / 3.0, (1.0 + 2.0 * cosine) / 3.0];
            // some fifty roundings of numbers of size 1
            let off = integrator.state().q().iter().zip(turned).map(|(q, exact)| (q - exact).abs()).fold(0.0, f64::max);
            assert!(off < 1e-14, "{gauge}: {off}");
        }
    }

    #[test]
    fn parts_and_momenta_follow_from_the_field() {
        let scene = |field: &str| read(field, "", "steps = 1").unwrap();
        let constant = scene("[\"-b*y/2\", \"b*x/2\"]");
        assert_eq!(constant.system.parts.hamiltonian().unwrap(), "((px - (-b*y/2))^2/2 + (py - (b*x/2))^2/2) + (0)");
        let texts: Vec<_> = constant.system.p.iter().map(|p| p.value.to_string()).collect();
        assert_eq!(texts, ["-1/4", "3/2"]);
        let of_position = scene("[\"-b*y^3*cos(t)\", \"b*x/2\"]");
        assert_eq!(
            of_position.system.parts.hamiltonian().unwrap(),
            "((px - (-b*y^3*cos(t)))^2/2) + ((py - (b*x/2))^2/2 + pt) + (0)"
        );
    }
}
