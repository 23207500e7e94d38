//! What tasks are, and how their computation is followed.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

/// Something to compute, identified by its JSON: tasks with equal JSON are computed once.
///
/// Tasks of different types may share a store only if their JSON differs, as that of an `enum` does. Numbers of more than
/// 64 bits must be texts.
pub trait Task: Serialize + Sync + Sized {
    /// Floating-point numbers in it must be finite, because JSON has no others.
    type Outcome: Serialize + DeserializeOwned;

    /// Tasks with the same group are computed together, since they share what is expensive; `None` for one alone.
    fn group(&self) -> Option<String> {
        None
    }

    /// The approximate time that a group takes, in a unit common to all tasks.
    fn cost(group: &[&Self]) -> f64;

    /// Computes a group in one thread, and gives each outcome to the watcher, until the watcher stops it.
    fn compute(group: &[&Self], watcher: &dyn Watcher<Self::Outcome>);
}

/// Follows the computation of a group.
pub trait Watcher<O> {
    /// This part of the cost of the group is done, from 0 to 1. Returns whether the computation is to continue.
    fn continues(&self, part: f64) -> bool;

    /// The outcome of the task at this place in the group.
    fn take(&self, place: usize, outcome: Result<O, Error>);
}
