//! The files of a study.

use std::io::Write;
use std::path::{Path, PathBuf};

use shadowstep_scenes::{Error, WholeFile};
use shadowstep_studies::Store;
use shadowstep_studies::page::{self, Report, Section};

use crate::study::Study;

const DATA: &str = "work-precision.csv";
const LINES: &str = "work-precision.jsonl";

const SCRIPT: &str = "plot.py";
const REPORT: &str = "report.html";

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
    let head =
        [version.clone(), format!("command: {}", title.command), title.title.to_owned(), reference.clone(), size];
    write_file(folder, DATA, &study.csv(&head)?)?;
    write_file(folder, LINES, &study.json_lines()?)?;
    write_file(folder, SCRIPT, PLOT)?;
    let mut pictures = Vec::new();
    let mut files = [DATA, LINES, SCRIPT].map(str::to_owned).to_vec();
    for picture in study.pictures(title.title) {
        let [name, for_print] = ["", "-print"].map(|kind| format!("{}{kind}.svg", picture.name));
        let svg = picture.chart.svg()?;
        write_file(folder, &name, &svg)?;
        write_file(folder, &for_print, &picture.chart.svg_for_print()?)?;
        pictures.push(page::Picture { svg, caption: picture.caption.to_owned() });
        files.extend([name, for_print]);
    }
    let section = Section {
        title: title.title.to_owned(),
        of_paper: None,
        stated: Vec::new(),
        pictures,
        findings: Vec::new(),
        found: [format!("H = {}.", title.hamiltonian), reference, TIMES.to_owned()]
            .into_iter()
            .chain(study.remark_on_times())
            .collect(),
        statements: Vec::new(),
        tables: study.tables(),
        files,
    };
    let made_with = [("program", version), ("command", title.command.to_owned())];
    let page = Report {
        title: "Speed against error".to_owned(),
        introduction: Vec::new(),
        remark: None,
        made_with: made_with.map(|(name, value)| (name.to_owned(), value)).to_vec(),
        sections: vec![section],
    };
    write_file(folder, REPORT, &page.html())?;
    Ok(folder.join(REPORT))
}

const TIMES: &str = "Times are those of the bare steps of tables that are read at run time, in one thread: medians of nine repeats, all \
                     schemes by turns. Orders are slopes of the largest range of steps in which no error is off the line by more than 0.1 \
                     decades.";

fn write_file(folder: &Path, name: &str, text: &str) -> Result<(), Error> {
    let mut file = WholeFile::create(&folder.join(name), "the file")?;
    file.write_all(text.as_bytes())?;
    file.finish()
}

/// Files of this program have its results beside them. Without them, files of the same names are not replaced.
///
/// # Errors
/// Such a file.
pub fn refuse_foreign(folder: &Path) -> Result<(), Error> {
    let foreign = [DATA, LINES, SCRIPT, REPORT].into_iter().map(|name| folder.join(name)).find(|path| path.exists());
    match foreign.filter(|_| !Store::is_in(folder)) {
        None => Ok(()),
        Some(path) => {
            let message = format!("{} exists, without results of this program beside it", path.display());
            Err(Error::usage(message, "give another folder, or replace its files with --force"))
        }
    }
}
