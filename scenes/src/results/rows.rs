//! Rows and the head of a file, as CSV or as JSON lines.

use std::io::Write;

use serde::{Serialize, Serializer};
use shadowstep::Real;
use shadowstep::shadow::Estimate;

use crate::error::Error;
use crate::results::metadata::Metadata;
use crate::results::origin::METADATA;
use crate::results::resumable::beside;
use crate::results::target::Target;
use crate::scene::{COLUMNS, Format};
use crate::tangent::TangentRun;
use crate::watch::summary::Summary;
use crate::whole_file::WholeFile;

/// A state of the run: what is written at its n. Numbers are texts that give the same numbers when they are read.
#[derive(Serialize)]
pub(crate) struct Row<'a> {
    pub(crate) n: i64,
    pub(crate) t: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) energy: Option<String>,
    #[serde(flatten)]
    pub(crate) modified_energy: Option<ModifiedEnergy>,
    #[serde(flatten)]
    pub(crate) chaos: Option<Indicators>,
    #[serde(flatten)]
    pub(crate) values: Values<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) q: Option<Vec<String>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) p: Option<Vec<String>>,
}

/// Values of expressions with the names of their columns; what is not due or not finite has no text.
pub(crate) struct Values<'a>(pub(crate) Vec<(&'a str, Option<String>)>);

impl Serialize for Values<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().filter_map(|(name, text)| Some((name, text.as_ref()?))))
    }
}

#[derive(Serialize)]
pub(crate) struct ModifiedEnergy {
    pub(crate) modified_energy: String,
    pub(crate) estimate: Option<String>,
    pub(crate) order: u32,
}

/// Indicators of chaos up to the state; a number that is not finite, as at t = 0, has no text.
#[derive(Serialize)]
pub(crate) struct Indicators {
    pub(crate) lyapunov: Option<String>,
    pub(crate) megno: Option<String>,
    pub(crate) mean_megno: Option<String>,
    pub(crate) sali: Option<String>,
}

impl Indicators {
    pub(crate) fn of(run: &dyn TangentRun) -> Self {
        let growth = run.growths()[0];
        let text = |x: f64| Some(x).filter(|x| x.is_finite()).map(|x| x.to_text());
        Indicators {
            lyapunov: text(growth.lyapunov()),
            megno: text(growth.megno()),
            mean_megno: text(growth.mean_megno()),
            sali: run.sali().and_then(text),
        }
    }
}

impl ModifiedEnergy {
    pub(crate) fn of<N: Real>(found: &Estimate<'_, N>) -> Self {
        ModifiedEnergy {
            modified_energy: found.value.to_text(),
            estimate: found.error.map(N::to_text),
            order: found.order,
        }
    }
}

/// The columns of a CSV file besides n and t.
pub(crate) struct Columns {
    pub(crate) energy: bool,
    pub(crate) modified_energy: bool,
    pub(crate) chaos: bool,
    /// The names of values.
    pub(crate) values: Vec<String>,
    /// The names of positions and momenta, if they are written.
    pub(crate) state: Vec<String>,
    /// How many of these are positions.
    pub(crate) coordinates: usize,
}

impl Columns {
    fn names(&self) -> Vec<&str> {
        let mut names = COLUMNS[..2].to_vec();
        names.extend(self.energy.then_some(COLUMNS[2]));
        names.extend(COLUMNS[3..6].iter().filter(|_| self.modified_energy));
        names.extend(COLUMNS[6..].iter().filter(|_| self.chaos));
        names.extend(self.values.iter().chain(&self.state).map(String::as_str));
        names
    }

    /// The cells of a row; what is not written at this n is empty.
    fn cells(&self, row: &Row<'_>) -> Vec<String> {
        let mut cells = vec![row.n.to_string(), row.t.clone()];
        if self.energy {
            cells.push(row.energy.clone().unwrap_or_default());
        }
        match row.modified_energy.as_ref().filter(|_| self.modified_energy) {
            Some(ModifiedEnergy { modified_energy, estimate, order }) => {
                cells.extend([modified_energy.clone(), estimate.clone().unwrap_or_default(), order.to_string()]);
            }
            None => cells.extend(vec![String::new(); if self.modified_energy { 3 } else { 0 }]),
        }
        match row.chaos.as_ref().filter(|_| self.chaos) {
            Some(Indicators { lyapunov, megno, mean_megno, sali }) => {
                cells.extend([lyapunov, megno, mean_megno, sali].map(|text| text.clone().unwrap_or_default()));
            }
            None => cells.extend(vec![String::new(); if self.chaos { 4 } else { 0 }]),
        }
        cells.extend(row.values.0.iter().map(|(_, text)| text.clone().unwrap_or_default()));
        match (&row.q, &row.p) {
            (Some(q), Some(p)) => cells.extend(q.iter().take(self.coordinates).chain(p).cloned()),
            _ => cells.extend(vec![String::new(); self.state.len()]),
        }
        cells
    }
}

/// Writes the head and rows in one format.
pub(crate) struct Rows<'a> {
    pub(crate) target: Target<'a>,
    pub(crate) format: Format,
    pub(crate) columns: Columns,
}

impl Rows<'_> {
    /// In CSV the metadata and the names of the columns; JSON lines are rows only.
    pub(crate) fn head(&mut self, metadata: &Metadata) -> Result<(), Error> {
        match self.format {
            Format::JsonLines => Ok(()),
            Format::Csv => {
                for line in metadata.lines() {
                    writeln!(self.target, "# {line}")?;
                }
                let line = record(self.columns.names())?;
                Ok(self.target.write_all(&line)?)
            }
        }
    }

    /// Completes the file. Beside one of JSON lines, another one has the metadata and the summary.
    pub(crate) fn finish(self, metadata: &Metadata, summary: Option<&Summary>) -> Result<(), Error> {
        if let (Format::JsonLines, Some(path)) = (self.format, self.target.path()) {
            let mut file = WholeFile::create(&beside(path, METADATA), "file")?;
            let object = serde_json::json!({ "metadata": metadata, "summary": summary });
            writeln!(file, "{}", serde_json::to_string_pretty(&object)?)?;
            file.finish()?;
        }
        self.target.finish()
    }

    pub(crate) fn row(&mut self, row: &Row<'_>) -> Result<(), Error> {
        match self.format {
            Format::JsonLines => self.line(row),
            Format::Csv => {
                let line = record(self.columns.cells(row))?;
                Ok(self.target.write_all(&line)?)
            }
        }
    }

    fn line(&mut self, object: &impl Serialize) -> Result<(), Error> {
        let line = serde_json::to_string(object)?;
        Ok(writeln!(self.target, "{line}")?)
    }
}

/// A line of CSV; a `csv::Writer` on the target itself would flush it with each line.
fn record<C: AsRef<[u8]>>(cells: impl IntoIterator<Item = C>) -> Result<Vec<u8>, Error> {
    let mut csv = csv::WriterBuilder::new().buffer_capacity(1 << 10).from_writer(Vec::new());
    csv.write_record(cells)?;
    Ok(csv.into_inner().map_err(csv::IntoInnerError::into_error)?)
}
