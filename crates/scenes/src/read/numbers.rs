//! Numbers of coordinates and of bodies: a list, a list for each body, or one formula for all bodies.

use std::ops::Range;

use num_traits::Zero;
use shadowstep::Rational;
use shadowstep_schemes::symbolic::Exact;
use toml::de::DeValue;

use super::reader::Reader;
use crate::document::schema::texts;
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
    /// The numbers of a key: a list, also one for each body, or a formula where they are those of bodies.
    pub(super) fn read(reader: &mut Reader<'_>, value: &Value<'_>, of_bodies: bool) -> Option<Numbers> {
        match value.get_ref() {
            DeValue::Array(bodies) if of_bodies && matches!(bodies[0].get_ref(), DeValue::Array(_)) => {
                let lists: Option<Vec<_>> = bodies.iter().map(|body| texts(reader.toml.source, body)).collect();
                match lists {
                    Some(lists) => Some(Numbers::Lists(lists, value.span())),
                    None => reader.toml.wrong_kind(value, "a list for each body"),
                }
            }
            DeValue::String(_) if of_bodies => Text::of(reader.toml.source, value).map(Numbers::Formula),
            _ => match texts(reader.toml.source, value) {
                Some(list) => Some(Numbers::List(list)),
                None => reader.toml.wrong_kind(value, "a list of numbers"),
            },
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

    /// The same of a list that may leave out what it determines: the last coordinate, t = 0, where H depends on it, and
    /// the second copies of the others.
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
