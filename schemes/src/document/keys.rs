//! The keys that a table of a document may have.

use crate::symbolic::nearest;

/// Words of other programs, and the keys that they are here.
const TRANSLATED: [(&str, &str); 14] = [
    ("dt", "step"),
    ("timestep", "step"),
    ("time_step", "step"),
    ("integrator", "scheme"),
    ("method", "scheme"),
    ("mass", "masses"),
    ("m", "mass"),
    ("sma", "a"),
    ("ecc", "e"),
    ("eccentricity", "e"),
    ("inc", "i"),
    ("inclination", "i"),
    ("Omega", "node"),
    ("omega", "pericentre"),
];

/// A key of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// The key itself.
    pub name: &'static str,
    /// A value that it may have, in TOML.
    pub example: &'static str,
}

impl Key {
    /// A key and a value that it may have.
    pub const fn new(name: &'static str, example: &'static str) -> Key {
        Key { name, example }
    }
}

/// All keys of a table.
#[derive(Clone, Debug)]
pub struct Keys {
    table: &'static str,
    keys: Vec<Key>,
    elsewhere: fn(&str) -> Option<&'static str>,
    /// Whether other keys are names that the user chooses.
    pub(super) has_names: bool,
}

impl Keys {
    /// The keys of a table, which messages call `table`: `[run]`.
    pub fn new(table: &'static str, keys: impl IntoIterator<Item = Key>) -> Keys {
        Keys { table, keys: keys.into_iter().collect(), elsewhere: |_| None, has_names: false }
    }

    /// Adds a function that finds the table of a key that is not one of these, for the hint at a key in the wrong
    /// table.
    pub fn with_elsewhere(self, elsewhere: fn(&str) -> Option<&'static str>) -> Keys {
        Keys { elsewhere, ..self }
    }

    /// Allows other keys, which are names that the user chooses.
    pub fn with_names(self) -> Keys {
        Keys { has_names: true, ..self }
    }

    /// The key of this name.
    pub(crate) fn find(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// Whether a word is a misspelling of a key: not a key itself, and spelt most like this one.
    pub(super) fn is_misspelling(&self, word: &str, key: &str) -> bool {
        self.find(word).is_none() && self.nearest(word) == Some(key)
    }

    /// What may be meant by a word that is not one of these keys.
    pub(super) fn hint(&self, word: &str) -> String {
        match (self.nearest(word), (self.elsewhere)(word)) {
            (Some(near), _) => format!("did you mean `{near}`?"),
            (None, Some(table)) => format!("`{word}` is a key of {table}"),
            (None, None) => format!("the keys of {} are {}", self.table, self.names().collect::<Vec<_>>().join(", ")),
        }
    }

    fn nearest(&self, word: &str) -> Option<&'static str> {
        let translated = TRANSLATED.iter().find(|(other, key)| *other == word && self.find(key).is_some());
        translated.map(|(_, key)| *key).or_else(|| nearest(word, self.names()))
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.keys.iter().map(|key| key.name)
    }
}
