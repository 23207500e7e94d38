//! A custom potential, with its coordinates and momenta.

use shadowstep::systems::formula::{FormulaError, FormulaPotential};
use shadowstep_schemes::symbolic::{Exact, SemanticFault};

use super::explicit_time;
use super::given::Given;
use super::kinetic;
use super::reader::Reader;
use super::variables::Variables;
use crate::scene::{Formula, InitialValueProblem, PotentialEnergy};
use shadowstep_schemes::document::Text;

/// The problem with this potential, and with it the slow potential of another one.
pub(super) fn problem(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    potential: &Text,
    slow: Option<&Text>,
) -> Option<(InitialValueProblem, Option<PotentialEnergy>)> {
    let parameters = given.own_parameters(reader);
    let mut both = [Some(potential), slow].into_iter().flatten();
    let explicit_time = both.any(|text| explicit_time::is_in(reader, given, &text.value));
    let variables = Variables::read(reader, given, false, explicit_time)?;
    let (are_valid, coordinates) = (variables.are_valid, &variables.coordinates);
    let mut in_names = |text| if are_valid { self::potential(reader, text, coordinates, &parameters) } else { None };
    let (potential, slow) = (in_names(potential), slow.map(in_names));
    let masses = given.masses.as_ref().and_then(|numbers| {
        let values = numbers.values(reader, variables.count)?;
        kinetic::masses(reader, numbers, values)
    });
    let state = variables.state(reader, given, masses.as_deref());
    let mut kinetic = None;
    if are_valid {
        let momenta = &variables.momenta[..variables.count];
        kinetic = kinetic::kinetic(reader, given, momenta, &parameters, masses);
    }
    let problem = variables.problem((PotentialEnergy::Formula(potential?), kinetic?), parameters, state)?;
    match slow {
        Some(slow) => Some((problem, Some(PotentialEnergy::Formula(slow?)))),
        None => Some((problem, None)),
    }
}

/// U(q) in these names.
pub(super) fn potential(
    reader: &mut Reader<'_>,
    text: &Text,
    coordinates: &[String],
    parameters: &[(String, Exact)],
) -> Option<Formula<FormulaPotential<f64>>> {
    match Formula::potential(&text.value, coordinates, parameters) {
        Ok(formula) => {
            reader.refuse_numbers(text, &formula.meaning().numbers());
            Some(formula)
        }
        Err(error) => {
            let help = what_a_potential_is(&text.value[error.range()], &error, coordinates);
            reader.toml.wrong(&text.place(&error.range()), error.to_string(), help)
        }
    }
}

/// A hint for the wrong part of the text of a potential.
fn what_a_potential_is(wrong: &str, error: &FormulaError, coordinates: &[String]) -> String {
    let is_unknown =
        matches!(error, FormulaError::Meaning(error) if matches!(error.fault, SemanticFault::UnknownName { .. }));
    let is_momentum =
        wrong.strip_prefix('p').is_some_and(|name| coordinates.iter().any(|coordinate| coordinate == name));
    if is_unknown && is_momentum {
        "U(q) has no momenta in it; T is p²/2m, or the formula `kinetic`".to_owned()
    } else if is_unknown {
        format!("U is a smooth formula of coordinates, which q has, and of parameters with values, such as {wrong} = 1")
    } else {
        "a potential is a smooth formula such as \"-1/sqrt(x^2 + y^2)\"".to_owned()
    }
}
