//! The bodies of a scene with their properties, and lists with a number for each of them.

use shadowstep::Rational;
use shadowstep::systems::pairs::Separation;
use shadowstep_schemes::symbolic::Exact;

use super::names::check_name;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::document::schema::Table;
use shadowstep_schemes::document::Text;

/// The name of the number of a body in formulas.
const NUMBER: &str = "i";

/// The number of bodies, and their properties.
#[derive(Clone)]
pub(super) struct Bodies {
    pub(super) count: usize,
    /// Names, with a value for each body.
    pub(super) properties: Vec<(String, Vec<Exact>)>,
}

impl Bodies {
    /// The bodies of [problem] with their properties, for a formula with these parameters.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        problem: &Table<'_, '_>,
        parameters: &[(Text, Text)],
    ) -> Option<Bodies> {
        if let Some(count) = problem.whole("bodies") {
            return Some(Bodies { count: count as usize, properties: Vec::new() });
        }
        let table = problem.table("bodies")?;
        let mut given = Vec::new();
        for (name, value) in table.names() {
            given.push((name, Numbers::read(reader, value, true)?));
        }
        let listed = || given.iter().find_map(|(_, numbers)| numbers.count());
        let Some(count) = table.whole("count").map(|count| count as usize).or_else(listed) else {
            let help = "write `bodies = 32`, or add `count = 32` to the properties";
            return reader.toml.wrong(&table.at, "the number of bodies is missing", help);
        };
        let before = reader.toml.faults.len();
        let mut bodies = Bodies { count, properties: Vec::new() };
        for (name, numbers) in &given {
            check_property(reader, name, parameters);
            // each may use those before it
            if let Some(values) = bodies.values(reader, numbers) {
                bodies.properties.push((name.value.clone(), values));
            }
        }
        (reader.toml.faults.len() == before).then_some(bodies)
    }

    /// A number for each body.
    pub(super) fn values(&self, reader: &mut Reader<'_>, numbers: &Numbers) -> Option<Vec<Exact>> {
        match numbers {
            Numbers::List(list) => reader.values(list, self.count, "body"),
            Numbers::Lists(_, at) => {
                reader.toml.wrong(at, "this needs one number for each body", "write one list of numbers")
            }
            Numbers::Formula(formula) => self.formula(reader, formula),
        }
    }

    /// A number for each coordinate, body after body.
    pub(super) fn values_in_space(
        &self,
        reader: &mut Reader<'_>,
        numbers: &Numbers,
        dimensions: usize,
    ) -> Option<Vec<Exact>> {
        let count = self.count;
        match numbers {
            Numbers::List(list) => {
                let each = if dimensions == 1 { "body" } else { "coordinate of each body" };
                reader.values(list, count * dimensions, each)
            }
            Numbers::Lists(lists, at) if lists.len() != count => {
                let found = format!("{} lists", lists.len());
                reader.wrong_count(at, "this needs a list for each body", (found, count))
            }
            Numbers::Lists(lists, _) => {
                // where the dimensions are wrong, so are all lists
                let wrong = lists.iter().position(|list| list.value.len() != dimensions);
                let lists = &lists[..wrong.map_or(count, |wrong| wrong + 1)];
                let bodies: Vec<_> =
                    lists.iter().map(|list| reader.values(list, dimensions, "coordinate of the body")).collect();
                Some(bodies.into_iter().collect::<Option<Vec<_>>>()?.concat())
            }
            Numbers::Formula(formula) if dimensions == 1 => self.formula(reader, formula),
            Numbers::Formula(formula) => {
                let message = format!("a formula for all bodies requires one dimension, not {dimensions}");
                reader.toml.wrong(&formula.at, message, "write a list for each body: [[0, 0, 0], [1, 0, 0]]")
            }
        }
    }

    /// The values at i = 1, 2, …; the formula can contain the properties of body i. Only the first fault is reported.
    fn formula(&self, reader: &mut Reader<'_>, formula: &Text) -> Option<Vec<Exact>> {
        let parameters = reader.known.clone();
        let mut values = Vec::new();
        for body in 0..self.count {
            reader.known.insert(NUMBER.to_owned(), whole(body + 1));
            let own = self.properties.iter().map(|(name, values)| (name.clone(), values[body].clone()));
            reader.known.extend(own);
            let Some(value) = reader.evaluate(formula) else {
                // at the first body it may be a fault of the formula itself
                if let Some(fault) = reader.toml.faults.last_mut().filter(|_| body > 0) {
                    fault.message += &format!(", at i = {}", body + 1);
                }
                break;
            };
            values.push(value);
        }
        reader.known = parameters;
        (values.len() == self.count).then_some(values)
    }
}

fn whole(n: usize) -> Exact {
    Exact { value: Rational::from_integer(n.into()), rounded: false }
}

/// Refuses a name of a property that is not valid, or that a parameter has in formulas.
fn check_property(reader: &mut Reader<'_>, name: &Text, parameters: &[(Text, Text)]) {
    check_name(reader, name);
    refuse_reserved(reader, name);
    let own = [name.value.clone(), format!("{}_i", name.value), format!("{}_j", name.value)];
    for (parameter, _) in parameters.iter().filter(|(parameter, _)| own.contains(&parameter.value)) {
        let message = format!("the parameter `{}` has the name of a property of the bodies", parameter.value);
        reader.toml.fault(&parameter.at, message, "give it another name");
    }
}

/// Refuses names that have a meaning in formulas for bodies.
pub(super) fn refuse_reserved(reader: &mut Reader<'_>, name: &Text) {
    let meaning = match (Separation::named(&name.value), name.value.as_str()) {
        (Some(Separation::Difference), _) => Some("the difference q_j - q_i"),
        (Some(Separation::SquaredDistance), _) => Some("the square of the distance"),
        (None, NUMBER) => Some("the number of a body"),
        (None, _) => None,
    };
    if let Some(meaning) = meaning {
        reader.toml.fault(&name.at, format!("with `pair`, `{}` is {meaning}", name.value), "give it another name");
    }
}
