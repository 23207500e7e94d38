//! The results of `drift` as a table of at most 80 columns, with the verdicts under it.

use num_traits::Zero;
use shadowstep::shadow::run::Finding;
use shadowstep_scenes::Summary;
use shadowstep_scenes::drift::{NOT_SEEN, Permanent, Record};
use shadowstep_scenes::readable::{shortened, wrapped};
use shadowstep_scenes::run::Run;
use shadowstep_schemes::symbolic::decimal::{from_text, significant};

use crate::colour::{heading, of_verdict, styled};
use crate::readable::{rounded, table};
use crate::report::with_flags;
use crate::selection::Selection;

/// Significant digits of energies.
const DIGITS: usize = 3;

/// The cells of a run.
type Row = [String; 8];

const COLUMNS: [&str; 8] =
    ["step", "error\nof H", "energy\ndrift", "on exact\nflow", "permanent\nchange", "", "forces", "seconds\n+ control"];
/// Of the columns, that of the control, of the permanent change and of the order.
const CONTROL: usize = 3;
const PERMANENT: usize = 4;
const ORDER: usize = 5;

fn row(run: Run<'_>, record: &Record) -> Row {
    let orders = match (record.order_least, record.order_most) {
        (least, most) if least == most => least.to_string(),
        (least, most) => format!("{least}–{most}"),
    };
    let error = record.energy_error.as_ref().map(|error| match &error.largest_relative {
        Some(relative) => rounded(relative, DIGITS),
        None => format!("{} {ABSOLUTE}", rounded(&error.largest, DIGITS)),
    });
    let control = match (&record.control, &record.control_left_out) {
        (Some(control), _) => rounded(&control.drift, DIGITS),
        (None, Some(_)) => LEFT_OUT.to_owned(),
        (None, None) => String::new(),
    };
    let mut seconds = significant(record.cost.seconds, 3);
    if let Some(control) = &record.control {
        seconds += &format!(" + {}", significant(control.seconds, 3));
    }
    [
        shortened(run.h.exact(), 12),
        error.unwrap_or_default(),
        rounded(&record.drift, DIGITS),
        control,
        record.permanent_change.as_ref().map_or(NOT_RELIABLE.to_owned(), shown),
        orders,
        record.cost.own_force_evaluations.to_string(),
        seconds,
    ]
}

/// Without error estimates, no state is known to have a small error.
const NOT_RELIABLE: &str = "not reliable";
const LEFT_OUT: &str = "left out";
const ABSOLUTE: &str = "abs.";

/// The permanent change, or what it is below.
fn shown(permanent: &Permanent) -> String {
    match permanent.seen {
        Finding::Resolved => rounded(&permanent.change, DIGITS),
        Finding::BelowResolution if is_zero(&permanent.resolution) => "0".to_owned(),
        Finding::BelowResolution => format!("< {}", rounded(&permanent.resolution, 2)),
        Finding::OneSided => NOT_SEEN.to_owned(),
    }
}

/// Whether a number is exactly 0.
fn is_zero(text: &str) -> bool {
    from_text(text).is_ok_and(|value| value.is_zero())
}

/// The meanings of the marks in a table, if there are any.
fn marks(rows: &[Row], left_out: Option<&String>) -> String {
    let left_out = left_out.map(|why| format!("left out: the estimate on the exact flow; {}", with_flags(why)));
    let meanings = [
        (ABSOLUTE, 1, "abs.: H(0) is 0, so the error of H is given as it is"),
        (LEFT_OUT, CONTROL, left_out.as_deref().unwrap_or_default()),
        ("< ", PERMANENT, "<: below the effect of estimation errors and round-off"),
        (
            NOT_SEEN,
            PERMANENT,
            "not seen: all states with small errors are on one side of those with large errors, such as an encounter",
        ),
        (NOT_RELIABLE, PERMANENT, "not reliable: no error estimate at this order"),
    ];
    let used = meanings.iter().filter(|(mark, column, _)| rows.iter().any(|row| row[*column].contains(mark)));
    used.map(|(.., meaning)| wrapped(meaning, "")).collect()
}

/// The most parameters and initial values that the table shows.
const MOST_VALUES: usize = 16;

