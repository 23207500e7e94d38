//! From a request to the files: results are computed until no figure lacks any, then charts, data and report are
//! written.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use shadowstep_scenes::shell_word;

use crate::figures::all::FIGURES;
use crate::figures::data;
use crate::figures::figure::Figure;
use crate::figures::results::Results;
use crate::figures::table::Table;
use crate::files::{PAGE, write_file, write_page, write_section};
use crate::page::{Report, Section};
use crate::{Error, Observer, Store, claim, named};

/// Which figures are wanted, and where.
#[derive(Clone, Debug)]
pub struct Request {
    /// Names of figures; all, if there is none.
    pub names: Vec<String>,
    /// Whether a coarser grid is enough.
    pub quick: bool,
    /// The folder for `report.html`, SVG and CSV files, and for the results, `results.jsonl`.
    pub folder: PathBuf,
}

/// What was written.
#[derive(Clone, Debug)]
pub struct Reproduction {
    /// The file of the report.
    pub report: PathBuf,
    /// How many statements agree, differ, and are not decided:
    /// `statements of the paper: 9 agree, 1 differs, 2 not decided`.
    pub verdicts: String,
}

/// The names of all files that are written, in which a `*` stands for any characters.
pub fn written() -> impl Iterator<Item = String> {
    let of_figure = |figure: &Figure| [format!("{}*.svg", figure.name), format!("{}*.csv", figure.name)];
    [PAGE.to_owned()].into_iter().chain(FIGURES.iter().flat_map(of_figure))
}

/// Computes what the folder does not have yet, and writes charts, data and the report.
///
/// Each figure `name` gets `name.svg`, or `name-1.svg` and so on, and its results as CSV. The report keeps the figures
/// of earlier calls whose results are complete. A failed calculation is reported to the observer and stops no other.
/// Files of the names that [`written`] gives are replaced.
///
/// # Errors
/// An unknown figure; a folder that cannot be written, or that another process uses.
pub fn reproduce(request: &Request, observer: &mut dyn Observer) -> Result<Reproduction, Error> {
    let requested = named(&FIGURES, |figure| figure.name, "figure", &request.names)?;
    let mut store = Store::open(&request.folder, observer)?;
    let mut results = Results::new(request.quick);
    loop {
        requested.iter().for_each(|figure| drop(figure.draw(&results)));
        if !results.compute(&mut store, observer)? {
            break;
        }
    }
    results.take_used();
    let (mut sections, mut earlier) = (Vec::new(), Vec::new());
    for figure in &FIGURES {
        if requested.iter().any(|requested| requested.name == figure.name) {
            sections.push(write_figure(figure, &results, &request.folder)?);
        } else if let Some(kept) = kept(figure, &store, &request.folder) {
            sections.push(write_figure(figure, &kept, &request.folder)?);
            earlier.push(format!("{}{}", figure.name, flag(kept.quick)));
        }
    }
    let report = report(request, sections, &earlier);
    Ok(Reproduction { report: write_page(&request.folder, &report)?, verdicts: report.verdicts() })
}

/// The results of a figure that is not requested, if earlier runs left all of them: of the full grid, or of the coarse
/// one. A figure that needs none is kept if its charts are there.
fn kept(figure: &Figure, store: &Store, folder: &Path) -> Option<Results> {
    [false, true].into_iter().find_map(|quick| {
        let mut results = Results::new(quick);
        let mut any = false;
        loop {
            drop(figure.draw(&results));
            if !results.take_kept(store)? {
                break;
            }
            any = true;
        }
        results.take_used();
        (any || folder.join(format!("{}.svg", figure.name)).exists()).then_some(results)
    })
}

fn flag(quick: bool) -> &'static str {
    if quick { " --quick" } else { "" }
}

/// Writes charts and data of one figure; returns its section of the report.
fn write_figure(figure: &Figure, results: &Results, folder: &Path) -> Result<Section, Error> {
    let Table { title, of_paper, .. } = figure.table();
    let mut section = write_section(folder, figure.name, title, figure.draw(results))?;
    section.of_paper = (!of_paper.is_empty()).then(|| of_paper.clone());
    let command = format!("shadowstep figures {}{}", figure.name, flag(results.quick));
    for (kind, text) in data::csv(&command, &results.take_used())? {
        let name = format!("{}{kind}.csv", figure.name);
        write_file(folder, &name, &text)?;
        section.files.push(name);
    }
    Ok(section)
}

/// The texts of the report: `report.toml`.
#[derive(Deserialize)]
struct Texts {
    title: String,
    introduction: Vec<String>,
    /// What a quick report cannot decide.
    quick: String,
    digits: String,
}

/// `earlier` are the figures that are not requested.
fn report(request: &Request, sections: Vec<Section>, earlier: &[String]) -> Report {
    let names: String = request.names.iter().map(|name| format!(" {name}")).collect();
    let command = format!("shadowstep figures{names}{} --out {}", flag(request.quick), shell_word(&request.folder));
    let Texts { title, introduction, quick, digits } = claim::read(include_str!("report.toml"));
    let remark = request.quick.then_some(quick);
    let mut report = Report { remark, introduction, sections, ..Report::new(&title, &command) };
    report.made_with.push(("digits".to_owned(), digits));
    if !earlier.is_empty() {
        report.made_with.push(("from earlier runs".to_owned(), earlier.join(", ")));
    }
    report
}
