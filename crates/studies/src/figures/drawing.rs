//! A figure while it is drawn.

use crate::chart::{Chart, Curve};
use crate::figures::fit::{DECAY_HEADER, ExponentialDecay, decay_row, logarithms, same_rates, theory_row};
use crate::figures::results::{Results, Sizes};
use crate::figures::run::Run;
use crate::figures::table::{Table, filled};
use crate::finding::Finding;
use crate::verdict::{Coverage, Verdict};

/// What a figure requests its results from, and what it has shown so far.
pub(crate) struct Drawing<'a> {
    pub(crate) results: &'a Results,
    pub(crate) table: &'a Table,
    pub(crate) finding: Finding,
}

/// (x, log₁₀ of a drift)
pub(crate) type Points = Vec<(f64, f64)>;

/// The drifts of one curve of a family.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    pub(crate) label: String,
    pub(crate) points: Points,
}

impl Series {
    pub(crate) fn line(&self, colour: usize) -> Curve {
        Curve::line(&self.label, self.points.clone(), colour)
    }

    /// Where both are above the round-off, what it is of others at the same x.
    pub(crate) fn relative_to(&self, to: &[(f64, f64)]) -> Series {
        Series { label: self.label.clone(), points: logarithms(&self.points, to) }
    }
}

/// A label, and the rate of what it stands for.
pub(crate) type Fit = (String, Option<ExponentialDecay>);

/// Lines with the colours from this one on.
pub(crate) fn lines(all: &[Series], first: usize) -> Vec<Curve> {
    all.iter().enumerate().map(|(i, series)| series.line(first + i)).collect()
}

impl<'a> Drawing<'a> {
    /// What a figure shows, with its table alone.
    pub(crate) fn new(results: &'a Results, table: &'a Table) -> Self {
        let (stated, found) = (table.stated.clone(), table.about.clone());
        Drawing { results, table, finding: Finding { stated, found, ..Finding::default() } }
    }

    /// The finding, with the drifts that are computed again.
    pub(crate) fn finished(mut self) -> Finding {
        for held in &self.table.held {
            let family = &self.table.families[&held.family];
            let (run, estimator) = (family.run(&held.c, &held.x), family.estimator(&held.c, &held.x));
            self.held(&held.what, self.results.digits_held(&run, &estimator, 200));
        }
        self.finding
    }

    /// By how much a result changes when it is computed with 200 digits.
    pub(crate) fn held(&mut self, what: &str, held: Option<f64>) {
        let Some(held) = held else { return };
        let change =
            if held.is_finite() { format!("changes by about 1e-{held:.0}") } else { "does not change".to_owned() };
        self.finding.found(format!("Recomputed with 200 digits, {what} {change}."));
    }

    /// The values x of a family.
    pub(crate) fn xs(&self, family: &str) -> Vec<String> {
        self.table.families[family].points(self.results.quick)
    }

    /// The values c of a family.
    pub(crate) fn cs(&self, family: &str) -> Vec<String> {
        self.table.families[family].curves(self.results.quick)
    }

    /// A run of a family.
    pub(crate) fn run(&self, family: &str, c: &str, x: &str) -> Run {
        self.table.families[family].run(c, x)
    }

    /// The sizes of a drift of a family.
    pub(crate) fn sizes(&self, family: &str, c: &str, x: &str) -> Option<Sizes> {
        let family = &self.table.families[family];
        self.results.sizes(&family.run(c, x), &family.estimator(c, x))
    }

    /// A curve of a family.
    pub(crate) fn series(&self, name: &str, c: &str) -> Series {
        let family = &self.table.families[name];
        let size = |x: &str| self.sizes(name, c, x).map_or(f64::NAN, |sizes| sizes.drift);
        let points = self.xs(name).iter().map(|x| (family.place(c, x), size(x))).collect();
        Series { label: family.label(c), points }
    }

    /// All curves of a family.
    pub(crate) fn family(&self, name: &str) -> Vec<Series> {
        self.cs(name).iter().map(|c| self.series(name, c)).collect()
    }

    /// A chart of the table with its curves.
    pub(crate) fn chart(&mut self, name: &str, curves: Vec<Curve>) -> &mut Chart {
        self.chart_of(name, &[], curves)
    }

    /// A chart of the table in whose texts each `{name}` is its value.
    pub(crate) fn chart_of(&mut self, name: &str, values: &[(&str, &str)], curves: Vec<Curve>) -> &mut Chart {
        let texts = &self.table.charts[name];
        let mut chart = texts.chart(curves);
        chart.title = filled(&chart.title, values);
        chart.y.label = filled(&chart.y.label, values);
        self.finding.chart(chart, filled(&texts.caption, values))
    }

    pub(crate) fn check(
        &mut self,
        statement: impl Into<String>,
        found: impl Into<String>,
        verdict: impl Into<Verdict>,
    ) {
        self.finding.check(statement, found, verdict);
    }

    pub(crate) fn found(&mut self, paragraph: impl Into<String>) {
        self.finding.found(paragraph);
    }

    /// Whether all rates are that of the first.
    pub(crate) fn same_rates(&mut self, statement: &str, fits: &[Fit]) {
        let [(_, Some(first)), others @ ..] = fits else { return };
        let others: Vec<_> = others.iter().filter_map(|(label, fit)| Some((label.as_str(), fit.as_ref()?))).collect();
        let (verdict, found) = same_rates(first, &others);
        self.check(statement, found, verdict);
    }

    /// A table of rates, with a value of the theory.
    pub(crate) fn rates(&mut self, caption: &str, fits: impl IntoIterator<Item = Fit>, theory: Option<(&str, String)>) {
        let rows = fits.into_iter().map(|(label, fit)| decay_row(&label, fit.as_ref()));
        let rows = rows.chain(theory.map(|(label, value)| theory_row(label, value))).collect();
        self.finding.table(caption, &DECAY_HEADER, rows);
    }

    pub(crate) fn coverage(&self) -> Coverage {
        self.results.coverage()
    }
}
