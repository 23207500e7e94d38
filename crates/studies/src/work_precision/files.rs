//! The files of a study.

use std::path::{Path, PathBuf};

use crate::Error;
use crate::files::{PAGE, write_charts, write_file, write_page};
use crate::finding::Finding;
use crate::page::{Report, Section};
use crate::work_precision::charts::{PICTURES, Picture};
use crate::work_precision::study::Study;

const DATA: &str = "work-precision.csv";
const LINES: &str = "work-precision.jsonl";
const SCRIPT: &str = "plot.py";

/// Makes PDF of the CSV, or PGF.
const PLOT: &str = include_str!("plot.py");

/// What a study is called in its files.
#[derive(Clone, Copy, Debug)]
pub struct Title<'a> {
    /// The problem, the time and the number type.
    pub title: &'a str,
    /// H.
    pub hamiltonian: &'a str,
    /// The command that makes the study.
    pub command: &'a str,
}

/// Writes data, charts, and a page that contains them; returns the path of the page.
///
/// # Errors
/// A file that cannot be written.
pub fn write(study: &Study<'_>, title: Title<'_>, folder: &Path) -> Result<PathBuf, Error> {
    let reference = study.reference.described();
    let version = format!("shadowstep {}", env!("CARGO_PKG_VERSION"));
    let size = format!("The largest coordinate of the reference is {:.3e}.", study.reference.size());
    let head = [version, format!("command: {}", title.command), title.title.to_owned(), reference.clone(), size];
    write_file(folder, DATA, &study.csv(&head)?)?;
    write_file(folder, LINES, &study.json_lines()?)?;
    write_file(folder, SCRIPT, PLOT)?;
    let mut charts = Vec::new();
    let mut files = [DATA, LINES, SCRIPT].map(str::to_owned).to_vec();
    for Picture { name, caption, chart } in study.pictures() {
        let (chart, for_print) = ([(chart, caption.to_owned())], format!("{name}-print.svg"));
        files.extend(write_charts(folder, name, &chart)?);
        write_file(folder, &for_print, &chart[0].0.svg_for_print())?;
        files.push(for_print);
        charts.extend(chart);
    }
    let hamiltonian = format!("H = {}.", title.hamiltonian);
    let found = [hamiltonian, reference, TIMES.to_owned()].into_iter().chain(study.remark_on_times()).collect();
    let finding = Finding { charts, found, tables: study.tables(), ..Finding::default() };
    let sections = vec![Section { title: title.title.to_owned(), of_paper: None, finding, files }];
    write_page(folder, &Report { sections, ..Report::new("Speed against error", title.command) })
}

const TIMES: &str = "Times are those of the bare steps of tables that are read at run time, in one thread: medians of \
    nine repeats, all schemes by turns. Orders are slopes of the largest range of steps in which no error is off the \
    line by more than 0.1 decades.";

/// The names of all files that are written.
pub fn written() -> impl Iterator<Item = String> {
    let charts = PICTURES.into_iter().flat_map(|name| [format!("{name}.svg"), format!("{name}-print.svg")]);
    [DATA, LINES, SCRIPT, PAGE].into_iter().map(str::to_owned).chain(charts)
}
