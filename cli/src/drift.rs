//! `shadowstep drift`: the drift of the modified energy, one run per scheme and step, beside the error of H; and on the exact
//! flow the drift that is the estimator's own.

mod control;
mod measure;
mod record;
mod table;

use std::io::{IsTerminal, Write};

use clap::Args;
use shadowstep::number::Rounded;
use shadowstep::run::EnergyDrift;
use shadowstep::shadow::{SelectionRule, StoppingRule};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Computation;
use shadowstep_scenes::estimates::{Estimates, Finished};
use shadowstep_scenes::propagator::Propagator;
use shadowstep_scenes::run::Run;
use shadowstep_symbolic::decimal::to_text;

use crate::colour::on_stdout;
use crate::cpu_time::CpuTime;
use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::Progress;
use crate::report::{self, Status};
use crate::run_arguments::RunArguments;
use crate::selection::Selection;
use control::{Controls, Found, Wanted};
use measure::measure;
use record::{Cost, OrderLabel, Permanent, Record};
use table::readable;

const EXAMPLE: &str = "\
Examples:
  shadowstep drift --problem kepler --set eccentricity=0.3 --scheme stormer-verlet,yoshida4 \\
      --step 1/10,1/20 --until 100 --digits 60 --order auto
  shadowstep drift --problem mine.toml --scheme mine-4.toml --step 1/20 --until 100 --double
  shadowstep drift --potential \"a*x^4 + x^2*y^2\" --set a=1/4 --q x=1,y=1/2 --p 0,0 --scheme yoshida4 \\
      --step 1/20 --until 100

The error of H is max |H(t) - H(0)| as a part of |H(0)|; the modified energy is what the scheme conserves in place of H.";

/// What can be done after an interruption.
const NOT_RESUMED: &str = "the runs before it are complete; give --scheme and --step of the others to make them";

/// The error of H and the drift of the modified energy: one run per scheme and step.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    #[command(flatten)]
    run: RunArguments,
    /// Leaves out the estimate on the exact flow, where that is known
    #[arg(long)]
    no_control: bool,
    /// Makes the estimate on the exact flow even if it takes longer than the run itself
    #[arg(long, conflicts_with = "no_control")]
    control: bool,
    /// One JSON object per run, a line each, in place of the table
    #[arg(long)]
    json: bool,
}

impl Arguments {
    fn controls(&self) -> Wanted {
        match (self.control, self.no_control) {
            (true, _) => Wanted::Always,
            (_, true) => Wanted::Never,
            _ => Wanted::IfFast,
        }
    }
}

/// Makes all runs; one that fails is reported, and the others are made.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let selection = Selection::read(&arguments.run)?;
    let interrupt = Interrupt::listen("drift", NOT_RESUMED);
    let mut records = Records::new(arguments, &selection)?;
    // a bar would run through the lines on the same terminal
    let bar = !arguments.json || arguments.run.output.output.is_some() || !std::io::stdout().is_terminal();
    let mut status = Status::Success;
    let mut controls = Controls::new(arguments.controls());
    for (number, (propagator, run)) in (1..).zip(selection.runs()) {
        let progress = Progress::new(bar, selection.numbered(number, run), run.steps);
        let measurement = Measurement {
            selection: &selection,
            propagator,
            run,
            controls: &mut controls,
            progress,
            interrupt: &interrupt,
            summarised: !arguments.run.no_summary,
        };
        let measured = interrupt.attended(
            || selection.arithmetic.compute(measurement),
            // the runs that are complete are written
            || match records.write() {
                Ok(()) => Error::run(format!("{}: interrupted", run.name()), NOT_RESUMED),
                Err(error) => error,
            },
        );
        match measured {
            Ok(record) => {
                if arguments.run.strict && !record.is_fine() {
                    status = status.max(Status::NegativeAnswer);
                }
                records.take(run, record)?;
            }
            Err(error) => status = status.max(report::error(&error)),
        }
        if interrupt.asked() {
            status = Status::RunFailed;
            break;
        }
    }
    records.write()?;
    Ok(status)
}

