//! `shadowstep sweep`: many runs of a scene, on this machine, a chunk at a time, or as jobs of Slurm.

mod slurm;

use std::env;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use shadowstep_scenes::Error;
use shadowstep_sweeps::{Chunk, Computed, Manifest, SweepPlan, chunk_of_task, compute, explain, is_there};

use crate::collect::{Format, collected};
use crate::output::Output;
use crate::report::{self, Status};
use crate::terminal::{SAVED, Terminal};
use slurm::SlurmArguments;

const EXAMPLE: &str = "\
Examples:
  shadowstep sweep sweep.toml --out DIR                computes all runs on all cores and collects them
  shadowstep sweep sweep.toml --out DIR --chunk 3/16   computes the third of 16 chunks
  shadowstep sweep sweep.toml --out DIR --submit       submits the chunks to Slurm as a job array
  shadowstep collect DIR                               collects chunks that were computed anywhere

After Ctrl-C (exit code 3), or a crash at any moment, the same command computes only what is missing. Results do not depend on the number
of threads: all cores, or as many as RAYON_NUM_THREADS says. A run that fails is recorded and stops nothing.
In a task of a Slurm array, the chunk is that of the task.";

/// Makes many runs of a scene, over axes of parameters.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Arguments {
    /// The sweep's file, such as sweep.toml
    #[arg(value_name = "FILE", required_unless_present = "explain")]
    sweep: Option<PathBuf>,
    /// The folder for the chunks, and for the table and the picture of all runs
    #[arg(long, value_name = "DIR", required_unless_present = "explain")]
    out: Option<PathBuf>,
    /// Computes chunk I of N only, such as 3/16; if it is there already, nothing is done
    #[arg(long, value_name = "I/N", value_parser = chunk)]
    chunk: Option<Chunk>,
    /// The format of the table
    #[arg(long, value_enum, default_value_t = Format::Csv, conflicts_with = "chunk")]
    format: Format,
    /// Explains every key of a sweep
    #[arg(long, exclusive = true)]
    explain: bool,
    #[command(flatten)]
    slurm: SlurmArguments,
}

/// `3/16`
fn chunk(text: &str) -> Result<Chunk, String> {
    let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
    match numbers {
        Some((number, of)) if 1 <= number && number <= of => Ok(Chunk { number, of }),
        Some((_, of)) if of >= 1 => Err(format!("the chunks are 1/{of} to {of}/{of}")),
        _ => Err("write the number of the chunk and that of all chunks, such as 3/16".to_owned()),
    }
}

/// Computes the runs that are asked for.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let Arguments { sweep: Some(sweep), out: Some(out), chunk, format, slurm, .. } = arguments else {
        let mut output = Output::stdout();
        write!(output, "{}", explain())?;
        output.finish()?;
        return Ok(Status::Success);
    };
    if slurm.is_given() {
        return slurm.execute(sweep, out);
    }
    let begun = Manifest::is_in(out).then(|| Manifest::read(out)).transpose()?;
    let chunk = match chunk {
        Some(chunk) => Some(*chunk),
        None => chunk_of_task(|name| env::var(name).ok(), begun.map(|manifest| manifest.chunks))?,
    };
    let plan = SweepPlan::open(sweep)?;
    let mut terminal = Terminal::listen(SAVED);
    let manifest = Manifest::begin(out, &plan, chunk.map(|chunk| chunk.of))?;
    let Some(chunk) = chunk else {
        let computed = compute(&plan, &manifest, out, manifest.all_chunks(), &mut terminal)?;
        report_failures(&plan, &computed);
        return collected(out, *format, &mut terminal);
    };
    if is_there(&manifest, out, chunk) {
        report::note(format_args!("chunk {}/{} is there already: nothing is done", chunk.number, chunk.of));
        return Ok(Status::Success);
    }
    let computed = compute(&plan, &manifest, out, [chunk], &mut terminal)?;
    report_failures(&plan, &computed);
    Ok(Status::Success)
}

/// Runs that failed are in the results; here, one of them is named.
fn report_failures(plan: &SweepPlan, computed: &Computed) {
    if let Some((run, failure)) = &computed.first_failure {
        let values = plan.axes().described(*run);
        report::note(format_args!(
            "{} of {} runs failed; run {run} ({values}): {failure}",
            computed.failed, computed.runs
        ));
    }
}
