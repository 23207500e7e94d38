//! A figure as it is drawn: what the paper states, the charts, what came out, and whether that is the same.

use super::chart::{Axis, Chart, Curve};
use super::fit::ExponentialDecay;
use super::report::{Figure, Picture, Statement, Table, Verdict};
use crate::complaint::Complaint;

/// A figure in the making.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    stated: Vec<String>,
    ours: bool,
    pub(crate) charts: Vec<(Chart, String)>,
    found: Vec<String>,
    statements: Vec<Statement>,
    tables: Vec<Table>,
}

impl Drawn {
    /// A figure of the paper, with what its text says of it.
    pub(crate) fn of_paper(stated: &[&str]) -> Self {
        Drawn {
            stated: stated.iter().map(|&text| text.to_owned()).collect(),
            ours: false,
            charts: Vec::new(),
            found: Vec::new(),
            statements: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// A figure that the paper does not have.
    pub(crate) fn ours(what: &str) -> Self {
        Drawn { ours: true, found: vec![what.to_owned()], ..Drawn::of_paper(&[]) }
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

    /// What is stated, what was found, and whether that agrees.
    pub(crate) fn check(&mut self, statement: &str, found: impl Into<String>, holds: bool) {
        self.statements.push(Statement { statement: statement.to_owned(), found: found.into(), holds });
    }

    pub(crate) fn table(&mut self, caption: &str, header: &[&str], rows: Vec<Vec<String>>) {
        let header = header.iter().map(|&cell| cell.to_owned()).collect();
        self.tables.push(Table { caption: caption.to_owned(), header, rows });
    }

    /// The digits to which a result stays when it is computed with more.
    pub(crate) fn digits_held(&mut self, what: &str, held: Option<f64>) {
        if let Some(held) = held {
            let held = if held.is_finite() { format!("to {held:.0} decimals") } else { "in every digit".to_owned() };
            self.found(format!("Computed again with 200 digits, {what} is the same {held}."));
        }
    }

    fn verdict(&self) -> Verdict {
        match &self.statements[..] {
            _ if self.ours => Verdict::Ours,
            [] => Verdict::NotReproduced,
            all if all.iter().all(|one| one.holds) => Verdict::Agrees,
            _ => Verdict::Differs,
        }
    }

    /// The section of the report; `files` are those beside it.
    pub(crate) fn section(self, title: &str, svgs: Vec<String>, files: Vec<String>) -> Figure {
        let verdict = self.verdict();
        let captions = self.charts.iter().map(|(_, caption)| caption.clone());
        let pictures = svgs.into_iter().zip(captions).map(|(svg, caption)| Picture { svg, caption }).collect();
        let Drawn { stated, found, statements, tables, .. } = self;
        Figure { title: title.to_owned(), stated, pictures, found, statements, tables, verdict, files }
    }

    /// The pictures as SVG.
    pub(crate) fn svgs(&self) -> Result<Vec<String>, Complaint> {
        self.charts.iter().map(|(chart, _)| chart.svg()).collect()
    }
}

/// Below this the round-off of 120 digits may be seen.
pub(crate) const ROUND_OFF: f64 = -108.0;

/// Rates that differ by less are called the same: what is to be told apart differs by a factor of two.
pub(crate) const SAME_RATE: f64 = 0.1;

/// The rate of a drift over the steps from `coarsest` on, as far as it is above the round-off.
pub(crate) fn decay(drifts: &[(f64, f64)], coarsest: f64) -> Option<ExponentialDecay> {
    let used: Vec<_> = drifts.iter().copied().filter(|(h, y)| *h <= coarsest && *y > ROUND_OFF).collect();
    ExponentialDecay::of(&used)
}

/// A row for a table of rates.
pub(crate) fn decay_row(label: &str, fit: Option<&ExponentialDecay>) -> Vec<String> {
    let Some(fit) = fit else {
        return vec![label.to_owned(), "not enough points".to_owned(), String::new(), String::new()];
    };
    vec![
        label.to_owned(),
        format!("{:.4} ± {:.4}", fit.c, fit.c_error),
        format!("{:.2}", fit.spread),
        format!("h = {:.4} … {:.4}, {} steps", fit.steps.0, fit.steps.1, fit.points),
    ]
}

/// The header of a table of rates.
pub(crate) const DECAY_HEADER: [&str; 4] = ["", "c in exp(−c/h)", "spread (decades)", "fitted over"];

/// The least, the geometric mean, and the largest ratio of two drifts at the same steps.
pub(crate) fn ratios(points: &[(f64, f64)], to: &[(f64, f64)]) -> [f64; 3] {
    let all = points.iter().zip(to).map(|((_, a), (_, b))| a - b).filter(|ratio| ratio.is_finite());
    let all: Vec<f64> = all.collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
    let (least, most) = all.iter().fold((least, most), |(least, most), y| (least.min(*y), most.max(*y)));
    [least, mean, most].map(|ratio| 10_f64.powf(ratio))
}

/// 1.2e-34 from its log₁₀.
pub(crate) fn power(log10: f64) -> String {
    if !log10.is_finite() {
        return if log10 == f64::NEG_INFINITY { "0" } else { "–" }.to_owned();
    }
    let exponent = log10.floor();
    let digits = format!("{:.2}", 10_f64.powf(log10 - exponent));
    if digits == "10.00" { format!("1.00e{}", exponent + 1.0) } else { format!("{digits}e{exponent}") }
}

/// Three digits and a power of ten.
pub(crate) fn scientific(value: f64) -> String {
    power(value.abs().log10())
}
