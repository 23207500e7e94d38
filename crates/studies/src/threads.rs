//! Groups of calculations on all cores.

use std::cell::Cell;
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::progress::Reporter;
use crate::{Calculation, Error, Observer};

/// Keeps the outcome, as JSON, of the calculation at a place, and the time that it took.
pub(crate) type Keep<'a> = dyn FnMut(usize, String, Duration) -> Result<(), Error> + Send + 'a;

/// Calculations that one thread makes together.
#[derive(Debug)]
struct Group {
    /// Their places in the list of all calculations.
    places: Vec<usize>,
    cost: f64,
}

impl Group {
    fn members<'a, C>(&self, calculations: &'a [C]) -> Vec<&'a C> {
        self.places.iter().map(|&place| &calculations[place]).collect()
    }
}

/// The calculations at these places that are made together; the most expensive groups first.
fn groups<C: Calculation>(calculations: &[C], due: &[usize]) -> Vec<Group> {
    let mut together: HashMap<String, usize> = HashMap::new();
    let mut groups: Vec<Group> = Vec::new();
    for &place in due {
        let next = groups.len();
        let at = calculations[place].group().map_or(next, |group| *together.entry(group).or_insert(next));
        if at == next {
            groups.push(Group { places: Vec::new(), cost: 0.0 });
        }
        groups[at].places.push(place);
    }
    for group in &mut groups {
        let members = group.members(calculations);
        let own: f64 = members.iter().map(|calculation| calculation.cost()).sum();
        group.cost = (C::cost_of_shared(&members) + own).max(0.0);
    }
    groups.sort_by(|a, b| b.cost.total_cmp(&a.cost));
    groups
}

/// Makes the calculations at these places, the most expensive first; each idle thread takes the next group. Returns the
/// failures, each with the place of its calculation.
pub(crate) fn compute<C: Calculation>(
    calculations: &[C],
    due: &[usize],
    keep: &mut Keep<'_>,
    observer: &mut dyn Observer,
) -> Result<Vec<(usize, Error)>, Error> {
    let groups = &groups(calculations, due);
    let reporter = Mutex::new(Reporter::new(observer, groups.iter().map(|group| (group.places.len(), group.cost))));
    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let keep = Mutex::new(keep);
    let failures = Mutex::new(Vec::new());
    let broken = Mutex::new(None);
    rayon::broadcast(|_| {
        while let Some((number, group)) = next_of(groups, &next).filter(|_| !stop.load(Ordering::Relaxed)) {
            let (keep, failures, broken) = (&keep, &failures, &broken);
            let (stop, reporter) = (&stop, &reporter);
            InThread { group, number, stop, keep, failures, broken, reporter }.compute(&group.members(calculations));
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
struct InThread<'a, 'k, 'o> {
    group: &'a Group,
    number: usize,
    stop: &'a AtomicBool,
    keep: &'a Mutex<&'a mut Keep<'k>>,
    failures: &'a Mutex<Vec<(usize, Error)>>,
    /// Why outcomes cannot be saved.
    broken: &'a Mutex<Option<Error>>,
    reporter: &'a Mutex<Reporter<'o>>,
}

impl InThread<'_, '_, '_> {
    /// Computes what the group shares and then each calculation, until it is stopped.
    fn compute<C: Calculation>(&self, members: &[&C]) {
        let mut begin = Instant::now();
        let mut done = C::cost_of_shared(members);
        let shared = C::share(members, &|part| self.continues(part * done));
        for (&place, calculation) in self.group.places.iter().zip(members) {
            let (cost, stopped) = (calculation.cost(), Cell::new(false));
            let continues = |part: f64| {
                let continues = self.continues(done + part * cost);
                stopped.set(stopped.get() || !continues);
                continues
            };
            if !continues(0.0) {
                return;
            }
            let outcome = calculation.compute(&shared, &continues);
            // a part of a calculation has no outcome
            if stopped.get() {
                return;
            }
            let took = std::mem::replace(&mut begin, Instant::now()).elapsed();
            self.take(place, outcome, took);
            done += cost;
        }
    }

    /// So much of the cost of the group is done: whether it is to continue.
    fn continues(&self, done: f64) -> bool {
        let part = done / self.group.cost.max(f64::MIN_POSITIVE);
        let continues = !self.stop.load(Ordering::Relaxed) && locked(self.reporter).continues(self.number, part);
        if !continues {
            self.stop.store(true, Ordering::Relaxed);
        }
        continues
    }

    fn take<O: Serialize + DeserializeOwned>(&self, place: usize, outcome: Result<O, Error>, took: Duration) {
        match outcome.and_then(|outcome| json(&outcome)) {
            Ok(outcome) => {
                let keep = &mut *locked(self.keep);
                if let Err(error) = keep(place, outcome, took) {
                    self.stop.store(true, Ordering::Relaxed);
                    *locked(self.broken) = Some(error);
                }
            }
            // others have stopped it, and it may have failed for that
            Err(_) if self.stop.load(Ordering::Relaxed) => return,
            Err(error) => locked(self.failures).push((place, error)),
        }
        locked(self.reporter).calculation_done();
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