/// The table and the verdicts, with colours if that is wanted.
pub(super) fn readable(selection: &Selection, records: &[(Run<'_>, Record)], coloured: bool) -> String {
    let rows: Vec<Row> = records.iter().map(|(run, record)| row(*run, record)).collect();
    let left_out = records.iter().find_map(|(_, record)| record.control_left_out.as_ref());
    let mut text = head(selection);
    text += &in_groups(&columns(selection, &rows), records, coloured);
    text += &marks(&rows, left_out);
    text += &verdicts(records, coloured);
    text
}

fn head(selection: &Selection) -> String {
    let mut values: Vec<_> = selection
        .problem
        .system
        .named()
        .map(|(name, exact)| format!("{name} = {}", shortened(&exact.value, 12)))
        .collect();
    if values.len() > MOST_VALUES {
        let rest = values.len() - MOST_VALUES;
        values.truncate(MOST_VALUES);
        values.push(format!("… ({rest} more; --json has all)"));
    }
    let problem = &selection.problem;
    let transformed = problem.system.transformed_time().is_some();
    let of = if transformed { " in transformed time: of H', with steps of s" } else { "" };
    [
        format!("{}: H = {}", problem.title, problem.hamiltonian),
        values.join(", "),
        format!(
            "from t = 0 to {}, {}; modified energy by {}{of}",
            shortened(&selection.until, 20),
            selection.arithmetic.described(),
            selection.estimator
        ),
    ]
    .map(|line| wrapped(&line, ""))
    .concat()
}

/// The table, without a column for controls if there are none.
fn columns(selection: &Selection, rows: &[Row]) -> String {
    let mut header = COLUMNS;
    header[ORDER] = selection.estimator.letter();
    let has_controls = rows.iter().any(|row| !row[CONTROL].is_empty());
    let kept = |column: &usize| has_controls || *column != CONTROL;
    let cells = |row: &Row| (0..row.len()).filter(kept).map(|column| row[column].clone()).collect();
    let header = (0..header.len()).filter(kept).map(|column| header[column]).collect::<Vec<_>>();
    let numbers = 0..header.len();
    table(header, rows.iter().map(cells).collect::<Vec<Vec<String>>>(), numbers)
}

/// The lines of a table with a line for each scheme above its rows.
fn in_groups(table: &str, records: &[(Run<'_>, Record)], coloured: bool) -> String {
    let lines: Vec<&str> = table.lines().collect();
    let first = lines.len() - records.len() - 1;
    let mut text: String = lines[..first].iter().map(|line| format!("{line}\n")).collect();
    let mut last = "";
    for ((run, record), line) in records.iter().zip(&lines[first..]) {
        if run.propagator != last {
            let cost = match record.cost.forces_per_step {
                Some(1) => ", 1 force a step".to_owned(),
                Some(forces) => format!(", {forces} forces a step"),
                None => String::new(),
            };
            text += &format!(" {}{cost}\n", heading(run.propagator, coloured));
            last = run.propagator;
        }
        text += &format!("{line}\n");
    }
    text + lines[lines.len() - 1] + "\n"
}

/// The verdict on each run, and its close encounters; of several runs, the reason only where the verdict is neither
/// bounded nor round-off.
fn verdicts(records: &[(Run<'_>, Record)], coloured: bool) -> String {
    let line = |(run, record): &(Run<'_>, Record)| {
        let summary: &Summary = record.summary.as_ref()?;
        let verdict = match summary.is_bounded() && records.len() > 1 {
            true => summary.conclusion().to_owned(),
            false => summary.verdict_with_reason(),
        };
        let encounters = match summary.encounters() {
            0 => String::new(),
            _ => format!("; close encounters: {}", summary.encounters_text(1)),
        };
        // lines after the first are indented
        let text = wrapped(&format!("{}: {verdict}{encounters}", run.name()), "    ");
        let text = if coloured {
            let verdict = styled(summary.verdict(), of_verdict(summary.is_bounded()));
            text.replacen(summary.verdict(), &verdict, 1)
        } else {
            text
        };
        Some(format!("{}\n", text.trim()))
    };
    records.iter().filter_map(line).collect()
}
