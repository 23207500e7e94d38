//! Numbers of coordinates and of bodies: a list, a list for each body, or one formula for all bodies.

use std::ops::Range;

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep_symbolic::Exact;
use toml::de::DeValue;

use super::reader::Reader;
use shadowstep_schemes::document::{Placed, Text, Value};

/// Numbers in the form in which the scene gives them.
pub(super) enum Numbers {
    List(Placed<Vec<Text>>),
    /// A list for each body.
    Lists(Vec<Placed<Vec<Text>>>, Range<usize>),
    /// A formula in the number i of the body.
    Formula(Text),
}

impl Numbers {
    /// A number for each coordinate.
    pub(super) fn of_coordinates(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        reader.numbers(value, "a list of numbers: [1, \"1/2\"]").map(Numbers::List)
    }

    /// A number for each body.
    pub(super) fn of_bodies(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        if matches!(value.get_ref(), DeValue::String(_)) {
            return reader.toml.text(value).map(Numbers::Formula);
        }
        let what = "a list with a number for each body, or a formula for all: \"1 + i/10\"";
        reader.numbers(value, what).map(Numbers::List)
    }

    /// A number for each coordinate of each body.
    pub(super) fn of_bodies_in_space(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Numbers> {
        match value.get_ref() {
            DeValue::Array(bodies) if matches!(bodies.first().map(Value::get_ref), Some(DeValue::Array(_))) => {
                let what = "a list with the numbers of one body: [1, 0, 0]";
                let lists: Vec<_> = bodies.iter().map(|body| reader.numbers(body, what)).collect();
                Some(Numbers::Lists(lists.into_iter().collect::<Option<_>>()?, value.span()))
            }
            _ => Numbers::of_bodies(reader, value),
        }
    }

    /// Where the number of a body or coordinate is, counted from 0.
    pub(super) fn place(&self, index: usize) -> &Range<usize> {
        match self {
            Numbers::List(list) => list.value.get(index).map_or(&list.at, |text| &text.at),
            Numbers::Lists(_, at) => at,
            Numbers::Formula(text) => &text.at,
        }
    }

    /// How many numbers are listed.
    pub(super) fn count(&self) -> Option<usize> {
        match self {
            Numbers::List(list) => Some(list.value.len()),
            Numbers::Lists(..) | Numbers::Formula(_) => None,
        }
    }

    /// The same of a list that may leave out what it determines: the last coordinate, t = 0, where H depends on it, and the second copies of the others.
    pub(super) fn values_of_all(
        &self,
        reader: &mut Reader<'_>,
        coordinates: usize,
        (copied, explicit_time): (bool, bool),
    ) -> Option<Vec<Exact>> {
        if self.count() == Some(coordinates) {
            return self.values(reader, coordinates);
        }
        let without_time = coordinates - usize::from(explicit_time);
        let mut values = self.values(reader, if copied { without_time / 2 } else { without_time })?;
        if copied {
            values.extend_from_within(..);
        }
        values.extend(explicit_time.then(|| Exact { value: Rational::zero(), rounded: false }));
        Some(values)
    }

    /// A number for each coordinate of a system without bodies.
    pub(super) fn values(&self, reader: &mut Reader<'_>, coordinates: usize) -> Option<Vec<Exact>> {
        match self {
            Numbers::List(list) => reader.values(list, coordinates, "coordinate"),
            Numbers::Lists(..) | Numbers::Formula(_) => unreachable!("they are read for bodies only"),
        }
    }
}
