//! A row: a cell for each column, as cells of CSV, as a record of NumPy, or as an object of JSON lines.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use shadowstep::Real;

/// The name of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Name {
    pub(crate) text: String,
    /// The list that has the column in JSON lines and in records of NumPy.
    pub(crate) list: Option<&'static str>,
    /// Whether it is a column, and not only in the list of JSON lines.
    pub(crate) is_column: bool,
}

impl From<&str> for Name {
    fn from(text: &str) -> Self {
        Name { text: text.to_owned(), list: None, is_column: true }
    }
}

impl Name {
    pub(crate) fn of_list(text: &str, list: &'static str, is_column: bool) -> Self {
        Name { list: Some(list), is_column, ..Name::from(text) }
    }
}

/// What a row has in a column.
#[derive(Clone, Debug)]
pub(crate) enum Cell<N> {
    Step(i64),
    Number(N),
    Order(u32),
    /// An indicator of chaos, which may be NaN.
    Double(f64),
    /// What is not known at this n.
    None,
    /// What is not written at this n.
    NotDue,
}

impl<N: Real> Cell<N> {
    /// As in CSV: a text that gives the same number when it is read.
    pub(super) fn text(&self) -> String {
        match self {
            Cell::Step(n) => n.to_string(),
            Cell::Number(x) => x.to_text(),
            Cell::Order(order) => order.to_string(),
            Cell::Double(x) if x.is_finite() => x.to_text(),
            Cell::Double(_) | Cell::None | Cell::NotDue => String::new(),
        }
    }

    /// As in a record of NumPy: a double, but of n an integer; NaN of what is not there.
    pub(super) fn bytes(&self) -> [u8; 8] {
        match self {
            Cell::Step(n) => n.to_le_bytes(),
            Cell::Number(x) => x.to_f64().to_le_bytes(),
            Cell::Order(order) => f64::from(*order).to_le_bytes(),
            Cell::Double(x) => x.to_le_bytes(),
            Cell::None | Cell::NotDue => f64::NAN.to_le_bytes(),
        }
    }
}

/// As in JSON lines: numbers are texts that give the same numbers when they are read.
impl<N: Real> Serialize for Cell<N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Cell::Step(n) => n.serialize(serializer),
            Cell::Order(order) => order.serialize(serializer),
            Cell::Number(_) | Cell::Double(_) => {
                Some(self.text()).filter(|text| !text.is_empty()).serialize(serializer)
            }
            Cell::None | Cell::NotDue => serializer.serialize_none(),
        }
    }
}

/// A cell for each name.
pub(super) struct Row<'a, N> {
    pub(super) names: &'a [Name],
    pub(super) cells: &'a [Cell<N>],
}

impl<'a, N> Row<'a, N> {
    /// Those of columns.
    pub(super) fn of_columns(&self) -> impl Iterator<Item = &'a Cell<N>> + use<'a, N> {
        self.names.iter().zip(self.cells).filter(|(name, _)| name.is_column).map(|(_, cell)| cell)
    }
}

/// As an object of JSON lines.
impl<N: Real> Serialize for Row<'_, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        let mut rest = self.cells;
        for names in self.names.chunk_by(|a, b| a.list.is_some() && a.list == b.list) {
            let (cells, after) = rest.split_at(names.len());
            rest = after;
            match (names[0].list, cells) {
                (_, [Cell::NotDue, ..]) => {}
                (Some(list), cells) => object.serialize_entry(list, cells)?,
                (None, cells) => object.serialize_entry(&names[0].text, &cells[0])?,
            }
        }
        object.end()
    }
}
