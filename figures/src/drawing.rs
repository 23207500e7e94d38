//! The content of a figure: what the paper states, charts, results, and whether the results agree.

use crate::Error;
use shadowstep_studies::chart::{Axis, Chart, Curve};
use shadowstep_studies::page::{Picture, Section, Statement, Table};
use shadowstep_studies::verdict::Verdict;

/// The axis of drifts over [0, 100].
pub(crate) fn drift_axis() -> Axis {
    Axis::log10("drift of the modified energy over [0, 100]")
}

/// The content of a figure.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    stated: Vec<String>,
    pub(crate) charts: Vec<(Chart, String)>,
    /// For the first page of the report.
    findings: Vec<String>,
    found: Vec<String>,
    statements: Vec<Statement>,
    tables: Vec<Table>,
}

impl Drawing {
    /// A figure of the paper, with the statements of its text.
    pub(crate) fn of_paper(stated: &[&str]) -> Self {
        Drawing {
            stated: stated.iter().map(|&text| text.to_owned()).collect(),
            charts: Vec::new(),
            findings: Vec::new(),
            found: Vec::new(),
            statements: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// An additional figure, which the paper does not have.
    pub(crate) fn additional(what: &str) -> Self {
        Drawing { found: vec![what.to_owned()], ..Drawing::of_paper(&[]) }
    }

    /// Adds a chart, to which marks can be added.
    pub(crate) fn chart(&mut self, title: &str, x: Axis, y: Axis, curves: Vec<Curve>, caption: &str) -> &mut Chart {
        self.chart_with_right_axis(title, x, y, None, curves, caption)
    }

    pub(crate) fn chart_with_right_axis(
        &mut self,
        title: &str,
        x: Axis,
        y: Axis,
        second_y: Option<Axis>,
        curves: Vec<Curve>,
        caption: &str,
    ) -> &mut Chart {
        self.charts.push((Chart { second_y, ..Chart::new(title, x, y, curves) }, caption.to_owned()));
        &mut self.charts.last_mut().expect("it has just been added").0
    }

    pub(crate) fn found(&mut self, paragraph: impl Into<String>) {
        self.found.push(paragraph.into());
    }

    /// A result for the first page of the report.
    pub(crate) fn finding(&mut self, paragraph: impl Into<String>) {
        self.findings.push(paragraph.into());
    }

    /// A statement, what was found, and whether that agrees with it.
    pub(crate) fn check(&mut self, statement: &str, found: impl Into<String>, verdict: impl Into<Verdict>) {
        let (statement, found, verdict) = (statement.to_owned(), found.into(), verdict.into());
        self.statements.push(Statement { statement, found, verdict });
    }

    pub(crate) fn table(&mut self, caption: &str, header: &[&str], rows: Vec<Vec<String>>) {
        let header = header.iter().map(|&cell| cell.to_owned()).collect();
        self.tables.push(Table { caption: caption.to_owned(), header, rows });
    }

    /// How many decimals of a result are the same when it is computed with 200 digits.
    pub(crate) fn digits_held(&mut self, what: &str, held: Option<f64>) {
        if let Some(held) = held {
            let held = if held.is_finite() { format!("to {held:.0} decimals") } else { "in all digits".to_owned() };
            self.found(format!("Recomputed with 200 digits, {what} is the same {held}."));
        }
    }

    /// The section of the report with a title and the paper's figure, if it has one; `files` are the names of its files.
    pub(crate) fn section(self, title: &str, of_paper: &str, svgs: Vec<String>, files: Vec<String>) -> Section {
        let captions = self.charts.iter().map(|(_, caption)| caption.clone());
        let pictures = svgs.into_iter().zip(captions).map(|(svg, caption)| Picture { svg, caption }).collect();
        let Drawing { stated, findings, found, statements, tables, .. } = self;
        let (title, of_paper) = (title.to_owned(), (!of_paper.is_empty()).then(|| of_paper.to_owned()));
        Section { title, of_paper, stated, pictures, findings, found, statements, tables, files }
    }

    /// The pictures as SVG.
    pub(crate) fn svgs(&self) -> Result<Vec<String>, Error> {
        self.charts.iter().map(|(chart, _)| chart.svg()).collect()
    }
}
