//! What is written: the page, its charts, and the table of verdicts for the documentation.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::files::{PAGE, write_file, write_page, write_section};
use crate::finding::Finding;
use crate::page::Report;
use crate::stability::case::CaseEntry;
use crate::stability::examination::names;
use crate::verdict::Counts;

const TABLE: &str = "stability.md";

/// How many rows agree, differ, and are not decided.
pub fn counts(findings: &[(&CaseEntry, Finding)]) -> Counts {
    Counts::of(findings.iter().flat_map(|(_, finding)| &finding.statements).map(|row| row.verdict))
}

/// Writes charts, the page that contains them and the table of verdicts; returns the path of the page. `command` made
/// them.
///
/// # Errors
/// A file that cannot be written.
pub fn write(findings: Vec<(&CaseEntry, Finding)>, command: &str, folder: &Path) -> Result<PathBuf, Error> {
    write_file(folder, TABLE, &markdown(&findings, command))?;
    let section = |(case, finding): (&CaseEntry, Finding)| write_section(folder, case.name(), case.title(), finding);
    let page = Report {
        introduction: vec![INTRODUCTION.to_owned()],
        sections: findings.into_iter().map(section).collect::<Result<_, Error>>()?,
        ..Report::new("Numerical stability on hard cases", command)
    };
    write_page(folder, &page)
}

const INTRODUCTION: &str = "Each case states what theory predicts. A row agrees with it, differs from it, or is not \
    decided by what was computed.";

/// The names of all files that are written, in which a `*` stands for any characters.
pub fn written() -> impl Iterator<Item = String> {
    let charts = names().into_iter().flat_map(|name| [format!("{name}.svg"), format!("{name}-*.svg")]);
    charts.chain([PAGE, TABLE].map(str::to_owned))
}

/// The table of verdicts as a page of Markdown.
fn markdown(findings: &[(&CaseEntry, Finding)], command: &str) -> String {
    let mut page = format!(
        "<!-- Written by `{command}`; do not edit. -->\n\n# Numerical stability on hard cases\n\n{INTRODUCTION}\n"
    );
    let _ = writeln!(page, "Of all rows, {}.", counts(findings));
    for (case, finding) in findings {
        let _ = write!(
            page,
            "\n## {}\n\n`shadowstep stability {}`\n\n{}\n",
            case.title(),
            case.name(),
            case.table().theory
        );
        for remark in &finding.found {
            let _ = write!(page, "\n{remark}\n");
        }
        let _ = write!(page, "\n| | found | theory |\n| --- | --- | --- |\n");
        for row in &finding.statements {
            let _ = writeln!(page, "| {} | {} | {} |", row.statement, row.explained(), row.verdict.word());
        }
    }
    page
}
