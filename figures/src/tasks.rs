//! Tasks on all cores. Each outcome is saved when its task is done, so that an interrupted computation can be resumed.

mod store;

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{Error, Observer, Progress};
pub(crate) use store::Store;

/// Something to compute, identified by its JSON: tasks with equal JSON are computed once.
///
/// Tasks of different types may share a store only if their JSON differs, as that of an `enum` does. Numbers of more than
/// 64 bits must be texts.
pub(crate) trait Task: Serialize + Sync {
    /// Floating-point numbers in it must be finite, because JSON has no others.
    type Outcome: Serialize + DeserializeOwned;

    /// The approximate time, in a unit common to all tasks.
    fn cost(&self) -> f64;

    /// Computes it in one thread.
    fn compute(&self) -> Result<Self::Outcome, Error>;
}

/// The outcomes of several tasks.
#[derive(Debug)]
pub(crate) struct Outcomes<O> {
    /// In the order of the tasks; `None` if the task failed.
    pub(crate) outcomes: Vec<Option<O>>,
    /// The failures, each with the place of its task.
    pub(crate) failures: Vec<(usize, Error)>,
}

/// Computes the tasks whose outcomes the store lacks, the most expensive first, and returns all outcomes.
///
/// It uses all threads of the current rayon pool: one per core, or the number of `RAYON_NUM_THREADS` or of the caller's pool.
/// Outcomes are always read back from their JSON, so that they depend neither on the threads nor on earlier calls. A
/// failed task stops no other; only a store that cannot be written stops all.
pub(crate) fn run<T: Task>(
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
    due.sort_by(|&a, &b| tasks[b].cost().total_cmp(&tasks[a].cost()));
    let failures = compute(tasks, &keys, &due, store, observer)?;
    let outcome = |key: &String| {
        let failed = failures.iter().any(|(place, _)| *place == places[key.as_str()]);
        if failed { Ok(None) } else { store.outcome(key).map(serde_json::from_str).transpose() }
    };
    let outcomes = keys.iter().map(outcome).collect::<Result<_, _>>()?;
    Ok(Outcomes { outcomes, failures })
}

/// All outcomes if the store has them; nothing is computed.
pub(crate) fn kept<T: Task>(tasks: &[T], store: &Store) -> Option<Vec<T::Outcome>> {
    tasks.iter().map(|task| serde_json::from_str(store.outcome(&key(task).ok()?)?).ok()).collect()
}

/// The JSON of a task; a `Value` is written in one way only.
fn key<T: Serialize>(task: &T) -> Result<String, Error> {
    Ok(serde_json::to_value(task)?.to_string())
}

/// Computes the tasks that are due in their order; each idle thread takes the next one.
fn compute<T: Task>(
    tasks: &[T],
    keys: &[String],
    due: &[usize],
    store: &mut Store,
    observer: &mut dyn Observer,
) -> Result<Vec<(usize, Error)>, Error> {
    let cost = |place: usize| tasks[place].cost().max(0.0);
    let progress = Mutex::new(Reporter::new(observer, due.len(), due.iter().map(|&place| cost(place)).sum()));
    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let store = Mutex::new(store);
    let failures = Mutex::new(Vec::new());
    let broken = Mutex::new(None);
    rayon::broadcast(|_| {
        while let Some(&place) = due.get(next.fetch_add(1, Ordering::Relaxed)).filter(|_| !stop.load(Ordering::Relaxed))
        {
            let begin = Instant::now();
            match tasks[place].compute().and_then(|outcome| json::<T>(&outcome)) {
                Ok(outcome) => {
                    if let Err(error) = locked(&store).keep(&keys[place], outcome, begin.elapsed()) {
                        stop.store(true, Ordering::Relaxed);
                        *locked(&broken) = Some(error);
                    }
                }
                Err(error) => locked(&failures).push((place, error)),
            }
            locked(&progress).done(cost(place));
        }
    });
    if let Some(error) = broken.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error);
    }
    let mut failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    failures.sort_by_key(|(place, _)| *place);
    Ok(failures)
}

/// Reports how much of the cost is done, and not only how many tasks: their costs differ widely.
struct Reporter<'a> {
    observer: &'a mut dyn Observer,
    done: usize,
    tasks: usize,
    cost_done: f64,
    cost: f64,
}

impl<'a> Reporter<'a> {
    fn new(observer: &'a mut dyn Observer, tasks: usize, cost: f64) -> Self {
        let mut reporter = Reporter { observer, done: 0, tasks, cost_done: 0.0, cost };
        if tasks > 0 {
            reporter.report();
        }
        reporter
    }

    fn done(&mut self, cost: f64) {
        self.done += 1;
        self.cost_done += cost;
        self.report();
    }

    fn report(&mut self) {
        let fraction = if self.cost > 0.0 { self.cost_done / self.cost } else { 0.0 };
        self.observer.progress(Progress { done: self.done, tasks: self.tasks, fraction });
    }
}

/// The JSON of an outcome, if it can be read back.
fn json<T: Task>(outcome: &T::Outcome) -> Result<String, Error> {
    let json = serde_json::to_string(outcome)?;
    match serde_json::from_str::<T::Outcome>(&json) {
        Ok(_) => Ok(json),
        Err(error) => Err(Error::run(
            format!("an outcome cannot be read back from its JSON ({error}): {json}"),
            "a number in it may be infinite or NaN",
        )),
    }
}

/// A thread that panicked leaves no partial changes.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests;
