//! The drift of the modified energy: one run per scheme and step, and the estimator's own on the exact flow.

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::time::Instant;

use rug::Float;
use serde::{Serialize, Serializer};
use shadowstep::Rational;
use shadowstep::exact_flow::has_exact_flow;
use shadowstep::number::{Number, Rounded};
use shadowstep::run::{EnergyDrift, Seen};
use shadowstep_symbolic::decimal::to_text;

use crate::arguments::DriftArguments;
use crate::arithmetic::Arithmetic;
use crate::complaint::{Complaint, Ending, remark, tell};
use crate::library::EXACT_FLOW;
use crate::output::Output;
use crate::progress::Progress;
use crate::propagator::Propagator;
use crate::readable::{rounded, shortened, table};
use crate::run::Run;
use crate::selection::Selection;

/// What a run gives, as JSON has it; numbers of high precision are texts.
#[derive(Serialize)]
struct Record {
    /// The version of the program.
    shadowstep: &'static str,
    problem: &'static str,
    #[serde(serialize_with = "as_object")]
    parameters: Vec<(String, String)>,
    scheme: String,
    step: String,
    until: String,
    /// The time of the last state: `until`, or the last multiple of the step before it.
    end: String,
    digits: NumberOrWord,
    estimator: &'static str,
    order: NumberOrWord,
    /// How the order is chosen, as far as the estimator has such a setting; none where the order is fixed.
    max_order: Option<u32>,
    stop: Option<&'static str>,
    rule: Option<&'static str>,
    accuracy: Option<String>,
    drift: String,
    minimum: String,
    maximum: String,
    at_minimum: i64,
    at_maximum: i64,
    first: String,
    last: String,
    permanent_change: Option<Permanent>,
    control: Option<Control>,
    order_least: u32,
    order_most: u32,
    steps: u64,
    force_evaluations: u64,
    seconds: f64,
}

/// The change between quiet states, which the estimator's error hardly reaches.
#[derive(Clone, Serialize)]
struct Permanent {
    change: String,
    first_to_last: String,
    largest_jump: String,
    resolution: String,
    #[serde(serialize_with = "as_word")]
    seen: Seen,
    from: i64,
    to: i64,
    states: u64,
    stretches: u64,
}

/// What the same estimator shows at the same times on the exact flow, whose energy does not change: its own error.
#[derive(Clone, Serialize)]
struct Control {
    drift: String,
    permanent_change: Option<Permanent>,
}

impl Permanent {
    fn of<N: Number>(found: &EnergyDrift<N>) -> Option<Self> {
        let permanent = found.permanent.as_ref()?;
        Some(Permanent {
            change: permanent.change.to_text(),
            first_to_last: permanent.first_to_last.to_text(),
            largest_jump: permanent.largest_jump.to_text(),
            resolution: permanent.resolution.to_text(),
            seen: permanent.seen,
            from: permanent.between.0,
            to: permanent.between.1,
            states: permanent.states,
            stretches: permanent.stretches,
        })
    }

    /// The change, or what it is below.
    fn shown(&self) -> String {
        match self.seen {
            Seen::Resolved => rounded(&self.change, 4),
            Seen::Below => format!("< {}", rounded(&self.resolution, 2)),
            Seen::OneSide => NOT_SEEN.to_owned(),
        }
    }
}

fn as_word<S: Serializer>(seen: &Seen, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match seen {
        Seen::Resolved => "resolved",
        Seen::Below => "below",
        Seen::OneSide => NOT_SEEN,
    })
}

/// All quiet states lie on one side of what is not quiet.
const NOT_SEEN: &str = "not seen";

/// What marks in the column of the permanent change mean, where there are any.
fn marks(rows: &[[String; 9]]) -> String {
    let meanings = [
        ("< ", "<: below what errors and round-off can feign"),
        (
            NOT_SEEN,
            "not seen: the states with small errors all lie on one side of those with large ones, such as an encounter",
        ),
        (NOT_RELIABLE, "not reliable here: this order tells no errors"),
    ];
    let used = meanings.iter().filter(|(mark, _)| rows.iter().any(|row| row[4].starts_with(mark)));
    used.map(|(_, meaning)| format!("{meaning}\n")).collect()
}

