//! Schemes by their names: shipped ones, and tables in files.

use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path};

use shadowstep::exact_flow;
use shadowstep::problems::Problem;
use shadowstep::tables::{self, Source, TableScheme, shipped_names};
use shadowstep_schemes::{First, shipped, shipped_hint};

use crate::complaint::Complaint;

/// The word that stands in place of a scheme for the exact flow.
pub(crate) const EXACT_FLOW: &str = "exact-flow";

/// A scheme under the name by which it was asked for.
#[derive(Debug)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) scheme: TableScheme,
}

/// The scheme that a word means: a shipped one, or a file.
pub(crate) fn scheme(word: &str) -> Result<Named, Complaint> {
    scheme_from(word, Path::new(""), None)
}

/// The same, with files as seen from a folder and steps that may begin with the other map.
pub(crate) fn scheme_from(word: &str, folder: &Path, first: Option<First>) -> Result<Named, Complaint> {
    let source = source_from(word, folder)?;
    let scheme = tables::read(&source, &beside_or_shipped, first).map_err(Complaint::Faults)?;
    Ok(Named { name: word.to_owned(), scheme })
}

/// The table that a word means: a shipped one, or a file.
pub(crate) fn source(word: &str) -> Result<Source, Complaint> {
    source_from(word, Path::new(""))
}

fn source_from(word: &str, folder: &Path) -> Result<Source, Complaint> {
    if is_file(word) { file(&folder.join(word).to_string_lossy()) } else { shipped(word).ok_or_else(|| unknown(word)) }
}

/// The text of a table.
fn file(path: &str) -> Result<Source, Complaint> {
    match fs::read_to_string(path) {
        Ok(text) => Ok(Source { path: path.to_owned(), text }),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let shipped = path.strip_suffix(".toml").filter(|name| shipped_names().contains(name));
            let hint = match shipped {
                Some(name) => format!("the shipped scheme is `{name}`, without `.toml`"),
                None => "give the path of a table, or a name that `shadowstep schemes` lists".to_owned(),
            };
            Err(Complaint::usage(format!("there is no file {path}"), hint))
        }
        Err(error) if error.kind() == ErrorKind::InvalidData => {
            Err(Complaint::usage(format!("{path} is no text in UTF-8"), "a table is a TOML file"))
        }
        Err(error) => Err(Complaint::usage(format!("{path} cannot be read: {error}"), "give the path of a table")),
    }
}

/// The base table of a composition: beside the table that names it, else shipped. What is shipped needs only that.
pub(crate) fn beside_or_shipped(base: &str, from: &Source) -> Option<Source> {
    if from.is_shipped() {
        return shipped(base);
    }
    beside(base, &from.path).or_else(|| shipped(base))
}

fn beside(base: &str, from: &str) -> Option<Source> {
    // a file name, no path: so a chain of tables ends or comes back to a name it has had
    let mut parts = Path::new(base).components();
    let (Some(Component::Normal(_)), None) = (parts.next(), parts.next()) else { return None };
    let file = format!("{}.toml", base.strip_suffix(".toml").unwrap_or(base));
    let path = Path::new(from).with_file_name(file).to_str()?.to_owned();
    let text = fs::read_to_string(&path).ok()?;
    Some(Source { path, text })
}

fn is_file(word: &str) -> bool {
    word.ends_with(".toml") || word.contains(std::path::is_separator)
}

fn unknown(word: &str) -> Complaint {
    if word == EXACT_FLOW {
        let known: Vec<_> = exact_flow::problems().map(Problem::name).collect();
        return Complaint::usage(
            "exact-flow is no scheme, but the solution itself, on which an estimator shows its own error",
            format!("`shadowstep drift` and `trace` take it as --scheme, for {}", known.join(", ")),
        );
    }
    let hint = match shipped_hint(word) {
        names if names.ends_with('?') => format!("{names} `shadowstep schemes` lists all"),
        none => format!("{none}; `shadowstep schemes` lists all; the name of a table of yours ends in .toml"),
    };
    Complaint::usage(format!("there is no scheme `{word}`"), hint)
}
