//! `results.csv`: a head of lines that begin with `#`, the names of the columns, and a row for each run.

use std::io::Write;
use std::path::Path;

use csv::Writer;
use shadowstep_scenes::spreadsheet::cell;
use shadowstep_scenes::{Error, WholeFile};

use super::table::{Cell, Head, Table};

/// The name of the file.
pub(super) const NAME: &str = "results.csv";

pub(super) struct CsvTable {
    writer: Writer<WholeFile>,
}

impl CsvTable {
    pub(super) fn new(folder: &Path, head: &Head) -> Result<Self, Error> {
        let mut file = WholeFile::create(&folder.join(NAME), "file")?;
        for (name, value) in &head.lines {
            writeln!(file, "# {name}: {value}")?;
        }
        let mut writer = Writer::from_writer(file);
        writer.write_record(head.columns.iter().map(|column| cell(&column.name).into_owned()))?;
        Ok(CsvTable { writer })
    }
}

impl Table for CsvTable {
    fn row(&mut self, cells: &[Cell]) -> Result<(), Error> {
        for own in cells {
            match own {
                Cell::Text(text) => self.writer.write_field(cell(text).as_ref())?,
                Cell::Double(double) => self.writer.write_field(double.to_string())?,
                Cell::Empty => self.writer.write_field("")?,
            }
        }
        Ok(self.writer.write_record(None::<&[u8]>)?)
    }

    fn finish(self: Box<Self>) -> Result<WholeFile, Error> {
        Ok(self.writer.into_inner().map_err(|error| error.into_error())?)
    }
}
