//! Studies: calculations on all cores whose outcomes are saved one by one, and what is made of them: charts, verdicts, a page of HTML.
//!
//! | file | what it is |
//! | --- | --- |
//! | `task` | what tasks are, and how their computation is followed |
//! | `observer` | how a caller follows it |
//! | `threads` | groups of tasks on all cores |
//! | `progress` | how much is done |
//! | `store` | the file of outcomes |
//! | [`chart`] | curves → SVG |
//! | [`heat_map`] | cells over two quantities, coloured by a third → SVG |
//! | [`verdict`] | whether results agree with a statement |
//! | [`page`] | sections with charts, tables and statements → HTML, which needs neither scripts nor a network |
//! | `indices` | subscripts in texts |
//! | `labels` | widths of texts, labels without overlaps |
//! | `picture` | what all pictures have in common: sizes of texts, colours on dark screens |
//! | `ticks` | round numbers and decades on an axis |

pub mod chart;
pub mod heat_map;
mod indices;
mod labels;
mod observer;
pub mod page;
mod picture;
mod progress;
mod store;
mod task;
mod threads;
mod ticks;
pub mod verdict;

use std::collections::HashMap;

use serde::Serialize;

pub use observer::{Observer, Progress};
pub use shadowstep_scenes::Error;
pub use store::Store;
pub use task::{Task, Watcher};
use threads::{Group, compute};

/// The outcomes of several tasks.
#[derive(Debug)]
pub struct Outcomes<O> {
    /// In the order of the tasks; `None` if the task failed.
    pub outcomes: Vec<Option<O>>,
    /// The failures, each with the place of its task.
    pub failures: Vec<(usize, Error)>,
}

/// Computes the tasks whose outcomes the store lacks, the most expensive first, and returns all outcomes.
///
/// It uses all threads of the current rayon pool: one per core, or the number of `RAYON_NUM_THREADS` or of the caller's pool.
/// Outcomes are always read back from their JSON, so that they depend neither on the threads nor on earlier calls. A
/// failed task stops no other; only a store that cannot be written stops all.
///
/// # Errors
/// A store that cannot be written; an observer that stops the computation.
pub fn run<T: Task>(
    tasks: &[T],
    store: &mut Store,
    observer: &mut dyn Observer,
) -> Result<Outcomes<T::Outcome>, Error> {
    let keys = tasks.iter().map(key).collect::<Result<Vec<_>, _>>()?;
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut due = Vec::new();
    for (place, key) in keys.iter().enumerate() {
        if places.contains_key(key.as_str()) {
            continue;
        }
        places.insert(key, place);
        // an outcome in another form is computed again
        if store.outcome(key).is_none_or(|json| serde_json::from_str::<T::Outcome>(json).is_err()) {
            due.push(place);
        }
    }
    let failures = compute(tasks, &keys, &groups(tasks, &due), store, observer)?;
    let outcome = |key: &String| {
        let failed = failures.iter().any(|(place, _)| *place == places[key.as_str()]);
        if failed { Ok(None) } else { store.outcome(key).map(serde_json::from_str).transpose() }
    };
    let outcomes = keys.iter().map(outcome).collect::<Result<_, _>>()?;
    Ok(Outcomes { outcomes, failures })
}

/// The tasks that are computed together; the most expensive groups first.
fn groups<T: Task>(tasks: &[T], due: &[usize]) -> Vec<Group> {
    let mut together: HashMap<String, usize> = HashMap::new();
    let mut groups: Vec<Group> = Vec::new();
    for &place in due {
        let next = groups.len();
        let at = tasks[place].group().map_or(next, |group| *together.entry(group).or_insert(next));
        if at == next {
            groups.push(Group::default());
        }
        groups[at].places.push(place);
    }
    for group in &mut groups {
        group.cost = T::cost(&group.members(tasks)).max(0.0);
    }
    groups.sort_by(|a, b| b.cost.total_cmp(&a.cost));
    groups
}

/// All outcomes if the store has them; nothing is computed.
pub fn kept<T: Task>(tasks: &[T], store: &Store) -> Option<Vec<T::Outcome>> {
    tasks.iter().map(|task| serde_json::from_str(store.outcome(&key(task).ok()?)?).ok()).collect()
}

/// The JSON of a task; a `Value` is written in one way only.
fn key<T: Serialize>(task: &T) -> Result<String, Error> {
    Ok(serde_json::to_value(task)?.to_string())
}

#[cfg(test)]
mod tests;
