//! Faults of a document: what is wrong, where, what was found and what is needed.

use std::fmt;
use std::ops::Range;
use std::path::Path;

/// The text of a document and its name in messages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path of the file, or the name of a shipped document.
    pub path: String,
    /// The TOML text.
    pub text: String,
}

impl Source {
    /// The folder of the file, to which paths in it are relative.
    pub fn folder(&self) -> &Path {
        Path::new(&self.path).parent().unwrap_or(Path::new(""))
    }

    /// A fault of this text at the byte range `at`.
    pub fn fault(&self, at: &Range<usize>, message: impl Into<String>) -> Fault {
        let start = self.floor_boundary(at.start);
        let line_start = self.text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line = self.text[line_start..].lines().next().unwrap_or("");
        let before = self.text[line_start..start].chars().count();
        let (source_line, shown_before) = shortened(line, before);
        let marked = source_line.chars().count().saturating_sub(shown_before).max(1);
        let meant = self.text[start..].char_indices().take_while(|(i, _)| start + i < at.end).count();
        Fault {
            path: self.path.clone(),
            line: self.text[..line_start].matches('\n').count() + 1,
            column: before + 1,
            marked: shown_before..shown_before + meant.clamp(1, marked),
            source_line,
            message: with_short_numbers(&message.into()),
            values: None,
            hint: None,
        }
    }

    fn floor_boundary(&self, at: usize) -> usize {
        (0..=at.min(self.text.len())).rev().find(|&i| self.text.is_char_boundary(i)).unwrap_or(0)
    }
}

/// The most characters of a line that are shown.
const LONGEST_LINE: usize = 160;

/// A line, or the part of a long line around the character `place`; and how many characters are before it then.
fn shortened(line: &str, place: usize) -> (String, usize) {
    let length = line.chars().count();
    if length <= LONGEST_LINE {
        return (line.to_owned(), place);
    }
    let begin = place.saturating_sub(LONGEST_LINE / 4);
    let part: String = line.chars().skip(begin).take(LONGEST_LINE).collect();
    let (head, tail) = (if begin > 0 { "…" } else { "" }, if begin + LONGEST_LINE < length { "…" } else { "" });
    (format!("{head}{part}{tail}"), place - begin + head.chars().count())
}

/// One fault of a document, with its place.
///
/// Displayed as the sentence, the line with the place marked, the values and the hint, if there are any:
/// ```text
/// mine.toml:3:9: order 4 is claimed, order 1 holds: the condition of the word KD fails
///   3 | order = 4
///     |         ^
///   found 0.5938, needed 1/2
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Path of the file.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The line itself; of a long one the part around the place.
    pub source_line: String,
    /// The characters of `source_line` that are marked, at least one.
    pub marked: Range<usize>,
    /// What is wrong, one sentence.
    pub message: String,
    /// The value found and the value needed.
    pub values: Option<(String, String)>,
    /// What would be right.
    pub hint: Option<String>,
}

impl Fault {
    /// Adds the value found and the value needed.
    pub fn values(mut self, found: impl Into<String>, needed: impl Into<String>) -> Fault {
        self.values = Some((found.into(), needed.into()));
        self
    }

    /// Adds what would be right.
    pub fn hint(mut self, hint: impl Into<String>) -> Fault {
        self.hint = Some(hint.into());
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fault { path, line, column, source_line, marked, message, .. } = self;
        let margin = " ".repeat(line.to_string().len());
        let place = " ".repeat(marked.start);
        writeln!(f, "{path}:{line}:{column}: {message}")?;
        writeln!(f, "  {line} | {}", source_line.replace('\t', " "))?;
        write!(f, "  {margin} | {place}{}", "^".repeat(marked.len()))?;
        if let Some((found, needed)) = &self.values {
            write!(f, "\n  found {found}, needed {needed}")?;
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n  hint: {hint}")?;
        }
        Ok(())
    }
}

/// All faults of a document, at least one, in the order of their places.
#[derive(Clone, PartialEq, Eq)]
pub struct Faults(pub Vec<Fault>);

impl Faults {
    /// The faults sorted by place; `None` if there are none.
    pub fn of(mut faults: Vec<Fault>) -> Option<Faults> {
        faults.sort_by(|a, b| (&a.path, a.line, a.column).cmp(&(&b.path, b.line, b.column)));
        (!faults.is_empty()).then_some(Faults(faults))
    }

    /// What was read, unless there are faults.
    ///
    /// # Errors
    /// The faults.
    ///
    /// # Panics
    /// If there is neither: what cannot be read is a fault.
    pub fn or<T>(faults: Vec<Fault>, found: Option<T>) -> Result<T, Faults> {
        match Faults::of(faults) {
            Some(faults) => Err(faults),
            None => Ok(found.expect("what cannot be read is a fault")),
        }
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.0.iter().enumerate() {
            write!(f, "{}{fault}", if i == 0 { "" } else { "\n" })?;
        }
        Ok(())
    }
}

crate::debug_as_text!(Faults);

impl std::error::Error for Faults {}

/// The most digits that follow each other in a message.
const MOST_DIGITS: usize = 60;

/// A message in which `…` stands for the rest of long numbers: these are in the text that it is about.
///
/// ```
/// use shadowstep_schemes::document::with_short_numbers;
///
/// let zeros = "0".repeat(300);
/// assert_eq!(with_short_numbers(&format!("1{zeros} is out of range")), "10000000000000000000… is out of range");
/// assert_eq!(with_short_numbers("0.25 is out of range"), "0.25 is out of range");
/// ```
pub fn with_short_numbers(message: &str) -> String {
    let mut short = String::new();
    for part in message.split_inclusive(|c: char| !c.is_ascii_digit()) {
        let digits = part.bytes().take_while(u8::is_ascii_digit).count();
        if digits > MOST_DIGITS {
            short.extend([&part[..MOST_DIGITS / 3], "…", &part[digits..]]);
        } else {
            short.push_str(part);
        }
    }
    short
}
