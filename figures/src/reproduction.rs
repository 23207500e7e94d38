//! `shadowstep figures`: the figures of Moan and Niesen's paper, and ours beside them, computed, drawn, and told.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`pendulum`], [`kepler`], [`henon_heiles`], [`scattering`] | the paper's figures |
//! | [`estimators`], [`reliability`], [`double_precision`] | ours |
//! | [`calculation`], [`results`], [`work`] | runs as tasks, over all cores; what is done stays in a file |
//! | [`drawn`], [`charts`], [`fit`] | a figure, its charts and statements; a line through points |
//! | [`chart`] | curves → SVG |
//! | [`report`], [`data`] | figures → one page of HTML; results → CSV |

mod calculation;
mod chart;
mod charts;
mod data;
mod double_precision;
mod drawn;
mod estimators;
mod fit;
mod henon_heiles;
mod kepler;
mod pendulum;
mod reliability;
mod report;
mod results;
mod scattering;
mod work;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use shadowstep_symbolic::meant;

use crate::complaint::{Complaint, Ending};
use crate::output::Output;
use drawn::Drawn;
use report::{Figure, Report};
use results::Results;
use work::Store;

/// A figure by its name.
struct Entry {
    name: &'static str,
    title: &'static str,
    draw: fn(&Results) -> Drawn,
}

/// In the order of the paper, then ours.
const FIGURES: [Entry; 17] = [
    Entry { name: "pendulum-step", title: "The pendulum: drift against the step", draw: pendulum::step },
    Entry {
        name: "pendulum-momentum",
        title: "The pendulum: drift against the initial momentum",
        draw: pendulum::momentum,
    },
    Entry { name: "kepler-step", title: "Kepler: drift against the step", draw: kepler::step },
    Entry { name: "kepler-eccentricity", title: "Kepler: drift against the eccentricity", draw: kepler::eccentricity },
    Entry { name: "kepler-schemes", title: "Kepler: three schemes, and the exact flow", draw: kepler::schemes },
    Entry { name: "kepler-energies", title: "Kepler: the modified energy in time", draw: kepler::energies },
    Entry { name: "kepler-orders", title: "Kepler: change per step, accumulated change, and m", draw: kepler::orders },
    Entry { name: "henon-heiles-step", title: "Hénon–Heiles: drift against the step", draw: henon_heiles::step },
    Entry {
        name: "henon-heiles-momentum",
        title: "Hénon–Heiles: drift against the initial momentum",
        draw: henon_heiles::momentum,
    },
    Entry { name: "scattering", title: "Scattering: the change of the energy itself", draw: scattering::draw },
    Entry { name: "estimators-exact-flow", title: "Estimators on the exact flow", draw: estimators::on_the_exact_flow },
    Entry { name: "estimators-schemes", title: "Estimators on schemes", draw: estimators::on_schemes },
    Entry { name: "permanent-change", title: "The permanent change of the schemes", draw: estimators::permanent },
    Entry { name: "pendulum-bilinear", title: "The pendulum by the bilinear estimator", draw: pendulum::bilinear },
    Entry {
        name: "henon-heiles-bilinear",
        title: "Hénon–Heiles by the bilinear estimator",
        draw: henon_heiles::bilinear,
    },
    Entry { name: "double-precision", title: "The noise floor of double precision", draw: double_precision::draw },
    Entry { name: "reliability", title: "What estimators say of their errors", draw: reliability::draw },
];

const EXAMPLE: &str = "\
Examples:
  shadowstep figures --quick --out figures
  shadowstep figures kepler-schemes kepler-orders --out figures
What is computed stays in DIR/results.jsonl: an interrupted run goes on where it stopped. All cores are used, or as many
as RAYON_NUM_THREADS says; results do not depend on that. Where only some figures are named, the report keeps those whose
results are in DIR already.";

/// Computes the figures of Moan and Niesen's paper, and ours: pictures, data, and a report.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// Only these figures, such as kepler-schemes; all, if none is named
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// The folder for report.html, SVG and CSV files, and for what is already computed
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// A thinned grid: every figure in less than a minute in all, on two cores
    #[arg(long)]
    quick: bool,
}

