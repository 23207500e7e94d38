//! A shipped problem with parameters and a state that may be other ones.

use shadowstep::problems::{ProblemError, Setup, problem};
use shadowstep_symbolic::{evaluate, nearest, parse};

use super::problem::Given;
use crate::arithmetic::{GUARD_DIGITS, MOST_VALUE_DIGITS};
use crate::scene::reader::{Reader, Text};
use crate::scene::system::{KineticEnergy, PotentialEnergy, System};

impl Given {
    /// The problem of this name.
    pub(super) fn shipped(self, reader: &mut Reader<'_>, name: &Text) -> Option<System> {
        self.refuse(
            reader,
            &["coordinates", "momenta", "masses", "kinetic", "bodies", "dimensions", "neighbours"],
            |key| {
                let help = format!("leave out `{key}`, or write a `potential` or `pair` in place of the name");
                (format!("{} has {key} of its own", name.value), help)
            },
        );
        let setup = self.setup(reader, name)?;
        let (coordinates, q): (Vec<_>, Vec<_>) = setup.values.positions().iter().cloned().unzip();
        let (momenta, p): (Vec<_>, Vec<_>) = setup.values.momenta().iter().cloned().unzip();
        let masses = setup.values.masses().map(<[_]>::to_vec);
        let (own_q, own_p) =
            self.state.values(reader, |reader, numbers| numbers.values(reader, coordinates.len()), masses.as_deref());
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
            potential: PotentialEnergy::Shipped(setup),
            kinetic: KineticEnergy::Masses(masses),
            coordinates,
            momenta,
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
        let parameters = problem.description().parameters;
        let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
        self.refuse_unknown_parameters(reader, problem.name(), &names);
        let given = |name: &str| self.parameters.iter().find(|(key, _)| key.value == name).map(|(_, text)| text);
        for parameter in parameters {
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
}
