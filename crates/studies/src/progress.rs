//! How much of the calculations is done.

use crate::{Error, Observer, Progress};

/// Reports how much of the cost is done, and not only how many calculations: their costs differ widely.
pub(crate) struct Reporter<'o> {
    observer: &'o mut dyn Observer,
    done: usize,
    all: usize,
    /// Of each group: its cost, and the part of it that is done.
    groups: Vec<(f64, f64)>,
    cost: f64,
    stopped: bool,
}

impl<'o> Reporter<'o> {
    /// For groups with these numbers of calculations and costs.
    pub(crate) fn new(observer: &'o mut dyn Observer, groups: impl Iterator<Item = (usize, f64)> + Clone) -> Self {
        let all = groups.clone().map(|(members, _)| members).sum();
        let cost = groups.clone().map(|(_, cost)| cost).sum();
        let groups = groups.map(|(_, cost)| (cost, 0.0)).collect();
        let mut reporter = Reporter { observer, done: 0, all, groups, cost, stopped: false };
        if all > 0 {
            reporter.report();
        }
        reporter
    }

    /// This part of a group is done. Returns whether the computation is to continue.
    pub(crate) fn continues(&mut self, group: usize, part: f64) -> bool {
        self.groups[group].1 = part.clamp(0.0, 1.0);
        self.stopped |= self.observer.stops();
        if !self.stopped {
            self.report();
        }
        !self.stopped
    }

    pub(crate) fn calculation_done(&mut self) {
        self.done += 1;
        self.report();
    }

    pub(crate) fn group_done(&mut self, group: usize) {
        self.groups[group].1 = 1.0;
    }

    fn report(&mut self) {
        let done: f64 = self.groups.iter().map(|(cost, part)| cost * part).sum();
        let fraction = if self.done == self.all { 1.0 } else { done / self.cost.max(f64::MIN_POSITIVE) };
        self.observer.progress(Progress { done: self.done, all: self.all, fraction });
    }

    /// The error of a computation that was stopped.
    pub(crate) fn interrupted(&self) -> Option<Error> {
        let message = format!("interrupted: {} of {} calculations are saved", self.done, self.all);
        self.stopped.then(|| Error::run(message, "the same command computes the others"))
    }
}
