//! Collecting the chunks of a sweep: checking that every run is there once, and writing all of them as one table.

mod csv_table;
mod missing;
#[cfg(feature = "parquet")]
mod parquet_table;
mod table;

use std::fs;
use std::io::{self, Write};
use std::iter;
use std::path::{Path, PathBuf};

use shadowstep_scenes::family::Meaning;
use shadowstep_scenes::{Error, WholeFile};

use crate::sweeps::axes::Axes;
use crate::sweeps::chunk;
use crate::sweeps::keep::Column;
use crate::sweeps::manifest::Manifest;
use crate::sweeps::picture::{Cells, Picture, double, number_of};
use crate::sweeps::plan;
use crate::sweeps::record::Record;
use crate::{Observer, Progress};
use csv_table::CsvTable;
pub use missing::Missing;
use missing::ranges;
use table::{Cell, Head, Table, TableColumn};

/// How the table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// `results.csv`
    Csv,
    /// `results.parquet`
    #[cfg(feature = "parquet")]
    Parquet,
}

/// What has been collected.
#[derive(Clone, Debug)]
pub enum Collected {
    /// All runs are there.
    Complete {
        /// The table, and the picture if one could be drawn.
        files: Vec<PathBuf>,
        /// How many runs there are.
        runs: u64,
        /// How many of them failed.
        failed: u64,
        /// What the user should know.
        notes: Vec<String>,
    },
    /// Chunks are missing or cannot be used; nothing is written, and what was collected earlier is removed.
    Incomplete {
        /// These chunks.
        missing: Missing,
        /// The files that were removed.
        removed: Vec<PathBuf>,
    },
}

const ROWS: &str = "rows.csv";
const PICTURE: &str = "picture.svg";
const PARQUET: &str = "results.parquet";
/// The names of all files that are written, one table of them.
pub(crate) const WRITTEN: [&str; 4] = [csv_table::NAME, PARQUET, ROWS, PICTURE];

/// Checks all chunks in the folder of a sweep and writes its table and its picture there.
///
/// Memory does not grow with the number of runs.
///
/// # Errors
/// A folder without a sweep, a file that cannot be written, an observer that stops it.
pub fn collect(folder: &Path, format: TableFormat, observer: &mut dyn Observer) -> Result<Collected, Error> {
    let manifest = Manifest::read(folder)?;
    let (axes, picture) = plan::axes_and_picture(&manifest.source(), &manifest.columns)?;
    let missing = Missing::find(&manifest, folder);
    if !missing.is_empty() {
        return incomplete(folder, missing);
    }
    let mut tables = Tables::new(&manifest, &axes, picture, folder, format)?;
    let mut functions: Vec<(Option<String>, u64)> = Vec::new();
    let mut damaged = Missing::default();
    for chunk in manifest.all_chunks() {
        let found = chunk::read(folder, chunk, manifest.runs, |record| tables.take(&record))?;
        match found {
            Ok(header) => functions.push((header.functions, chunk.number)),
            Err(why) => damaged.add(chunk, why),
        }
        if observer.stops() {
            return Err(Error::run("interrupted: nothing is written", "the same command collects the results"));
        }
        let fraction = chunk.number as f64 / manifest.chunks as f64;
        observer.progress(Progress { done: chunk.number as usize, all: manifest.chunks as usize, fraction });
    }
    if !damaged.is_empty() {
        drop(tables);
        return incomplete(folder, damaged);
    }
    let collected = tables.finish(&functions)?;
    chunk::remove_left(folder);
    Ok(collected)
}

/// A table of an earlier collection would be taken for that of the chunks that are there now.
fn incomplete(folder: &Path, missing: Missing) -> Result<Collected, Error> {
    let mut removed = Vec::new();
    for path in WRITTEN.map(|name| folder.join(name)) {
        match fs::remove_file(&path) {
            Ok(()) => removed.push(path),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => {
                let message = format!("{} is of an earlier collection and cannot be removed: {error}", path.display());
                return Err(Error::usage(message, "remove it: chunks are missing"));
            }
        }
    }
    Ok(Collected::Incomplete { missing, removed })
}

/// All that is written.
struct Tables<'a> {
    manifest: &'a Manifest,
    axes: &'a Axes,
    folder: &'a Path,
    results: Box<dyn Table>,
    /// The rows of all runs, if they are kept.
    rows: Option<WholeFile>,
    picture: Option<(Picture, Cells)>,
    runs: u64,
    failed: u64,
}

impl<'a> Tables<'a> {
    fn new(
        manifest: &'a Manifest,
        axes: &'a Axes,
        picture: Option<Picture>,
        folder: &'a Path,
        format: TableFormat,
    ) -> Result<Self, Error> {
        let head = head(manifest, axes);
        let results: Box<dyn Table> = match format {
            TableFormat::Csv => Box::new(CsvTable::new(folder, &head)?),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => Box::new(parquet_table::ParquetTable::new(&folder.join(PARQUET), &head)?),
        };
        let picture = picture.and_then(|picture| Cells::new(&picture, axes).map(|cells| (picture, cells)));
        Ok(Tables { manifest, axes, folder, results, rows: None, picture, runs: 0, failed: 0 })
    }

