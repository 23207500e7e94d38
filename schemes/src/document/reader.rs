//! TOML text → tables, texts, numbers and lists with their places; what cannot be read becomes a fault.

use std::fmt::Display;
use std::ops::{Range, RangeInclusive};

use toml::de::{DeTable, DeValue, Error};

use super::fault::{Fault, Faults, Source};
use super::keys::Keys;
use super::value::{Placed, Text, Value, whole_number};
use crate::symbolic::nearest;

/// Reads the text as TOML: its outermost table, if the text is TOML at all, and all faults of the syntax.
pub fn document(source: &Source) -> (Option<DeTable<'_>>, Vec<Fault>) {
    let (document, errors) = DeTable::parse_recoverable(&source.text);
    // what follows a broken line may be a fault of that line only; a repeated key breaks nothing
    if let Some(first) = errors.iter().find(|error| !is_repeated_key(error)) {
        return (None, vec![syntax_fault(source, first)]);
    }
    let faults = errors.iter().map(|error| syntax_fault(source, error)).collect();
    (Some(document.into_inner()), faults)
}

/// The outermost table of a text that is TOML without faults.
///
/// # Errors
/// The faults of its syntax.
pub fn valid_document(source: &Source) -> Result<DeTable<'_>, Faults> {
    let (document, faults) = document(source);
    Faults::or(faults, document)
}

fn is_repeated_key(error: &Error) -> bool {
    error.message().contains("duplicate key")
}

fn syntax_fault(source: &Source, error: &Error) -> Fault {
    let at = error.span().unwrap_or(0..0);
    match error.message() {
        // the parser's message about any bare word
        message if message.starts_with("invalid boolean") => {
            source.fault(&at, "a bare word is not a value").hint("write numbers in digits and texts in quotes")
        }
        message if is_repeated_key(error) => source.fault(&at, message).hint("keep one of the two"),
        message => {
            let fault = source.fault(&at, message.replace('\n', ", "));
            match unquoted_formula(&source.text, at.start) {
                Some(formula) => fault.hint(format!("write fractions and formulas in quotes: \"{formula}\"")),
                None => fault,
            }
        }
    }
}

/// A formula such as `1/20` without quotes around a place of the text.
fn unquoted_formula(text: &str, place: usize) -> Option<&str> {
    let is_formula = |c: char| c.is_ascii_alphanumeric() || "+-*/^(). _".contains(c);
    let (before, after) = (text.get(..place)?, text.get(place..)?);
    let begin = before.rfind(|c| !is_formula(c)).map_or(0, |i| i + 1);
    let end = after.find(|c| !is_formula(c)).unwrap_or(after.len());
    let formula = text.get(begin..place + end)?.trim();
    let is_value = before[..begin].trim_end().ends_with(['=', '[', ',']);
    let has_operator = formula.contains(['/', '*', '^', '('])
        && formula.starts_with(|c: char| c.is_ascii_alphanumeric() || "+-.(".contains(c));
    (is_value && has_operator).then_some(formula)
}

/// A table of the document with the keys that it may have; an empty one where the document leaves it out.
#[derive(Debug)]
pub struct Section<'t, 'i> {
    keys: Keys,
    table: Option<&'t DeTable<'i>>,
    /// Where it is.
    pub at: Range<usize>,
}

impl<'t, 'i> Section<'t, 'i> {
    /// Whether the document has it.
    fn is_there(&self) -> bool {
        self.table.is_some()
    }

    /// The value of a key, where it is given. The key must be one that the table may have.
    pub fn get(&self, key: &str) -> Option<&'t Value<'i>> {
        debug_assert!(self.keys.find(key).is_some(), "`{key}` is not among the keys");
        self.table?.get(key)
    }

    /// Whether a key is there in a misspelling.
    pub fn misspells(&self, key: &str) -> bool {
        self.table.is_some_and(|table| table.keys().any(|word| self.keys.is_misspelling(word.get_ref(), key)))
    }
}

/// Of more words than these the nearest is shown.
const MOST_SHOWN: usize = 4;

