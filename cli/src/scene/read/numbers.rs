//! Numbers of coordinates and of bodies: a list, a list for each body, or one formula for all bodies.

use std::ops::Range;

use shadowstep_symbolic::Exact;
use toml::de::DeValue;

use crate::scene::reader::{List, Reader, Text, Value};

/// Numbers as the scene has them.
pub(super) enum Numbers {
    List(List),
    /// A list for each body.
    Lists(Vec<List>, Range<usize>),
    /// A formula in the number i of the body.
    Formula(Text),
}

impl Numbers {
    /// A number for each coordinate.
    pub(super) fn of_coordinates(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        reader.list(value, "a list of numbers: [1, \"1/2\"]", Reader::number).map(Numbers::List)
    }

    /// A number for each body.
    pub(super) fn of_bodies(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        if matches!(value.get_ref(), DeValue::String(_)) {
            return reader.text(value).map(Numbers::Formula);
        }
        let what = "a list with a number for each body, or a formula for all: \"1 + i/10\"";
        reader.list(value, what, Reader::number).map(Numbers::List)
    }

    /// A number for each coordinate of each body.
    pub(super) fn of_bodies_in_space(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        match value.get_ref() {
            DeValue::Array(bodies) if matches!(bodies.first().map(Value::get_ref), Some(DeValue::Array(_))) => {
                let what = "a list with the numbers of one body: [1, 0, 0]";
                let lists: Vec<_> = bodies.iter().map(|body| reader.list(body, what, Reader::number)).collect();
                Some(Numbers::Lists(lists.into_iter().collect::<Option<_>>()?, value.span()))
            }
            _ => Numbers::of_bodies(reader, value),
        }
    }

    /// Where the number of a body or coordinate is, counted from 0.
    pub(super) fn place(&self, index: usize) -> &Range<usize> {
        match self {
            Numbers::List(list) => list.texts.get(index).map_or(&list.at, |text| &text.at),
            Numbers::Lists(_, at) => at,
            Numbers::Formula(text) => &text.at,
        }
    }

    /// A number for each of so many coordinates that are of no bodies.
    pub(super) fn values(&self, reader: &mut Reader<'_>, coordinates: usize) -> Option<Vec<Exact>> {
        match self {
            Numbers::List(list) => reader.values(list, coordinates, "coordinate"),
            Numbers::Lists(..) | Numbers::Formula(_) => unreachable!("they are read for bodies only"),
        }
    }
}

/// How many bodies there are, and what they have.
pub(super) struct Bodies {
    pub(super) count: usize,
    pub(super) dimensions: usize,
    /// Names, with a value for each body.
    pub(super) properties: Vec<(String, Vec<Exact>)>,
}

impl Bodies {
    /// A number for each body.
    pub(super) fn values(&self, reader: &mut Reader<'_>, numbers: &Numbers) -> Option<Vec<Exact>> {
        match numbers {
            Numbers::List(list) => reader.values(list, self.count, "body"),
            Numbers::Lists(_, at) => reader.wrong(at, "this needs one number for each body", "write a single list"),
            Numbers::Formula(formula) => self.formula(reader, formula),
        }
    }

    /// A number for each coordinate, body after body.
    pub(super) fn values_in_space(&self, reader: &mut Reader<'_>, numbers: &Numbers) -> Option<Vec<Exact>> {
        let Bodies { count, dimensions, .. } = *self;
        match numbers {
            Numbers::List(list) => {
                let each = if dimensions == 1 { "body" } else { "coordinate of each body" };
                reader.values(list, count * dimensions, each)
            }
            Numbers::Lists(lists, at) if lists.len() != count => {
                let fault = reader.source.fault(at, "this needs a list for each body");
                reader.faults.push(fault.values(format!("{} lists", lists.len()), count.to_string()));
                None
            }
            Numbers::Lists(lists, _) => {
                // where the dimensions are wrong, so are all lists
                let wrong = lists.iter().position(|list| list.texts.len() != dimensions);
                let lists = &lists[..wrong.map_or(count, |wrong| wrong + 1)];
                let bodies: Vec<_> =
                    lists.iter().map(|list| reader.values(list, dimensions, "coordinate of the body")).collect();
                Some(bodies.into_iter().collect::<Option<Vec<_>>>()?.concat())
            }
            Numbers::Formula(formula) if dimensions == 1 => self.formula(reader, formula),
            Numbers::Formula(formula) => {
                let message = format!("a formula for all bodies is for a line, and here are {dimensions} dimensions");
                reader.wrong(&formula.at, message, "write a list for each body: [[0, 0, 0], [1, 0, 0]]")
            }
        }
    }

    /// The values at i = 1, 2, …, where the properties of body i have their names; only the first fault is told of.
    fn formula(&self, reader: &mut Reader<'_>, formula: &Text) -> Option<Vec<Exact>> {
        let parameters = reader.known.clone();
        let mut values = Vec::new();
        for body in 0..self.count {
            reader.known.insert(NUMBER.to_owned(), whole(body + 1));
            let own = self.properties.iter().map(|(name, values)| (name.clone(), values[body].clone()));
            reader.known.extend(own);
            let Some(value) = reader.evaluate(formula) else {
                // at the first body it may be a fault of the formula itself
                if let Some(fault) = reader.faults.last_mut().filter(|_| body > 0) {
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

/// What formulas call the number of a body.
pub(super) const NUMBER: &str = "i";

fn whole(n: usize) -> Exact {
    Exact { value: shadowstep::Rational::from_integer(n.into()), rounded: false }
}
