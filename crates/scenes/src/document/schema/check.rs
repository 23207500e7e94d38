//! A document beside its rows: what it has that it cannot have, and what it lacks.

use std::ops::Range;

use shadowstep_schemes::document::{self, Reader, Value};
use shadowstep_schemes::symbolic::nearest;
use toml::de::{DeTable, DeValue};

use super::{Key, Kind, Section, is_given, shown};

/// Numbers in TOML.
const NUMBERS: &str = "1, 0.05, or in quotes \"1/10\" or \"sqrt(2)/20\"";

/// Finds the heading of the section that has a key, for the hint at a key in the wrong one.
type Elsewhere = fn(&str) -> Option<&'static str>;

/// Whether these sections have what their rows say; all faults are added to the reader.
pub fn has_form(
    reader: &mut Reader<'_>,
    root: &DeTable<'_>,
    sections: &[&'static Section],
    elsewhere: Elsewhere,
) -> bool {
    let before = reader.faults.len();
    let mut check = Check { reader, root, elsewhere };
    for section in sections {
        match root.get(section.name()) {
            Some(value) => check.section(section, value),
            None if section.heading.starts_with('[') => {}
            // of the document itself, which has sections besides
            None => {
                let given = check.reader.table(root, 0..0, section.keys().with_names());
                check.keys(section, root, &given);
            }
        }
    }
    reader.faults.len() == before
}

/// Refuses sections that are neither these nor `others`, and a missing one of those that are `required`.
pub(crate) fn refuse_unknown(
    reader: &mut Reader<'_>,
    root: &DeTable<'_>,
    sections: &[&'static Section],
    (required, others): (&[&str], &[&str]),
    elsewhere: Elsewhere,
) {
    let names: Vec<&str> = sections.iter().map(|section| section.name()).collect();
    let is_known = |name: &str| names.contains(&name) || others.contains(&name);
    for key in root.keys().filter(|key| !is_known(key.get_ref())) {
        let word: &str = key.get_ref();
        let help = match (elsewhere(word), nearest(word, names.iter().copied())) {
            (Some(section), _) => format!("`{word}` is a key of {section}"),
            (None, Some(near)) => format!("did you mean [{near}]?"),
            (None, None) => format!("the sections are [{}]", names.join("], [")),
        };
        reader.fault(&key.span(), format!("unknown section `{word}`"), help);
    }
    for name in required.iter().filter(|name| !root.contains_key(**name) && !misspells(root, &names, name)) {
        let help = "`shadowstep scene kepler` writes a scene with all sections";
        reader.fault(&(0..0), format!("the section [{name}] is missing"), help);
    }
}

/// Whether a section is there in a misspelling.
fn misspells(root: &DeTable<'_>, names: &[&str], section: &str) -> bool {
    let is_near = |word: &str| !names.contains(&word) && nearest(word, names.iter().copied()) == Some(section);
    root.keys().any(|word| is_near(word.get_ref()))
}

struct Check<'c, 'r, 'd, 'i> {
    reader: &'c mut Reader<'r>,
    root: &'d DeTable<'i>,
    elsewhere: Elsewhere,
}

impl Check<'_, '_, '_, '_> {
    fn section(&mut self, section: &'static Section, value: &Value<'_>) {
        match value.get_ref() {
            DeValue::Table(table) => self.table(section, table, value.span()),
            DeValue::Array(members) if section.heading.starts_with("[[") && !members.is_empty() => {
                members.iter().for_each(|member| self.section(section, member));
            }
            _ => self.wrong_kind(value, &format!("a table: {}", section.heading)),
        }
    }

    fn wrong_kind(&mut self, value: &Value<'_>, needed: &str) {
        let _: Option<()> = self.reader.wrong_kind(value, needed);
    }

    fn table(&mut self, section: &'static Section, table: &DeTable<'_>, at: Range<usize>) {
        let elsewhere = if section.heading.starts_with('[') { self.elsewhere } else { |_: &str| None };
        let given = self.reader.table(table, at, section.keys().with_elsewhere(elsewhere));
        self.keys(section, table, &given);
    }

    fn keys(&mut self, section: &'static Section, table: &DeTable<'_>, given: &document::Section<'_, '_>) {
        for key in section.keys {
            match table.get(key.name) {
                Some(value) => {
                    self.value(&key.kind, value, key.example);
                    self.others(section, (key, value), given, table);
                }
                None if key.default.is_none() => self.reader.missing(given, &[key.name]),
                None => {}
            }
        }
        let names = table.iter().filter(|(name, _)| section.find(name.get_ref()).is_none());
        if let Some(kind) = section.names {
            names.for_each(|(_, value)| self.value(kind, value, ""));
        }
        let one_of: Vec<&str> = section.one_of.split('|').filter(|key| !key.is_empty()).collect();
        if !one_of.is_empty() && !one_of.iter().any(|key| is_given(key, table, self.root)) {
            let keys: Vec<&str> = one_of.into_iter().filter(|key| !key.contains('[')).collect();
            self.reader.missing(given, &keys);
        }
    }

    /// Refuses a key without what it needs, or with what it excludes.
    fn others(
        &mut self,
        section: &'static Section,
        (key, value): (&Key, &Value<'_>),
        given: &document::Section<'_, '_>,
        table: &DeTable<'_>,
    ) {
        if key.if_list && !matches!(value.get_ref(), DeValue::Array(_)) {
            return;
        }
        let root = self.root;
        let is_there = |others: &str| others.split('|').any(|other| is_given(other, table, root));
        if let Some(other) = key.excludes.iter().find(|other| is_there(other)) {
            let message = format!("{} and {} are both given", shown(other).replace('`', ""), key.name);
            return self.reader.fault(&value.span(), message, "keep one of the two");
        }
        let misspelt = |other: &str| match other.split_once('.').map(|(section, _)| section) {
            Some(section) => misspells(root, &[section], section),
            None => !other.starts_with('[') && given.misspells(other.trim_end_matches("[]")),
        };
        if let Some(need) = key.needs.iter().find(|need| !is_there(need))
            && !need.split('|').any(misspelt)
        {
            let row = need.split('|').find_map(|need| section.find(need));
            let needed = row.map_or("it".to_owned(), |row| format!("`{} = {}`", row.name, row.example));
            let message = format!("{} requires {}", key.name, shown(need));
            self.reader.fault(&value.span(), message, format!("add {needed}, or remove `{}`", key.name));
        }
    }

    /// Refuses a value of another kind.
    fn value(&mut self, kind: &Kind, value: &Value<'_>, example: &str) {
        let text = value.get_ref().as_str();
        if kind.is_whole()
            && let Some(number) = text.and_then(|text| text.parse::<u64>().ok())
        {
            return self.reader.fault(&value.span(), "this number is in quotes", format!("write {number}"));
        }
        if !kind.is_of(value.get_ref()) {
            let example = if example.is_empty() { String::new() } else { format!(": {example}") };
            return self.wrong_kind(value, &format!("{kind}{example}"));
        }
        match (kind, value.get_ref()) {
            (Kind::Text(_), _) => drop(self.reader.text(value)),
            (Kind::Word(words), _) => {
                let _ = self.reader.word(value, &words.iter().map(|word| (*word, ())).collect::<Vec<_>>());
            }
            (Kind::Number(_), _) => drop(self.reader.number(value, NUMBERS)),
            (Kind::Whole(least, most), _) => {
                let _ = self.reader.whole(value, *least..=*most, "a whole number");
            }
            (Kind::List(_), DeValue::Array(members)) if members.is_empty() => {
                self.reader.fault(&value.span(), "this list is empty", format!("write {kind}"));
            }
            (Kind::List(kind), DeValue::Array(members)) => {
                members.iter().for_each(|member| self.value(kind, member, ""));
            }
            (Kind::Names(kind), DeValue::Table(table)) => {
                table.values().for_each(|value| self.value(kind, value, ""));
            }
            (Kind::Table(section), DeValue::Table(table)) => self.table(section, table, value.span()),
            (Kind::Any(kinds), found) => {
                if let Some(kind) = kinds.iter().find(|kind| kind.is_of(found)) {
                    self.value(kind, value, "");
                }
            }
            _ => {}
        }
    }
}