/// Computes what is missing, and writes pictures, data and the report.
pub(crate) fn execute(arguments: &Arguments) -> Result<Ending, Complaint> {
    let chosen = chosen(&arguments.names)?;
    refuse_foreign_report(&arguments.out)?;
    let mut store = Store::open(&arguments.out)?;
    let mut results = Results::new(arguments.quick);
    let mut ending = Ending::Done;
    // a figure asks for what it needs, some of it after it has seen the rest
    loop {
        chosen.iter().for_each(|entry| drop((entry.draw)(&results)));
        if !results.compute(&mut store, &mut ending)? {
            break;
        }
    }
    results.take_used();
    let (mut sections, mut earlier) = (Vec::new(), Vec::new());
    for entry in &FIGURES {
        if chosen.iter().any(|chosen| chosen.name == entry.name) {
            sections.push(write_figure(entry, &results, &arguments.out)?);
        } else if let Some(kept) = kept(entry, &store) {
            sections.push(write_figure(entry, &kept, &arguments.out)?);
            earlier.push(format!("{}{}", entry.name, if kept.quick { " --quick" } else { "" }));
        }
    }
    let report = report(arguments, sections, &earlier);
    write(&arguments.out, REPORT, &report.html())?;
    let mut said = Output::open(None, "")?;
    writeln!(said, "{}: {}", arguments.out.join(REPORT).display(), report.verdicts())?;
    said.finish()?;
    Ok(ending)
}

const REPORT: &str = "report.html";

/// What the program wrote has its results beside it.
fn refuse_foreign_report(folder: &Path) -> Result<(), Complaint> {
    let path = folder.join(REPORT);
    if !path.exists() || Store::is_in(folder) {
        return Ok(());
    }
    let sentence = format!("{} is there, without results of this program beside it", path.display());
    Err(Complaint::usage(sentence, "give another folder, or take the file away"))
}

/// The results of a figure that is not asked for, if an earlier run left all of them: of the full grid, or of the thinned one.
fn kept(entry: &Entry, store: &Store) -> Option<Results> {
    [false, true].into_iter().find_map(|quick| {
        let mut results = Results::new(quick);
        loop {
            drop((entry.draw)(&results));
            if !results.take_kept(store)? {
                break;
            }
        }
        results.take_used();
        Some(results)
    })
}

fn chosen(names: &[String]) -> Result<Vec<&'static Entry>, Complaint> {
    let known = FIGURES.map(|entry| entry.name);
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(Complaint::usage(format!("there is no figure `{name}`"), meant(name, &known)));
    }
    let wanted = |entry: &&Entry| names.is_empty() || names.iter().any(|name| name == entry.name);
    Ok(FIGURES.iter().filter(wanted).collect())
}

/// Pictures and data of one figure; its section of the report.
fn write_figure(entry: &Entry, results: &Results, folder: &Path) -> Result<Figure, Complaint> {
    let drawn = (entry.draw)(results);
    let svgs = drawn.svgs()?;
    let mut files = Vec::new();
    for (i, svg) in svgs.iter().enumerate() {
        let name =
            if svgs.len() == 1 { format!("{}.svg", entry.name) } else { format!("{}-{}.svg", entry.name, i + 1) };
        write(folder, &name, svg)?;
        files.push(name);
    }
    let command = format!("shadowstep figures {}{}", entry.name, if results.quick { " --quick" } else { "" });
    for (kind, text) in data::csv(&command, &results.take_used())? {
        let name = format!("{}{kind}.csv", entry.name);
        write(folder, &name, &text)?;
        files.push(name);
    }
    Ok(drawn.section(entry.title, svgs, files))
}

/// Under a temporary name until it is complete.
fn write(folder: &Path, name: &str, text: &str) -> Result<(), Complaint> {
    let mut output = Output::open(Some(&folder.join(name)), "--out")?;
    output.write_all(text.as_bytes())?;
    output.finish()
}

/// `earlier` are the figures that this run was not asked for.
fn report(arguments: &Arguments, figures: Vec<Figure>, earlier: &[String]) -> Report {
    let quick = if arguments.quick { " --quick" } else { "" };
    let names: String = arguments.names.iter().map(|name| format!(" {name}")).collect();
    let introduction = [
        "P. C. Moan and J. Niesen, “On an asymptotic method for computing the modified energy for symplectic methods”, follow the modified \
         energy of splitting schemes at 120 digits. Each of their figures is computed here again and held against what their text states.",
        "Then come figures of ours, which tell what in these results is the method's and what is the estimator's: the same estimators on the exact \
         flow, whose energy does not change, and the permanent change of the modified energy between quiet states.",
        "The drift is max − min of the modified energy over the states n = 0 … N of the interval. States before 0 and after N, which estimators \
         need, are made by the scheme and its exact inverse. The paper's sign of the rate of β, printed −h a (qᵀU_q + 2U), is +h a (qᵀU_q − 2U).",
    ];
    let mut made_with = vec![
        ("program".to_owned(), format!("shadowstep {}", env!("CARGO_PKG_VERSION"))),
        ("command".to_owned(), format!("shadowstep figures{names}{quick} --out {}", arguments.out.display())),
        ("digits".to_owned(), "120, where nothing else is said".to_owned()),
    ];
    if !earlier.is_empty() {
        made_with.push(("from earlier runs".to_owned(), earlier.join(", ")));
    }
    Report {
        title: "The modified energy of splitting schemes".to_owned(),
        introduction: introduction.map(str::to_owned).to_vec(),
        made_with,
        figures,
    }
}
