//! `shadowstep chaos`: whether a trajectory is chaotic, and whether its step size makes it so.

mod subject;

use std::io::{IsTerminal, Write};

use clap::Args;
use shadowstep_scenes::Error;
use shadowstep_scenes::chaos::{ChaosRecord, conclusion};
use shadowstep_scenes::tangent::Vectors;
use shadowstep_schemes::symbolic::decimal::significant;

use crate::headings::{OUTPUT, SCHEMES};
use crate::interrupt::Interrupt;
use crate::output::{Output, OutputArguments};
use crate::progress::Progress;
use crate::quantity::whole;
use crate::readable::table;
use crate::report::Status;
use crate::run::Terminal;
use subject::{Subject, SubjectArguments};

const EXAMPLES: &str = "\
Examples:
  shadowstep chaos scene.toml
  shadowstep chaos scene.toml --exponents 4 --json
  shadowstep chaos henon-heiles --scheme yoshida4 --step 1/10 --until 1000";

const MORE: &str = "\
The run is made at the step size and at half of it, with tangent vectors. Chaos that only the larger step has is \
caused by that step.

The exponent is the largest Lyapunov exponent over the last three quarters of the run, with \
half the width of its interval of 95 %. The mean of MEGNO tends to 2 on regular orbits, to 0 where all frequencies \
are constant, and grows with the time on chaotic ones. SALI tends to 0 exponentially on chaotic ones.";

const VECTORS: &str = "Tangent vectors";

/// What can be done after an interruption.
const AGAIN: &str = "try a shorter run, or a larger --every";

/// Whether a trajectory is chaotic.
///
/// The indicators are Lyapunov exponents, MEGNO, SALI and GALI.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    #[command(flatten)]
    subject: SubjectArguments,
    /// Tangent vectors: 2 give SALI, more give GALI of all
    #[arg(long, value_name = "N", default_value_t = 2, help_heading = VECTORS, value_parser = |text: &str| whole(text, 1..=64))]
    vectors: u32,
    /// The N largest Lyapunov exponents, in place of SALI
    ///
    /// Their tangent vectors are orthonormal.
    #[arg(long, value_name = "N", conflicts_with = "vectors", help_heading = VECTORS, value_parser = |text: &str| whole(text, 1..=64))]
    exponents: Option<u32>,
    /// Vectors are measured every N steps
    ///
    /// They are made orthonormal then.
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = VECTORS, value_parser = |text: &str| whole(text, 1..=1_000_000))]
    every: u32,
    /// Only this step size, not half of it
    #[arg(long, help_heading = SCHEMES)]
    one: bool,
    /// One JSON object per run in place of the table
    ///
    /// Each object is a line.
    #[arg(long, help_heading = OUTPUT)]
    json: bool,
    #[command(flatten)]
    output: OutputArguments,
}

impl Arguments {
    fn vectors(&self) -> Vectors {
        match self.exponents {
            Some(count) => Vectors::Orthonormal(count as usize),
            None => Vectors::Free(self.vectors as usize),
        }
    }
}

pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let subject = Subject::read(&arguments.subject)?;
    let interrupt = Interrupt::listen(&subject.title, AGAIN);
    let mut output = Output::of(&arguments.output)?;
    let bar = arguments.output.output.is_some() || !std::io::stdout().is_terminal();
    let mut records = Vec::new();
    for parts in if arguments.one { 1..=1 } else { 1..=2 } {
        let request = subject.request(arguments.vectors(), arguments.every.into());
        let name = format!("{}, part {parts}", request.posed.run.name());
        let progress = Progress::of_run(bar, name, request.posed.expected_steps() * u64::from(parts));
        let mut terminal = Terminal { progress, interrupt: &interrupt, summarises: false, summary: None };
        let record = request.run(parts, &mut terminal)?;
        if arguments.json {
            output.json(&record)?;
        }
        records.push(record);
    }
    if !arguments.json {
        write!(output, "{}", readable(&records))?;
    }
    output.finish()?;
    Ok(Status::Success)
}

/// A row for each run, and what both say.
fn readable(records: &[ChaosRecord]) -> String {
    let or_nothing = |value: Option<f64>, digits: usize| value.map_or_else(String::new, |x| format!("{x:.digits$e}"));
    let row = |record: &ChaosRecord| {
        let exponent = match (record.exponent, record.exponent_error) {
            (Some(value), Some(error)) => format!("{value:.3e} ± {error:.0e}"),
            _ => String::new(),
        };
        [
            record.step.clone(),
            record.motion.to_string(),
            exponent,
            record.mean_megno.map_or_else(String::new, |x| significant(x, 5)),
            or_nothing(record.sali, 1),
            record.summary.conclusion().to_owned(),
        ]
    };
    let header = ["step", "motion", "exponent", "mean MEGNO", "SALI", "energy"];
    let mut text = table(header, records.iter().map(row).collect(), 2..5) + "\n";
    for record in records {
        if let Some(exponents) = &record.exponents {
            let texts = exponents.iter().map(|[value, error]| format!("{value:.3e} ± {error:.0e}"));
            text += &format!("exponents at {}: {}\n", record.step, texts.collect::<Vec<_>>().join(", "));
        }
        if let Some(gali) = record.gali {
            text += &format!("GALI at {}: {gali:.1e}\n", record.step);
        }
    }
    match records {
        [whole, half] => text + &conclusion(whole, half) + "\n",
        _ => text,
    }
}
