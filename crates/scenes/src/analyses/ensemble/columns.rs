//! The section \[ensemble\]: columns in the text, or in a file.

use std::ops::Range;

use shadowstep::tables::{Faults, Source};
use shadowstep::{Rational, exact};
use shadowstep_schemes::document::{Fault, Reader, Text, Value, document, read_text};
use shadowstep_schemes::symbolic::decimal::to_text;

use crate::document::keys::{ENSEMBLE, section_with};
use crate::document::schema::{Table, has_form};
use crate::files::outside::path_within;
use crate::read::family::Meaning;
use crate::results::sha256;
use crate::texts::error::Error;
use crate::texts::readable::{LONGEST_NUMBER, shortened};

/// The most bytes of a file of columns.
const LARGEST_FILE: u64 = 1 << 30;

/// The other columns of the rows, besides those of a state.
const BESIDE: [&str; 8] = [
    "trajectory",
    "energy_error",
    "energy_start",
    "energy_end",
    "modified_drift",
    "modified_start",
    "modified_end",
    "not_finite",
];

/// Values of some names in each trajectory.
#[derive(Debug)]
pub(super) struct Columns {
    pub(super) names: Vec<String>,
    /// A row for each trajectory, at least one.
    pub(super) rows: Vec<Vec<Rational>>,
    /// Where they are in the scene.
    pub(super) at: Range<usize>,
}

impl Columns {
    pub(super) fn read(source: &Source) -> Result<Columns, Error> {
        let (document, faults) = document(source);
        let Some(document) = document.filter(|_| faults.is_empty()) else { return Err(Faults(faults).into()) };
        let mut reader = Reader::new(source, Vec::new());
        if !has_form(&mut reader, &document, &[&ENSEMBLE], section_with) {
            return Err(Faults(reader.faults).into());
        }
        let section = Table::of(source, &document, &ENSEMBLE);
        if let Some(file) = section.text("file") {
            return of_file(source, &file);
        }
        let found = section.get("columns").and_then(|columns| of_lists(&mut reader, columns));
        match (Faults::of(reader.faults), found) {
            (None, Some(columns)) => Ok(columns),
            (Some(faults), _) => Err(faults.into()),
            (None, None) => unreachable!("what cannot be read is a fault"),
        }
    }

    /// How many trajectories there are.
    pub(super) fn trajectories(&self) -> usize {
        self.rows.len()
    }

    /// Refuses names that are there twice, or that other columns of the rows have, those of a state among them.
    pub(super) fn refuse_repeated<'a>(
        &self,
        source: &Source,
        state: impl Iterator<Item = &'a String>,
    ) -> Result<(), Error> {
        let mut taken: Vec<&str> = BESIDE.into_iter().chain(state.map(String::as_str)).collect();
        for name in &self.names {
            if taken.contains(&name.as_str()) {
                let fault = self.fault(source, format!("two columns would be named `{name}`"));
                return Err(Faults(vec![fault.hint("give the column of the ensemble another name")]).into());
            }
            taken.push(name);
        }
        Ok(())
    }

    /// A hash of the names and values, which may be in another file than the scene.
    pub(super) fn sha256(&self) -> String {
        let row = |row: &Vec<Rational>| row.iter().map(to_text).collect::<Vec<_>>().join(",");
        let rows: Vec<String> = [self.names.join(",")].into_iter().chain(self.rows.iter().map(row)).collect();
        sha256(&rows.join("\n"))
    }

    /// The names with their values in a trajectory.
    pub(super) fn values(&self, t: usize) -> Vec<(String, Meaning)> {
        let meaning = |value: &Rational| Meaning::Number(value.clone());
        self.names.iter().cloned().zip(self.rows[t].iter().map(meaning)).collect()
    }

    /// A fault at the place of the columns.
    pub(super) fn fault(&self, source: &Source, message: impl Into<String>) -> Fault {
        source.fault(&self.at, message)
    }

    /// The faults of a trajectory's scene, with its values.
    pub(super) fn with_trajectory(&self, faults: Faults, t: usize) -> Faults {
        let short = |(name, value): (&String, &Rational)| format!("{name} = {}", shortened(value, LONGEST_NUMBER));
        let values = self.names.iter().zip(&self.rows[t]).map(short);
        let trajectory = format!(" (trajectory {t}: {})", values.collect::<Vec<_>>().join(", "));
        let named = |fault: Fault| Fault { message: fault.message.clone() + &trajectory, ..fault };
        Faults(faults.0.into_iter().map(named).collect())
    }
}