/// The results of the runs, and where they go.
struct Records<'a> {
    arguments: &'a Arguments,
    selection: &'a Selection,
    /// `None` when all is written.
    output: Option<Output>,
    any: bool,
    /// Those of the table.
    records: Vec<(Run<'a>, Record)>,
}

impl<'a> Records<'a> {
    fn new(arguments: &'a Arguments, selection: &'a Selection) -> Result<Self, Error> {
        let output = Some(Output::of(&arguments.run.output)?);
        Ok(Records { arguments, selection, output, any: false, records: Vec::new() })
    }

    /// Takes the result of a run: a line of JSON is written at once.
    fn take(&mut self, run: Run<'a>, record: Record) -> Result<(), Error> {
        self.any = true;
        match &mut self.output {
            Some(output) if self.arguments.json => {
                output.json(&record)?;
                output.flush()?;
            }
            _ => self.records.push((run, record)),
        }
        Ok(())
    }

    /// Writes the table, and completes the file; without results there is none.
    fn write(&mut self) -> Result<(), Error> {
        let Some(mut output) = self.output.take().filter(|_| self.any) else { return Ok(()) };
        if !self.records.is_empty() {
            let coloured = self.arguments.run.output.output.is_none() && on_stdout();
            write!(output, "{}", readable(self.selection, &self.records, coloured))?;
        }
        output.finish()
    }
}

/// The measurement of one run, in any number type.
struct Measurement<'a> {
    selection: &'a Selection,
    propagator: &'a Propagator,
    run: Run<'a>,
    controls: &'a mut Controls,
    progress: Progress,
    interrupt: &'a Interrupt,
    summarised: bool,
}

impl Computation for Measurement<'_> {
    type Output = Result<Record, Error>;

    fn compute<N: Rounded + 'static>(self, context: &N::Context) -> Self::Output {
        let Measurement { selection, propagator, run, controls, progress, interrupt, summarised } = self;
        let settings = selection.estimator.clone().with_errors(true);
        let system = &selection.problem.system;
        let compensated = selection.arithmetic.is_compensated() && propagator.scheme().is_some();
        let begin = CpuTime::begin();
        let estimates = Estimates { system, propagator, run, compensated, settings: &settings, summarised };
        let (found, finished) = measure::<N>(estimates, context, |n| {
            progress.reach(n);
            interrupt.check(run, n, NOT_RESUMED)
        })?;
        let seconds = begin.elapsed();
        let control = match propagator.scheme() {
            Some(_) => controls.of::<N>(estimates, context, seconds, (&progress, interrupt)),
            None => Found::Nothing,
        };
        let per_step = propagator.scheme().map(|named| named.scheme.proved().plan.evaluations);
        let cost = Cost {
            forces_per_step: per_step,
            own_force_evaluations: finished.own_evaluations,
            force_evaluations: finished.evaluations,
            seconds: seconds.as_secs_f64(),
        };
        Ok(record(selection, run, &found, finished, control, cost))
    }
}

fn record<N: Rounded>(
    selection: &Selection,
    run: Run<'_>,
    found: &EnergyDrift<N>,
    finished: Finished,
    control: Found,
    cost: Cost,
) -> Record {
    let options = selection.estimator.options();
    let (control, control_left_out) = control.parts();
    Record {
        shadowstep: env!("CARGO_PKG_VERSION"),
        problem: selection.problem.name.clone(),
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
        energy_error: finished.energy,
        drift: found.drift.to_text(),
        minimum: found.minimum.to_text(),
        maximum: found.maximum.to_text(),
        at_minimum: found.at_minimum,
        at_maximum: found.at_maximum,
        first: found.first.to_text(),
        last: found.last.to_text(),
        permanent_change: Permanent::of(found),
        control,
        control_left_out,
        order_least: found.orders.0,
        order_most: found.orders.1,
        steps: run.steps,
        cost,
        summary: finished.summary,
    }
}
