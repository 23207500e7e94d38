//! A shipped problem, with its own or other parameters and initial state.

use shadowstep::problems::{self, Problem, ProblemError, Setup};
use shadowstep::systems::wisdom_holman::Bodies;
use shadowstep_schemes::symbolic::{Budget, nearest};

use super::given::Given;
use super::kinetic;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::run::arithmetic::{ANY_SIZE, GUARD_DIGITS, MOST_VALUE_DIGITS};
use crate::scene::{InitialValueProblem, KineticEnergy};
use shadowstep_schemes::document::Text;

/// The problem of this name; with its bodies and their dimensions, if it has bodies that attract each other.
pub(super) fn problem(
    reader: &mut Reader<'_>,
    given: &Given<'_, '_>,
    name: &Text,
) -> Option<(InitialValueProblem, Option<(Bodies, usize)>)> {
    let setup = setup(reader, given, name)?;
    let bodies = setup.bodies();
    let mut problem = InitialValueProblem::of_setup(setup);
    problem.parameters = reader.known.iter().map(|(name, value)| (name.clone(), value.clone())).collect();
    let KineticEnergy::Masses(masses) = &mut problem.kinetic else {
        unreachable!("T of shipped problems is by masses")
    };
    if let Some(mass) = masses.as_deref().and_then(|masses| reader.arithmetic.mass_out_of_range(masses)) {
        let message = kinetic::out_of_range(mass, reader.arithmetic);
        reader.toml.fault(&name.at, message, ANY_SIZE);
        // with which the rest is read
        *masses = None;
    }
    let values = |reader: &mut Reader<'_>, numbers: &Numbers| numbers.values(reader, problem.coordinates.len());
    let (q, p) = given.state.values(reader, values, masses.as_deref());
    for (own, names, values) in [(&q, &problem.coordinates, &problem.q), (&p, &problem.momenta, &problem.p)] {
        let mut values = names.iter().zip(values);
        let short = values.find(|(_, value)| own.is_none() && !reader.arithmetic.has_digits_of(value));
        if let Some((value, _)) = short {
            let message = format!("{value} is irrational and computed to {MOST_VALUE_DIGITS} digits");
            let help = format!("use digits = {} or less, or other parameters", MOST_VALUE_DIGITS - GUARD_DIGITS);
            reader.toml.fault(&name.at, message, help);
        }
    }
    problem.q = q.unwrap_or(problem.q);
    problem.p = p.unwrap_or(problem.p);
    Some((problem, bodies))
}

/// The shipped problem with its parameters, which become known to the reader.
fn setup(reader: &mut Reader<'_>, given: &Given<'_, '_>, name: &Text) -> Option<Setup> {
    let problem = match problems::problem(&name.value) {
        Ok(problem) => problem,
        Err(ProblemError::UnknownProblem { hint, .. }) => {
            return reader.toml.wrong(&name.at, format!("there is no problem `{}`", name.value), hint);
        }
        Err(error) => return reader.toml.wrong(&name.at, error.to_string(), "`shadowstep problems` lists all"),
    };
    let parameters = problem.description().parameters;
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
    refuse_unknown_parameters(reader, given, problem.name(), &names);
    let value_of = |name: &str| given.parameters.iter().find(|(key, _)| key.value == name).map(|(_, text)| text);
    for parameter in parameters {
        let value = match value_of(parameter.name) {
            Some(text) => Some(reader.evaluate(text)?),
            // a default that cannot be evaluated is a fault of the setup below
            None => {
                let (default, digits) = (Text::alone(parameter.default), reader.arithmetic.value_digits());
                default.evaluate(&reader.known, digits, &Budget::default()).ok()
            }
        };
        if let Some(value) = value {
            reader.define(parameter.name, value, value_of(parameter.name), &given.problem.at);
        }
    }
    if !reader.names.is_empty()
        && let Some(setup) = setup_with_numbers(reader, problem, &names, |name| value_of(name).is_some())
    {
        return Some(setup);
    }
    let set: Vec<_> =
        names.iter().filter_map(|name| Some(((*name).to_owned(), text(reader, name, value_of(name)?)))).collect();
    let place = |name: &str| value_of(name).map_or(given.problem.at.clone(), |text| text.at.clone());
    match problem.setup(&set, reader.arithmetic.value_digits()) {
        Ok(setup) => Some(setup),
        Err(ProblemError::OutOfRange { name, text, range }) => {
            reader.toml.wrong(&place(name), format!("{name} = {text} is out of range"), range)
        }
        Err(ProblemError::NoValue { name, text, why }) => {
            let help = "choose other parameters";
            reader.toml.wrong(&place(&name), format!("{name} = {text}: {why}"), help)
        }
        Err(error) => reader.toml.wrong(&given.problem.at, error.to_string(), "see `shadowstep problems`"),
    }
}

/// The problem with the values of the parameters that are given, which were evaluated; `None` where its text is to say
/// what is wrong.
fn setup_with_numbers(
    reader: &Reader<'_>,
    problem: Problem,
    names: &[&str],
    is_given: impl Fn(&str) -> bool,
) -> Option<Setup> {
    let given = names.iter().filter(|name| is_given(name));
    let set = given.map(|name| Some(((*name).to_owned(), reader.arithmetic.number(reader.known.get(*name)?))));
    problem.setup_with_numbers(&set.collect::<Option<Vec<_>>>()?, reader.arithmetic.value_digits()).ok()
}

/// The text of a parameter's value: its formula, or its value where that may contain names that the problem does not
/// know.
fn text(reader: &Reader<'_>, name: &str, formula: &Text) -> String {
    match reader.known.get(name).filter(|_| !reader.names.is_empty()) {
        Some(value) => reader.arithmetic.text(value),
        None => formula.value.clone(),
    }
}

fn refuse_unknown_parameters(reader: &mut Reader<'_>, given: &Given<'_, '_>, problem: &str, names: &[&str]) {
    for (key, _) in given.parameters.iter().filter(|(key, _)| !names.contains(&key.value.as_str())) {
        let help = match nearest(&key.value, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.is_empty() => "it has no parameters; the initial state is set in [initial]".to_owned(),
            None => format!("it has {}; the initial state is set in [initial]", names.join(", ")),
        };
        reader.toml.fault(&key.at, format!("{problem} has no parameter `{}`", key.value), help);
    }
}
