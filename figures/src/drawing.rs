//! The content of a figure: what the paper states, charts, results, and whether the results agree.

use crate::Error;
use crate::chart::{Axis, Chart, Curve};
use crate::report::{Picture, Section, Statement, Table, Verdict};

/// The content of a figure.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    stated: Vec<String>,
    additional: bool,
    pub(crate) charts: Vec<(Chart, String)>,
    found: Vec<String>,
    statements: Vec<Statement>,
    tables: Vec<Table>,
}

impl Drawing {
    /// A figure of the paper, with the statements of its text.
    pub(crate) fn of_paper(stated: &[&str]) -> Self {
        Drawing {
            stated: stated.iter().map(|&text| text.to_owned()).collect(),
            additional: false,
            charts: Vec::new(),
            found: Vec::new(),
            statements: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// An additional figure, which the paper does not have.
    pub(crate) fn additional(what: &str) -> Self {
        Drawing { additional: true, found: vec![what.to_owned()], ..Drawing::of_paper(&[]) }
    }

    pub(crate) fn chart(&mut self, title: &str, x: Axis, y: Axis, curves: Vec<Curve>, caption: &str) {
        self.chart_with_right_axis(title, x, y, None, curves, caption);
    }

    pub(crate) fn chart_with_right_axis(
        &mut self,
        title: &str,
        x: Axis,
        y: Axis,
        second_y: Option<Axis>,
        curves: Vec<Curve>,
        caption: &str,
    ) {
        let chart = Chart { title: title.to_owned(), x, y, second_y, curves, notes: Vec::new() };
        self.charts.push((chart, caption.to_owned()));
    }

    pub(crate) fn found(&mut self, paragraph: impl Into<String>) {
        self.found.push(paragraph.into());
    }

    /// A statement, what was found, and whether the statement holds.
    pub(crate) fn check(&mut self, statement: &str, found: impl Into<String>, holds: bool) {
        self.statements.push(Statement { statement: statement.to_owned(), found: found.into(), holds });
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

    fn verdict(&self) -> Verdict {
        match &self.statements[..] {
            _ if self.additional => Verdict::Additional,
            [] => Verdict::NotReproduced,
            all if all.iter().all(|one| one.holds) => Verdict::Agrees,
            _ => Verdict::Differs,
        }
    }

    /// The section of the report; `files` are the names of its files.
    pub(crate) fn section(self, title: &str, svgs: Vec<String>, files: Vec<String>) -> Section {
        let verdict = self.verdict();
        let captions = self.charts.iter().map(|(_, caption)| caption.clone());
        let pictures = svgs.into_iter().zip(captions).map(|(svg, caption)| Picture { svg, caption }).collect();
        let Drawing { stated, found, statements, tables, .. } = self;
        Section { title: title.to_owned(), stated, pictures, found, statements, tables, verdict, files }
    }

    /// The pictures as SVG.
    pub(crate) fn svgs(&self) -> Result<Vec<String>, Error> {
        self.charts.iter().map(|(chart, _)| chart.svg()).collect()
    }
}
