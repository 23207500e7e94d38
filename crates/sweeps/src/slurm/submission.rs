//! What is submitted: an array of the chunks that are missing, and after it a job that collects.

use std::collections::BTreeMap;
use std::path::Path;

use shadowstep_scenes::{Error, shell_word};

use super::Chunks;
use super::added::Added;
use super::command::{Failure, call};
use super::jobs::{self, Job};
use super::queue::{self, Key, State};
use super::script::{Script, Scripts, SweepCommand};
use super::tasks::TaskList;

/// What was submitted.
#[derive(Debug, PartialEq, Eq)]
pub enum Submitted {
    /// An array, and the job that collects.
    Array {
        /// The number of the array's job.
        array: u64,
        /// Its tasks.
        tasks: TaskList,
        /// The number of the job that collects after it.
        collect: u64,
    },
    /// Nothing: every missing chunk has a task that is pending or running, one of these.
    Active(TaskList),
}

/// Submits the chunks that are missing and have no task that is pending or running, and a job that collects after them.
///
/// The numbers of the jobs are saved in the folder of the sweep. What was added to the folder stays as soon as an array
/// is submitted.
///
/// # Errors
/// Slurm is not there, or refuses; the numbers of the jobs cannot be read or written.
pub fn submit(chunks: Chunks<'_>, command: &SweepCommand, scripts: &Scripts, added: Added) -> Result<Submitted, Error> {
    let earlier = jobs::read(chunks.folder)?;
    let states = if earlier.is_empty() { BTreeMap::new() } else { queue::states(&earlier)? };
    let active = active(&earlier, &states);
    let tasks = chunks.missing.without(&active);
    if tasks.is_empty() {
        added.keep();
        return Ok(Submitted::Active(active));
    }
    let mut arguments = Vec::new();
    if tasks.len() as u64 != chunks.count {
        arguments.push(format!("--array={tasks}{}", scripts.array.limit()));
    }
    let array = sbatch(&arguments, &scripts.array, Some(&tasks)).map_err(|failure| refusal(failure, command))?;
    added.keep();
    jobs::add(chunks.folder, &array)?;
    let before = before(&earlier, &states, &array);
    let collect = sbatch(&[format!("--dependency=afterany:{before}")], &scripts.collect, None);
    let then = format!(
        "the array {} was submitted; run `shadowstep collect {}` when it has ended",
        array.job,
        shell_word(chunks.folder)
    );
    let collect = collect.map_err(|failure| failure.error("sbatch", then))?;
    jobs::add(chunks.folder, &collect)?;
    Ok(Submitted::Array { array: array.job, tasks, collect: collect.job })
}

/// The tasks that are pending or running.
fn active(jobs: &[Job], states: &BTreeMap<Key, State>) -> TaskList {
    let of_array = |job: &Job| job.tasks().is_some();
    let arrays: Vec<u64> = jobs.iter().filter(|job| of_array(job)).map(|job| job.job).collect();
    let active = states.iter().filter(|((job, _), state)| arrays.contains(job) && is_active(state));
    active.filter_map(|((_, task), _)| *task).collect()
}

fn is_active(state: &State) -> bool {
    matches!(state, State::Pending(_) | State::Running)
}

/// The arrays that must end before chunks are collected: the new one, and others that have not ended.
fn before(earlier: &[Job], states: &BTreeMap<Key, State>, array: &Job) -> String {
    let has_active = |job: &&Job| {
        job.tasks().is_some() && states.iter().any(|((number, _), state)| *number == job.job && is_active(state))
    };
    let others = earlier.iter().filter(has_active).map(|job| job.job);
    others.chain([array.job]).map(|job| job.to_string()).collect::<Vec<_>>().join(":")
}

fn sbatch(arguments: &[String], script: &Script, tasks: Option<&TaskList>) -> Result<Job, Failure> {
    let mut all = vec!["--parsable".to_owned()];
    all.extend_from_slice(arguments);
    all.push(script.path.display().to_string());
    let printed = call("sbatch", &all)?;
    let unread = || Failure::Refused(format!("{:?} has no number of a job", printed.trim()));
    Job::read(&printed, tasks).ok_or_else(unread)
}

fn refusal(failure: Failure, command: &SweepCommand) -> Error {
    match failure {
        Failure::NotFound => Error::usage(
            "sbatch is not found: Slurm is not installed here, or its programs are not on the PATH",
            format!("without Slurm, GNU parallel computes the chunks: {}", parallel(command)),
        ),
        Failure::Refused(message) if message.contains("array") => failure_of_array(message),
        refused => {
            refused.error("sbatch", "give other flags, or options of your site in the file: --dry-run writes it")
        }
    }
}

fn failure_of_array(message: String) -> Error {
    let hint =
        "arrays of a site have a largest number, see `scontrol show config | grep MaxArraySize`: give fewer --chunks";
    Failure::Refused(message).error("sbatch", hint)
}

/// The line that computes all chunks with GNU parallel, each with one core.
fn parallel(command: &SweepCommand) -> String {
    let SweepCommand { program, sweep, folder, chunks } = command;
    let word = |path: &Path| shell_word(path);
    let (log, program, sweep, folder) = (word(&folder.join("jobs.log")), word(program), word(sweep), word(folder));
    let quote = if format!("{program}{sweep}{folder}").contains('\'') { " --quote" } else { "" };
    format!(
        "seq {chunks} | RAYON_NUM_THREADS=1 parallel{quote} --joblog {log} --resume-failed \
         {program} sweep {sweep} --out {folder} --chunk {{}}/{chunks}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(number: u64, tasks: Option<&str>) -> Job {
        Job::read(&number.to_string(), tasks.and_then(TaskList::read).as_ref()).unwrap()
    }

    #[test]
    fn the_collecting_job_waits_for_all_arrays_that_have_not_ended() {
        let earlier = [job(5, Some("1-16")), job(6, None), job(7, Some("3,4")), job(8, None)];
        let states = BTreeMap::from([
            ((5, Some(1)), State::Done),
            ((6, None), State::Running),
            ((7, Some(3)), State::Pending("Resources".to_owned())),
            ((7, Some(4)), State::Failed("TIMEOUT".to_owned())),
        ]);
        assert_eq!(active(&earlier, &states).to_string(), "3");
        assert_eq!(before(&earlier, &states, &job(9, Some("4"))), "7:9");
    }

    #[test]
    fn the_line_of_gnu_parallel() {
        let plain =
            SweepCommand { program: "shadowstep".into(), sweep: "map.toml".into(), folder: "map".into(), chunks: 16 };
        assert_eq!(
            parallel(&plain),
            "seq 16 | RAYON_NUM_THREADS=1 parallel --joblog map/jobs.log --resume-failed \
             shadowstep sweep map.toml --out map --chunk {}/16"
        );
        let blank = SweepCommand { sweep: "my map.toml".into(), ..plain };
        assert!(parallel(&blank).contains("parallel --quote --joblog"));
    }
}