#[derive(Serialize)]
#[serde(untagged)]
enum NumberOrWord {
    Number(u32),
    Word(&'static str),
}

fn as_object<S: Serializer>(pairs: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}

/// Runs all; a run that fails is told of, and the others go on.
pub(crate) fn drift(arguments: &DriftArguments) -> Result<Ending, Complaint> {
    let selection = Selection::read(&arguments.run)?;
    let mut output = Output::open(arguments.run.output.as_deref(), "--output")?;
    // a bar would run through the lines on the same terminal
    let bar = !arguments.json || arguments.run.output.is_some() || !std::io::stdout().is_terminal();
    let mut ending = Ending::Done;
    let mut rows = Vec::new();
    let mut controls = Controls { wanted: !arguments.no_control, bar, known: BTreeMap::new() };
    for (propagator, run) in selection.runs() {
        let found = match selection.arithmetic {
            Arithmetic::Double => record::<f64>(&selection, propagator, run, &(), &mut controls),
            Arithmetic::Digits(_, precision) => record::<Float>(&selection, propagator, run, &precision, &mut controls),
        };
        match found {
            Ok(record) if arguments.json => {
                output.json(&record)?;
                output.flush()?;
            }
            Ok(record) => rows.push(row(run, &record)),
            Err(complaint) => ending = ending.max(tell(&complaint)),
        }
    }
    if !arguments.json && !rows.is_empty() {
        write!(output, "{}", readable(&selection, rows))?;
    }
    output.finish()?;
    Ok(ending)
}

/// What the estimator shows on the exact flow, by the step; none where the flow is not known.
struct Controls {
    wanted: bool,
    bar: bool,
    known: BTreeMap<Rational, Option<Control>>,
}

impl Controls {
    fn of<N: Rounded + 'static>(
        &mut self,
        selection: &Selection,
        run: Run<'_>,
        context: &N::Context,
    ) -> Option<Control> {
        if !self.wanted || has_exact_flow(&selection.setup).is_err() {
            return None;
        }
        if let Some(known) = self.known.get(run.h) {
            return known.clone();
        }
        let run = Run { propagator: EXACT_FLOW, ..run };
        let found = match measure::<N>(selection, &Propagator::ExactFlow, run, context, self.bar) {
            Ok(found) => Some(Control { drift: found.drift.to_text(), permanent_change: Permanent::of(&found) }),
            Err(complaint) => {
                remark(format_args!("there is no control: {complaint}"));
                None
            }
        };
        self.known.insert(run.h.clone(), found.clone());
        found
    }
}

fn measure<N: Rounded + 'static>(
    selection: &Selection,
    propagator: &Propagator,
    run: Run<'_>,
    context: &N::Context,
    bar: bool,
) -> Result<EnergyDrift<N>, Complaint> {
    let progress = Progress::new(bar, run.name(), run.steps);
    let method = selection.estimator.method(true);
    let found = propagator.energy_drift::<N>(&selection.setup, run, &method, context, |n| progress.reach(n))?;
    // both extremes may be finite where their difference overflows
    if !found.drift.is_finite() {
        return Err(run.not_finite("the energy drift"));
    }
    Ok(found)
}

fn record<N: Rounded + 'static>(
    selection: &Selection,
    propagator: &Propagator,
    run: Run<'_>,
    context: &N::Context,
    controls: &mut Controls,
) -> Result<Record, Complaint> {
    let begin = Instant::now();
    let found = measure::<N>(selection, propagator, run, context, controls.bar)?;
    let seconds = begin.elapsed().as_secs_f64();
    let control = propagator.scheme().and_then(|_| controls.of::<N>(selection, run, context));
    let search = selection.estimator.stop_and_rule();
    Ok(Record {
        shadowstep: env!("CARGO_PKG_VERSION"),
        problem: selection.setup.problem.name(),
        parameters: selection.values(),
        scheme: run.propagator.to_owned(),
        step: to_text(run.h),
        until: to_text(&selection.until),
        end: to_text(&run.time_of_last()),
        digits: match selection.arithmetic {
            Arithmetic::Double => NumberOrWord::Word("double"),
            Arithmetic::Digits(digits, _) => NumberOrWord::Number(digits),
        },
        estimator: selection.estimator.name(),
        order: selection.estimator.order().map_or(NumberOrWord::Word("auto"), NumberOrWord::Number),
        max_order: selection.estimator.max_order(),
        stop: search.map(|(stop, _)| stop),
        rule: search.map(|(_, rule)| rule),
        accuracy: selection.estimator.accuracy().map(to_text),
        drift: found.drift.to_text(),
        minimum: found.minimum.to_text(),
        maximum: found.maximum.to_text(),
        at_minimum: found.at_minimum,
        at_maximum: found.at_maximum,
        first: found.first.to_text(),
        last: found.last.to_text(),
        permanent_change: Permanent::of(&found),
        control,
        order_least: found.orders.0,
        order_most: found.orders.1,
        steps: run.steps,
        force_evaluations: found.evaluations,
        seconds,
    })
}

fn row(run: Run<'_>, record: &Record) -> [String; 9] {
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

/// Where the estimator tells no errors, no state is known to be quiet.
const NOT_RELIABLE: &str = "not reliable here";

/// More parameters and initial values are not shown to people.
const MOST_VALUES: usize = 16;

fn readable(selection: &Selection, rows: Vec<[String; 9]>) -> String {
    let problem = selection.setup.problem.description();
    let all = selection.setup.values.named().iter();
    let mut values: Vec<_> = all.map(|(name, exact)| format!("{name} = {}", shortened(&exact.value, 12))).collect();
    if values.len() > MOST_VALUES {
        let rest = values.len() - MOST_VALUES;
        values.truncate(MOST_VALUES);
        values.push(format!("… ({rest} more; --json has all)"));
    }
    let digits = match selection.arithmetic {
        Arithmetic::Double => "double precision".to_owned(),
        Arithmetic::Digits(digits, _) => format!("{digits} digits"),
    };
    let order = selection.estimator.letter();
    let columns =
        ["scheme", "step", "energy drift", "estimator's own", "permanent change", order, "steps", "forces", "seconds"];
    let marks = marks(&rows);
    format!(
        "{}: H = {}\n{}\nfrom t = 0 to {}, {digits}; modified energy by {}\n{}\n{marks}",
        problem.title,
        problem.hamiltonian,
        values.join(", "),
        shortened(&selection.until, 20),
        selection.estimator.described(),
        table(columns, rows, 1..9)
    )
}
