//! TOML values → texts, numbers, cells and lists of them, with their places; what is of the wrong kind becomes a fault.

use std::ops::Range;

use shadowstep_symbolic::nearest;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::fault::{Fault, Source};
use crate::table::{Cell, Placed};

/// Collects faults while it reads.
pub(crate) struct Reader<'a> {
    pub(crate) source: &'a Source,
    pub(crate) faults: Vec<Fault>,
}

impl Reader<'_> {
    pub(crate) fn fault(&mut self, at: &Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.faults.push(self.source.fault(at, message).help(help));
    }

    pub(crate) fn refuse_unknown(&mut self, table: &DeTable<'_>, known: &[&str], whose: &str) {
        for key in table.keys() {
            let word: &str = key.get_ref();
            if !known.contains(&word) {
                let help = match nearest(word, known.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("the keys of {whose} are {}", known.join(", ")),
                };
                self.fault(&key.span(), format!("unknown key `{word}`"), help);
            }
        }
    }

    pub(crate) fn text(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Placed<String>> {
        match value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() => {
                Some(Placed { value: text.trim().to_owned(), at: value.span() })
            }
            DeValue::String(_) => self.wrong(value, "this text is empty", "write something between the quotes"),
            _ => self.wrong_kind(value, "a text in quotes"),
        }
    }

    pub(crate) fn truth(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Placed<bool>> {
        match value.get_ref() {
            DeValue::Boolean(truth) => Some(Placed { value: *truth, at: value.span() }),
            _ => self.wrong_kind(value, "true or false"),
        }
    }

    pub(crate) fn whole(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        range: std::ops::RangeInclusive<u32>,
        help: &str,
    ) -> Option<Placed<u32>> {
        let DeValue::Integer(number) = value.get_ref() else {
            return self.wrong_kind(value, "a whole number");
        };
        match u32::from_str_radix(number.as_str(), number.radix()) {
            Ok(n) if range.contains(&n) => Some(Placed { value: n, at: value.span() }),
            _ => self.wrong(value, format!("{} is out of range", number.as_str()), help),
        }
    }

    pub(crate) fn member<'t, 'i>(
        &mut self,
        table: &'t DeTable<'i>,
        whole: &Spanned<DeValue<'_>>,
        key: &str,
    ) -> Option<&'t Spanned<DeValue<'i>>> {
        let value = table.get(key);
        if value.is_none() {
            self.fault(&whole.span(), format!("the key `{key}` is missing"), format!("add `{key} = […]`"));
        }
        value
    }

    pub(crate) fn cells(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Placed<Vec<Cell>>> {
        let DeValue::Array(array) = value.get_ref() else {
            return self.wrong_kind(value, "a list of weights, such as [\"1/2\", \"1/2\"]");
        };
        if array.is_empty() {
            return self.wrong(value, "this list of weights is empty", "a scheme has at least one stage");
        }
        let cells = array.iter().map(|v| self.cell(v)).collect::<Vec<_>>();
        Some(Placed { value: cells.into_iter().collect::<Option<_>>()?, at: value.span() })
    }

    /// The members of a list, each read by `member`; those that have a fault are left out.
    pub(crate) fn list<T>(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        needed: &str,
        member: impl Fn(&mut Self, &Spanned<DeValue<'_>>) -> Option<T>,
    ) -> Vec<T> {
        match value.get_ref() {
            DeValue::Array(array) if !array.is_empty() => array.iter().filter_map(|v| member(self, v)).collect(),
            DeValue::Array(_) => {
                self.wrong::<()>(value, "this list is empty", format!("write {needed}, or leave the key out"));
                Vec::new()
            }
            _ => {
                self.wrong_kind::<()>(value, needed);
                Vec::new()
            }
        }
    }

    pub(crate) fn cell(&mut self, value: &Spanned<DeValue<'_>>) -> Option<Cell> {
        match value.get_ref() {
            // the place of the expression is inside the quotes
            DeValue::String(text) => {
                let span = value.span();
                let quotes = (span.len().saturating_sub(text.len())) / 2;
                Some(Placed { value: text.to_string(), at: span.start + quotes..span.end - quotes })
            }
            DeValue::Integer(n) if n.radix() == 10 => Some(Placed { value: n.as_str().to_owned(), at: value.span() }),
            DeValue::Float(x) if x.as_str().contains("inf") || x.as_str().contains("nan") => {
                self.wrong(value, format!("a weight cannot be {}", x.as_str()), "weights are finite exact numbers")
            }
            DeValue::Float(x) => Some(Placed { value: x.as_str().to_owned(), at: value.span() }),
            _ => self.wrong_kind(value, "an exact number: 1, 0.25 or an expression in quotes, \"1/(2 - 2^(1/3))\""),
        }
    }

    pub(crate) fn wrong<T>(
        &mut self,
        value: &Spanned<DeValue<'_>>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.fault(&value.span(), message, help);
        None
    }

    pub(crate) fn wrong_kind<T>(&mut self, value: &Spanned<DeValue<'_>>, needed: &str) -> Option<T> {
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
