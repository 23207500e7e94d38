//! The values of a checked document: each is of a kind that its row has.

use std::ops::Range;

use shadowstep_schemes::document::{Placed, Source, Text, Value, whole_number};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::{Key, Section};

/// A name with its place.
type Name<'i> = Spanned<DeString<'i>>;

/// A section of a checked document, or a table in it; an empty one where the document leaves it out.
#[derive(Clone, Debug)]
pub struct Table<'t, 'i> {
    source: &'t Source,
    rows: &'static Section,
    table: Option<&'t DeTable<'i>>,
    /// Where it is.
    pub at: Range<usize>,
}

impl<'t, 'i> Table<'t, 'i> {
    /// The section of a document.
    pub fn of(source: &'t Source, root: &'t DeTable<'i>, rows: &'static Section) -> Self {
        let found = root.get(rows.name()).and_then(|value| Some((value.get_ref().as_table()?, value.span())));
        let (table, at) = found.map_or((None, 0..0), |(table, at)| (Some(table), at));
        Table { source, rows, table, at }
    }

    /// The table that is a value, with these keys.
    pub fn of_value(source: &'t Source, value: &'t Value<'i>, rows: &'static Section) -> Option<Self> {
        let table = value.get_ref().as_table()?;
        Some(Table { source, rows, table: Some(table), at: value.span() })
    }

    /// Whether the document has it.
    pub fn is_there(&self) -> bool {
        self.table.is_some()
    }

    /// The row of a key.
    pub(crate) fn row(&self, key: &str) -> &'static Key {
        self.rows.find(key).expect("a key that is read has a row")
    }

    /// The value of a key, where it is given.
    pub fn get(&self, key: &str) -> Option<&'t Value<'i>> {
        self.table?.get(self.row(key).name)
    }

    /// Where the value of a key is, or else the section.
    pub fn place(&self, key: &str) -> Range<usize> {
        self.get(key).map_or(self.at.clone(), Value::span)
    }

    /// The value of a key, where it is a table with keys.
    pub(crate) fn table(&self, key: &str) -> Option<Table<'t, 'i>> {
        Table::of_value(self.source, self.get(key)?, self.row(key).kind.table()?)
    }

    /// The value of a key, where it is true or false.
    pub fn truth(&self, key: &str) -> Option<bool> {
        self.get(key)?.get_ref().as_bool()
    }

    /// The value of a key, where it is a whole number.
    pub fn whole(&self, key: &str) -> Option<u64> {
        whole_number(self.get(key)?)
    }

    /// The value of a key, where it is a text.
    pub fn str(&self, key: &str) -> Option<&'t str> {
        self.get(key)?.get_ref().as_str()
    }

    /// The meaning of the value of a key, where it is one of these words.
    pub fn word<T: Copy>(&self, key: &str, words: &[(&str, T)]) -> Option<T> {
        let given = self.str(key)?;
        words.iter().find(|(word, _)| *word == given).map(|(_, meaning)| *meaning)
    }

    /// The value of a key as a text; of a number the digits in the document.
    pub fn text(&self, key: &str) -> Option<Text> {
        Text::of(self.source, self.get(key)?)
    }

    /// The list of texts or numbers that is the value of a key.
    pub fn list(&self, key: &str) -> Option<Placed<Vec<Text>>> {
        texts(self.source, self.get(key)?)
    }

    /// The names that are no keys of its own, with their values, in the order of the document.
    pub fn names(&self) -> Vec<(Text, &'t Value<'i>)> {
        in_order(self.table.into_iter().flatten().filter(|(name, _)| self.rows.find(name.get_ref()).is_none()))
    }

    /// The names with their texts or numbers in the table that is the value of a key, in the order of the document.
    pub(crate) fn named(&self, key: &str) -> Vec<(Text, Text)> {
        let table = self.get(key).and_then(|value| value.get_ref().as_table());
        let text = |(name, value)| Some((name, Text::of(self.source, value)?));
        in_order(table.into_iter().flatten()).into_iter().filter_map(text).collect()
    }

    /// How often something is written, `true` or `{ every = 10 }`, and the table.
    pub fn every(&self, key: &str) -> Option<(u64, Option<Table<'t, 'i>>)> {
        match self.table(key) {
            Some(table) => Some((table.whole("every").unwrap_or(1), Some(table))),
            None => (self.truth(key) == Some(true)).then_some((1, None)),
        }
    }
}

/// Names with their values, in the order of the document.
fn in_order<'t, 'i: 't>(names: impl Iterator<Item = (&'t Name<'i>, &'t Value<'i>)>) -> Vec<(Text, &'t Value<'i>)> {
    let mut found: Vec<_> = names.map(|(name, value)| (Text::of_key(name), value)).collect();
    found.sort_by_key(|(name, _)| name.at.start);
    found
}

/// The texts or numbers of a list.
pub fn texts(source: &Source, value: &Value<'_>) -> Option<Placed<Vec<Text>>> {
    let texts = value.get_ref().as_array()?.iter().map(|value| Text::of(source, value)).collect::<Option<_>>()?;
    Some(Placed { value: texts, at: value.span() })
}

/// Calls a function with each text in a value and its place.
pub(crate) fn each_text(value: &Value<'_>, call: &mut impl FnMut(&str, Range<usize>)) {
    match value.get_ref() {
        DeValue::String(text) => call(text, value.span()),
        DeValue::Array(members) => members.iter().for_each(|member| each_text(member, call)),
        DeValue::Table(table) => table.values().for_each(|value| each_text(value, call)),
        _ => {}
    }
}

/// The longest parts of a text that can be names.
pub(crate) fn words_of(text: &str) -> impl Iterator<Item = &str> {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    text.split(move |c| !is_letter(c)).filter(|word| word.starts_with(|c: char| c.is_alphabetic()))
}
