//! Groups of tasks on all cores.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::progress::Reporter;
use super::store::Store;
use super::task::{Task, Watcher};
use crate::{Error, Observer};

/// Tasks that one thread computes together.
#[derive(Debug, Default)]
pub(super) struct Group {
    /// Their places in the list of all tasks.
    pub(super) places: Vec<usize>,
    pub(super) cost: f64,
}

impl Group {
    pub(super) fn members<'a, T>(&self, tasks: &'a [T]) -> Vec<&'a T> {
        self.places.iter().map(|&place| &tasks[place]).collect()
    }
}

/// Computes the groups in their order; each idle thread takes the next one.
pub(super) fn compute<T: Task>(
    tasks: &[T],
    keys: &[String],
    groups: &[Group],
    store: &mut Store,
    observer: &mut dyn Observer,
) -> Result<Vec<(usize, Error)>, Error> {
    let reporter = Mutex::new(Reporter::new(observer, groups.iter().map(|group| (group.places.len(), group.cost))));
    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let store = Mutex::new(store);
    let failures = Mutex::new(Vec::new());
    let broken = Mutex::new(None);
    rayon::broadcast(|_| {
        while let Some((number, group)) = next_of(groups, &next).filter(|_| !stop.load(Ordering::Relaxed)) {
            let (store, failures, broken) = (&store, &failures, &broken);
            let (begin, stop, reporter) = (Mutex::new(Instant::now()), &stop, &reporter);
            let watcher = InThread { group, number, keys, begin, stop, store, failures, broken, reporter };
            T::compute(&group.members(tasks), &watcher);
            locked(reporter).group_done(number);
        }
    });
    if let Some(error) = broken.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error);
    }
    let reporter = reporter.into_inner().unwrap_or_else(PoisonError::into_inner);
    if let Some(interrupted) = reporter.interrupted() {
        return Err(interrupted);
    }
    let mut failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    failures.sort_by_key(|(place, _)| *place);
    Ok(failures)
}

/// The next group that no thread has taken, with its number.
fn next_of<'a, G>(groups: &'a [G], next: &AtomicUsize) -> Option<(usize, &'a G)> {
    let number = next.fetch_add(1, Ordering::Relaxed);
    Some((number, groups.get(number)?))
}

/// Saves the outcomes of a group, and reports its progress.
struct InThread<'a, 'o> {
    group: &'a Group,
    number: usize,
    keys: &'a [String],
    /// When the present task began.
    begin: Mutex<Instant>,
    stop: &'a AtomicBool,
    store: &'a Mutex<&'a mut Store>,
    failures: &'a Mutex<Vec<(usize, Error)>>,
    /// Why outcomes cannot be saved.
    broken: &'a Mutex<Option<Error>>,
    reporter: &'a Mutex<Reporter<'o>>,
}

impl<O: Serialize + DeserializeOwned> Watcher<O> for InThread<'_, '_> {
    fn continues(&self, part: f64) -> bool {
        let continues = !self.stop.load(Ordering::Relaxed) && locked(self.reporter).continues(self.number, part);
        if !continues {
            self.stop.store(true, Ordering::Relaxed);
        }
        continues
    }

    fn take(&self, place: usize, outcome: Result<O, Error>) {
        let place = self.group.places[place];
        let took = std::mem::replace(&mut *locked(&self.begin), Instant::now()).elapsed();
        match outcome.and_then(|outcome| json(&outcome)) {
            Ok(outcome) => {
                if let Err(error) = locked(self.store).keep(&self.keys[place], outcome, took) {
                    self.stop.store(true, Ordering::Relaxed);
                    *locked(self.broken) = Some(error);
                }
            }
            // it was stopped, and has not failed
            Err(_) if self.stop.load(Ordering::Relaxed) => return,
            Err(error) => locked(self.failures).push((place, error)),
        }
        locked(self.reporter).task_done();
    }
}

/// The JSON of an outcome, if it can be read back.
fn json<O: Serialize + DeserializeOwned>(outcome: &O) -> Result<String, Error> {
    let json = serde_json::to_string(outcome)?;
    match serde_json::from_str::<O>(&json) {
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
