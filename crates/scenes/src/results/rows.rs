//! Rows and the head of a file, as CSV, as JSON lines or as records of NumPy.

use std::io::Write;

use shadowstep::Real;

use crate::files::whole_file::WholeFile;
use crate::results::metadata::Metadata;
use crate::results::numpy;
use crate::results::origin::METADATA;
use crate::results::resumable::beside;
use crate::results::row::{Cell, Name, Row};
use crate::results::target::Target;
use crate::scene::Format;
use crate::texts::error::Error;
use crate::watch::summary::Summary;

/// Writes the head and rows in one format.
pub(crate) struct Rows<'a> {
    pub(crate) target: Target<'a>,
    pub(crate) format: Format,
    pub(crate) names: Vec<Name>,
}

impl Rows<'_> {
    /// In CSV the metadata and the names of the columns; JSON lines are rows only.
    pub(crate) fn head(&mut self, metadata: &Metadata) -> Result<(), Error> {
        match self.format {
            Format::JsonLines => Ok(()),
            Format::Numpy => Ok(self.target.write_all(&numpy::head(&self.names, 0))?),
            Format::Csv => {
                for line in metadata.lines() {
                    writeln!(self.target, "# {line}")?;
                }
                let names = self.names.iter().filter(|name| name.is_column);
                let line = record(names.map(|name| &name.text))?;
                Ok(self.target.write_all(&line)?)
            }
        }
    }

    /// Completes the file. Beside one without a head of metadata, another one has these and the summary.
    pub(crate) fn finish(self, metadata: &Metadata, summary: Option<&Summary>) -> Result<(), Error> {
        if let (false, Some(path)) = (self.format.has_metadata(), self.target.path()) {
            let mut file = WholeFile::create(&beside(path, METADATA), "file")?;
            let object = serde_json::json!({ "metadata": metadata, "summary": summary });
            writeln!(file, "{}", serde_json::to_string_pretty(&object)?)?;
            file.finish()?;
        }
        match self.format {
            Format::Numpy => {
                let records = self.target.bytes_of_rows() / numpy::length(&self.names);
                self.target.finish(Some(&numpy::head(&self.names, records)))
            }
            Format::Csv | Format::JsonLines => self.target.finish(None),
        }
    }

    pub(crate) fn row<N: Real>(&mut self, cells: &[Cell<N>]) -> Result<(), Error> {
        let row = Row { names: &self.names, cells };
        match self.format {
            Format::JsonLines => {
                let line = serde_json::to_string(&row)?;
                Ok(writeln!(self.target, "{line}")?)
            }
            Format::Numpy => Ok(self.target.write_all(&numpy::record(&row))?),
            Format::Csv => {
                let line = record(row.of_columns().map(Cell::text))?;
                Ok(self.target.write_all(&line)?)
            }
        }
    }
}

/// A line of CSV; a `csv::Writer` on the target itself would flush it with each line.
fn record<C: AsRef<[u8]>>(cells: impl IntoIterator<Item = C>) -> Result<Vec<u8>, Error> {
    let mut csv = csv::WriterBuilder::new().buffer_capacity(1 << 10).from_writer(Vec::new());
    csv.write_record(cells)?;
    Ok(csv.into_inner().map_err(csv::IntoInnerError::into_error)?)
}
