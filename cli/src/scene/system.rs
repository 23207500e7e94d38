//! What moves: a shipped problem or a formula's potential, its masses and its state at t = 0.

use std::ops::Range;

use num_traits::{One, Signed};
use shadowstep::formula::FormulaPotential;
use shadowstep::problems::{ProblemError, Setup, problem};
use shadowstep::{DiagonalMasses, Kinetic, Motion, Number, Potential, Rational, UnitMasses};
use shadowstep_symbolic::{Exact, Expression, Kind, evaluate, nearest, parse};
use toml::de::DeValue;

use crate::arithmetic::{GUARD_DIGITS, MOST_VALUE_DIGITS};
use crate::scene::reader::{List, Reader, Section, Text, Value};
use crate::scene::write::COLUMNS;

/// H = T(p) + U(q) and the state at t = 0, all exact.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) energy: PotentialEnergy,
    /// Names and values.
    pub(crate) parameters: Vec<(String, Exact)>,
    /// Names of q_1, q_2, ….
    pub(crate) coordinates: Vec<String>,
    /// Names of p_1, p_2, ….
    pub(crate) momenta: Vec<String>,
    /// One for each coordinate, unless all are 1.
    pub(crate) masses: Option<Vec<Exact>>,
    pub(crate) q: Vec<Exact>,
    pub(crate) p: Vec<Exact>,
}

/// U(q)
#[derive(Debug)]
pub(crate) enum PotentialEnergy {
    Shipped(Setup),
    Formula(String),
}

/// A system in motion.
pub(crate) type Moving<N> = Motion<N, Vec<N>, Box<dyn Potential<N>>, Masses<N>>;

impl System {
    /// Positions and momenta at t = 0.
    pub(crate) fn start<N: Number>(&self, context: &N::Context) -> (Vec<N>, Vec<N>) {
        let numbers = |values: &[Exact]| values.iter().map(|v| N::from_rational(&v.value, context)).collect();
        (numbers(&self.q), numbers(&self.p))
    }