/// Reads the values of a document and collects what is wrong with them.
#[derive(Debug)]
pub struct Reader<'a> {
    /// The document's text.
    pub source: &'a Source,
    /// All faults so far.
    pub faults: Vec<Fault>,
}

impl<'a> Reader<'a> {
    /// A reader of a document with the faults of its syntax.
    pub fn new(source: &'a Source, faults: Vec<Fault>) -> Reader<'a> {
        Reader { source, faults }
    }

    /// Adds a fault.
    pub fn fault(&mut self, at: &Range<usize>, message: impl Into<String>, hint: impl Into<String>) {
        self.faults.push(self.source.fault(at, message).hint(hint));
    }

    /// Adds a fault in place of a value.
    pub fn wrong<T>(&mut self, at: &Range<usize>, message: impl Into<String>, hint: impl Into<String>) -> Option<T> {
        self.fault(at, message, hint);
        None
    }

    /// Adds the fault of a value that is not what is `needed`, such as `a text in quotes`.
    pub fn wrong_kind<T>(&mut self, value: &Value<'_>, needed: &str) -> Option<T> {
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

/// Tables.
impl Reader<'_> {
    /// A table at the range `at`; unknown keys are faults.
    pub fn table<'t, 'i>(&mut self, table: &'t DeTable<'i>, at: Range<usize>, keys: Keys) -> Section<'t, 'i> {
        for key in table.keys() {
            let word: &str = key.get_ref();
            if !keys.has_names && keys.find(word).is_none() {
                self.fault(&key.span(), format!("unknown key `{word}`"), keys.hint(word));
            }
        }
        Section { keys, table: Some(table), at }
    }

    /// The table that is the value of a key of `parent`: `[name]`.
    pub(crate) fn section<'t, 'i>(&mut self, parent: &'t DeTable<'i>, name: &str, keys: Keys) -> Section<'t, 'i> {
        match parent.get(name).map(|value| (value, value.get_ref())) {
            Some((value, DeValue::Table(table))) => return self.table(table, value.span(), keys),
            Some((value, _)) => self.wrong_kind(value, &format!("a table: [{name}]")).unwrap_or(()),
            None => {}
        }
        Section { keys, table: None, at: 0..0 }
    }

    /// The value of a key that cannot be left out.
    pub fn required<'t, 'i>(&mut self, section: &Section<'t, 'i>, key: &str) -> Option<&'t Value<'i>> {
        let value = section.get(key);
        if value.is_none() {
            self.missing(section, &[key]);
        }
        value
    }

    /// Adds the fault that none of some keys is given. A table that is missing, or a key that is misspelt, has a fault
    /// already.
    pub fn missing(&mut self, section: &Section<'_, '_>, keys: &[&str]) {
        if !section.is_there() || keys.iter().any(|key| section.misspells(key)) {
            return;
        }
        let example = |key: &&str| Some(format!("`{key} = {}`", section.keys.find(key)?.example));
        let examples = keys.iter().filter_map(example).collect::<Vec<_>>().join(" or ");
        match keys {
            [key] => self.fault(&section.at, format!("the key `{key}` is missing"), format!("add {examples}")),
            _ => {
                let message = format!("one of the keys `{}` is needed", keys.join("`, `"));
                self.fault(&section.at, message, format!("add one such as {examples}"));
            }
        }
    }
}

/// Values.
impl Reader<'_> {
    /// A text in quotes that is not blank.
    pub fn text(&mut self, value: &Value<'_>) -> Option<Text> {
        match value.get_ref() {
            DeValue::String(text) if text.trim().is_empty() => {
                self.wrong(&value.span(), "this text is empty", "write something between the quotes")
            }
            DeValue::String(_) => Text::of(self.source, value),
            _ => self.wrong_kind(value, "a text in quotes"),
        }
    }

    /// One of a few words, with its meaning.
    pub fn word<T: Copy>(&mut self, value: &Value<'_>, words: &[(&str, T)]) -> Option<Placed<T>> {
        let text = self.text(value)?;
        if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == text.value) {
            return Some(Placed { value: *meaning, at: text.at });
        }
        let near = nearest(&text.value, words.iter().map(|(word, _)| *word)).filter(|_| words.len() > MOST_SHOWN);
        let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let hint = near.map_or(format!("write {}", known.join(" or ")), |near| format!("did you mean \"{near}\"?"));
        self.wrong(&text.at, format!("`{}` is not known here", text.value), hint)
    }

