//! `shadowstep drift`: the drift of the modified energy, one run per scheme and step, beside the error of H; and on the
//! exact flow the drift that is the estimator's own.

mod table;

use std::io::{IsTerminal, Write};

use clap::Args;
use shadowstep_scenes::Error;
use shadowstep_scenes::drift::{Controls, Follower, Record, Wanted};
use shadowstep_scenes::readable::shortened;
use shadowstep_scenes::run::Run;

use crate::colour::on_stdout;
use crate::headings::{ESTIMATOR, OUTPUT};
use crate::interrupt::Interrupt;
use crate::output::Output;
use crate::progress::Progress;
use crate::report::{self, Status};
use crate::run_arguments::{RunArguments, usage};
use crate::selection::Selection;
use table::readable;

const EXAMPLES: &str = "\
Examples:
  shadowstep drift --problem kepler --set eccentricity=0.3 --digits 60 \\
      --scheme stormer-verlet,yoshida4 --step 1/10,1/20 --until 100
  shadowstep drift mine.toml --scheme own.toml --step 1/8 --until 100";

const MORE: &str = "  \
  shadowstep drift --potential \"a*x^4 + x^2*y^2\" --set a=1/4 \\
      --q x=1,y=1/2 --p 0,0 --scheme yoshida4 --step 1/20 --until 100

The error of H is max |H(t) - H(0)| as a part of |H(0)|. The modified energy is what the scheme conserves in place of H.";

/// What can be done after an interruption.
const NOT_RESUMED: &str = "the runs before it are complete; give --scheme and --step of the others to make them";

/// The error of H and the drift of the modified energy.
///
/// One run is made for each scheme and each step.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n{MORE}"), override_usage = usage("drift"))]
pub(crate) struct Arguments {
    #[command(flatten)]
    run: RunArguments,
    /// No estimate on the exact flow
    ///
    /// It is made only where the exact flow is known.
    #[arg(long, help_heading = ESTIMATOR)]
    no_control: bool,
    /// The estimate on the exact flow, however long it takes
    ///
    /// Without this flag it is left out if it takes longer than the run itself.
    #[arg(long, conflicts_with = "no_control", help_heading = ESTIMATOR)]
    control: bool,
    /// One JSON object per run in place of the table
    ///
    /// Each object is a line.
    #[arg(long, help_heading = OUTPUT)]
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
    let request = selection.drift_request(!arguments.run.no_summary);
    for (number, (propagator, run)) in (1..).zip(selection.runs()) {
        let progress = Progress::of_run(bar, selection.numbered(number, run), selection.expected_steps(run));
        let mut follower = DriftProgress { progress, interrupt: &interrupt, hint: NOT_RESUMED };
        let measured = interrupt.attended(
            || request.run(propagator, run, &mut controls, &mut follower),
            // the runs that are complete are written
            || match records.write() {
                Ok(()) => Error::run(format!("{}: interrupted", run.name()), NOT_RESUMED),
                Err(error) => error,
            },
        );
        match measured {
            Ok(record) => {
                if arguments.run.strict && !record.is_bounded() {
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

/// Shows the progress of a run, and ends it after a signal.
struct DriftProgress<'a> {
    progress: Progress,
    interrupt: &'a Interrupt,
    /// What can be done after an interruption.
    hint: &'static str,
}

impl Follower for DriftProgress<'_> {
    fn reaches(&mut self, run: Run<'_>, n: i64) -> Result<(), Error> {
        self.progress.reach(n);
        self.interrupt.check(run, n, self.hint)
    }

    fn begins_control(&mut self, run: Run<'_>) {
        self.progress.restart(format!("on the exact flow, step {}", shortened(run.h.exact(), 20)));
        self.hint = "the run itself is complete";
    }

    fn no_control(&mut self, error: &Error) {
        report::note(format_args!("no estimate on the exact flow: {error}"));
    }
}
