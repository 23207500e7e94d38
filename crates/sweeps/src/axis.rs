//! An axis: a name and the values that it takes, each made from its number alone.

mod draws;
mod number;
mod range;

use shadowstep_scenes::family::Meaning;
use shadowstep_scenes::schema::{Table, texts};
use shadowstep_schemes::document::{Reader, Text, Value};
use shadowstep_symbolic::Error;

use crate::keys::DRAWS;
use draws::Draws;
use number::evaluated;
pub(crate) use number::number;
use range::Range;

/// A name and its values, which are numbered from 0.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The name.
    pub name: String,
    values: Values,
}

#[derive(Clone, Debug)]
enum Values {
    /// Numbers only, or words.
    List {
        values: Vec<Meaning>,
        is_numeric: bool,
    },
    Range(Range),
    Draws(Draws),
}

impl Axis {
    /// Reads the value of a key of \[axes\].
    pub(crate) fn read(reader: &mut Reader<'_>, name: &Text, value: &Value<'_>) -> Option<Axis> {
        let values = if let Some(draws) = Table::of_value(reader.source, value, &DRAWS) {
            Values::Draws(Draws::read(reader, &name.value, &draws)?)
        } else if let Some(list) = texts(reader.source, value) {
            self::list(list.value)
        } else {
            Values::Range(Range::read(reader, &name.value, &Text::of(reader.source, value)?)?)
        };
        Some(Axis { name: name.value.clone(), values })
    }

    /// How many values it has.
    pub fn count(&self) -> u64 {
        match &self.values {
            Values::List { values, .. } => values.len() as u64,
            Values::Range(range) => range.count(),
            Values::Draws(draws) => draws.count(),
        }
    }

    /// The value of this number, which is less than [`count`](Axis::count).
    ///
    /// # Panics
    /// If it is not.
    pub fn value(&self, number: u64) -> Meaning {
        assert!(number < self.count(), "axis {} has {} values", self.name, self.count());
        match &self.values {
            Values::List { values, .. } => values[usize::try_from(number).expect("a list fits into memory")].clone(),
            Values::Range(range) => Meaning::Number(range.value(number)),
            Values::Draws(draws) => Meaning::Number(draws.value(number)),
        }
    }

    /// Whether its values are numbers.
    pub(crate) fn is_numeric(&self) -> bool {
        match &self.values {
            Values::List { is_numeric, .. } => *is_numeric,
            Values::Range(_) | Values::Draws(_) => true,
        }
    }

    /// The first value that is not a number, and why it is none.
    pub(crate) fn first_word(&self) -> Option<(u64, Error)> {
        let Values::List { values, is_numeric: false } = &self.values else { return None };
        let word = |value: &Meaning| match value {
            Meaning::Word(word) => evaluated(word).err(),
            Meaning::Number(_) => None,
        };
        values.iter().zip(0..).find_map(|(value, number)| Some((number, word(value)?)))
    }

    /// Whether its values are random: they have no order.
    pub(crate) fn is_random(&self) -> bool {
        matches!(self.values, Values::Draws(_))
    }

    /// Whether equal distances mean equal ratios.
    pub(crate) fn is_logarithmic(&self) -> bool {
        matches!(&self.values, Values::Range(range) if range.is_logarithmic())
    }
}

/// Numbers if all members are numbers, otherwise words.
fn list(texts: Vec<Text>) -> Values {
    let numbers: Option<Vec<_>> = texts.iter().map(|text| evaluated(&text.value).ok().map(Meaning::Number)).collect();
    let is_numeric = numbers.is_some();
    let words = || texts.into_iter().map(|text| Meaning::Word(text.value)).collect();
    Values::List { values: numbers.unwrap_or_else(words), is_numeric }
}
