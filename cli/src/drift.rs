//! `shadowstep drift`: the drift of the modified energy, one run per scheme and step, and on the exact flow that of the
//! estimator itself.

mod record;
mod table;

use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::time::Instant;

use clap::Args;
use shadowstep::Rational;
use shadowstep::exact_flow::has_exact_flow;
use shadowstep::number::Rounded;
use shadowstep::run::EnergyDrift;
use shadowstep::shadow::{SelectionRule, StoppingRule};
use shadowstep_scenes::arithmetic::Computation;
use shadowstep_scenes::library::EXACT_FLOW;
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::Run;
use shadowstep_symbolic::decimal::to_text;

use crate::output::Output;
use crate::progress::Progress;
use crate::report::{self, Status};
use crate::run_arguments::RunArguments;
use crate::selection::Selection;
use record::{Control, OrderLabel, Permanent, Record};
use shadowstep_scenes::Error;
use table::{readable, row};

const EXAMPLE: &str = "\
Example:
  shadowstep drift --problem kepler --set eccentricity=0.3 --scheme stormer-verlet,yoshida4 \\
      --step 1/10,1/20 --until 100 --digits 60 --order auto";

/// The drift of the modified energy: one run per scheme and step.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    #[command(flatten)]
    run: RunArguments,
    /// Skips the estimate on the exact flow, where that is known: it takes longer than a run in double precision
    #[arg(long)]
    no_control: bool,
    /// One JSON object per run, a line each, in place of the table
    #[arg(long)]
    json: bool,
}

/// Makes all runs; one that fails is reported, and the others are made.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let selection = Selection::read(&arguments.run)?;
    let mut output = Output::open(arguments.run.output.as_deref(), "--output")?;
    // a bar would run through the lines on the same terminal
    let bar = !arguments.json || arguments.run.output.is_some() || !std::io::stdout().is_terminal();
    let mut status = Status::Success;
    let mut rows = Vec::new();
    let mut controls = Controls { wanted: !arguments.no_control, bar, known: BTreeMap::new() };
    for (propagator, run) in selection.runs() {
        let measurement = Measurement { selection: &selection, propagator, run, controls: &mut controls };
        match selection.arithmetic.compute(measurement) {
            Ok(record) if arguments.json => {
                output.json(&record)?;
                output.flush()?;
            }
            Ok(record) => rows.push(row(run, &record)),
            Err(error) => status = status.max(report::error(&error)),
        }
    }
    if !arguments.json && !rows.is_empty() {
        write!(output, "{}", readable(&selection, rows))?;
    }
    output.finish()?;
    Ok(status)
}

/// The estimates on the exact flow by step size; `None` where the flow is not known.
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
            Err(error) => {
                report::note(format_args!("no estimate on the exact flow: {error}"));
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
) -> Result<EnergyDrift<N>, Error> {
    let progress = Progress::new(bar, run.name(), run.steps);
    let settings = selection.estimator.clone().with_errors(true);
    let found = propagator.energy_drift::<N>(&selection.setup, run, &settings, context, |n| progress.reach(n))?;
    // both extremes may be finite where their difference overflows
    if !found.drift.is_finite() {
        return Err(run.not_finite("the energy drift"));
    }
    Ok(found)
}

/// The measurement of one run, in any number type.
struct Measurement<'a> {
    selection: &'a Selection,
    propagator: &'a Propagator,
    run: Run<'a>,
    controls: &'a mut Controls,
}

impl Computation for Measurement<'_> {
    type Output = Result<Record, Error>;

    fn compute<N: Rounded + 'static>(self, context: &N::Context) -> Self::Output {
        let Measurement { selection, propagator, run, controls } = self;
        let begin = Instant::now();
        let found = measure::<N>(selection, propagator, run, context, controls.bar)?;
        let seconds = begin.elapsed().as_secs_f64();
        let control = propagator.scheme().and_then(|_| controls.of::<N>(selection, run, context));
        Ok(record(selection, run, &found, control, seconds))
    }
}

fn record<N: Rounded>(
    selection: &Selection,
    run: Run<'_>,
    found: &EnergyDrift<N>,
    control: Option<Control>,
    seconds: f64,
) -> Record {
    let options = selection.estimator.options();
    Record {
        shadowstep: env!("CARGO_PKG_VERSION"),
        problem: selection.setup.problem.name(),
        parameters: selection.values(),
        scheme: run.propagator.to_owned(),
        step: to_text(run.h),
        until: to_text(&selection.until),
        end: to_text(&run.time_of_last()),
        digits: selection.arithmetic.label(),
        estimator: selection.estimator.name(),
        order: options.order.map_or(OrderLabel::Word("auto"), OrderLabel::Fixed),
        max_order: options.max_order,
        stop: options.stop.map(StoppingRule::name),
        rule: options.rule.map(SelectionRule::name),
        accuracy: options.accuracy.as_ref().map(to_text),
        drift: found.drift.to_text(),
        minimum: found.minimum.to_text(),
        maximum: found.maximum.to_text(),
        at_minimum: found.at_minimum,
        at_maximum: found.at_maximum,
        first: found.first.to_text(),
        last: found.last.to_text(),
        permanent_change: Permanent::of(found),
        control,
        order_least: found.orders.0,
        order_most: found.orders.1,
        steps: run.steps,
        force_evaluations: found.evaluations,
        seconds,
    }
}
