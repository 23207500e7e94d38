//! TOML values → texts, numbers and lists with their places; every fault is collected.

use std::collections::BTreeMap;
use std::ops::{Range, RangeInclusive};

use shadowstep_schemes::{Fault, Source};
use shadowstep_symbolic::decimal::{from_text, to_significant};
use shadowstep_symbolic::{Error, Exact, Graph, evaluate, parse};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::arithmetic::NUMBER_EXAMPLES;
use crate::arithmetic::{Arithmetic, GUARD_DIGITS, MOST_VALUE_DIGITS};
use crate::keys;
use crate::note::Note;

/// A text of the scene: a name, a formula or a number as it is written.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) value: String,
    /// The value in the file, with its quotes.
    pub(super) at: Range<usize>,
    /// Where the text itself begins in the file; `None` where escapes stand for some of it.
    begin: Option<usize>,
}

impl Text {
    /// A key as a text.
    pub(super) fn of_key(key: &Spanned<DeString<'_>>) -> Text {
        Text { value: key.get_ref().to_string(), at: key.span(), begin: None }
    }

    /// Bytes of the text as bytes of the file.
    pub(super) fn place(&self, range: &Range<usize>) -> Range<usize> {
        self.begin.map_or(self.at.clone(), |begin| begin + range.start..begin + range.end)
    }
}

/// A list with its place.
#[derive(Clone, Debug)]
pub(super) struct List {
    pub(super) texts: Vec<Text>,
    pub(super) at: Range<usize>,
}

/// A section, or nothing where it is left out.
pub(super) struct Section<'t, 'i> {
    name: &'static str,
    table: Option<&'t DeTable<'i>>,
    pub(super) at: Range<usize>,
}

impl Section<'_, '_> {
    pub(super) fn is_there(&self) -> bool {
        self.table.is_some()
    }
}

pub(super) type Value<'i> = Spanned<DeValue<'i>>;

