//! What is written: the page, its charts, and the table of verdicts for the documentation.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use shadowstep_scenes::{Error, WholeFile};
use shadowstep_studies::Store;
use shadowstep_studies::page::{Picture, Report, Section, Statement};
use shadowstep_studies::verdict::Counts;

use crate::examination::{CaseEntry, names};
use crate::finding::Finding;

const REPORT: &str = "report.html";
const TABLE: &str = "stability.md";

/// How many rows agree, differ, and are not decided.
pub fn counts(findings: &[(CaseEntry, Finding)]) -> Counts {
    Counts::of(findings.iter().flat_map(|(_, finding)| &finding.rows).map(|row| row.verdict))
}

/// Writes charts, the page that contains them and the table of verdicts; returns the path of the page. `command` made them.
///
/// # Errors
/// A file that cannot be written.
pub fn write(findings: &[(CaseEntry, Finding)], command: &str, folder: &Path) -> Result<PathBuf, Error> {
    let sections = findings.iter().map(|(case, finding)| section(*case, finding, folder)).collect::<Result<_, _>>()?;
    let made_with = [("program", format!("shadowstep {}", env!("CARGO_PKG_VERSION"))), ("command", command.to_owned())];
    let page = Report {
        title: "Numerical stability on hard cases".to_owned(),
        introduction: vec![INTRODUCTION.to_owned()],
        remark: None,
        made_with: made_with.map(|(name, value)| (name.to_owned(), value)).to_vec(),
        sections,
    };
    write_file(folder, TABLE, &markdown(findings, command))?;
    write_file(folder, REPORT, &page.html())?;
    Ok(folder.join(REPORT))
}

const INTRODUCTION: &str = "Each case states what theory predicts. A row agrees with it, differs from it, or is not decided by what was computed.";

/// Files of this program have their results beside them. Without them, files of the same names are not replaced.
///
/// # Errors
/// Such a file.
pub fn refuse_foreign(folder: &Path) -> Result<(), Error> {
    let charts = names().into_iter().flat_map(|name| [format!("{name}.svg"), format!("{name}-1.svg")]);
    let all = charts.chain([REPORT, TABLE].map(str::to_owned));
    let foreign = all.map(|name| folder.join(name)).find(|path| path.exists());
    match foreign.filter(|_| !Store::is_in(folder)) {
        None => Ok(()),
        Some(path) => {
            let message = format!("{} exists, without results of this program beside it", path.display());
            Err(Error::usage(message, "give another folder, or replace its files with --force"))
        }
    }
}

fn section(case: CaseEntry, finding: &Finding, folder: &Path) -> Result<Section, Error> {
    let (mut pictures, mut files) = (Vec::new(), Vec::new());
    for (i, (chart, caption)) in finding.charts.iter().enumerate() {
        let number = if finding.charts.len() == 1 { String::new() } else { format!("-{}", i + 1) };
        let name = format!("{}{number}.svg", case.name());
        let svg = chart.svg()?;
        write_file(folder, &name, &svg)?;
        pictures.push(Picture { svg, caption: caption.clone() });
        files.push(name);
    }
    let statement = |row: &crate::finding::Row| Statement {
        statement: row.subject.clone(),
        found: row.found.clone(),
        verdict: row.verdict,
    };
    Ok(Section {
        title: case.title().to_owned(),
        of_paper: None,
        stated: vec![case.theory().to_owned()],
        pictures,
        findings: Vec::new(),
        found: finding.remarks.clone(),
        statements: finding.rows.iter().map(statement).collect(),
        tables: Vec::new(),
        files,
    })
}

/// The table of verdicts as a page of Markdown.
fn markdown(findings: &[(CaseEntry, Finding)], command: &str) -> String {
    let mut page = format!(
        "<!-- Written by `{command}`; do not edit. -->\n\n# Numerical stability on hard cases\n\n{INTRODUCTION}\n"
    );
    let _ = writeln!(page, "Of all rows, {}.", counts(findings));
    for (case, finding) in findings {
        let _ = write!(page, "\n## {}\n\n`shadowstep stability {}`\n\n{}\n", case.title(), case.name(), case.theory());
        for remark in &finding.remarks {
            let _ = write!(page, "\n{remark}\n");
        }
        let _ = write!(page, "\n| | found | theory |\n| --- | --- | --- |\n");
        for row in &finding.rows {
            let _ = writeln!(page, "| {} | {} | {} |", row.subject, row.found, row.verdict.word());
        }
    }
    page
}

fn write_file(folder: &Path, name: &str, text: &str) -> Result<(), Error> {
    let mut file = WholeFile::create(&folder.join(name), "the file")?;
    file.write_all(text.as_bytes())?;
    file.finish()
}
