//! The states of jobs and tasks: squeue has those that have not ended or have ended recently, sacct also older ones.

use std::collections::{BTreeMap, BTreeSet};

use shadowstep_scenes::Error;

use super::command::{Failure, call};
use super::jobs::Job;

/// What a task or a job is doing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// It waits; why, in Slurm's word.
    Pending(String),
    Running,
    /// It has ended with exit status 0.
    Done,
    /// It has ended otherwise; how, in Slurm's word.
    Failed(String),
}

/// A job, and the number of a task if it is an array.
pub(super) type Key = (u64, Option<u64>);

/// The states of all that Slurm remembers of these jobs.
///
/// # Errors
/// squeue is not there or cannot reach the cluster. sacct may refuse: many clusters have no accounting.
pub(super) fn states(jobs: &[Job]) -> Result<BTreeMap<Key, State>, Error> {
    let mut found = BTreeMap::new();
    for cluster in jobs.iter().map(|job| &job.cluster).collect::<BTreeSet<_>>() {
        let of_cluster: Vec<&Job> = jobs.iter().filter(|job| job.cluster == *cluster).collect();
        let numbers = of_cluster.iter().map(|job| job.job.to_string()).collect::<Vec<_>>().join(",");
        let mut arguments = vec![format!("--jobs={numbers}"), "--noheader".to_owned(), "--array".to_owned()];
        arguments.extend(cluster.iter().map(|cluster| format!("--clusters={cluster}")));
        let known = squeue(&arguments)?;
        let all_known = of_cluster.iter().all(|job| is_known(job, &known));
        if !all_known {
            found.extend(sacct(&arguments));
        }
        found.extend(known);
    }
    Ok(found)
}

fn is_known(job: &Job, known: &BTreeMap<Key, State>) -> bool {
    match job.tasks() {
        Some(tasks) => tasks.numbers().all(|task| known.contains_key(&(job.job, Some(task)))),
        None => known.contains_key(&(job.job, None)),
    }
}

fn squeue(arguments: &[String]) -> Result<BTreeMap<Key, State>, Error> {
    let mut arguments = arguments.to_vec();
    arguments.extend(["--states=all".to_owned(), "--format=%F|%K|%T|%r".to_owned()]);
    match call("squeue", &arguments) {
        Ok(text) => Ok(text.lines().filter_map(of_squeue).collect()),
        // all of them ended long ago
        Err(Failure::Refused(message)) if message.contains("Invalid job id") => Ok(BTreeMap::new()),
        Err(failure) => Err(failure.error("squeue", "try again when the cluster can be reached")),
    }
}

fn sacct(arguments: &[String]) -> BTreeMap<Key, State> {
    let mut arguments = arguments.to_vec();
    arguments.extend(["--allocations", "--parsable2", "--format=JobID,State"].map(str::to_owned));
    call("sacct", &arguments).map(|text| text.lines().filter_map(of_sacct).collect()).unwrap_or_default()
}

/// A line of squeue: array's job | task | state | reason.
fn of_squeue(line: &str) -> Option<(Key, State)> {
    let mut parts = line.trim().split('|');
    let job = parts.next()?.parse().ok()?;
    let task = parts.next()?;
    let task = if task == "N/A" { None } else { Some(task.parse().ok()?) };
    Some(((job, task), state(parts.next()?, parts.next()?)))
}

/// A line of sacct: `12_3|COMPLETED`.
fn of_sacct(line: &str) -> Option<(Key, State)> {
    let (job, word) = line.trim().split_once('|')?;
    let key = match job.split_once('_') {
        Some((job, task)) => (job.parse().ok()?, Some(task.parse().ok()?)),
        None => (job.parse().ok()?, None),
    };
    // `CANCELLED by 1000`
    Some((key, state(word.split(' ').next()?, "")))
}

fn state(word: &str, reason: &str) -> State {
    match word {
        "PENDING" | "REQUEUED" | "REQUEUE_HOLD" | "REQUEUE_FED" | "RESV_DEL_HOLD" | "SPECIAL_EXIT" => {
            State::Pending(reason.to_owned())
        }
        "RUNNING" | "CONFIGURING" | "COMPLETING" | "RESIZING" | "SIGNALING" | "STAGE_OUT" | "STOPPED" | "SUSPENDED" => {
            State::Running
        }
        "COMPLETED" => State::Done,
        _ => State::Failed(word.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_squeue() {
        assert_eq!(of_squeue("12|3|RUNNING|None"), Some(((12, Some(3)), State::Running)));
        assert_eq!(of_squeue("12|4|PENDING|Resources"), Some(((12, Some(4)), State::Pending("Resources".into()))));
        assert_eq!(of_squeue("12|5|COMPLETED|None"), Some(((12, Some(5)), State::Done)));
        assert_eq!(of_squeue("12|6|TIMEOUT|TimeLimit"), Some(((12, Some(6)), State::Failed("TIMEOUT".into()))));
        assert_eq!(of_squeue("13|N/A|PENDING|Dependency"), Some(((13, None), State::Pending("Dependency".into()))));
        assert_eq!(of_squeue("CLUSTER: north"), None);
    }

    #[test]
    fn lines_of_sacct() {
        assert_eq!(of_sacct("12_3|CANCELLED by 1000"), Some(((12, Some(3)), State::Failed("CANCELLED".into()))));
        assert_eq!(of_sacct("13|COMPLETED"), Some(((13, None), State::Done)));
        assert_eq!(of_sacct("12_[5-7]|PENDING"), None);
    }
}
