//! A custom potential, with its coordinates and momenta.

use shadowstep::systems::formula::{FormulaError, FormulaPotential};
use shadowstep_symbolic::{Exact, SemanticFault};

use super::explicit_time;
use super::given::Given;
use super::kinetic;
use super::names::check_name;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::columns::fixed_names;
use crate::scene::{Formula, InitialValueProblem, PotentialEnergy};
use shadowstep_schemes::document::{Placed, Text};

/// The problem with this potential, and with it the slow potential of another one.
pub(super) fn problem(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    potential: &Text,
    slow: Option<&Text>,
) -> Option<(InitialValueProblem, Option<PotentialEnergy>)> {
    let parameters = given.own_parameters(reader);
    let list = given.coordinates.as_ref()?;
    let before = reader.toml.faults.len();
    let (mut coordinates, mut momenta) = names(reader, given, list);
    let of_coordinates = coordinates.len();
    let moved = momenta.clone();
    let mut both = [Some(potential), slow].into_iter().flatten();
    let explicit_time = both.any(|text| explicit_time::is_in(reader, given, &text.value));
    if explicit_time {
        explicit_time::add_names(reader, given, (&mut coordinates, &mut momenta));
    }
    let named = reader.toml.faults.len() == before;
    let mut in_names = |text| if named { self::potential(reader, text, &coordinates, &parameters) } else { None };
    let (potential, slow) = (in_names(potential), slow.map(in_names));
    let masses = given.masses.as_ref().and_then(|numbers| {
        let values = numbers.values(reader, of_coordinates)?;
        kinetic::masses(reader, numbers, values)
    });
    let values = |reader: &mut Reader<'_>, numbers: &Numbers| {
        numbers.values_of_all(reader, coordinates.len(), (false, explicit_time))
    };
    let (q, p) = given.state.values(reader, values, masses.as_deref());
    if explicit_time {
        explicit_time::refuse_other_start(reader, given, q.as_ref());
    }
    let kinetic = if named { kinetic::kinetic(reader, given, &moved, &parameters, masses) } else { None };
    let problem = InitialValueProblem {
        potential: PotentialEnergy::Formula(potential?),
        kinetic: kinetic?,
        parameters,
        coordinates,
        momenta,
        q: q?,
        p: p?,
        explicit_time,
    };
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

/// The names of the coordinates and of their momenta, each different from all other names.
pub(super) fn names(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    list: &Placed<Vec<Text>>,
) -> (Vec<String>, Vec<String>) {
    let mut taken: Vec<(String, String)> =
        fixed_names().map(|name| (name.to_owned(), "of a column of the output".to_owned())).collect();
    taken.extend(reader.names.iter().map(|(name, _)| (name.clone(), "of an axis or a column".to_owned())));
    taken.extend(given.parameters.iter().map(|(name, _)| (name.value.clone(), "of a parameter".to_owned())));
    for name in &list.value {
        check_name(reader, name);
        // by default, momenta are named after the coordinates
        let momentum = given.place("momenta").is_none().then(|| format!("p{}", name.value));
        let is_its = |other: &String| *other == name.value || momentum.as_ref() == Some(other);
        if let Some((other, whose)) = taken.iter().find(|(other, _)| is_its(other)) {
            let message = match *other == name.value {
                true if whose == COORDINATE => format!("the coordinate `{other}` is named twice"),
                true => format!("the coordinate `{other}` has the name {whose}"),
                false => format!("the momentum `{other}` of `{}` has the name {whose}", name.value),
            };
            reader.toml.fault(&name.at, message, "give it another name");
        }
        taken.push((name.value.clone(), COORDINATE.to_owned()));
        taken.extend(momentum.map(|momentum| (momentum, format!("of the momentum of `{}`", name.value))));
    }
    if let Some(momenta) = given.problem.list("momenta") {
        check_momenta(reader, &momenta, list.value.len(), taken);
    }
    given.variables(list)
}

const COORDINATE: &str = "of a coordinate";

/// Checks the names of the momenta: one for each coordinate, and each different from all other names.
fn check_momenta(
    reader: &mut Reader<'_>,
    list: &Placed<Vec<Text>>,
    coordinates: usize,
    mut taken: Vec<(String, String)>,
) {
    for name in &list.value {
        check_name(reader, name);
        if let Some((other, whose)) = taken.iter().find(|(other, _)| *other == name.value) {
            reader.toml.fault(&name.at, format!("the momentum `{other}` has the name {whose}"), "give it another name");
        }
        taken.push((name.value.clone(), "of another momentum".to_owned()));
    }
    if list.value.len() != coordinates {
        let fault = reader.toml.source.fault(&list.at, "this list needs a name for each coordinate");
        reader.toml.faults.push(fault.values(list.value.len().to_string(), coordinates.to_string()));
    }
}
