//! [problem]: a shipped problem, or a potential with coordinates, parameters and masses.

use std::collections::BTreeMap;
use std::ops::Range;

use num_traits::{One, Signed};
use shadowstep::Rational;
use shadowstep::problems::{ProblemError, Setup, problem};
use shadowstep_symbolic::{Exact, Expression, Kind, evaluate, nearest, parse};
use toml::de::DeValue;

use super::initial::State;
use crate::arithmetic::{GUARD_DIGITS, MOST_VALUE_DIGITS};
use crate::scene::reader::{List, Reader, Section, Text};
use crate::scene::system::{PotentialEnergy, System, formula_potential};
use crate::scene::write::COLUMNS;

/// What moves, and where from.
pub(super) fn system(reader: &mut Reader<'_>, problem: &Section<'_, '_>, initial: &Section<'_, '_>) -> Option<System> {
    let (name, potential) = (reader.get(problem, "name"), reader.get(problem, "potential"));
    let both = name.zip(potential).map(|(_, potential)| potential.span());
    let neither = name.is_none() && potential.is_none();
    let name = name.and_then(|value| reader.text(value));
    let potential = potential.and_then(|value| reader.text(value));
    let given = Given {
        coordinates: reader.list_of(problem, "coordinates", "a list of names: [\"x\", \"y\"]", Reader::text),
        masses: reader.list_of(problem, "masses", "a list of numbers: [1, 2]", Reader::number),
        parameters: parameters(reader, problem),
        state: State::read(reader, initial),
        problem: problem.at.clone(),
        initial: initial.is_there().then(|| initial.at.clone()),
    };
    if let Some(at) = both {
        return reader.wrong(&at, "name and potential are both given", "keep one of the two");
    }
    if neither {
        reader.missing(problem, "potential");
        return None;
    }
    if name.is_none() && reader.get(problem, "coordinates").is_none() {
        reader.missing(problem, "coordinates");
    }
    match (name, potential) {
        (Some(name), _) => given.shipped(reader, &name),
        (_, Some(potential)) => given.formula(reader, &potential),
        (None, None) => None,
    }
}

/// What the scene says besides the problem's name or its potential.
struct Given {
    coordinates: Option<List>,
    masses: Option<List>,
    parameters: Vec<(Text, Text)>,
    state: State,
    /// Places of the sections.
    problem: Range<usize>,
    initial: Option<Range<usize>>,
}

impl Given {
    fn shipped(self, reader: &mut Reader<'_>, name: &Text) -> Option<System> {
        for (key, list) in [("coordinates", &self.coordinates), ("masses", &self.masses)] {
            if let Some(list) = list {
                let message = format!("{} has {key} of its own", name.value);
                reader.fault(&list.at, message, "leave them out, or write the `potential` in place of the name");
            }
        }
        let setup = self.setup(reader, name)?;
        let (coordinates, q): (Vec<_>, Vec<_>) = setup.positions().iter().cloned().unzip();
        let (momenta, p): (Vec<_>, Vec<_>) = setup.momenta().iter().cloned().unzip();
        let masses = setup.masses.clone();
        let (own_q, own_p) = self.state.values(reader, coordinates.len(), masses.as_deref());
        for (given, names, values) in [(&own_q, &coordinates, &q), (&own_p, &momenta, &p)] {
            let mut values = names.iter().zip(values);
            let short = values.find(|(_, value)| given.is_none() && !reader.arithmetic.has_digits_of(value));
            if let Some((value, _)) = short {
                let message = format!("{value} is irrational and computed to {MOST_VALUE_DIGITS} digits");
                let help = format!("use digits = {} or less, or other parameters", MOST_VALUE_DIGITS - GUARD_DIGITS);
                reader.fault(&name.at, message, help);
            }
        }
        Some(System {
            parameters: reader.known.iter().map(|(name, value)| (name.clone(), value.clone())).collect(),
            energy: PotentialEnergy::Shipped(setup),
            coordinates,
            momenta,
            masses,
            q: own_q.unwrap_or(q),
            p: own_p.unwrap_or(p),
        })
    }

    /// The shipped problem with its parameters, which become known to the reader.
    fn setup(&self, reader: &mut Reader<'_>, name: &Text) -> Option<Setup> {
        let problem = match problem(&name.value) {
            Ok(problem) => problem,
            Err(ProblemError::UnknownProblem { hint, .. }) => {
                return reader.wrong(&name.at, format!("there is no problem `{}`", name.value), hint);
            }
            Err(error) => return reader.wrong(&name.at, error.to_string(), "`shadowstep problems` lists all"),
        };
        let names: Vec<&str> = problem.parameters.iter().map(|parameter| parameter.name).collect();
        self.refuse_unknown_parameters(reader, problem.name, &names);
        let given = |name: &str| self.parameters.iter().find(|(key, _)| key.value == name).map(|(_, text)| text);
        for parameter in problem.parameters {
            let value = match given(parameter.name) {
                Some(text) => Some(reader.evaluate(text)?),
                None => {
                    let default = parse(parameter.default).ok();
                    default.and_then(|d| evaluate(&d, &reader.known, reader.arithmetic.value_digits()).ok())
                }
            };
            // a default that has no value with the others is a fault of the setup below
            reader.known.extend(value.map(|value| (parameter.name.to_owned(), value)));
        }
        let set: Vec<_> =
            names.iter().filter_map(|name| Some(((*name).to_owned(), given(name)?.value.clone()))).collect();
        let place = |name: &str| given(name).map_or(self.problem.clone(), |text| text.at.clone());
        match problem.setup(&set, reader.arithmetic.value_digits()) {
            Ok(setup) => Some(setup),
            Err(ProblemError::OutOfRange { name, text, range }) => {
                reader.wrong(&place(name), format!("{name} = {text} is out of range"), range)
            }
            Err(ProblemError::NoValue { name, text, why }) => {
                let help = "other parameters give it a value";
                reader.wrong(&place(&name), format!("{name} = {text}: {why}"), help)
            }
            Err(error) => reader.wrong(&self.problem, error.to_string(), "see `shadowstep problems`"),
        }
    }

