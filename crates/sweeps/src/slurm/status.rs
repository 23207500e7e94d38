//! What has become of the tasks of a sweep, and what to do next.

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};

use shadowstep_scenes::{Error, shell_word};

use super::Chunks;
use super::jobs::{self, Job};
use super::queue::{self, Key, State};
use super::tasks::TaskList;
use crate::collect::TABLES;

/// The tasks and chunks of a sweep.
///
/// Displayed as lines: tasks by their states, failures, chunks, and what to do next.
#[derive(Debug)]
pub struct Status {
    /// The state of each task that was submitted, as of the last array with it; `None` if Slurm no longer lists it.
    tasks: BTreeMap<u64, Option<State>>,
    /// The job that collects, and its state.
    collect: Option<(u64, Option<State>)>,
    count: u64,
    missing: TaskList,
    /// The commands that submit and collect.
    submit: String,
    collects: String,
    /// Whether results are there.
    has_results: bool,
}

impl Status {
    /// Asks Slurm for the jobs of a sweep; `sweep` is its file, as the user gave it.
    ///
    /// # Errors
    /// squeue is not there, or cannot reach the cluster; the file of the jobs cannot be read.
    pub fn of(chunks: Chunks<'_>, sweep: &std::path::Path) -> Result<Self, Error> {
        let jobs = jobs::read(chunks.folder)?;
        let states = if jobs.is_empty() { BTreeMap::new() } else { queue::states(&jobs)? };
        let folder = shell_word(chunks.folder);
        Ok(Status {
            tasks: of_tasks(&jobs, &states),
            collect: jobs
                .iter()
                .rfind(|job| job.tasks().is_none())
                .map(|job| (job.job, states.get(&(job.job, None)).cloned())),
            count: chunks.count,
            missing: chunks.missing.clone(),
            submit: format!("shadowstep sweep {} --out {folder} --submit", shell_word(sweep)),
            collects: format!("shadowstep collect {folder}"),
            has_results: TABLES.iter().any(|name| chunks.folder.join(name).is_file()),
        })
    }

    /// Whether chunks are missing that no task is going to compute.
    pub fn is_stuck(&self) -> bool {
        !self.missing.without(&self.active()).is_empty()
    }

    fn active(&self) -> TaskList {
        self.with(|state| matches!(state, Some(State::Pending(_) | State::Running)))
    }

    /// The tasks in some states.
    fn with(&self, has: impl Fn(&Option<State>) -> bool) -> TaskList {
        self.tasks.iter().filter(|(_, state)| has(state)).map(|(task, _)| *task).collect()
    }

    fn counts(&self) -> String {
        let pending = self.with(|state| matches!(state, Some(State::Pending(_))));
        let mut text = format!("{} pending", pending.len());
        let reasons = grouped(&self.tasks, |state| match state {
            State::Pending(reason) => Some(reason),
            _ => None,
        });
        let words: Vec<&str> = reasons.keys().copied().filter(|reason| !["", "None"].contains(reason)).collect();
        if !words.is_empty() {
            let _ = write!(text, " ({})", words.join(", "));
        }
        let running = self.with(|state| *state == Some(State::Running)).len();
        let done = self.with(|state| *state == Some(State::Done)).len();
        let failed = self.with(|state| matches!(state, Some(State::Failed(_)))).len();
        let _ = write!(text, ", {running} running, {done} done, {failed} failed");
        match self.with(Option::is_none).len() {
            0 => text,
            forgotten => text + &format!(", {forgotten} no longer listed by Slurm"),
        }
    }

    /// The failed tasks by their ends.
    fn failures(&self) -> String {
        let failures = grouped(&self.tasks, |state| match state {
            State::Failed(word) => Some(word),
            _ => None,
        });
        failures.iter().map(|(word, tasks)| format!("{tasks} ({word})")).collect::<Vec<_>>().join(", ")
    }

