//! What a figure, a case or a problem of a study has shown.

use crate::chart::Chart;
use crate::verdict::Verdict;

/// Charts, results, and whether they agree with what is stated. All texts are plain.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    /// What a paper or theory states, in paragraphs.
    pub stated: Vec<String>,
    /// Charts with captions.
    pub charts: Vec<(Chart, String)>,
    /// Results for the first page.
    pub highlights: Vec<String>,
    /// The results, in paragraphs.
    pub found: Vec<String>,
    /// Statements with their verdicts.
    pub statements: Vec<Statement>,
    /// After the text.
    pub tables: Vec<Table>,
}

/// A statement, what was found, and whether that agrees with it.
#[derive(Clone, Debug)]
pub struct Statement {
    /// What is stated; or, in a report without a paper, the name of what it is about.
    pub statement: String,
    /// The result.
    pub found: String,
    /// Whether it agrees.
    pub verdict: Verdict,
}

/// A table of numbers or short texts. Each row has as many cells as the header.
#[derive(Clone, Debug)]
pub struct Table {
    /// Above it.
    pub caption: String,
    /// The names of the columns.
    pub header: Vec<String>,
    /// The cells.
    pub rows: Vec<Vec<String>>,
}

impl Statement {
    /// What was found, and why that does not decide.
    pub fn explained(&self) -> String {
        let reason = self.verdict.reason().map(|reason| format!(" Not decided: {reason}"));
        let end = if reason.is_some() && !self.found.ends_with('.') { "." } else { "" };
        format!("{}{end}{}", self.found, reason.unwrap_or_default())
    }
}

impl Finding {
    /// Adds a chart with its caption; marks can be added to it.
    pub fn chart(&mut self, chart: Chart, caption: impl Into<String>) -> &mut Chart {
        self.charts.push((chart, caption.into()));
        &mut self.charts.last_mut().expect("it has just been added").0
    }

    /// Adds a result for the first page.
    pub(crate) fn highlight(&mut self, paragraph: impl Into<String>) {
        self.highlights.push(paragraph.into());
    }

    /// Adds a result.
    pub fn found(&mut self, paragraph: impl Into<String>) {
        self.found.push(paragraph.into());
    }

    /// Adds a statement, what was found, and whether that agrees with it.
    pub fn check(&mut self, statement: impl Into<String>, found: impl Into<String>, verdict: impl Into<Verdict>) {
        self.statements.push(Statement { statement: statement.into(), found: found.into(), verdict: verdict.into() });
    }

    /// Adds a table.
    pub fn table(&mut self, caption: &str, header: &[&str], rows: Vec<Vec<String>>) {
        let header = header.iter().map(|&cell| cell.to_owned()).collect();
        self.tables.push(Table { caption: caption.to_owned(), header, rows });
    }
}
