//! What a document can contain, as data: a row for each key. Reading, explanations, completion and the JSON Schema are
//! made from the rows.

mod check;
mod json;
mod table;

use std::fmt;

use shadowstep_schemes::document::{self, Keys};
use toml::de::{DeTable, DeValue};

pub use check::has_form;
pub(crate) use check::refuse_unknown;
pub use json::json_schema;
pub use table::{Table, texts};
pub(crate) use table::{each_text, words_of};

/// A section of a document, or a table that is the value of a key.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Its name in brackets: `[output]`, `[[body]]`, `[output.energy]`; something else for the keys before all
    /// sections.
    pub heading: &'static str,
    /// What it is about.
    pub meaning: &'static str,
    /// Keys of which one must be there, separated by `|`; the empty text if there are none.
    pub one_of: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
    /// What other keys have as values, which are names that the user chooses; `None` if there are no others.
    pub names: Option<&'static Kind>,
}

/// A key of a section.
///
/// What it needs and excludes are keys of its section (`file`), keys of other ones (`initial.q`), keys whose value is a
/// list (`parts[]`), or sections (`[[body]]`). Of several with `|` between them one is enough.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its own name.
    pub name: &'static str,
    /// What values it can have.
    pub kind: Kind,
    /// A value in TOML.
    pub example: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// The default; `None` if the key is required.
    pub default: Option<&'static str>,
    /// What must be there, too.
    pub needs: &'static [&'static str],
    /// What cannot be there, too.
    pub excludes: &'static [&'static str],
    /// Whether it needs and excludes these only where its value is a list.
    pub if_list: bool,
}

