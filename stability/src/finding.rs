//! What a case has shown.

use serde::Serialize;
use shadowstep_studies::chart::Chart;
use shadowstep_studies::verdict::Verdict;

/// Rows with verdicts, charts, remarks.
#[derive(Debug, Default)]
pub struct Finding {
    /// One for each scheme or system.
    pub rows: Vec<Row>,
    /// Charts with captions.
    pub charts: Vec<(Chart, String)>,
    /// Sentences on all rows together.
    pub remarks: Vec<String>,
}

/// What was found of a scheme or a system, and whether it is as theory predicts.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The scheme, or what else the row is about.
    pub subject: String,
    /// The numbers, in a sentence.
    pub found: String,
    /// Whether it agrees with the theory of the case.
    #[serde(serialize_with = "word")]
    pub verdict: Verdict,
}

fn word<S: serde::Serializer>(verdict: &Verdict, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(verdict.word())
}

impl Finding {
    /// Adds a row.
    pub(crate) fn row(&mut self, subject: impl Into<String>, found: impl Into<String>, verdict: impl Into<Verdict>) {
        self.rows.push(Row { subject: subject.into(), found: found.into(), verdict: verdict.into() });
    }

    /// Adds a chart with its caption.
    pub(crate) fn chart(&mut self, chart: Chart, caption: impl Into<String>) {
        self.charts.push((chart, caption.into()));
    }
}
