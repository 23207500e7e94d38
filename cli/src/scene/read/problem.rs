//! [problem]: what moves, said in one of several ways, each with its file.

use std::collections::BTreeMap;
use std::ops::Range;

use shadowstep_symbolic::{Expression, Kind, evaluate, parse};
use toml::de::DeValue;

use super::initial::State;
use crate::scene::keys;
use crate::scene::reader::{List, Reader, Section, Text};
use crate::scene::system::System;

/// What moves, and where from.
pub(super) fn system(reader: &mut Reader<'_>, problem: &Section<'_, '_>, initial: &Section<'_, '_>) -> Option<System> {
    let (name, potential) = (reader.get(problem, "name"), reader.get(problem, "potential"));
    let both = name.zip(potential).map(|(_, potential)| potential.span());
    let neither = name.is_none() && potential.is_none();
    let name = name.and_then(|value| reader.text(value));
    let potential = potential.and_then(|value| reader.text(value));
    let given = Given {
        coordinates: reader.list_of(problem, "coordinates", "a list of names: [\"x\", \"y\"]", Reader::text),
        momenta: reader.list_of(problem, "momenta", "a list of names: [\"px\", \"py\"]", Reader::text),
        masses: reader.list_of(problem, "masses", "a list of numbers: [1, 2]", Reader::number),
        kinetic: reader.get(problem, "kinetic").and_then(|value| reader.text(value)),
        parameters: parameters(reader, problem),
        state: State::read(reader, initial),
        places: keys::of("problem").filter_map(|key| Some((key.name, reader.get(problem, key.name)?.span()))).collect(),
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
pub(super) struct Given {
    pub(super) coordinates: Option<List>,
    pub(super) momenta: Option<List>,
    pub(super) masses: Option<List>,
    /// T(p)
    pub(super) kinetic: Option<Text>,
    /// Names and values in the order of the text.
    pub(super) parameters: Vec<(Text, Text)>,
    pub(super) state: State,
    /// Places of the values of all keys that there are, right or wrong.
    places: Vec<(&'static str, Range<usize>)>,
    /// Places of the sections.
    pub(super) problem: Range<usize>,
    pub(super) initial: Option<Range<usize>>,
}

impl Given {
    /// Where the value of a key is, if the key is there.
    pub(super) fn place(&self, key: &str) -> Option<&Range<usize>> {
        self.places.iter().find(|(name, _)| *name == key).map(|(_, at)| at)
    }

    /// Refuses keys that say nothing here, each with why and what would be right.
    pub(super) fn refuse(&self, reader: &mut Reader<'_>, keys: &[&str], why: impl Fn(&str) -> (String, String)) {
        for (key, at) in self.places.iter().filter(|(key, _)| keys.contains(key)) {
            let (message, help) = why(key);
            reader.fault(at, message, help);
        }
    }
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
pub(super) fn check_name(reader: &mut Reader<'_>, name: &Text) {
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
