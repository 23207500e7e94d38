//! What [problem] and [initial] contain, whichever way the problem is given.

use std::ops::Range;

use num_traits::One;
use shadowstep::Rational;
use shadowstep::systems::pairs::Ends;
use shadowstep_symbolic::Exact;
use toml::de::DeValue;

use super::bodies::GivenBodies;
use super::cutoff::{GivenBox, GivenCutoff};
use super::initial::State;
use super::names::check_name;
use super::numbers::Numbers;
use super::reader::Reader;
use crate::keys;
use shadowstep_schemes::document::{Placed, Section, Text};

/// The values of [problem] and [initial] besides the problem's name, its potential or its pairs.
pub(super) struct Given {
    pub(super) coordinates: Option<Placed<Vec<Text>>>,
    pub(super) momenta: Option<Placed<Vec<Text>>>,
    pub(super) masses: Option<Numbers>,
    /// T(p)
    pub(super) kinetic: Option<Text>,
    /// Energies of each body of a planetary system.
    pub(super) central: Option<Text>,
    pub(super) external: Option<Text>,
    pub(super) bodies: Option<GivenBodies>,
    pub(super) dimensions: Option<usize>,
    pub(super) neighbours: Option<Ends>,
    pub(super) cutoff: Option<GivenCutoff>,
    /// Those of the box.
    pub(super) sides: Option<GivenBox>,
    /// Names and values in the order of the text.
    pub(super) parameters: Vec<(Text, Text)>,
    pub(super) state: State,
    /// Places of the values of all given keys, valid or not.
    places: Vec<(&'static str, Range<usize>)>,
    /// Places of the sections.
    pub(super) problem: Range<usize>,
    pub(super) initial: Option<Range<usize>>,
}

impl Given {
    pub(super) fn read(
        reader: &mut Reader<'_>,
        problem: &Section<'_, '_>,
        initial: &Section<'_, '_>,
        of_bodies: bool,
    ) -> Given {
        let ends = [("free", Ends::Free), ("fixed", Ends::Fixed), ("periodic", Ends::Periodic)];
        let masses = if of_bodies { Numbers::of_bodies } else { Numbers::of_coordinates };
        Given {
            coordinates: reader.names(problem, "coordinates", "a list of names: [\"x\", \"y\"]"),
            momenta: reader.names(problem, "momenta", "a list of names: [\"px\", \"py\"]"),
            masses: problem.get("masses").and_then(|value| masses(reader, value)),
            kinetic: problem.get("kinetic").and_then(|value| reader.toml.text(value)),
            central: problem.get("central").and_then(|value| reader.toml.text(value)),
            external: problem.get("external").and_then(|value| reader.toml.text(value)),
            bodies: problem.get("bodies").and_then(|value| GivenBodies::read(reader, value)),
            dimensions: problem
                .get("dimensions")
                .and_then(|value| reader.whole(value, 1..=3))
                .map(|dimensions| dimensions as usize),
            neighbours: problem.get("neighbours").and_then(|value| reader.word(value, &ends)),
            cutoff: problem.get("cutoff").and_then(|value| GivenCutoff::read(reader, value)),
            sides: problem.get("box").and_then(|value| GivenBox::read(reader, value)),
            parameters: parameters(reader, problem),
            state: State::read(reader, initial, of_bodies),
            places: keys::of("problem").filter_map(|key| Some((key.name, problem.get(key.name)?.span()))).collect(),
            problem: problem.at.clone(),
            initial: initial.is_there().then(|| initial.at.clone()),
        }
    }

    /// Refuses a missing key.
    pub(super) fn needs(&self, reader: &mut Reader<'_>, problem: &Section<'_, '_>, key: &str) {
        if self.place(key).is_none() {
            reader.toml.missing(problem, &[key]);
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
            reader.define(&name.value, value.clone(), Some(text), &self.problem);
            parameters.push((name.value.clone(), value));
        }
        parameters
    }

    /// The names of the coordinates and momenta as they are given, valid or not: by default, momenta are named after the coordinates.
    pub(super) fn variables(&self, coordinates: &Placed<Vec<Text>>) -> (Vec<String>, Vec<String>) {
        let texts = |list: &Placed<Vec<Text>>| list.value.iter().map(|name| name.value.clone()).collect::<Vec<_>>();
        let coordinates = texts(coordinates);
        let default = || coordinates.iter().map(|name| format!("p{name}")).collect();
        let momenta = self.momenta.as_ref().map_or_else(default, texts);
        (coordinates, momenta)
    }

    /// Refuses keys that only pairs of bodies have.
    pub(super) fn refuse_keys_of_pairs(&self, reader: &mut Reader<'_>) {
        self.refuse(reader, &["bodies", "dimensions", "neighbours", "cutoff", "box"], |key| {
            (format!("{key} requires `pair`"), format!("remove `{key}`, or write `pair` instead of `potential`"))
        });
    }

    /// The place of the value of a key, if the key is given.
    pub(super) fn place(&self, key: &str) -> Option<&Range<usize>> {
        self.places.iter().find(|(name, _)| *name == key).map(|(_, at)| at)
    }

    /// Refuses keys that have no meaning here, each with a message and a hint.
    pub(super) fn refuse(&self, reader: &mut Reader<'_>, keys: &[&str], why: impl Fn(&str) -> (String, String)) {
        for (key, at) in self.places.iter().filter(|(key, _)| keys.contains(key)) {
            let (message, help) = why(key);
            reader.toml.fault(at, message, help);
        }
    }
}

/// Names and values in the order of the text.
fn parameters(reader: &mut Reader<'_>, problem: &Section<'_, '_>) -> Vec<(Text, Text)> {
    let Some(value) = problem.get("parameters") else { return Vec::new() };
    let DeValue::Table(table) = value.get_ref() else {
        reader.toml.wrong_kind::<()>(value, "a table: { depth = 2 }");
        return Vec::new();
    };
    let mut found: Vec<_> =
        table.iter().filter_map(|(key, value)| Some((Text::of_key(key), reader.number(value)?))).collect();
    found.sort_by_key(|(name, _)| name.at.start);
    found
}
