//! `parts = ["…", "…", "…"]`: H as a sum of parts by their formulas.

use shadowstep::systems::QUADRATIC_FLOW_DIGITS;
use shadowstep::systems::many_parts::{PartError, PartFormula};
use shadowstep_schemes::document::{Placed, Text};
use shadowstep_schemes::symbolic::Exact;

use super::explicit_time;
use super::given::Given;
use super::reader::Reader;
use super::variables::Variables;
use crate::scene::split::Formulas;
use crate::scene::{Formula, KineticEnergy, Parts, PotentialEnergy, System};

/// What a part may be.
const KNOWN: &str = "a part is a function of variables none of which is the momentum of another, such as T(p), U(q) \
    or x*py, a quadratic form, f((q^2 + p^2)/2) or f(q*p) of one pair, p^2/(2*m) - k/r, or a sum of these in \
    different coordinates";

/// The system of these parts.
pub(super) fn system(reader: &mut Reader<'_>, given: &Given<'_, '_>, formulas: Placed<Vec<Text>>) -> Option<System> {
    given.state.refuse_velocities(reader, "H is given by formulas of its parts");
    if formulas.value.len() < 2 {
        return reader.toml.wrong(&formulas.at, "H needs two parts at least, not 1", "add the other parts of H");
    }
    let parameters = given.own_parameters(reader);
    of_formulas(reader, given, formulas.value, parameters, Copies::One(None))
}

/// How often there is each degree of freedom.
#[derive(Clone, Copy)]
pub(super) enum Copies<'a> {
    /// Once; with masses, if `v` gives velocities.
    One(Option<&'a [Exact]>),
    /// Twice, the second time with other names.
    Two,
}

/// The system of these parts, two at least.
pub(super) fn of_formulas(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    mut formulas: Vec<Text>,
    parameters: Vec<(String, Exact)>,
    copies: Copies<'_>,
) -> Option<System> {
    let explicit_time = formulas.iter().any(|formula| explicit_time::is_in(reader, given, &formula.value));
    let variables = Variables::read(reader, given, matches!(copies, Copies::Two), explicit_time)?;
    if explicit_time {
        explicit_time::add_momentum(reader, given, &mut formulas);
    }
    let names = (&variables.coordinates[..], &variables.momenta[..]);
    let parts = formulas.iter().filter(|_| variables.are_valid);
    let parts: Vec<_> = parts.map(|formula| part(reader, formula, names, &parameters)).collect();
    let masses = if let Copies::One(masses) = copies { masses } else { None };
    let state = variables.state(reader, given, masses);
    let energies = (PotentialEnergy::OfParts, KineticEnergy::Masses(None));
    let problem = variables.problem(energies, parameters, state)?;
    Some(System { problem, parts: Parts::Formulas(Formulas(parts.into_iter().collect::<Option<_>>()?)) })
}

/// H = T(p, t) + U as formulas of its parts.
pub(super) fn with_time_in_kinetic(reader: &mut Reader<'_>, given: &Given<'_, '_>, potential: Text) -> Option<System> {
    let help = "remove it, or give the parts by their formulas: parts = [\"p^2*exp(-t)/2\", \"q^4\"]";
    given.refuse(reader, "parts", "T depends on t, so that its part is that of its formula", help);
    given.state.refuse_velocities(reader, "T is given by `kinetic`");
    let parameters = given.own_parameters(reader);
    of_formulas(reader, given, vec![given.problem.text("kinetic")?, potential], parameters, Copies::One(None))
}

/// A part whose flow is known.
fn part(
    reader: &mut Reader<'_>,
    text: &Text,
    names: (&[String], &[String]),
    parameters: &[(String, Exact)],
) -> Option<Formula<PartFormula>> {
    match Formula::part(&text.value, names, parameters) {
        Ok(part) if part.meaning().has_quadratic_form() && reader.arithmetic.digits() > QUADRATIC_FLOW_DIGITS => {
            let message = PartError::Digits.to_string();
            reader.toml.wrong(&text.at, message, format!("write digits = {QUADRATIC_FLOW_DIGITS}, or less"))
        }
        Ok(part) => {
            reader.refuse_numbers(text, &part.meaning().numbers());
            Some(part)
        }
        Err(error @ PartError::Formula(_)) => {
            let help = "a part is a smooth formula in the coordinates, their momenta and the parameters";
            reader.toml.wrong(&text.place(&error.range()), error.to_string(), help)
        }
        Err(error) => reader.toml.wrong(&text.at, error.to_string(), KNOWN),
    }
}
