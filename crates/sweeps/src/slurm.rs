//! Sweeps on a cluster with Slurm: a job array computes the chunks, a job after it collects them.
//!
//! Two job scripts are written into the folder of the sweep and kept. Whoever needs other options of sbatch edits them:
//! a script that is there is submitted as it is. Slurm starts the tasks, again if a node is lost; here is only what is
//! submitted and what became of it.
//!
//! | module | what it is |
//! | --- | --- |
//! | `tasks` | lists of tasks such as `3,7-9` |
//! | `script` | the job scripts: their texts and their options |
//! | `command` | the programs of Slurm, and what they print |
//! | `jobs` | the numbers of the jobs that were submitted |
//! | `submission`, `added` | what is submitted; what it adds to the folder |
//! | `queue` | the states of tasks, from squeue and sacct |
//! | `status` | what has become of the tasks and what to do next |

mod added;
mod command;
mod jobs;
mod queue;
mod script;
mod status;
mod submission;
mod tasks;

pub use added::Added;
pub(crate) use script::SCRIPTS;
pub use script::{Resources, Scripts, SweepCommand};
pub use status::Status;
pub use submission::{Submitted, submit};
pub use tasks::TaskList;

use std::path::Path;

/// The folder of a sweep, its chunks and those that are missing.
#[derive(Clone, Copy, Debug)]
pub struct Chunks<'a> {
    /// The folder.
    pub folder: &'a Path,
    /// How many chunks the sweep has.
    pub count: u64,
    /// The chunks without a file.
    pub missing: &'a TaskList,
}