/// Reads the values of a scene.
pub(super) struct Reader<'a> {
    pub(super) source: &'a Source,
    pub(super) faults: Vec<Fault>,
    pub(super) arithmetic: Arithmetic,
    /// The parameters, by which values may be written.
    pub(super) known: BTreeMap<String, Exact>,
    /// What the user should know.
    pub(super) notes: Vec<Note>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(source: &'a Source) -> Self {
        let arithmetic = Arithmetic::Double;
        Reader { source, faults: Vec::new(), arithmetic, known: BTreeMap::new(), notes: Vec::new() }
    }

    pub(super) fn fault(&mut self, at: &Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.faults.push(self.source.fault(at, message).hint(help));
    }

    /// A fault in place of a value.
    pub(super) fn wrong<T>(
        &mut self,
        at: &Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.fault(at, message, help);
        None
    }

    /// A section of the scene, whose keys are all known ones.
    pub(super) fn section<'t, 'i>(&mut self, root: &'t DeTable<'i>, name: &'static str) -> Section<'t, 'i> {
        let none = Section { name, table: None, at: 0..0 };
        let Some(value) = root.get(name) else { return none };
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_kind::<()>(value, &format!("a section: [{name}]"));
            return none;
        };
        self.table(table, value.span(), name)
    }

    /// A table that is the value of a key.
    pub(super) fn table<'t, 'i>(
        &mut self,
        table: &'t DeTable<'i>,
        at: Range<usize>,
        name: &'static str,
    ) -> Section<'t, 'i> {
        for key in table.keys() {
            let word: &str = key.get_ref();
            if keys::find(name, word).is_none() {
                self.fault(&key.span(), format!("unknown key `{word}`"), keys::hint(name, word));
            }
        }
        Section { name, table: Some(table), at }
    }

    pub(super) fn get<'t, 'i>(&self, section: &Section<'t, 'i>, key: &str) -> Option<&'t Value<'i>> {
        debug_assert!(keys::find(section.name, key).is_some(), "{key} is explained nowhere");
        section.table?.get(key)
    }

    /// A key that cannot be left out.
    pub(super) fn missing(&mut self, section: &Section<'_, '_>, key: &str) {
        // a section that is missing is told of once, and so is a key that is misspelt
        if section.is_there() && !misspells(section, key) {
            let example = keys::find(section.name, key).map_or("…", |key| key.example);
            self.fault(&section.at, format!("the key `{key}` is missing"), format!("add `{key} = {example}`"));
        }
    }

    /// Keys of which one cannot be left out.
    pub(super) fn all_missing(&mut self, section: &Section<'_, '_>, keys: &[&str]) {
        if section.is_there() && !keys.iter().any(|key| misspells(section, key)) {
            let example = |key: &&str| Some(format!("`{key} = {}`", keys::find(section.name, key)?.example));
            let examples: Vec<String> = keys.iter().filter_map(example).collect();
            let message = format!("one of the keys `{}` is needed", keys.join("`, `"));
            self.fault(&section.at, message, format!("add one such as {}", examples.join(" or ")));
        }
    }

    pub(super) fn text(&mut self, value: &Value<'_>) -> Option<Text> {
        match value.get_ref() {
            DeValue::String(text) if text.trim().is_empty() => {
                self.wrong(&value.span(), "this text is empty", "write something between the quotes")
            }
            DeValue::String(text) => Some(self.placed(text, value.span())),
            _ => self.wrong_kind(value, "a text in quotes"),
        }
    }

    fn placed(&self, text: &str, at: Range<usize>) -> Text {
        let begin = self.source.text.get(at.clone()).and_then(|written| written.find(text)).map(|from| at.start + from);
        Text { value: text.to_owned(), at, begin }
    }

    /// A number as it is written: digits, or an expression in quotes.
    pub(super) fn number(&mut self, value: &Value<'_>) -> Option<Text> {
        let at = value.span();
        match value.get_ref() {
            DeValue::String(_) => self.text(value),
            DeValue::Integer(n) if n.radix() == 10 => Some(self.placed(n.as_str(), at)),
            DeValue::Integer(_) => self.wrong_kind(value, "a number in decimal digits"),
            DeValue::Float(x) if x.as_str().contains("inf") || x.as_str().contains("nan") => {
                self.wrong(&at, format!("{} is no finite number", x.as_str()), NUMBER_EXAMPLES)
            }
            DeValue::Float(x) => Some(self.placed(x.as_str(), at)),
            _ => self.wrong_kind(value, "an exact number: 1, 0.25 or an expression in quotes, \"sqrt(2)/20\""),
        }
    }

    /// A list of numbers or of texts.
    pub(super) fn list(
        &mut self,
        value: &Value<'_>,
        what: &str,
        read: fn(&mut Self, &Value<'_>) -> Option<Text>,
    ) -> Option<List> {
        let DeValue::Array(array) = value.get_ref() else { return self.wrong_kind(value, what) };
        if array.is_empty() {
            return self.wrong(&value.span(), "this list is empty", format!("write {what}"));
        }
        let texts: Vec<_> = array.iter().map(|value| read(self, value)).collect();
        Some(List { texts: texts.into_iter().collect::<Option<_>>()?, at: value.span() })
    }

    /// The list of a key, where it is given.
    pub(super) fn list_of(
        &mut self,
        section: &Section<'_, '_>,
        key: &str,
        what: &str,
        read: fn(&mut Self, &Value<'_>) -> Option<Text>,
    ) -> Option<List> {
        self.get(section, key).and_then(|value| self.list(value, what, read))
    }

    pub(super) fn whole(&mut self, value: &Value<'_>, range: RangeInclusive<u64>) -> Option<u64> {
        let DeValue::Integer(number) = value.get_ref() else { return self.wrong_kind(value, "a whole number") };
        let unsigned = number.as_str().trim_start_matches('+');
        match u64::from_str_radix(unsigned, number.radix()) {
            Ok(n) if range.contains(&n) => Some(n),
            _ => {
                let help = format!("write a whole number from {} to {}", range.start(), range.end());
                self.wrong(&value.span(), format!("{} is out of range", number.as_str()), help)
            }
        }
    }

    /// One of a few words.
    pub(super) fn word<T: Copy>(&mut self, value: &Value<'_>, words: &[(&str, T)]) -> Option<T> {
        let text = self.text(value)?;
        if let Some((_, meant)) = words.iter().find(|(word, _)| *word == text.value) {
            return Some(*meant);
        }
        let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        self.wrong(&text.at, format!("`{}` is not known here", text.value), format!("write {}", known.join(" or ")))
    }

    /// The value of a number, which may use the parameters.
    pub(super) fn evaluate(&mut self, text: &Text) -> Option<Exact> {
        let digits = self.arithmetic.value_digits();
        let found = value(&text.value, &self.known, digits);
        match found {
            Ok(exact) if !self.arithmetic.has_digits_of(&exact) => {
                let message = format!(
                    "this value is irrational and computed to {MOST_VALUE_DIGITS} digits; the run needs {digits}"
                );
                let help = format!("use digits = {} or less, or write a fraction", MOST_VALUE_DIGITS - GUARD_DIGITS);
                self.wrong(&text.at, message, help)
            }
            Ok(exact) if !self.arithmetic.holds(&exact.value) => {
                let message =
                    format!("{} overflows or underflows in double precision", to_significant(&exact.value, 6));
                self.wrong(&text.at, message, "write digits = 16 in [run] for numbers of any size")
            }
            Ok(exact) => Some(exact),
            Err(error) => self.wrong(&text.place(&error.range()), error.to_string(), NUMBER_EXAMPLES),
        }
    }

    /// A list of so many values, one for `each` of what it is about.
    pub(super) fn values(&mut self, list: &List, count: usize, each: &str) -> Option<Vec<Exact>> {
        let found: Vec<_> = list.texts.iter().map(|text| self.evaluate(text)).collect();
        if found.len() != count {
            let numbers = |n: usize| if n == 1 { "1 number".to_owned() } else { format!("{n} numbers") };
            let fault = self.source.fault(&list.at, format!("this list needs a number for each {each}"));
            self.faults.push(fault.values(numbers(found.len()), count.to_string()));
            return None;
        }
        found.into_iter().collect()
    }

    /// Refuses a formula in these names with numbers that the run's would take for 0 or infinity.
    pub(super) fn refuse_constants<'n>(&mut self, text: &Text, names: impl Iterator<Item = &'n String>) {
        let names: Vec<String> = names.cloned().collect();
        let mut graph = Graph::new();
        let Ok(expression) = parse(&text.value) else { return };
        let Ok(node) = graph.build(&expression, &names, &[]) else { return };
        if let Some(value) = graph.numbers(node).into_iter().find(|value| !self.arithmetic.holds(value)) {
            let message = format!(
                "the number {} in the formula overflows or underflows in double precision",
                to_significant(value, 12)
            );
            self.fault(&text.at, message, "write digits = 17, or scale the number");
        }
    }

    pub(super) fn wrong_kind<T>(&mut self, value: &Value<'_>, needed: &str) -> Option<T> {
        let found = match value.get_ref() {
            DeValue::String(_) => "a text",
            DeValue::Integer(_) => "a whole number",
            DeValue::Float(_) => "a decimal number",
            DeValue::Boolean(_) => "a truth value",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.faults.push(self.source.fault(&value.span(), "this value is of the wrong kind").values(found, needed));
        None
    }
}

/// Whether a key is there under a name that is none.
fn misspells(section: &Section<'_, '_>, key: &str) -> bool {
    let misspelt = |word: &str| keys::find(section.name, word).is_none() && keys::near(section.name, word) == Some(key);
    section.table.is_some_and(|table| table.keys().any(|word| misspelt(word.get_ref())))
}

fn value(text: &str, known: &BTreeMap<String, Exact>, digits: u32) -> Result<Exact, Error> {
    // what is a number already may be longer than a formula
    if let Ok(value) = from_text(text) {
        return Ok(Exact { value, rounded: false });
    }
    Ok(evaluate(&parse(text)?, known, digits)?)
}