    /// true or false
    pub fn truth(&mut self, value: &Value<'_>) -> Option<Placed<bool>> {
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(Placed { value: *truth, at: value.span() }),
            _ => self.wrong_kind(value, "true or false"),
        }
    }

    /// A whole number within a range; `what` is what messages call it: `a whole number`, `an order`.
    pub fn whole<T>(&mut self, value: &Value<'_>, range: RangeInclusive<T>, what: &str) -> Option<Placed<T>>
    where
        T: TryFrom<u64> + PartialOrd + Display,
    {
        let DeValue::Integer(number) = value.get_ref() else { return self.wrong_kind(value, "a whole number") };
        let found = whole_number(value).and_then(|n| T::try_from(n).ok());
        match found.filter(|n| range.contains(n)) {
            Some(n) => Some(Placed { value: n, at: value.span() }),
            None => {
                let hint = format!("write {what} from {} to {}", range.start(), range.end());
                self.wrong(&value.span(), format!("{} is out of range", number.as_str()), hint)
            }
        }
    }

    /// A finite number as it is written: decimal digits, or an expression in quotes; [`Text::evaluate`] computes it.
    /// `examples` are shown where it is something else.
    pub fn number(&mut self, value: &Value<'_>, examples: &str) -> Option<Text> {
        let at = value.span();
        match value.get_ref() {
            DeValue::String(_) => self.text(value),
            DeValue::Integer(number) if number.radix() != 10 => self.wrong_kind(value, "a number in decimal digits"),
            DeValue::Float(x) if x.as_str().contains("inf") || x.as_str().contains("nan") => {
                self.wrong(&at, format!("{} is not a finite number", x.as_str()), format!("write a number: {examples}"))
            }
            DeValue::Integer(_) | DeValue::Float(_) => Text::of(self.source, value),
            _ => self.wrong_kind(value, &format!("an exact number: {examples}")),
        }
    }

    /// A list that is not empty, each member read by `read`; `what` is what is needed: `a list of names`. Nothing if a
    /// member cannot be read.
    pub fn list<T>(
        &mut self,
        value: &Value<'_>,
        what: &str,
        read: impl FnMut(&mut Self, &Value<'_>) -> Option<T>,
    ) -> Option<Placed<Vec<T>>> {
        let members = self.members(value, what, read)?;
        Some(Placed { value: members.value.into_iter().collect::<Option<_>>()?, at: members.at })
    }

    /// Like [`Reader::list`]; a member that cannot be read is left out, so that the others can be checked too.
    pub(crate) fn readable_members<T>(
        &mut self,
        value: &Value<'_>,
        what: &str,
        read: impl FnMut(&mut Self, &Value<'_>) -> Option<T>,
    ) -> Vec<T> {
        self.members(value, what, read).into_iter().flat_map(|members| members.value).flatten().collect()
    }

    /// Whether a list has at most this many members; adds a fault if it has more, and then none is read. `what` is
    /// what they are: `weights`.
    pub fn has_at_most(&mut self, value: &Value<'_>, most: usize, what: &str) -> bool {
        let count = match value.get_ref() {
            DeValue::Array(array) => array.len(),
            DeValue::Table(table) => table.len(),
            _ => 0,
        };
        if count > most {
            self.fault(&value.span(), format!("{count} {what} are too many"), format!("at most {most} are allowed"));
        }
        count <= most
    }

    fn members<T>(
        &mut self,
        value: &Value<'_>,
        what: &str,
        mut read: impl FnMut(&mut Self, &Value<'_>) -> Option<T>,
    ) -> Option<Placed<Vec<Option<T>>>> {
        let DeValue::Array(array) = value.get_ref() else { return self.wrong_kind(value, what) };
        if array.is_empty() {
            return self.wrong(&value.span(), "this list is empty", format!("write {what}"));
        }
        Some(Placed { value: array.iter().map(|value| read(self, value)).collect(), at: value.span() })
    }
}
