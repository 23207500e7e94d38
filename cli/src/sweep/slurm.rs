//! `--submit` and `--status`: the chunks of a sweep as jobs of Slurm.

use std::io::Write;
use std::path::{Path, absolute};

use clap::Args;
use shadowstep_scenes::{Error, shell_word};
use shadowstep_sweeps::slurm::{self, Added, Chunks, Resources, Scripts, Submitted, SweepCommand, TaskList};
use shadowstep_sweeps::{Manifest, Missing, SweepPlan};

use crate::invocation;
use crate::output::Output;
use crate::quantity::whole;
use crate::report::{self, Status};

/// Flags for a cluster with Slurm.
#[derive(Debug, Args)]
#[command(next_help_heading = "Slurm")]
pub(super) struct SlurmArguments {
    /// Submits the missing chunks as a job array
    ///
    /// Another job collects them. The job scripts DIR/array.sbatch and DIR/collect.sbatch are written unless they are
    /// there, and shown.
    #[arg(long, conflicts_with_all = ["chunk", "format"])]
    submit: bool,
    /// Writes and shows the job scripts, and submits nothing
    #[arg(long, requires = "submit")]
    dry_run: bool,
    /// Shows the state of the tasks, and what to do next
    ///
    /// The exit code is 1 if chunks are missing that no task is going to compute.
    #[arg(long, conflicts_with_all = ["submit", "chunk", "format"])]
    status: bool,
    /// The number of chunks and tasks [default: 16]
    ///
    /// It cannot be changed later. The default is larger if there are more than 2^20 runs.
    #[arg(long, value_name = "N", requires = "submit", value_parser = |text: &str| whole(text, 1..=99_999))]
    pub(super) chunks: Option<u32>,
    /// Option --partition of sbatch
    #[arg(long, value_name = "NAME", requires = "submit")]
    partition: Option<String>,
    /// Option --time of sbatch, such as 2:00:00
    ///
    /// It is the longest time of a task: 30 (minutes), 2:00:00 or 1-12 (days-hours).
    #[arg(long, value_name = "TIME", requires = "submit")]
    time: Option<String>,
    /// Option --mem of sbatch, such as 2G
    ///
    /// It is the memory of a task.
    #[arg(long, value_name = "SIZE", requires = "submit")]
    memory: Option<String>,
    /// Option --cpus-per-task of sbatch [default: 1]
    ///
    /// It is the number of threads of a task.
    #[arg(long, value_name = "N", requires = "submit", value_parser = |text: &str| whole(text, 1..=65_536))]
    cpus: Option<u32>,
}

impl SlurmArguments {
    /// Shows what has become of the sweep, if that is asked for.
    pub(super) fn asked(&self, sweep: &Path, folder: &Path) -> Option<Result<Status, Error>> {
        self.status.then(|| status(sweep, folder))
    }

    pub(super) fn submits(&self) -> bool {
        self.submit
    }

    /// Submits the sweep.
    pub(super) fn submit(&self, plan: &SweepPlan, sweep: &Path, folder: &Path) -> Result<Status, Error> {
        let added = Added::to(folder);
        let manifest = Manifest::begin(folder, plan, self.chunks.map(u64::from))?;
        let missing = missing(&manifest, folder);
        if missing.is_empty() && !self.dry_run {
            report::note(format_args!(
                "all chunks are complete: collect them with `shadowstep collect {}`",
                shell_word(folder)
            ));
            return Ok(Status::Success);
        }
        let command = command(sweep, folder, manifest.chunks)?;
        let scripts = Scripts::prepare(&command, &self.resources())?;
        let chunks = Chunks { folder, count: manifest.chunks, missing: &missing };
        let submitted = if self.dry_run {
            added.keep();
            None
        } else {
            Some(slurm::submit(chunks, &command, &scripts, added)?)
        };
        let mut output = Output::stdout();
        for script in [&scripts.array, &scripts.collect] {
            writeln!(output, "# {}\n{}", script.path.display(), script.text)?;
        }
        match submitted {
            None => {}
            Some(Submitted::Array { array, tasks, collect }) => {
                let count = tasks.len();
                writeln!(
                    output,
                    "submitted: job {array}, an array of {count} tasks, {tasks}; job {collect} collects after it"
                )?;
            }
            Some(Submitted::Active(active)) => {
                writeln!(
                    output,
                    "nothing is submitted: the missing chunks have tasks that are pending or running, {active}"
                )?;
            }
        }
        output.finish()?;
        Ok(Status::Success)
    }

    fn resources(&self) -> Resources {
        let SlurmArguments { partition, time, memory, cpus, .. } = self;
        Resources { partition: partition.clone(), time: time.clone(), memory: memory.clone(), cpus: *cpus }
    }
}

fn status(sweep: &Path, folder: &Path) -> Result<Status, Error> {
    let manifest = Manifest::read(folder)?;
    let missing = missing(&manifest, folder);
    let status = slurm::Status::of(Chunks { folder, count: manifest.chunks, missing: &missing }, sweep)?;
    let mut output = Output::stdout();
    writeln!(output, "{status}")?;
    output.finish()?;
    Ok(if status.is_stuck() { Status::NegativeAnswer } else { Status::Success })
}

fn missing(manifest: &Manifest, folder: &Path) -> TaskList {
    Missing::find(manifest, folder).chunks.into_iter().collect()
}

/// The command of the scripts, which run in another folder: all paths are absolute.
fn command(sweep: &Path, folder: &Path, chunks: u64) -> Result<SweepCommand, Error> {
    let unknown = |what: &str, error: std::io::Error| {
        Error::usage(
            format!("the path of {what} cannot be found: {error}"),
            "give paths from the root, such as /home/me/sweep.toml",
        )
    };
    Ok(SweepCommand {
        program: invocation::program().map_err(|error| unknown("this program", error))?,
        sweep: absolute(sweep).map_err(|error| unknown("the sweep", error))?,
        folder: absolute(folder).map_err(|error| unknown("the folder", error))?,
        chunks,
    })
}