    fn next(&self) -> String {
        let active = self.active();
        let missing = self.missing.without(&active);
        if !missing.is_empty() {
            let of = if self.tasks.is_empty() { "submit the chunks" } else { "submit the missing chunks" };
            return format!("{of}: {}", self.submit);
        }
        if !self.missing.is_empty() {
            return format!("wait for the tasks {active}");
        }
        match &self.collect {
            Some((job, Some(State::Pending(_) | State::Running))) => {
                format!("wait for job {job}, which collects the chunks")
            }
            _ if self.has_results => "nothing: all chunks are complete and the results are written".to_owned(),
            _ => format!("collect the chunks: {}", self.collects),
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.tasks.is_empty() {
            writeln!(f, "tasks:   none was submitted")?;
        } else {
            writeln!(f, "tasks:   {}", self.counts())?;
        }
        let failures = self.failures();
        if !failures.is_empty() {
            writeln!(f, "failed:  {failures}")?;
        }
        let complete = self.count - self.missing.len() as u64;
        write!(f, "chunks:  {complete} of {} are complete", self.count)?;
        if complete > 0 && !self.missing.is_empty() {
            write!(f, ", missing: {}", self.missing)?;
        }
        write!(f, "\nnext:    {}", self.next())
    }
}

/// The state of each task, as of the last array that has it.
fn of_tasks(jobs: &[Job], states: &BTreeMap<Key, State>) -> BTreeMap<u64, Option<State>> {
    let mut found = BTreeMap::new();
    for job in jobs {
        for task in job.tasks().iter().flat_map(TaskList::numbers) {
            found.insert(task, states.get(&(job.job, Some(task))).cloned());
        }
    }
    found
}

/// The tasks by a word of their states.
fn grouped<'a>(
    tasks: &'a BTreeMap<u64, Option<State>>,
    word: impl Fn(&'a State) -> Option<&'a String>,
) -> BTreeMap<&'a str, TaskList> {
    let mut groups: BTreeMap<&str, Vec<u64>> = BTreeMap::new();
    for (task, state) in tasks {
        if let Some(word) = state.as_ref().and_then(&word) {
            groups.entry(word).or_default().push(*task);
        }
    }
    groups.into_iter().map(|(word, tasks)| (word, tasks.into_iter().collect())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(tasks: &[(u64, Option<State>)], missing: &str, collect: Option<State>) -> Status {
        Status {
            tasks: tasks.iter().cloned().collect(),
            collect: Some((13, collect)),
            count: 16,
            missing: TaskList::read(missing).unwrap_or_default(),
            submit: "shadowstep sweep map.toml --out map --submit".to_owned(),
            collects: "shadowstep collect map".to_owned(),
            has_results: false,
        }
    }

    fn failed(word: &str) -> Option<State> {
        Some(State::Failed(word.to_owned()))
    }

    #[test]
    fn tasks_that_are_on_their_way_are_waited_for() {
        let pending = Some(State::Pending("Resources".to_owned()));
        let status = status(&[(1, Some(State::Done)), (2, Some(State::Running)), (3, pending)], "2,3", None);
        assert!(!status.is_stuck());
        assert_eq!(
            status.to_string(),
            "tasks:   1 pending (Resources), 1 running, 1 done, 0 failed\n\
             chunks:  14 of 16 are complete, missing: 2-3\n\
             next:    wait for the tasks 2-3"
        );
    }

    #[test]
    fn chunks_without_a_task_are_submitted_again() {
        let tasks = [
            (1, Some(State::Done)),
            (3, failed("TIMEOUT")),
            (7, failed("CANCELLED")),
            (8, failed("CANCELLED")),
            (9, None),
        ];
        let status = status(&tasks, "3,7-9", Some(State::Done));
        assert!(status.is_stuck());
        assert_eq!(
            status.to_string(),
            "tasks:   0 pending, 0 running, 1 done, 3 failed, 1 no longer listed by Slurm\n\
             failed:  7-8 (CANCELLED), 3 (TIMEOUT)\n\
             chunks:  12 of 16 are complete, missing: 3,7-9\n\
             next:    submit the missing chunks: shadowstep sweep map.toml --out map --submit"
        );
    }

    #[test]
    fn complete_chunks_are_collected_once() {
        let done = [(1, Some(State::Done))];
        let next = |status: &Status| status.to_string().lines().last().unwrap().to_owned();
        let mut status = status(&done, "", Some(State::Pending("Dependency".to_owned())));
        assert_eq!(next(&status), "next:    wait for job 13, which collects the chunks");
        status.collect = None;
        assert_eq!(next(&status), "next:    collect the chunks: shadowstep collect map");
        status.has_results = true;
        assert_eq!(next(&status), "next:    nothing: all chunks are complete and the results are written");
        assert!(!status.is_stuck());
    }

    #[test]
    fn the_last_array_of_a_task_counts() {
        let job = |number: u64, tasks: &str| Job::read(&number.to_string(), TaskList::read(tasks).as_ref()).unwrap();
        let states = BTreeMap::from([
            ((5, Some(1)), State::Done),
            ((5, Some(2)), State::Failed("TIMEOUT".to_owned())),
            ((7, Some(2)), State::Running),
        ]);
        let tasks = of_tasks(&[job(5, "1-3"), job(7, "2")], &states);
        assert_eq!(tasks, BTreeMap::from([(1, Some(State::Done)), (2, Some(State::Running)), (3, None)]));
    }
}
