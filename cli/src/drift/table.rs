//! The results of `drift` as a table.

use shadowstep::run::Finding;
use shadowstep_scenes::readable::shortened;
use shadowstep_scenes::run::Run;

use super::record::{NOT_SEEN, Permanent, Record};
use crate::readable::{rounded, table};
use crate::selection::Selection;

pub(super) fn row(run: Run<'_>, record: &Record) -> [String; 9] {
    let orders = match (record.order_least, record.order_most) {
        (least, most) if least == most => least.to_string(),
        (least, most) => format!("{least}–{most}"),
    };
    let control = record.control.as_ref().map(|control| rounded(&control.drift, 4));
    [
        record.scheme.clone(),
        shortened(run.h, 12),
        rounded(&record.drift, 4),
        control.unwrap_or_default(),
        record.permanent_change.as_ref().map_or(NOT_RELIABLE.to_owned(), Permanent::shown),
        orders,
        record.steps.to_string(),
        record.force_evaluations.to_string(),
        format!("{:.3}", record.seconds),
    ]
}

/// Without error estimates, no state is known to have a small error.
const NOT_RELIABLE: &str = "not reliable here";

impl Permanent {
    /// The change, or what it is below.
    fn shown(&self) -> String {
        match self.seen {
            Finding::Resolved => rounded(&self.change, 4),
            Finding::BelowResolution => format!("< {}", rounded(&self.resolution, 2)),
            Finding::OneSided => NOT_SEEN.to_owned(),
        }
    }
}

/// The meanings of the marks in the column of the permanent change, if there are any.
fn marks(rows: &[[String; 9]]) -> String {
    let meanings = [
        ("< ", "<: below the effect of estimation errors and round-off"),
        (
            NOT_SEEN,
            "not seen: all states with small errors are on one side of those with large errors, such as an encounter",
        ),
        (NOT_RELIABLE, "not reliable: no error estimate at this order"),
    ];
    let used = meanings.iter().filter(|(mark, _)| rows.iter().any(|row| row[4].starts_with(mark)));
    used.map(|(_, meaning)| format!("{meaning}\n")).collect()
}

/// The most parameters and initial values that the table shows.
const MOST_VALUES: usize = 16;

pub(super) fn readable(selection: &Selection, rows: Vec<[String; 9]>) -> String {
    let problem = selection.setup.problem.description();
    let all = selection.setup.values.named().iter();
    let mut values: Vec<_> = all.map(|(name, exact)| format!("{name} = {}", shortened(&exact.value, 12))).collect();
    if values.len() > MOST_VALUES {
        let rest = values.len() - MOST_VALUES;
        values.truncate(MOST_VALUES);
        values.push(format!("… ({rest} more; --json has all)"));
    }
    let order = selection.estimator.letter();
    let columns =
        ["scheme", "step", "energy drift", "estimator's own", "permanent change", order, "steps", "forces", "seconds"];
    let marks = marks(&rows);
    format!(
        "{}: H = {}\n{}\nfrom t = 0 to {}, {}; modified energy by {}\n{}\n{marks}",
        problem.title,
        problem.hamiltonian,
        values.join(", "),
        shortened(&selection.until, 20),
        selection.arithmetic.described(),
        selection.estimator,
        table(columns, rows, 1..9)
    )
}