/// What values a key can have.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A text in quotes: a formula, a path, or what else this is.
    Text(&'static str),
    /// One of these words.
    Word(&'static [&'static str]),
    /// An exact number: digits, or an expression in quotes.
    Number(Sign),
    /// A whole number from the first to the second.
    Whole(u64, u64),
    /// true or false
    Truth,
    /// A list, not empty.
    List(&'static Kind),
    /// A table of names, each with a value of this kind.
    Names(&'static Kind),
    /// A table with these keys.
    Table(&'static Section),
    /// One of these.
    Any(&'static [Kind]),
}

/// What numbers a key can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// All.
    Any,
    /// Those above 0.
    Positive,
    /// All but 0.
    Nonzero,
}

/// Of more words than these the first is shown.
const MOST_SHOWN: usize = 6;

/// A number.
pub const NUMBER: Kind = Kind::Number(Sign::Any);
/// A number above 0.
pub(crate) const POSITIVE: Kind = Kind::Number(Sign::Positive);
/// A number that is not 0.
pub(crate) const NONZERO: Kind = Kind::Number(Sign::Nonzero);
/// Numbers.
pub const NUMBERS: Kind = Kind::List(&NUMBER);
/// A formula.
pub const FORMULA: Kind = Kind::Text("formula");
/// A comparison of formulas.
pub const CONDITION: Kind = Kind::Text("condition");
/// The path of a file.
pub const PATH: Kind = Kind::Text("path");
/// The name of something in the document.
pub const NAME: Kind = Kind::Text("name");
/// Names.
pub const NAMES: Kind = Kind::List(&NAME);

/// The rows of a section: `name: kind => example, meaning, else default, needs […], excludes […];`, of which those
/// after the meaning can be left out.
#[macro_export]
macro_rules! rows {
    ($($name:ident: $kind:expr => $example:literal, $meaning:literal $(, else $default:literal)? $(, needs [$($need:literal),*])?
        $(, excludes [$($other:literal),*])? $(, if_list $list:literal)?;)*) => {
        const { &[$($crate::schema::Key {
            name: stringify!($name),
            kind: $kind,
            example: $example,
            meaning: $meaning,
            default: $crate::schema::only(&[$($default)?]),
            needs: &[$($($need),*)?],
            excludes: &[$($($other),*)?],
            if_list: false $(|| $list)?,
        }),*] }
    };
}

/// The member of a list that has one, at most.
pub const fn only(list: &[&'static str]) -> Option<&'static str> {
    match list {
        [member] => Some(member),
        _ => None,
    }
}

impl Section {
    /// A section with these keys.
    pub const fn new(heading: &'static str, meaning: &'static str, keys: &'static [Key]) -> Section {
        Section { heading, meaning, one_of: "", keys, names: None }
    }

    /// With keys of which one must be there.
    pub const fn one_of(self, one_of: &'static str) -> Section {
        Section { one_of, ..self }
    }

    /// With names that have values of this kind.
    pub const fn with_names(self, kind: &'static Kind) -> Section {
        Section { names: Some(kind), ..self }
    }

    /// Its name without brackets.
    pub fn name(&self) -> &'static str {
        self.heading.trim_matches(['[', ']'])
    }

    /// The key of this name.
    pub fn find(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The tables that are values of its keys and have names of their own.
    pub fn tables(&self) -> impl Iterator<Item = &'static Section> {
        self.keys.iter().filter_map(|key| key.kind.table()).filter(|table| table.heading.starts_with('['))
    }

    /// The keys for the reader of documents.
    fn keys(&self) -> Keys {
        let keys = Keys::new(self.heading, self.keys.iter().map(|key| document::Key::new(key.name, key.example)));
        if self.names.is_some() { keys.with_names() } else { keys }
    }
}

impl Kind {
    /// The table that a value can be.
    pub(crate) fn table(&self) -> Option<&'static Section> {
        match self {
            Kind::Table(section) => Some(section),
            Kind::Any(kinds) => kinds.iter().find_map(Kind::table),
            _ => None,
        }
    }

    /// What numbers of this kind there are.
    pub(crate) fn sign(&self) -> Sign {
        match self {
            Kind::Number(sign) | Kind::List(Kind::Number(sign)) => *sign,
            Kind::Any(kinds) => kinds.first().map_or(Sign::Any, Kind::sign),
            _ => Sign::Any,
        }
    }

    /// Whether a value is of this kind at first sight.
    fn is_of(&self, value: &DeValue<'_>) -> bool {
        match self {
            Kind::Text(_) | Kind::Word(_) => matches!(value, DeValue::String(_)),
            Kind::Number(_) => matches!(value, DeValue::String(_) | DeValue::Integer(_) | DeValue::Float(_)),
            Kind::Whole(..) => matches!(value, DeValue::Integer(_)),
            Kind::Truth => matches!(value, DeValue::Boolean(_)),
            Kind::List(_) => matches!(value, DeValue::Array(_)),
            Kind::Names(_) | Kind::Table(_) => matches!(value, DeValue::Table(_)),
            Kind::Any(kinds) => kinds.iter().any(|kind| kind.is_of(value)),
        }
    }

    /// Whether numbers of this kind are whole ones, and texts are no numbers.
    fn is_whole(&self) -> bool {
        match self {
            Kind::Whole(..) => true,
            Kind::Any(kinds) => kinds.iter().any(Kind::is_whole),
            _ => false,
        }
    }

    /// Several of this kind, without an article.
    fn several(&self) -> String {
        match self {
            Kind::Text(what) => format!("{what}s in quotes"),
            Kind::Word(words) if words.len() > MOST_SHOWN => format!("words such as \"{}\"", words[0]),
            Kind::Number(Sign::Any) => "numbers".to_owned(),
            Kind::Number(Sign::Positive) => "positive numbers".to_owned(),
            Kind::Number(Sign::Nonzero) => "nonzero numbers".to_owned(),
            Kind::Whole(least, most) => format!("whole numbers from {least} to {most}"),
            Kind::List(kind) => format!("lists of {}", kind.several()),
            Kind::Any(kinds) => kinds.iter().map(Kind::several).collect::<Vec<_>>().join(" or "),
            other => other.to_string(),
        }
    }
}

/// With its article: `a whole number from 1 to 3`.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Kind::Text(what) => write!(f, "a {what} in quotes"),
            Kind::Word(words) if words.len() > MOST_SHOWN => write!(f, "a word such as \"{}\"", words[0]),
            Kind::Word(words) => {
                let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
                write!(f, "{}", words.join(" or "))
            }
            Kind::Number(Sign::Any) => write!(f, "a number"),
            Kind::Number(Sign::Positive) => write!(f, "a positive number"),
            Kind::Number(Sign::Nonzero) => write!(f, "a nonzero number"),
            Kind::Whole(least, most) => write!(f, "a whole number from {least} to {most}"),
            Kind::Truth => write!(f, "true or false"),
            Kind::List(kind) => write!(f, "a list of {}", kind.several()),
            Kind::Names(kind) => write!(f, "a table of names with {}", kind.several()),
            Kind::Table(_) => write!(f, "a table"),
            Kind::Any(kinds) => {
                let kinds: Vec<_> = kinds.iter().map(Kind::to_string).collect();
                write!(f, "{}", kinds.join(", or "))
            }
        }
    }
}

/// Whether a document has what a key of a table needs or excludes.
fn is_given(other: &str, table: &DeTable<'_>, root: &DeTable<'_>) -> bool {
    let list = other.strip_suffix("[]");
    let value = match list.unwrap_or(other) {
        section if section.starts_with('[') => root.get(section.trim_matches(['[', ']'])),
        key => match key.split_once('.') {
            Some((section, key)) => root.get(section).and_then(|section| section.get_ref().as_table()?.get(key)),
            None => table.get(key),
        },
    };
    value.is_some_and(|value| list.is_none() || matches!(value.get_ref(), DeValue::Array(_)))
}

/// As messages call what a key needs or excludes: several are separated by `or`.
fn shown(others: &str) -> String {
    let one = |other: &str| match other.strip_suffix("[]") {
        Some(key) => format!("formulas of `{key}`"),
        None if other.starts_with('[') => other.to_owned(),
        None => match other.split_once('.') {
            Some((section, key)) => format!("`{key}` in [{section}]"),
            None => format!("`{other}`"),
        },
    };
    others.split('|').map(one).collect::<Vec<_>>().join(" or ")
}