    fn refuse_unknown_parameters(&self, reader: &mut Reader<'_>, problem: &str, names: &[&str]) {
        for (key, _) in self.parameters.iter().filter(|(key, _)| !names.contains(&key.value.as_str())) {
            let help = match nearest(&key.value, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None if names.is_empty() => "it has none; the state is set in [initial]".to_owned(),
                None => format!("it has {}; the state is set in [initial]", names.join(", ")),
            };
            reader.fault(&key.at, format!("{problem} has no parameter `{}`", key.value), help);
        }
    }

    fn formula(self, reader: &mut Reader<'_>, potential: &Text) -> Option<System> {
        let parameters = self.own_parameters(reader);
        let list = self.coordinates.as_ref()?;
        let before = reader.faults.len();
        let coordinates = self.names(reader, list);
        let momenta = coordinates.iter().map(|name| format!("p{name}")).collect();
        if reader.faults.len() == before
            && let Err(error) = formula_potential::<f64>(&potential.value, &coordinates, &parameters, &())
        {
            let help = "a potential is a smooth formula such as \"-1/sqrt(x^2 + y^2)\"";
            reader.fault(&potential.place(&error.range()), error.to_string(), help);
        }
        let masses = self.masses.as_ref().and_then(|list| masses(reader, list, coordinates.len()));
        if let Some(initial) = &self.initial {
            self.state.all_there(reader, initial);
        }
        let (q, p) = self.state.values(reader, coordinates.len(), masses.as_deref());
        let energy = PotentialEnergy::Formula(potential.value.clone());
        Some(System { energy, parameters, coordinates, momenta, masses, q: q?, p: p? })
    }

    /// Names and values, which become known to the reader.
    fn own_parameters(&self, reader: &mut Reader<'_>) -> Vec<(String, Exact)> {
        let mut parameters = Vec::new();
        for (name, text) in &self.parameters {
            check_name(reader, name);
            // a parameter without a value stands as 1, so that its users add no faults of their own
            let value = reader.evaluate(text).unwrap_or(Exact { value: Rational::one(), rounded: false });
            reader.known.insert(name.value.clone(), value.clone());
            parameters.push((name.value.clone(), value));
        }
        parameters
    }

    /// The names of the coordinates; each is new, and so is that of its momentum.
    fn names(&self, reader: &mut Reader<'_>, list: &List) -> Vec<String> {
        let mut taken: Vec<(String, String)> =
            COLUMNS.iter().map(|name| ((*name).to_owned(), "of a column of the output".to_owned())).collect();
        taken.extend(self.parameters.iter().map(|(name, _)| (name.value.clone(), "of a parameter".to_owned())));
        for name in &list.texts {
            check_name(reader, name);
            let names = [name.value.clone(), format!("p{}", name.value)];
            if let Some((other, whose)) = taken.iter().find(|(other, _)| names.contains(other)) {
                let message = match *other == name.value {
                    true if whose == COORDINATE => format!("the coordinate `{other}` is named twice"),
                    true => format!("the coordinate `{other}` has the name {whose}"),
                    false => format!("the momentum `{other}` of `{}` has the name {whose}", name.value),
                };
                reader.fault(&name.at, message, "give it another name");
            }
            let [coordinate, momentum] = names;
            taken.push((coordinate, COORDINATE.to_owned()));
            taken.push((momentum, format!("of the momentum of `{}`", name.value)));
        }
        list.texts.iter().map(|name| name.value.clone()).collect()
    }
}

const COORDINATE: &str = "of a coordinate";

/// Names and values in the order of the text.
fn parameters(reader: &mut Reader<'_>, problem: &Section<'_, '_>) -> Vec<(Text, Text)> {
    let Some(value) = reader.get(problem, "parameters") else { return Vec::new() };
    let DeValue::Table(table) = value.get_ref() else {
        reader.wrong_kind::<()>(value, "a table: { depth = 2 }");
        return Vec::new();
    };
    let mut found: Vec<_> =
        table.iter().filter_map(|(key, value)| Some((Text::of_key(key), reader.number(value)?))).collect();
    found.sort_by_key(|(name, _)| name.at.start);
    found
}

/// The masses, unless all are 1.
fn masses(reader: &mut Reader<'_>, list: &List, coordinates: usize) -> Option<Vec<Exact>> {
    let values = reader.values(list, coordinates)?;
    for (value, text) in values.iter().zip(&list.texts).filter(|(value, _)| !value.value.is_positive()) {
        let message = format!("a mass of {} is not positive", reader.arithmetic.text(value));
        reader.fault(&text.at, message, "masses are positive");
    }
    values.iter().any(|mass| !mass.value.is_one()).then_some(values)
}

/// Refuses what formulas cannot have as a name.
fn check_name(reader: &mut Reader<'_>, name: &Text) {
    let is_name = |expression: &Expression| matches!(&expression.kind, Kind::Name(whole) if *whole == name.value);
    match parse(&name.value) {
        Ok(expression) if is_name(&expression) => {
            // a name that has a value without being given one is that of a constant
            if evaluate(&expression, &BTreeMap::new(), 1).is_ok() {
                reader.fault(&name.at, format!("`{}` is a constant", name.value), "give it another name");
            }
        }
        _ => {
            let help = "a name begins with a letter and goes on with letters, digits and _";
            reader.fault(&name.at, format!("`{}` is no name", name.value), help);
        }
    }
}
