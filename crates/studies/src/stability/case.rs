//! What a case is: its table, its trials as calculations whose outcomes are saved, and the rows that they become.

use std::sync::OnceLock;

use serde::de::DeserializeOwned;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::chart::Curve;
use crate::finding::Finding;
use crate::stability::suite::{Examined, Suite};
use crate::stability::table::{Look, Table, Values};
use crate::stability::trial::Trial;
use crate::verdict::Verdict;
use crate::{Calculation, Continues, Error, claim};

/// What a case computes and what theory says of it. Its table has the rest: `cases/NAME.toml`.
pub(crate) trait Case {
    /// What a trial has measured. Numbers must be finite.
    type Measured: Serialize + DeserializeOwned;

    /// A trial of the table with what depends on the scheme; `None` if the case is not about it.
    fn complete(_: &Examined, values: Values) -> Option<Values> {
        Some(values)
    }

    /// All trials.
    fn trials<'a>(suite: &'a Suite, table: &'a Table) -> Vec<Trial<'a>> {
        let all = table.trials(suite, Self::complete).into_iter();
        all.map(|(scheme, values)| Trial::of(suite, table, scheme, values)).collect()
    }

    /// The time that a trial takes in double precision, in seconds, to a factor of a few.
    fn seconds(trial: &Trial<'_>) -> f64 {
        trial.seconds()
    }

    /// Makes a trial. One that is asked not to continue ends at once, with any result, which is dropped.
    fn measure(trial: &Trial<'_>, continues: Continues<'_>) -> Result<Self::Measured, Error>;

    /// What the trials of a scheme show, or what one trial shows, where each has a row. Failed trials are left out.
    fn judge(all: &[&Done<'_, Self::Measured>]) -> Vec<Row>;

    /// What all trials show together.
    fn finish(finding: &mut Finding, all: &[Done<'_, Self::Measured>]) {
        let _ = (finding, all);
    }
}

/// A trial with what it has measured.
pub(crate) struct Done<'a, M> {
    pub(crate) trial: Trial<'a>,
    pub(crate) found: M,
}

/// The texts of several, joined.
pub(crate) fn joined<T>(all: &[T], between: &str, text: impl Fn(&T) -> String) -> String {
    all.iter().map(text).collect::<Vec<_>>().join(between)
}

/// The largest of values that are at least 0; 0 without any.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

/// A row of the report, with its curve in the chart of the case.
pub(crate) struct Row {
    label: String,
    found: String,
    verdict: Verdict,
    curve: Option<(String, Vec<(f64, f64)>)>,
}

impl Row {
    /// A row of the scheme of a trial.
    pub(crate) fn of(trial: &Trial<'_>, found: impl Into<String>, verdict: impl Into<Verdict>) -> Row {
        Row { label: trial.name().to_owned(), found: found.into(), verdict: verdict.into(), curve: None }
    }

    /// The row with another label.
    pub(crate) fn labelled(self, label: impl Into<String>) -> Row {
        Row { label: label.into(), ..self }
    }

    /// The row with a curve of its label.
    pub(crate) fn with(self, points: impl IntoIterator<Item = (f64, f64)>) -> Row {
        let label = self.label.clone();
        self.with_curve(label, points)
    }

    /// The row with a curve.
    pub(crate) fn with_curve(self, label: String, points: impl IntoIterator<Item = (f64, f64)>) -> Row {
        Row { curve: Some((label, points.into_iter().collect())), ..self }
    }
}

/// A case of the list of all cases.
pub struct CaseEntry {
    pub(crate) name: &'static str,
    text: &'static str,
    read: OnceLock<Table>,
    trials: for<'a> fn(&'static str, &'a Suite, &'a Table) -> Vec<Calculated<'a>>,
    finding: fn(&Suite, &Table, Vec<Option<Value>>) -> Finding,
}

impl CaseEntry {
    /// The case with this name and the text of its table.
    pub(crate) const fn of<C: Case>(name: &'static str, text: &'static str) -> CaseEntry {
        CaseEntry { name, text, read: OnceLock::new(), trials: calculations::<C>, finding: finding::<C> }
    }

    /// The name by which it is requested.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Its heading.
    pub fn title(&self) -> &str {
        &self.table().title
    }

    pub(crate) fn table(&self) -> &Table {
        self.read.get_or_init(|| claim::read(self.text))
    }

    /// The computations of the case.
    pub(crate) fn trials<'a>(&'a self, suite: &'a Suite) -> Vec<Calculated<'a>> {
        (self.trials)(self.name, suite, self.table())
    }

    /// What their results, in the same order, show.
    pub(crate) fn finding(&self, suite: &Suite, results: Vec<Option<Value>>) -> Finding {
        Finding { stated: vec![self.table().theory.clone()], ..(self.finding)(suite, self.table(), results) }
    }
}

fn calculations<'a, C: Case>(name: &'static str, suite: &'a Suite, table: &'a Table) -> Vec<Calculated<'a>> {
    let prepare = |trial: Trial<'a>| {
        let (arithmetic, revision) = (trial.arithmetic, table.revision);
        Calculated {
            key: json!({ "case": name, "revision": revision, "digits": arithmetic.label(), "trial": trial.values }),
            seconds: C::seconds(&trial) * arithmetic.numbers().cost(),
            measure: Box::new(move |continues| Ok(serde_json::to_value(C::measure(&trial, continues)?)?)),
        }
    };
    C::trials(suite, table).into_iter().map(prepare).collect()
}

fn finding<C: Case>(suite: &Suite, table: &Table, results: Vec<Option<Value>>) -> Finding {
    let measured = |result: Option<Value>| serde_json::from_value::<C::Measured>(result?).ok();
    let pairs = C::trials(suite, table).into_iter().zip(results);
    let all: Vec<_> = pairs.filter_map(|(trial, result)| Some(Done { trial, found: measured(result)? })).collect();
    let (mut finding, mut curves) = (Finding::default(), Vec::new());
    for row in table.groups(&all, |done| done.trial.identity()).iter().flat_map(|group| C::judge(group)) {
        finding.check(row.label, row.found, row.verdict);
        curves.extend(row.curve);
    }
    if let Some(chart) = &table.chart {
        let curves = curves.into_iter().take(table.most_curves.unwrap_or(usize::MAX)).enumerate();
        let curve = |(i, (label, points))| match table.curves {
            Look::Marked => Curve::marked(label, points, i),
            Look::Line => Curve::line(label, points, i),
            Look::Unjoined => Curve::unjoined(label, points, i),
        };
        finding.chart(chart.chart(curves.map(curve).collect()), chart.caption.clone());
    }
    C::finish(&mut finding, &all);
    finding
}

/// A computation of a case.
pub(crate) struct Calculated<'a> {
    key: Value,
    seconds: f64,
    measure: Box<Measuring<'a>>,
}

type Measuring<'a> = dyn Fn(Continues<'_>) -> Result<Value, Error> + Sync + 'a;

impl Serialize for Calculated<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.key.serialize(serializer)
    }
}

impl Calculation for Calculated<'_> {
    type Outcome = Value;
    type Shared = ();

    fn cost(&self) -> f64 {
        self.seconds
    }

    fn compute(&self, (): &(), continues: Continues<'_>) -> Result<Value, Error> {
        (self.measure)(continues)
    }
}
