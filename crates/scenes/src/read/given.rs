//! What [problem] and [initial] contain, whichever way the problem is given.

use std::ops::Range;

use num_traits::One;
use shadowstep::Rational;
use shadowstep_schemes::symbolic::Exact;

use super::initial::State;
use super::names::check_name;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::document::keys::{INITIAL, PROBLEM};
use crate::document::schema::Table;
use shadowstep_schemes::document::{Text, Value};
use toml::de::DeTable;

/// The values of [problem] and [initial] besides the problem's name, its potential or its pairs.
pub(super) struct Given<'t, 'i> {
    pub(super) masses: Option<Numbers>,
    /// Names and values in the order of the text.
    pub(super) parameters: Vec<(Text, Text)>,
    pub(super) state: State,
    pub(super) problem: Table<'t, 'i>,
    pub(super) initial: Table<'t, 'i>,
}

impl<'t, 'i> Given<'t, 'i> {
    pub(super) fn read<'s: 't>(reader: &mut Reader<'s>, root: &'t DeTable<'i>) -> Self {
        let (problem, initial) =
            (Table::of(reader.toml.source, root, &PROBLEM), Table::of(reader.toml.source, root, &INITIAL));
        let of_bodies = problem.get("pair").is_some();
        Given {
            masses: problem.get("masses").and_then(|value| Numbers::read(reader, value, of_bodies)),
            parameters: problem.named("parameters"),
            state: State::read(reader, &initial, of_bodies),
            problem,
            initial,
        }
    }

    /// Names and values, which become known to the reader.
    pub(super) fn own_parameters(&self, reader: &mut Reader<'_>) -> Vec<(String, Exact)> {
        let is_own = |name: &String| self.parameters.iter().any(|(own, _)| own.value == *name);
        let mut parameters: Vec<_> = reader.names.iter().filter(|(name, _)| !is_own(name)).cloned().collect();
        for (name, text) in &self.parameters {
            check_name(reader, name);
            // a parameter with a fault has the value 1, so that values that contain it add no more faults
            let value = reader.evaluate(text).unwrap_or(Exact { value: Rational::one(), rounded: false });
            reader.define(&name.value, value.clone(), Some(text), &self.problem.at);
            parameters.push((name.value.clone(), value));
        }
        parameters
    }

    /// The place of the value of a key, if the key is given.
    pub(super) fn place(&self, key: &str) -> Option<Range<usize>> {
        self.problem.get(key).map(Value::span)
    }

    /// Refuses a key that has no meaning here.
    pub(super) fn refuse(&self, reader: &mut Reader<'_>, key: &str, message: &str, help: &str) {
        if let Some(at) = self.place(key) {
            reader.toml.fault(&at, message, help);
        }
    }
}
