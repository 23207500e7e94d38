//! The values of a scene, which are of their kinds: numbers with the scene's parameters, in its number type.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;

use num_traits::{Signed as _, Zero as _};
use shadowstep::Rational;
use shadowstep_schemes::document::{self, Placed, Source, Text};
use shadowstep_schemes::symbolic::decimal::to_significant;
use shadowstep_schemes::symbolic::{Budget, Exact};

use crate::document::schema::{Sign, Table};
use crate::files::outside::path_within;
use crate::run::arithmetic::{ANY_SIZE, Arithmetic, GUARD_DIGITS, MOST_VALUE_DIGITS, NUMBER_EXAMPLES};
use crate::run::note::Note;
use crate::texts::refusal::Refusal;

/// Reads the values of a scene.
pub(super) struct Reader<'a> {
    /// Values with their places, and the faults.
    pub(super) toml: document::Reader<'a>,
    pub(super) arithmetic: Arithmetic,
    /// The parameters, which values can contain.
    pub(super) known: BTreeMap<String, Exact>,
    /// Those of them that the text does not define: the names of a family.
    pub(super) names: Vec<(String, Exact)>,
    /// How much computing the values may take together.
    budget: Budget,
    /// Whether what takes long is left out, to find the faults of all else.
    pub(super) is_cursory: bool,
    /// What the user should know.
    pub(super) notes: Vec<Note>,
    /// Other files that have states, with the names that the text has for them.
    pub(super) files: Vec<Source>,
}

impl<'a> Reader<'a> {
    /// Of a text whose numbers can contain these names, for a run in this arithmetic.
    pub(super) fn new(source: &'a Source, names: Vec<(String, Exact)>, arithmetic: Arithmetic) -> Self {
        Reader {
            toml: document::Reader::new(source, Vec::new()),
            arithmetic,
            known: names.iter().cloned().collect(),
            names,
            budget: Budget::default(),
            is_cursory: false,
            notes: Vec::new(),
            files: Vec::new(),
        }
    }

    /// The path of a file that a key names, relative to the folder of the scene.
    pub(super) fn path(&mut self, name: &Text) -> Option<PathBuf> {
        path_within(self.toml.source, name).map_err(|faults| self.toml.faults.extend(faults.0)).ok()
    }

    /// What is found, or the fault that it is refused at this place.
    pub(super) fn found<T>(&mut self, at: &Range<usize>, found: Result<T, Refusal>) -> Option<T> {
        found.map_err(|Refusal { message, hint }| self.toml.fault(at, message, hint)).ok()
    }

    /// Adds the fault of another number of members than is needed, in place of a value.
    pub(super) fn wrong_count<T>(
        &mut self,
        at: &Range<usize>,
        message: impl Into<String>,
        (found, needed): (impl ToString, usize),
    ) -> Option<T> {
        let fault = self.toml.source.fault(at, message);
        self.toml.faults.push(fault.values(found.to_string(), needed.to_string()));
        None
    }

    /// The number that is the value of a key, which has the sign that its row says.
    pub(super) fn value(&mut self, section: &Table<'_, '_>, key: &str) -> Option<(Text, Exact)> {
        let text = section.text(key)?;
        let exact = self.evaluate(&text)?;
        let row = section.row(key);
        let (sign, is_right) = match row.kind.sign() {
            Sign::Any => return Some((text, exact)),
            Sign::Positive => ("positive", exact.value.is_positive()),
            Sign::Nonzero => ("nonzero", !exact.value.is_zero()),
        };
        if is_right {
            return Some((text, exact));
        }
        let message = format!("{key} must be {sign}, not {}", to_significant(&exact.value, 12));
        self.toml.wrong(&text.at, message, format!("write {key} = {}, for example", row.example))
    }

