//! An axis: a name and the values that it takes, each made from its number alone.

mod draws;
mod number;
mod range;

use shadowstep::Rational;
use shadowstep_scenes::family::Meaning;
use shadowstep_scenes::schema::{Table, texts};
use shadowstep_schemes::document::{Reader, Text, Value};
use shadowstep_schemes::symbolic::Error;

use crate::sweeps::keys::DRAWS;
use draws::Draws;
use number::evaluated;
pub(crate) use number::number;
use range::Range;

/// A name and its values, which are numbered from 0.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    /// The name.
    pub name: String,
    count: u64,
    values: Values,
}

#[derive(Clone, Debug)]
enum Values {
    Numbers(Vec<Rational>),
    Words(Vec<String>),
    Range(Range),
    Draws(Draws),
}

impl Axis {
    /// Reads the value of a key of \[axes\].
    pub(crate) fn read(reader: &mut Reader<'_>, name: &Text, value: &Value<'_>) -> Option<Axis> {
        let (count, values) = if let Some(draws) = Table::of_value(reader.source, value, &DRAWS) {
            (draws.whole("draws")?, Values::Draws(Draws::read(reader, &name.value, &draws)?))
        } else if let Some(list) = texts(reader.source, value) {
            (list.value.len() as u64, self::list(list.value))
        } else {
            let range = Range::read(reader, &name.value, &Text::of(reader.source, value)?)?;
            (range.steps + 1, Values::Range(range))
        };
        Some(Axis { name: name.value.clone(), count, values })
    }

    /// How many values it has.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// The value of this number, which is less than [`count`](Axis::count).
    ///
    /// # Panics
    /// If it is not.
    pub(crate) fn value(&self, number: u64) -> Meaning {
        assert!(number < self.count, "axis {} has {} values", self.name, self.count);
        match &self.values {
            Values::Numbers(numbers) => Meaning::Number(numbers[number as usize].clone()),
            Values::Words(words) => Meaning::Word(words[number as usize].clone()),
            Values::Range(range) => Meaning::Number(range.value(number)),
            Values::Draws(draws) => Meaning::Number(draws.value(number)),
        }
    }

    /// Whether its values are numbers.
    pub(crate) fn is_numeric(&self) -> bool {
        !matches!(self.values, Values::Words(_))
    }

    /// The first value that is not a number, and why it is none.
    pub(crate) fn first_word(&self) -> Option<(u64, Error)> {
        let Values::Words(words) = &self.values else { return None };
        words.iter().zip(0..).find_map(|(word, number)| Some((number, evaluated(word).err()?)))
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
    let numbers = texts.iter().map(|text| evaluated(&text.value).ok()).collect();
    let words = || Values::Words(texts.into_iter().map(|text| text.value).collect());
    Option::map_or_else(numbers, words, Values::Numbers)
}
