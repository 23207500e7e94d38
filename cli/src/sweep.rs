//! `shadowstep sweep`: many runs of a scene, on this machine or a chunk at a time; a job script for Slurm.

use std::env;
use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use shadowstep_scenes::Error;
use shadowstep_studies::sweeps::{
    Chunk, Computed, Manifest, SweepPlan, chunk_of_task, compute, explain, is_there, job_script, refuse_foreign,
    remove_foreign, sweep_schema,
};

use crate::collect::{Format, collected};
use crate::headings::OUTPUT;
use crate::invocation;
use crate::output::Output;
use crate::quantity::whole;
use crate::report::{self, Status};
use crate::terminal::{SAVED, Terminal};

const EXAMPLES: &str = "\
Examples:
  shadowstep sweep sweep.toml --out DIR                # all runs on all cores
  shadowstep sweep sweep.toml --out DIR --chunk 3/16   # chunk 3 of 16
  shadowstep sweep sweep.toml --out DIR --job-script 16 > sweep.sbatch
  shadowstep collect DIR                               # chunks of any machine";

const MORE: &str = "\
After Ctrl-C (exit code 3), or a crash at any moment, the same command computes only what is missing. Results do not \
depend on the number of threads: all cores, or the number in RAYON_NUM_THREADS. A run that fails is recorded and \
stops nothing.

In a task of a Slurm array, the chunk is the one of the task.";

/// The sweep itself, beside its output.
const RUNS: &str = "Runs";

/// Makes many runs of a scene, over axes of parameters.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// The sweep's file, such as sweep.toml
    #[arg(value_name = "FILE", required_unless_present_any = ["explain", "schema"], help_heading = RUNS, display_order = 0)]
    sweep: Option<PathBuf>,
    /// The folder for chunks, table and picture
    #[arg(long, value_name = "DIR", help_heading = OUTPUT, required_unless_present_any = ["explain", "schema"])]
    out: Option<PathBuf>,
    /// Computes chunk I of N only, such as 3/16
    ///
    /// If it is there already, nothing is done.
    #[arg(long, value_name = "I/N", help_heading = RUNS, value_parser = chunk)]
    chunk: Option<Chunk>,
    /// Writes a script for sbatch of Slurm: N tasks, a chunk each
    ///
    /// It is written to stdout, and nothing is computed. `sbatch SCRIPT` submits all chunks, and
    /// `sbatch --array=$(shadowstep collect DIR) SCRIPT` those that are missing; squeue and sacct show their states.
    #[arg(long, value_name = "N", help_heading = RUNS, conflicts_with_all = ["chunk", "format"],
        value_parser = |text: &str| whole(text, 1..=99_999))]
    job_script: Option<u32>,
    /// The format of the table
    #[arg(long, value_enum, default_value_t = Format::Csv, help_heading = OUTPUT, conflicts_with = "chunk")]
    format: Format,
    /// Explains every key of a sweep
    #[arg(long, exclusive = true, help_heading = RUNS)]
    explain: bool,
    /// Writes the JSON Schema of sweeps, for editors
    #[arg(long, exclusive = true, help_heading = RUNS)]
    schema: bool,
    /// Replaces files in --out that are not from this sweep
    ///
    /// They are results of another sweep, or of this one before it was changed, and files of other programs.
    #[arg(long, help_heading = OUTPUT)]
    force: bool,
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
    let Arguments { sweep: Some(sweep), out: Some(out), chunk, job_script: tasks, format, force, .. } = arguments
    else {
        let mut output = Output::stdout();
        write!(output, "{}", if arguments.schema { sweep_schema() } else { explain() })?;
        output.finish()?;
        return Ok(Status::Success);
    };
    let tasks = tasks.map(u64::from);
    let plan = SweepPlan::open(sweep)?;
    if *force {
        remove_foreign(out, &plan, chunk.map(|chunk| chunk.of).or(tasks))?
    } else {
        refuse_foreign(out)?
    }
    if let Some(tasks) = tasks {
        let unknown = |error| Error::usage(format!("this program has no path: {error}"), "call it by its path");
        let script = job_script(&plan, out, tasks, &invocation::program().map_err(unknown)?)?;
        let mut output = Output::stdout();
        write!(output, "{script}")?;
        output.finish()?;
        return Ok(Status::Success);
    }
    let begun = Manifest::is_in(out).then(|| Manifest::read(out)).transpose()?;
    let chunk = match chunk {
        Some(chunk) => Some(*chunk),
        None => chunk_of_task(|name| env::var(name).ok(), begun.map(|manifest| manifest.chunks))?,
    };
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
