//! Bodies and the energy of each pair of them.

use shadowstep::pairs::{Ends, Separation};
use shadowstep_symbolic::{Expression, Kind, parse};
use toml::de::DeValue;

use super::formula::masses;
use super::numbers::{Bodies, NUMBER, Numbers};
use super::problem::{Given, check_name};
use crate::complaint::remark;
use crate::scene::pairs::PairEnergy;
use crate::scene::reader::{Reader, Text, Value};
use crate::scene::system::{KineticEnergy, PotentialEnergy, System};

/// More bodies than anyone can wait for.
const MOST_BODIES: u64 = 100_000;

/// The key among the properties that says how many bodies there are.
const COUNT: &str = "count";

/// The energy of a pair, as the scene has it.
pub(super) struct PairFormula {
    pub(super) text: Text,
    pub(super) separation: Separation,
}

impl PairFormula {
    /// Finds out what the formula is in.
    pub(super) fn read(reader: &mut Reader<'_>, text: Text) -> Option<PairFormula> {
        let help = "r2 is the square of the distance, d = q_j - q_i the difference on a line: \"-g*m_i*m_j/sqrt(r2)\"";
        let expression = match parse(&text.value) {
            Ok(expression) => expression,
            Err(error) => return reader.wrong(&text.place(&error.range), error.to_string(), help),
        };
        let mut found = Vec::new();
        separations(&expression, &mut found);
        found.dedup();
        match found[..] {
            [separation] => Some(PairFormula { text, separation }),
            [] => reader.wrong(&text.at, "the energy of a pair is a formula in `r2` or in `d`, here is neither", help),
            _ => reader.wrong(&text.at, "the energy of a pair is a formula in `r2` or in `d`, here are both", help),
        }
    }
}

fn separations(expression: &Expression, found: &mut Vec<Separation>) {
    match &expression.kind {
        Kind::Number(_) => {}
        Kind::Name(name) => found.extend(Separation::named(name)),
        Kind::Negate(inner) => separations(inner, found),
        Kind::Binary(_, left, right) => [left, right].into_iter().for_each(|part| separations(part, found)),
        Kind::Call { arguments, .. } => arguments.iter().for_each(|part| separations(part, found)),
    }
}

/// The bodies, as the scene has them.
pub(super) enum GivenBodies {
    Count(u64),
    Properties(Vec<(Text, Property)>),
}

/// What stands in the table of properties.
pub(super) enum Property {
    Count(u64),
    Values(Numbers),
}

impl GivenBodies {
    pub(super) fn read(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<GivenBodies> {
        match value.get_ref() {
            DeValue::Integer(_) => reader.whole(value, 1..=MOST_BODIES).map(GivenBodies::Count),
            DeValue::Table(table) => {
                let mut properties = Vec::new();
                for (key, value) in table {
                    let property = match key.get_ref().as_ref() == COUNT {
                        true => reader.whole(value, 1..=MOST_BODIES).map(Property::Count),
                        false => Numbers::of_bodies(reader, value).map(Property::Values),
                    };
                    properties.push(property.map(|property| (Text::of_key(key), property)));
                }
                let mut properties = properties.into_iter().collect::<Option<Vec<_>>>()?;
                properties.sort_by_key(|(name, _)| name.at.start);
                Some(GivenBodies::Properties(properties))
            }
            _ => reader.wrong_kind(value, "the number of bodies, or a table of their properties: { m = [1, 2] }"),
        }
    }
}

impl Given {
    /// The system of bodies with this energy of each pair.
    pub(super) fn pairs(self, reader: &mut Reader<'_>, pair: Option<PairFormula>) -> Option<System> {
        self.refuse(reader, &["coordinates", "momenta"], |key| {
            let names = "x1, y1, …, px1, py1, …, or on a line q1, …, p1, …";
            (format!("with `pair` {key} have names by themselves"), format!("leave out `{key}`: the names are {names}"))
        });
        let parameters = self.own_parameters(reader);
        self.parameters.iter().for_each(|(name, _)| refuse_reserved(reader, name));
        let dimensions = self.dimensions(reader, pair.as_ref());
        let bodies = self.bodies(reader, dimensions);
        if let Some(initial) = &self.initial {
            self.state.all_there(reader, initial);
        }
        let (pair, bodies) = (pair?, bodies?);
        let dimensions = dimensions?;
        let (coordinates, momenta) = names(&bodies);
        self.refuse_names_of_bodies(reader, &coordinates, &momenta);
        let energy = PairEnergy {
            formula: pair.text.value.clone(),
            separation: pair.separation,
            dimensions,
            bodies: bodies.count,
            properties: bodies.properties.clone(),
            ends: self.ends(reader, &bodies),
        };
        if let Err(error) = energy.pair::<f64>(&parameters, &()) {
            let help = "the energy of a pair is a smooth formula such as \"-g*m_i*m_j/sqrt(r2)\"";
            reader.fault(&pair.text.place(&error.range()), error.to_string(), help);
        }
        let kinetic = self.kinetic_energy(reader, &momenta, &parameters);
        let masses = self.masses.as_ref().and_then(|numbers| {
            let values = bodies.values(reader, numbers)?;
            let masses = masses(reader, numbers, values)?;
            Some(masses.into_iter().flat_map(|mass| vec![mass; dimensions]).collect::<Vec<_>>())
        });
        let (q, p) =
            self.state.values(reader, |reader, numbers| bodies.values_in_space(reader, numbers), masses.as_deref());
        if self.place("masses").or(self.place("kinetic")).is_none() {
            remark_on_masses(&bodies);
        }
        let kinetic = kinetic.unwrap_or(KineticEnergy::Masses(masses));
        let potential = PotentialEnergy::Pairs(energy);
        Some(System { potential, kinetic, parameters, coordinates, momenta, q: q?, p: p? })
    }

