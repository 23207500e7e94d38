//! The drift of the modified energy: one run per scheme and step.

use std::io::{IsTerminal, Write};
use std::time::Instant;

use rug::Float;
use serde::{Serialize, Serializer};
use shadowstep::exact_flow::ExactFlow;
use shadowstep::number::{Number, Rounded};
use shadowstep::run::{EnergyDrift, ShadowRun, energy_drift};
use shadowstep::shadow::Stop;
use shadowstep_symbolic::decimal::{to_significant, to_text};

use crate::arguments::DriftArguments;
use crate::arithmetic::Arithmetic;
use crate::complaint::{Complaint, Ending};
use crate::estimator::Chosen;
use crate::output::Output;
use crate::progress::Progress;
use crate::propagator::Propagator;
use crate::readable::{rounded, shortened, table};
use crate::run::Run;
use crate::selection::Selection;

/// What a run gives, as JSON has it; numbers of high precision are texts.
#[derive(Serialize)]
struct Record {
    problem: &'static str,
    #[serde(serialize_with = "as_object")]
    parameters: Vec<(String, String)>,
    scheme: String,
    step: String,
    until: String,
    digits: NumberOrWord,
    estimator: &'static str,
    order: NumberOrWord,
    drift: String,
    minimum: String,
    maximum: String,
    at_minimum: i64,
    at_maximum: i64,
    first: String,
    last: String,
    order_least: u32,
    order_most: u32,
    steps: u64,
    force_evaluations: u64,
    seconds: f64,
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
    for (propagator, run) in selection.runs() {
        let found = match selection.arithmetic {
            Arithmetic::Double => measure::<f64>(&selection, propagator, run, &(), bar),
            Arithmetic::Digits(_, precision) => measure::<Float>(&selection, propagator, run, &precision, bar),
        };
        match found {
            Ok(record) if arguments.json => {
                output.json(&record)?;
                output.flush()?;
            }
            Ok(record) => rows.push(row(run, selection.estimator, &record)),
            Err(complaint) => ending = ending.max(complaint.tell()),
        }
    }
    if !arguments.json && !rows.is_empty() {
        write!(output, "{}", readable(&selection, rows))?;
    }
    output.finish()?;
    Ok(ending)
}

fn measure<N: Rounded + 'static>(
    selection: &Selection,
    propagator: &Propagator,
    run: Run<'_>,
    context: &N::Context,
    bar: bool,
) -> Result<Record, Complaint> {
    let progress = Progress::new(bar, run.name(), run.steps);
    let begin = Instant::now();
    let (method, heard) = (selection.estimator.method(false), progress.listener());
    let found = match propagator {
        Propagator::Scheme(named) => {
            energy_drift(&named.scheme, selection.motion::<N>(context), run.h, run.steps, &method, heard)
        }
        Propagator::ExactFlow => {
            ShadowRun::<ExactFlow<N>, _>::of_exact_flow(&selection.setup, run.h, run.steps, &method, context)
                .map_err(|error| run.not_followed(&error))?
                .drift(heard)
        }
    }
    .map_err(|error| run.failed(&error))?;
    // both extremes may be finite where their difference overflows
    if !found.drift.is_finite() {
        return Err(run.not_finite("the energy drift"));
    }
    Ok(record(selection, run, &found, begin.elapsed().as_secs_f64()))
}

fn record<N: Number>(selection: &Selection, run: Run<'_>, found: &EnergyDrift<N>, seconds: f64) -> Record {
    Record {
        problem: selection.setup.problem.name,
        parameters: selection.values(),
        scheme: run.propagator.to_owned(),
        step: to_text(run.h),
        until: to_text(&selection.until),
        digits: match selection.arithmetic {
            Arithmetic::Double => NumberOrWord::Word("double"),
            Arithmetic::Digits(digits, _) => NumberOrWord::Number(digits),
        },
        estimator: match selection.estimator {
            Chosen::Central(_) | Chosen::Best(..) => "central",
            Chosen::Bilinear(_) => "bilinear",
        },
        order: match selection.estimator {
            Chosen::Central(order) | Chosen::Bilinear(order) => NumberOrWord::Number(order),
            Chosen::Best(..) => NumberOrWord::Word("auto"),
        },
        drift: found.drift.to_text(),
        minimum: found.minimum.to_text(),
        maximum: found.maximum.to_text(),
        at_minimum: found.at_minimum,
        at_maximum: found.at_maximum,
        first: found.first.to_text(),
        last: found.last.to_text(),
        order_least: found.orders.0,
        order_most: found.orders.1,
        steps: run.steps,
        force_evaluations: found.evaluations,
        seconds,
    }
}

fn row(run: Run<'_>, estimator: Chosen, record: &Record) -> [String; 9] {
    let time = |n: i64| to_significant(&run.time_of_value(n, estimator), 6);
    let orders = match (record.order_least, record.order_most) {
        (least, most) if least == most => least.to_string(),
        (least, most) => format!("{least}–{most}"),
    };
    [
        record.scheme.clone(),
        shortened(run.h, 12),
        rounded(&record.drift, 4),
        time(record.at_minimum),
        time(record.at_maximum),
        orders,
        record.steps.to_string(),
        record.force_evaluations.to_string(),
        format!("{:.3}", record.seconds),
    ]
}

/// More parameters and initial values are not shown to people.
const MOST_VALUES: usize = 16;

fn readable(selection: &Selection, rows: Vec<[String; 9]>) -> String {
    let problem = selection.setup.problem;
    let all = selection.setup.values.iter();
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
    let estimator = match selection.estimator {
        Chosen::Central(m) => format!("central differences, m = {m}"),
        Chosen::Best(largest, Stop::Full) => format!("central differences, the best m of 2–{largest}"),
        Chosen::Best(largest, Stop::Early) => {
            format!("central differences, the best m of 2–{largest} before errors rise")
        }
        Chosen::Bilinear(k) => format!("products of {} states, k = {k}", k + 1),
    };
    let order = if matches!(selection.estimator, Chosen::Bilinear(_)) { "k" } else { "m" };
    let columns = ["scheme", "step", "energy drift", "least at t", "largest at t", order, "steps", "forces", "seconds"];
    format!(
        "{}: H = {}\n{}\nfrom t = 0 to {}, {digits}; modified energy by {estimator}\n{}\n",
        problem.title,
        problem.hamiltonian,
        values.join(", "),
        shortened(&selection.until, 20),
        table(columns, rows, 1..9)
    )
}