    fn take(&mut self, record: &Record) -> Result<(), Error> {
        self.runs += 1;
        self.failed += u64::from(record.failure.is_some());
        let numbers = self.axes.numbers(record.run);
        let mut cells = vec![Cell::Text(record.run.to_string())];
        for (axis, &number) in self.axes.all().iter().zip(&numbers) {
            let value = axis.value(number);
            cells.push(Cell::Text(value.text()));
            if let Meaning::Number(number) = &value {
                cells.push(Cell::double(Some(double(number))));
            }
        }
        for (place, column) in self.manifest.columns.iter().enumerate() {
            let text = record.values.get(place).and_then(Option::as_ref);
            cells.push(Cell::text(text));
            if has_double(column, self.manifest.long_numbers) {
                cells.push(Cell::double(text.and_then(|text| number_of(text))));
            }
        }
        cells.push(Cell::text(record.failure.as_ref()));
        self.results.row(&cells)?;
        if let Some((picture, cells)) = &mut self.picture {
            cells.include(picture, &numbers, record);
        }
        self.take_rows(record)
    }

    /// Writes the rows of a run, with its number in the first column.
    fn take_rows(&mut self, record: &Record) -> Result<(), Error> {
        let Some(rows) = &record.rows else { return Ok(()) };
        let mut lines = rows.lines();
        let Some(names) = lines.next() else { return Ok(()) };
        if self.rows.is_none() {
            let mut file = WholeFile::create(&self.folder.join(ROWS), "file")?;
            writeln!(file, "run,{names}")?;
            self.rows = Some(file);
        }
        let file = self.rows.as_mut().expect("it was created");
        Ok(lines.try_for_each(|line| writeln!(file, "{},{line}", record.run))?)
    }

    fn finish(self, functions: &[(Option<String>, u64)]) -> Result<Collected, Error> {
        let mut files = Vec::new();
        for file in iter::once(self.results.finish()?).chain(self.rows) {
            files.push(file.path().to_owned());
            file.finish()?;
        }
        let mut notes: Vec<String> = functions_differ(functions).into_iter().collect();
        if let Some((picture, cells)) = self.picture {
            let title = Path::new(&self.manifest.path).file_name().unwrap_or_default().to_string_lossy();
            let why = match picture.svg(&cells, self.axes, &self.manifest.columns, &title) {
                Ok(Some(svg)) => {
                    files.push(self.folder.join(PICTURE));
                    let mut file = WholeFile::create(&files[files.len() - 1], "file")?;
                    file.write_all(svg.as_bytes())?;
                    file.finish()?;
                    None
                }
                Ok(None) => Some("no run has such a value, or there are too many words, curves or panels".to_owned()),
                // the table is complete all the same
                Err(Error::Usage { message, hint }) => Some(format!("{message}; {hint}")),
                Err(error) => return Err(error),
            };
            notes.extend(why.map(|why| format!("there is no picture: {why}")));
        }
        Ok(Collected::Complete { files, runs: self.runs, failed: self.failed, notes })
    }
}

/// Whether a column has doubles beside its texts: where these are exact, or have more digits.
fn has_double(column: &Column, long_numbers: bool) -> bool {
    column.is_number && (long_numbers || column.is_exact)
}

fn head(manifest: &Manifest, axes: &Axes) -> Head {
    let text = |name: &str| TableColumn { name: name.to_owned(), is_double: false };
    let double = |name: &str| TableColumn { name: format!("{name}_double"), is_double: true };
    let mut columns = vec![text("run")];
    for axis in axes.all() {
        columns.push(text(&axis.name));
        columns.extend(axis.is_numeric().then(|| double(&axis.name)));
    }
    for column in &manifest.columns {
        columns.push(text(&column.name));
        columns.extend(has_double(column, manifest.long_numbers).then(|| double(&column.name)));
    }
    columns.push(text("failure"));
    let lines = [
        ("shadowstep", manifest.digests.shadowstep.clone()),
        ("sweep", manifest.digests.sweep.clone()),
        ("tables", manifest.digests.tables.clone()),
        ("runs", manifest.runs.to_string()),
    ];
    Head { lines, columns }
}

/// A remark if chunks were computed with different elementary functions.
fn functions_differ(functions: &[(Option<String>, u64)]) -> Option<String> {
    let first = &functions.first()?.0;
    let others: Vec<u64> = functions.iter().filter(|(own, _)| own != first).map(|(_, chunk)| *chunk).collect();
    (!others.is_empty()).then(|| {
        format!(
            "chunks {} were computed with other elementary functions (of another C library or processor) than chunk \
             1: the last digits of their results may differ",
            ranges(&others)
        )
    })
}