    /// How many dimensions there are: on a line one.
    fn dimensions(&self, reader: &mut Reader<'_>, pair: Option<&PairFormula>) -> Option<usize> {
        let on_a_line = pair.is_some_and(|pair| pair.separation == Separation::Difference);
        match (self.dimensions, self.place("dimensions")) {
            (Some(dimensions), Some(at)) if on_a_line && dimensions != 1 => {
                let message = format!("a formula in d is for bodies on a line, and here are {dimensions} dimensions");
                reader.wrong(at, message, "leave it out, or write the formula in `r2`")
            }
            (None, None) => on_a_line.then_some(1),
            (dimensions, _) => dimensions,
        }
    }

    /// The bodies with their properties.
    fn bodies(&self, reader: &mut Reader<'_>, dimensions: Option<usize>) -> Option<Bodies> {
        let at = self.place("bodies")?;
        let given = match self.bodies.as_ref()? {
            GivenBodies::Count(count) => {
                return Some(Bodies { count: *count as usize, dimensions: dimensions?, properties: Vec::new() });
            }
            GivenBodies::Properties(given) => given,
        };
        let counted = given.iter().find_map(|(_, property)| match property {
            Property::Count(count) => Some(*count as usize),
            Property::Values(_) => None,
        });
        let listed = given.iter().find_map(|(_, property)| match property {
            Property::Values(Numbers::List(list)) => Some(list.texts.len()),
            _ => None,
        });
        let Some(count) = counted.or(listed) else {
            let help = "write `bodies = 32`, or among the properties `count = 32`";
            return reader.wrong(at, "how many bodies there are is not said", help);
        };
        let before = reader.faults.len();
        let mut bodies = Bodies { count, dimensions: dimensions.unwrap_or(1), properties: Vec::new() };
        for (name, property) in given {
            let Property::Values(numbers) = property else { continue };
            self.check_property(reader, name);
            // each may use those before it
            if let Some(values) = bodies.values(reader, numbers) {
                bodies.properties.push((name.value.clone(), values));
            }
        }
        (reader.faults.len() == before && dimensions.is_some()).then_some(bodies)
    }

    /// The name of a property is one, and in formulas it is none of a parameter.
    fn check_property(&self, reader: &mut Reader<'_>, name: &Text) {
        check_name(reader, name);
        refuse_reserved(reader, name);
        let own = [name.value.clone(), format!("{}_i", name.value), format!("{}_j", name.value)];
        for (parameter, _) in self.parameters.iter().filter(|(parameter, _)| own.contains(&parameter.value)) {
            let message = format!("the parameter `{}` has the name of a property of the bodies", parameter.value);
            reader.fault(&parameter.at, message, "give it another name");
        }
    }

    fn refuse_names_of_bodies(&self, reader: &mut Reader<'_>, coordinates: &[String], momenta: &[String]) {
        for (name, _) in &self.parameters {
            for (names, what) in [(coordinates, "coordinate"), (momenta, "momentum")] {
                if names.contains(&name.value) {
                    let message = format!("the parameter `{}` has the name of a {what} of the bodies", name.value);
                    reader.fault(&name.at, message, "give it another name");
                }
            }
        }
    }

    /// The ends of a chain, unless all pairs interact.
    fn ends(&self, reader: &mut Reader<'_>, bodies: &Bodies) -> Option<Ends> {
        let ends = self.neighbours;
        let at = self.place("bodies").unwrap_or(&self.problem);
        if ends == Some(Ends::Fixed) && !bodies.properties.is_empty() {
            let message = "between fixed ends bodies have no properties: the walls would need them, too";
            reader.fault(at, message, "write `bodies = 32`, or neighbours = \"free\" or \"periodic\"");
        }
        if ends != Some(Ends::Fixed) && bodies.count == 1 {
            reader.fault(at, "one body makes no pair", "two bodies do, or one with neighbours = \"fixed\"");
        }
        ends
    }
}

/// Tells that a property of this name is no mass of T by itself.
fn remark_on_masses(bodies: &Bodies) {
    if let Some((name, _)) = bodies.properties.iter().find(|(name, _)| ["m", "mass"].contains(&name.as_str())) {
        remark(format_args!("all masses of T are 1; `masses = \"{name}\"` takes them from the property {name}"));
    }
}

/// Refuses the names that formulas have already.
fn refuse_reserved(reader: &mut Reader<'_>, name: &Text) {
    let meaning = match (Separation::named(&name.value), name.value.as_str()) {
        (Some(Separation::Difference), _) => Some("the difference q_j - q_i"),
        (Some(Separation::SquaredDistance), _) => Some("the square of the distance"),
        (None, NUMBER) => Some("the number of a body"),
        (None, _) => None,
    };
    if let Some(meaning) = meaning {
        reader.fault(&name.at, format!("with `pair`, `{}` is {meaning}", name.value), "give it another name");
    }
}

/// The names of the coordinates and momenta, body after body.
fn names(bodies: &Bodies) -> (Vec<String>, Vec<String>) {
    let axes: &[&str] = if bodies.dimensions == 1 { &["q"] } else { &["x", "y", "z"][..bodies.dimensions] };
    let momentum = |axis: &str| if bodies.dimensions == 1 { "p".to_owned() } else { format!("p{axis}") };
    let each = |name: &dyn Fn(&str) -> String| {
        (1..=bodies.count).flat_map(|body| axes.iter().map(move |axis| format!("{}{body}", name(axis)))).collect()
    };
    (each(&|axis| axis.to_owned()), each(&momentum))
}
