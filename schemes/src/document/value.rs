//! Values of a document with their places in its text.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeValue};

use super::fault::Source;
use crate::symbolic::decimal::from_text;
use crate::symbolic::{Budget, Error, Exact, evaluate_within, parse};

/// A value as the TOML parser gives it, with its place.
pub type Value<'i> = Spanned<DeValue<'i>>;

/// A value and its byte range in the text of the document.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed<T> {
    /// The value.
    pub value: T,
    /// Where it is.
    pub at: Range<usize>,
}

/// A value that is a whole number.
pub fn whole_number(value: &Value<'_>) -> Option<u64> {
    let DeValue::Integer(number) = value.get_ref() else { return None };
    u64::from_str_radix(number.as_str().trim_start_matches('+'), number.radix()).ok()
}

/// A text of the document: a name, a formula, or a number as it is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The text without quotes, escapes resolved.
    pub value: String,
    /// Where the value is, with its quotes.
    pub at: Range<usize>,
    /// Where the text itself begins; `None` where escapes stand for some of it.
    begin: Option<usize>,
}

impl Text {
    /// The text of a value at the range `at` of the `document`.
    fn new(document: &str, value: &str, at: Range<usize>) -> Text {
        let begin = document.get(at.clone()).and_then(|written| written.find(value)).map(|from| at.start + from);
        Text { value: value.to_owned(), at, begin }
    }

    /// The value as a text; of a decimal number the digits in the document.
    pub fn of(source: &Source, value: &Value<'_>) -> Option<Text> {
        let text = match value.get_ref() {
            DeValue::String(text) => text.as_ref(),
            DeValue::Integer(number) if number.radix() == 10 => number.as_str(),
            DeValue::Float(number) => number.as_str(),
            _ => return None,
        };
        Some(Text::new(&source.text, text, value.span()))
    }

    /// A document that is a text and nothing else.
    pub fn alone(text: &str) -> Text {
        Text { value: text.to_owned(), at: 0..text.len(), begin: Some(0) }
    }

    /// A text that the value at this place stands for.
    pub fn at(text: &str, at: Range<usize>) -> Text {
        Text { value: text.to_owned(), at, begin: None }
    }

    /// A key as a text.
    pub fn of_key(key: &Spanned<DeString<'_>>) -> Text {
        Text::at(key.get_ref(), key.span())
    }

    /// The place in the document of a byte range of the text; the whole value where escapes stand for some of the text.
    pub fn place(&self, range: &Range<usize>) -> Range<usize> {
        self.begin.map_or(self.at.clone(), |begin| begin + range.start..begin + range.end)
    }

    /// The text with its place inside the quotes.
    pub(crate) fn inside_quotes(self) -> Placed<String> {
        let at = self.place(&(0..self.value.len()));
        Placed { value: self.value, at }
    }

    /// The value of the text as a number or an expression in `known` numbers. An irrational value is rounded to
    /// `digits` significant digits. All formulas of a document share a budget.
    ///
    /// # Errors
    /// A text that is not a number or expression, or has no value; `Error::range` is a range of the text.
    pub fn evaluate(&self, known: &BTreeMap<String, Exact>, digits: u32, budget: &Budget) -> Result<Exact, Error> {
        // a name alone is its value, which needs no formula
        if let Some(value) = known.get(&self.value) {
            return Ok(value.clone());
        }
        // a number may be longer than a formula
        if let Ok(value) = from_text(&self.value) {
            return Ok(Exact { value, rounded: false });
        }
        Ok(evaluate_within(&parse(&self.value)?, known, digits, budget)?)
    }
}
