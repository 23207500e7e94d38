//! How far tasks of very different costs are, on a terminal.

use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

/// A bar on stderr, where that is a terminal; its length is the cost of all tasks, and not their number.
pub(super) struct Progress {
    bar: ProgressBar,
    /// How many are done, and of how many.
    tasks: (usize, usize),
    /// Of those done, and of all.
    cost: (f64, f64),
    /// How long all together will take, as it seemed when the last task was done.
    expected: Arc<Mutex<Option<Duration>>>,
}

impl Progress {
    /// The positions of the bar.
    const LENGTH: f64 = 10_000.0;

    pub(super) fn new(tasks: usize, cost: f64) -> Progress {
        let bar = if tasks > 0 { ProgressBar::new(Self::LENGTH as u64) } else { ProgressBar::hidden() };
        let expected = Arc::new(Mutex::new(None));
        let seen = Arc::clone(&expected);
        let left = move |state: &ProgressState, writer: &mut dyn Write| {
            let expected: Option<Duration> = *seen.lock().unwrap_or_else(PoisonError::into_inner);
            let _ = match expected {
                Some(all) => write!(writer, "{} left", HumanDuration(all.saturating_sub(state.elapsed()))),
                None => Ok(()),
            };
        };
        let style = ProgressStyle::with_template("{prefix}  {wide_bar}  {left}");
        bar.set_style(style.expect("the template is well formed").with_key("left", left));
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        let progress = Progress { bar, tasks: (0, tasks), cost: (0.0, cost), expected };
        progress.show();
        progress
    }

    pub(super) fn done(&mut self, cost: f64) {
        self.tasks.0 += 1;
        self.cost.0 += cost;
        *self.expected.lock().unwrap_or_else(PoisonError::into_inner) = in_all(self.bar.elapsed(), self.fraction());
        self.show();
    }

    fn fraction(&self) -> f64 {
        if self.cost.1 > 0.0 { self.cost.0 / self.cost.1 } else { 0.0 }
    }

    fn show(&self) {
        self.bar.set_prefix(format!("{} of {} tasks", self.tasks.0, self.tasks.1));
        self.bar.set_position((self.fraction() * Self::LENGTH) as u64);
    }
}

/// How long all takes where a fraction of the cost took so long; `None` where that says nothing.
fn in_all(elapsed: Duration, fraction: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(elapsed.as_secs_f64() / fraction).ok()
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One task of ten is done, but nine tenths of the cost: a ninth of the time is left.
    #[test]
    fn time_is_told_from_costs_and_not_from_the_number_of_tasks() {
        let mut progress = Progress::new(10, 100.0);
        progress.done(90.0);
        assert_eq!(progress.fraction(), 0.9);
        assert_eq!(in_all(Duration::from_secs(90), 0.9), Some(Duration::from_secs(100)));
        assert_eq!(in_all(Duration::from_secs(90), 0.0), None);
    }
}