/// columns = { x0 = [0.1, 0.2], depth = [1, 2] }
fn of_lists(reader: &mut Reader<'_>, value: &Value<'_>) -> Option<Columns> {
    let table = value.get_ref().as_table()?;
    let (mut names, mut columns): (Vec<String>, Vec<Vec<Rational>>) = (Vec::new(), Vec::new());
    // in the order of the text
    let mut lists: Vec<_> = table.iter().collect();
    lists.sort_by_key(|(name, _)| name.span().start);
    for (name, list) in lists {
        let column = column(reader, list)?;
        if let Some(first) = columns.first().filter(|first| first.len() != column.len()) {
            let fault = reader.source.fault(&list.span(), "columns need the same number of values");
            reader.faults.push(fault.values(column.len().to_string(), first.len().to_string()));
            return None;
        }
        names.push(Text::of_key(name).value);
        columns.push(column);
    }
    let Some(first) = columns.first() else {
        return reader.wrong(&value.span(), "there is no column", "write columns = { x0 = [0.1, 0.2] }");
    };
    let row = |t: usize| columns.iter().map(|column| column[t].clone()).collect();
    Some(Columns { names, rows: (0..first.len()).map(row).collect(), at: value.span() })
}

fn column(reader: &mut Reader<'_>, list: &Value<'_>) -> Option<Vec<Rational>> {
    let number = |value: &Value<'_>| {
        let text = Text::of(reader.source, value)?;
        match exact(&text.value) {
            Ok(number) => Some(number),
            Err(error) => reader.wrong(&text.place(&error.range()), error.to_string(), "write a number or a fraction"),
        }
    };
    // all faults of the list
    list.get_ref().as_array()?.iter().map(number).collect::<Vec<_>>().into_iter().collect()
}

/// A file of CSV with a line of names; its path is relative to the folder of the scene.
fn of_file(source: &Source, file: &Text) -> Result<Columns, Error> {
    let path = path_within(source, file)?;
    let text = read_text(&path, LARGEST_FILE).map_err(|error| {
        let fault = source.fault(&file.at, format!("{} cannot be read: {error}", path.display()));
        Faults(vec![fault.hint("give a file of CSV with a line of names")])
    })?;
    let shown = path.display().to_string();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let names: Vec<String> =
        reader.headers().map_err(|error| unreadable(&shown, &error))?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    if !names.iter().all(|name| is_name(name)) {
        let hint = "write a line of names, and a row of numbers for each trajectory";
        return Err(Error::usage(format!("{shown}:1: the first line does not have the names of columns"), hint));
    }
    for record in reader.records() {
        rows.push(row(&shown, &names, &record.map_err(|error| unreadable(&shown, &error))?)?);
    }
    if rows.is_empty() {
        let hint = "write a line of names, and a row of numbers for each trajectory";
        return Err(Error::usage(format!("{shown} has no trajectories"), hint));
    }
    Ok(Columns { names, rows, at: file.at.clone() })
}

/// Whether a text can stand in a scene for the values of a column.
fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_') && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The numbers of a trajectory, from a line of the file.
fn row(file: &str, names: &[String], record: &csv::StringRecord) -> Result<Vec<Rational>, Error> {
    let line = record.position().map_or(0, csv::Position::line);
    let value = |(name, cell): (&String, &str)| {
        let message =
            |_| Error::usage(format!("{file}:{line}: the value of {name} is not a number"), "write 0.1, 1e-3 or 1/3");
        exact(cell).map_err(message)
    };
    names.iter().zip(record).map(value).collect()
}

/// A line with more or fewer cells than names, for example.
fn unreadable(file: &str, error: &csv::Error) -> Error {
    Error::usage(format!("{file}: {error}"), "each line has a number for each name")
}
