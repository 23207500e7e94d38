//! The jobs that were submitted: a line each in a file of the sweep's folder.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use shadowstep_scenes::lock::open_itself;
use shadowstep_scenes::{Error, not_written};

use super::tasks::TaskList;

/// A job of Slurm.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Job {
    /// Its number.
    pub(super) job: u64,
    /// Its cluster, where a site has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) cluster: Option<String>,
    /// The tasks of an array; `None` for the job that collects.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tasks: Option<String>,
}

impl Job {
    /// Reads what `sbatch --parsable` prints: `123`, or `123;cluster`.
    pub(super) fn read(printed: &str, tasks: Option<&TaskList>) -> Option<Job> {
        let last = printed.lines().rfind(|line| !line.trim().is_empty())?.trim();
        let (job, cluster) =
            last.split_once(';').map_or((last, None), |(job, cluster)| (job, Some(cluster.to_owned())));
        Some(Job { job: job.parse().ok()?, cluster, tasks: tasks.map(TaskList::to_string) })
    }

    /// The tasks of an array; `None` for the job that collects.
    pub(super) fn tasks(&self) -> Option<TaskList> {
        self.tasks.as_deref().and_then(TaskList::read)
    }
}

/// The file of the jobs.
fn path(folder: &Path) -> PathBuf {
    folder.join("slurm-jobs.jsonl")
}

/// The jobs in the order in which they were submitted.
pub(super) fn read(folder: &Path) -> Result<Vec<Job>, Error> {
    let path = path(folder);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(Error::usage(format!("{} cannot be read: {error}", path.display()), "mend the file")),
    };
    let line = |(number, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| {
            Error::usage(format!("{}:{}: not a job: {error}", path.display(), number + 1), "remove the line")
        })
    };
    text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).map(line).collect()
}

/// Adds a job, at once and permanently: a job without its line could not be found again.
pub(super) fn add(folder: &Path, job: &Job) -> Result<(), Error> {
    let path = path(folder);
    let add = || -> io::Result<()> {
        let mut file = open_itself(&path, OpenOptions::new().append(true).create(true))?;
        file.write_all(format!("{}\n", serde_json::to_string(job)?).as_bytes())?;
        file.sync_all()
    };
    let again = format!("add this line: {}", serde_json::to_string(job)?);
    add().map_err(|error| not_written(&path, error, &again).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_sbatch_prints_is_read() {
        let tasks = TaskList::read("3,7-9").unwrap();
        let job = Job::read("123\n", Some(&tasks)).unwrap();
        assert_eq!((job.job, job.cluster.as_deref(), job.tasks()), (123, None, Some(tasks)));
        let job = Job::read("a note of the site\n124;north\n", None).unwrap();
        assert_eq!((job.job, job.cluster.as_deref(), job.tasks()), (124, Some("north"), None));
        assert_eq!(Job::read("Submitted batch job 5\n", None), None);
    }

    #[test]
    fn jobs_are_read_back() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(read(folder.path()).unwrap(), []);
        let jobs = [Job::read("5", Some(&TaskList::all(16))).unwrap(), Job::read("6;north", None).unwrap()];
        for job in &jobs {
            add(folder.path(), job).unwrap();
        }
        assert_eq!(read(folder.path()).unwrap(), jobs);
        fs::write(path(folder.path()), "{\"job\":5}\nx\n").unwrap();
        let refused = read(folder.path()).unwrap_err().to_string();
        assert!(refused.contains("slurm-jobs.jsonl:2: not a job"), "{refused}");
    }
}
