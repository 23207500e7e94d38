//! Faults of a table: what is wrong, where, what was found and what is needed.

use std::fmt;
use std::ops::Range;

/// The text of a table and the name under which messages speak of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// File path, or the file name of a shipped table.
    pub path: String,
    /// The TOML text.
    pub text: String,
}

impl Source {
    /// A fault of this text at the byte range `at`.
    pub fn fault(&self, at: &Range<usize>, message: impl Into<String>) -> Fault {
        let start = self.floor_boundary(at.start);
        let line_start = self.text[..start].rfind('\n').map_or(0, |i| i + 1);
        let rest = &self.text[line_start..];
        let source_line = rest.lines().next().unwrap_or("");
        let length = at.end.saturating_sub(start);
        let marked = source_line.get(start - line_start..).unwrap_or("");
        Fault {
            path: self.path.clone(),
            line: self.text[..line_start].matches('\n').count() + 1,
            column: self.text[line_start..start].chars().count() + 1,
            width: marked.char_indices().take_while(|(i, _)| *i < length).count().max(1),
            source_line: source_line.to_owned(),
            message: message.into(),
            values: None,
            help: None,
        }
    }

    fn floor_boundary(&self, at: usize) -> usize {
        (0..=at.min(self.text.len())).rev().find(|&i| self.text.is_char_boundary(i)).unwrap_or(0)
    }
}

/// One fault of a table, with its place.
///
/// Displayed as the sentence, the line with the place marked, and where there are such the values:
/// ```text
/// mine.toml:3:9: order 4 is claimed, order 1 holds: the condition of the word KD fails
///   3 | order = 4
///     |         ^
///   found 0.5938, needed 1/2
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// File of the table.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// How many characters are meant, at least 1.
    pub width: usize,
    /// The line itself.
    pub source_line: String,
    /// What is wrong, one sentence.
    pub message: String,
    /// The value found and the value needed.
    pub values: Option<(String, String)>,
    /// What would be right.
    pub help: Option<String>,
}

impl Fault {
    /// Adds the value found and the value needed.
    pub fn values(mut self, found: impl Into<String>, needed: impl Into<String>) -> Fault {
        self.values = Some((found.into(), needed.into()));
        self
    }

    /// Adds what would be right.
    pub fn help(mut self, help: impl Into<String>) -> Fault {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fault { path, line, column, source_line, message, .. } = self;
        let margin = " ".repeat(line.to_string().len());
        let place = " ".repeat(column - 1);
        writeln!(f, "{path}:{line}:{column}: {message}")?;
        writeln!(f, "  {line} | {}", source_line.replace('\t', " "))?;
        write!(f, "  {margin} | {place}{}", "^".repeat(self.width))?;
        if let Some((found, needed)) = &self.values {
            write!(f, "\n  found {found}, needed {needed}")?;
        }
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

/// All the faults of a table, at least one, in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faults(pub Vec<Fault>);

impl Faults {
    /// The faults sorted by place; `None` if there are none.
    pub fn of(mut faults: Vec<Fault>) -> Option<Faults> {
        faults.sort_by(|a, b| (&a.path, a.line, a.column).cmp(&(&b.path, b.line, b.column)));
        (!faults.is_empty()).then_some(Faults(faults))
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

impl std::error::Error for Faults {}