    /// The system at q, p.
    pub(crate) fn motion<N: Number + 'static>(&self, q: Vec<N>, p: Vec<N>, context: &N::Context) -> Moving<N> {
        Motion::new(self.potential(context), self.kinetic(context), q, p)
    }

    fn potential<N: Number + 'static>(&self, context: &N::Context) -> Box<dyn Potential<N>> {
        match &self.energy {
            PotentialEnergy::Shipped(setup) => setup.potential(context),
            PotentialEnergy::Formula(formula) => {
                let potential = formula_potential::<N>(formula, &self.coordinates, &self.parameters, context);
                Box::new(potential.expect("the formula was read with the scene"))
            }
        }
    }

    fn kinetic<N: Number>(&self, context: &N::Context) -> Masses<N> {
        let Some(masses) = &self.masses else { return Masses::Unit };
        let masses: Vec<Rational> = masses.iter().map(|mass| mass.value.clone()).collect();
        Masses::Diagonal(DiagonalMasses::new(&masses, context).expect("the masses were read with the scene"))
    }

    /// Reads the sections [problem] and [initial].
    pub(crate) fn read(reader: &mut Reader<'_>, problem: &Section<'_, '_>, initial: &Section<'_, '_>) -> Option<Self> {
        let (name, potential) = (reader.get(problem, "name"), reader.get(problem, "potential"));
        let both = name.zip(potential).map(|(_, potential)| potential.span());
        let neither = name.is_none() && potential.is_none();
        let name = name.and_then(|value| reader.text(value));
        let potential = potential.and_then(|value| reader.text(value));
        let given = Given {
            coordinates: list(reader, problem, "coordinates", "a list of names: [\"x\", \"y\"]", Reader::text),
            masses: list(reader, problem, "masses", "a list of numbers: [1, 2]", Reader::number),
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
        match (name, potential) {
            (Some(name), _) => given.shipped(reader, &name),
            (_, Some(potential)) => given.formula(reader, &potential),
            (None, None) => None,
        }
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
        let of = |names: &[(&'static str, &'static str)]| -> (Vec<String>, Vec<Exact>) {
            let value = |name| setup.values.iter().find(|(known, _)| known == name).map(|(_, value)| value.clone());
            names.iter().filter_map(|(name, _)| Some(((*name).to_owned(), value(name)?))).unzip()
        };
        let (coordinates, q) = of(setup.problem.positions);
        let (momenta, p) = of(setup.problem.momenta);
        let (own_q, own_p) = self.state.values(reader, coordinates.len(), None);
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
            masses: None,
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
        for (key, _) in self.parameters.iter().filter(|(key, _)| !names.contains(&key.value.as_str())) {
            let help = match nearest(&key.value, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None if names.is_empty() => "it has none; the state is set in [initial]".to_owned(),
                None => format!("it has {}; the state is set in [initial]", names.join(", ")),
            };
            reader.fault(&key.at, format!("{} has no parameter `{}`", problem.name, key.value), help);
        }
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

    fn formula(self, reader: &mut Reader<'_>, potential: &Text) -> Option<System> {
        let before = reader.faults.len();
        let mut parameters = Vec::new();
        for (name, text) in &self.parameters {
            is_name(reader, name);
            // a parameter without a value stands as 1, so that its users add no faults of their own
            let value = reader.evaluate(text).unwrap_or(Exact { value: Rational::one(), rounded: false });
            reader.known.insert(name.value.clone(), value.clone());
            parameters.push((name.value.clone(), value));
        }
        let Some(list) = &self.coordinates else {
            // a list that is no list is told of already
            if reader.faults.len() == before {
                let help = "add `coordinates = [\"x\", \"y\"]`, all names in the potential that are no parameters";
                reader.fault(&self.problem, "the key `coordinates` is missing", help);
            }
            return None;
        };
        let coordinates = self.names(reader, list);
        let momenta = coordinates.iter().map(|name| format!("p{name}")).collect();
        if reader.faults.len() == before
            && let Err(error) = formula_potential::<f64>(&potential.value, &coordinates, &parameters, &())
        {
            let help = "a potential is a smooth formula such as \"-1/sqrt(x^2 + y^2)\"";
            reader.fault(&potential.place(&error.range()), error.to_string(), help);
        }
        let masses = self.masses.as_ref().and_then(|list| {
            let values = reader.values(list, coordinates.len())?;
            for (value, text) in values.iter().zip(&list.texts).filter(|(value, _)| !value.value.is_positive()) {
                let message = format!("a mass of {} is not positive", reader.arithmetic.text(value));
                reader.fault(&text.at, message, "masses are positive");
            }
            values.iter().any(|mass| !mass.value.is_one()).then_some(values)
        });
        if let Some(initial) = &self.initial {
            self.state.all_there(reader, initial);
        }
        let (q, p) = self.state.values(reader, coordinates.len(), masses.as_deref());
        let energy = PotentialEnergy::Formula(potential.value.clone());
        Some(System { energy, parameters, coordinates, momenta, masses, q: q?, p: p? })
    }

    /// The names of the coordinates; each is new, and so is that of its momentum.
    fn names(&self, reader: &mut Reader<'_>, list: &List) -> Vec<String> {
        let mut taken: Vec<(String, String)> =
            COLUMNS.iter().map(|name| ((*name).to_owned(), "of a column of the output".to_owned())).collect();
        taken.extend(self.parameters.iter().map(|(name, _)| (name.value.clone(), "of a parameter".to_owned())));
        for name in &list.texts {
            is_name(reader, name);
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

/// The state as the scene says it.
struct State {
    q: Option<List>,
    p: Option<List>,
    /// Whether `p` is of velocities.
    velocities: bool,
    /// How many of the lists are there, right or wrong.
    has_q: bool,
    has_p: bool,
}

impl State {
    fn read(reader: &mut Reader<'_>, initial: &Section<'_, '_>) -> State {
        let what = "a list of numbers: [1, \"1/2\"]";
        let q = list(reader, initial, "q", what, Reader::number);
        let p = list(reader, initial, "p", what, Reader::number);
        let v = list(reader, initial, "v", what, Reader::number);
        let has = |key| reader.get(initial, key).is_some();
        let (has_q, has_p, velocities) = (has("q"), has("p") || has("v"), has("v"));
        if let (Some(_), Some(value)) = (reader.get(initial, "p"), reader.get(initial, "v")) {
            reader.fault(&value.span(), "p and v are both given", "keep one of the two");
        }
        State { q, p: v.or(p), velocities, has_q, has_p }
    }

    /// Refuses a state that is left out.
    fn all_there(&self, reader: &mut Reader<'_>, at: &Range<usize>) {
        for (there, key) in [(self.has_q, "q"), (self.has_p, "p")] {
            if !there {
                let help = format!("add `{key} = […]` to [initial], with a number for each coordinate");
                reader.fault(at, format!("the key `{key}` is missing"), help);
            }
        }
    }

    /// q and p, where they are given.
    fn values(
        &self,
        reader: &mut Reader<'_>,
        coordinates: usize,
        masses: Option<&[Exact]>,
    ) -> (Option<Vec<Exact>>, Option<Vec<Exact>>) {
        let q = self.q.as_ref().and_then(|list| reader.values(list, coordinates));
        let mut p = self.p.as_ref().and_then(|list| reader.values(list, coordinates));
        if let (true, Some(p), Some(masses)) = (self.velocities, &mut p, masses) {
            for (p, mass) in p.iter_mut().zip(masses) {
                p.value *= &mass.value;
                p.rounded |= mass.rounded;
            }
        }
        (q, p)
    }
}

fn list<'r>(
    reader: &mut Reader<'r>,
    section: &Section<'_, '_>,
    key: &str,
    what: &str,
    read: fn(&mut Reader<'r>, &Value<'_>) -> Option<Text>,
) -> Option<List> {
    reader.get(section, key).and_then(|value| reader.list(value, what, read))
}

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

/// Refuses what formulas cannot have as a name.
fn is_name(reader: &mut Reader<'_>, name: &Text) {
    let is_name = |expression: &Expression| matches!(&expression.kind, Kind::Name(whole) if *whole == name.value);
    match parse(&name.value) {
        Ok(expression) if is_name(&expression) => {
            // a name that has a value without being given one is that of a constant
            if evaluate(&expression, &Default::default(), 1).is_ok() {
                reader.fault(&name.at, format!("`{}` is a constant", name.value), "give it another name");
            }
        }
        _ => {
            let help = "a name begins with a letter and goes on with letters, digits and _";
            reader.fault(&name.at, format!("`{}` is no name", name.value), help);
        }
    }
}

fn formula_potential<N: Number>(
    formula: &str,
    coordinates: &[String],
    parameters: &[(String, Exact)],
    context: &N::Context,
) -> Result<FormulaPotential<N>, shadowstep::formula::FormulaError> {
    let coordinates: Vec<&str> = coordinates.iter().map(String::as_str).collect();
    let parameters: Vec<(&str, N)> =
        parameters.iter().map(|(name, exact)| (name.as_str(), N::from_rational(&exact.value, context))).collect();
    FormulaPotential::new(formula, &coordinates, &parameters)
}

/// T = ½pᵀM⁻¹p with the masses of a scene.
pub(crate) enum Masses<N> {
    Unit,
    Diagonal(DiagonalMasses<N>),
}

impl<N: Number> Kinetic<N> for Masses<N> {
    fn dimension(&self) -> Option<usize> {
        match self {
            Masses::Unit => None,
            Masses::Diagonal(masses) => masses.dimension(),
        }
    }

    fn drift(&self, weight: &N, p: &[N], q: &mut [N], velocity: &mut N) {
        match self {
            Masses::Unit => UnitMasses.drift(weight, p, q, velocity),
            Masses::Diagonal(masses) => masses.drift(weight, p, q, velocity),
        }
    }

    fn energy(&self, p: &[N], energy: &mut N, velocity: &mut N) {
        match self {
            Masses::Unit => UnitMasses.energy(p, energy, velocity),
            Masses::Diagonal(masses) => masses.energy(p, energy, velocity),
        }
    }
}
