//! A table in any format.

use shadowstep_scenes::{Error, WholeFile};

/// The head of a table: what is in it.
pub(crate) struct Head {
    /// `shadowstep 0.1.0`, …
    pub(crate) lines: [(&'static str, String); 4],
    pub(crate) columns: Vec<TableColumn>,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TableColumn {
    pub(crate) name: String,
    /// Whether its values are doubles, and not texts.
    pub(crate) is_double: bool,
}

/// A value of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    Text(String),
    /// A finite one.
    Double(f64),
    Empty,
}

impl Cell {
    pub(crate) fn text(text: Option<&String>) -> Cell {
        text.map_or(Cell::Empty, |text| Cell::Text(text.clone()))
    }

    /// None of a number that overflows.
    pub(crate) fn double(number: Option<f64>) -> Cell {
        number.filter(|number| number.is_finite()).map_or(Cell::Empty, Cell::Double)
    }
}

/// A table in any format.
pub(crate) trait Table {
    /// Writes a row, with a cell for each column.
    fn row(&mut self, cells: &[Cell]) -> Result<(), Error>;
    /// The whole file.
    fn finish(self: Box<Self>) -> Result<WholeFile, Error>;
}