    /// Makes the value of a parameter known, which has this text, or is the default of the problem at `place`.
    pub(super) fn define(&mut self, name: &str, value: Exact, text: Option<&Text>, place: &Range<usize>) {
        let is_itself = text.is_some_and(|text| text.value.trim() == name);
        // that of an axis or a column would be ignored
        if !is_itself && self.names.iter().any(|(other, _)| other == name) {
            let message = format!("the parameter `{name}` has the name of an axis or a column, and another value");
            let help = format!("write parameters.{name} = \"{name}\", or give the axis or the column another name");
            self.toml.fault(text.map_or(place, |text| &text.at), message, help);
        }
        self.known.insert(name.to_owned(), value);
    }

    /// The value of a number, which can contain the parameters.
    pub(super) fn evaluate(&mut self, text: &Text) -> Option<Exact> {
        // the value that took the rest has its fault
        if self.budget.is_spent() {
            return None;
        }
        let digits = self.arithmetic.value_digits();
        match text.evaluate(&self.known, digits, &self.budget) {
            Ok(exact) if !self.arithmetic.has_digits_of(&exact) => {
                let message = format!(
                    "this value is irrational and computed to {MOST_VALUE_DIGITS} digits; the run needs {digits}"
                );
                let hint = format!("use digits = {} or less, or write a fraction", MOST_VALUE_DIGITS - GUARD_DIGITS);
                self.toml.wrong(&text.at, message, hint)
            }
            Ok(exact) if !self.arithmetic.holds(&exact.value) => {
                let message = format!(
                    "{} overflows or underflows in {}",
                    to_significant(&exact.value, 6),
                    self.arithmetic.described()
                );
                self.toml.wrong(&text.at, message, ANY_SIZE)
            }
            Ok(exact) => Some(exact),
            Err(error) => self.toml.wrong(&text.place(&error.range()), error.to_string(), NUMBER_EXAMPLES),
        }
    }

    /// The values of a list, which must have `count` of them, one for `each`.
    pub(super) fn values(&mut self, list: &Placed<Vec<Text>>, count: usize, each: &str) -> Option<Vec<Exact>> {
        let found: Vec<_> = list.value.iter().map(|text| self.evaluate(text)).collect();
        if found.len() != count {
            let numbers = |n: usize| if n == 1 { "1 number".to_owned() } else { format!("{n} numbers") };
            let message = format!("this list needs a number for each {each}");
            return self.wrong_count(&list.at, message, (numbers(found.len()), count));
        }
        found.into_iter().collect()
    }

    /// Refuses a formula if one of its numbers overflows or underflows in the number type of the run.
    pub(super) fn refuse_numbers(&mut self, text: &Text, numbers: &[&Rational]) {
        if let Some(value) = numbers.iter().find(|value| !self.arithmetic.holds(value)) {
            let message = format!(
                "the number {} in the formula overflows or underflows in {}",
                to_significant(value, 12),
                self.arithmetic.described()
            );
            self.toml.fault(&text.at, message, "write digits = 17, or scale the number");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::schema::texts;

    #[test]
    fn the_numbers_of_a_scene_share_a_budget() {
        let numbers: Vec<String> = (1..=100).map(|n| format!("\"sin({n})\"")).collect();
        let source = Source { path: "mine.toml".to_owned(), text: format!("q = [{}]", numbers.join(", ")) };
        let (document, _) = document::document(&source);
        let document = document.unwrap();
        let evaluated = |budget: Budget| {
            let mut reader = Reader::new(&source, Vec::new(), Arithmetic::DOUBLE);
            reader.budget = budget;
            let list = texts(&source, document.get("q").unwrap()).unwrap();
            let values = list.value.iter().filter_map(|text| reader.evaluate(text)).count();
            (values, reader.toml.faults.iter().map(|fault| fault.message.clone()).collect::<Vec<_>>())
        };
        assert_eq!(evaluated(Budget::default()), (100, Vec::new()));
        // each costs less than 10⁷ bits squared at these digits, and more than 10⁵; one fault is enough
        let (values, faults) = evaluated(Budget::new(10_000_000));
        assert!((1..100).contains(&values), "{values}");
        assert!(faults.len() == 1 && faults[0].starts_with("this takes too long"), "{faults:?}");
    }
}
