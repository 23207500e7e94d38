//! How far a run or a study is, on a terminal.

use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

/// A bar on stderr while a run lasts; nothing if stderr is not a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    shown: bool,
    early: Early,
    /// When the first state of a run was reached: the states that only the estimator needs come before.
    begin: Option<Instant>,
    /// When all is done, as far as it is known.
    end: Arc<Mutex<Option<Instant>>>,
}

/// No time left is shown before this time and this part of all: what comes first is no measure of the others.
type Early = (Duration, f64);

const EARLY_IN_RUN: Early = (Duration::from_secs(2), 0.01);

/// The first calculations may be cheaper or more expensive than those that follow.
const EARLY_IN_STUDY: Early = (Duration::from_secs(3), 0.05);

/// The length of the bar of a study, which is the cost of all calculations, not their number.
const LENGTH: f64 = 10_000.0;

impl Progress {
    pub(crate) fn of_run(is_shown: bool, run: String, steps: u64) -> Self {
        let bar = if is_shown { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        bar.set_prefix(run);
        Progress::new(bar, "{prefix}  {wide_bar}  {pos}/{len}  {left}", EARLY_IN_RUN)
    }

    pub(crate) fn of_study() -> Self {
        let mut progress =
            Progress::new(ProgressBar::new(LENGTH as u64), "{prefix}  {wide_bar}  {left}", EARLY_IN_STUDY);
        if progress.shown {
            progress.bar.enable_steady_tick(Duration::from_secs(1));
        }
        progress.begin = Some(Instant::now());
        progress
    }

    fn new(bar: ProgressBar, template: &str, early: Early) -> Self {
        let end: Arc<Mutex<Option<Instant>>> = Arc::default();
        let seen = Arc::clone(&end);
        let left = move |_: &ProgressState, writer: &mut dyn Write| {
            if let Some(end) = *seen.lock().unwrap_or_else(PoisonError::into_inner) {
                // the bar draws what it can
                let _ = write!(writer, "{} left", HumanDuration(end.saturating_duration_since(Instant::now())));
            }
        };
        let style = ProgressStyle::with_template(template).expect("the template is well formed");
        bar.set_style(style.with_key("left", left));
        Progress { shown: !bar.is_hidden(), bar, early, begin: None, end }
    }

    /// The run is at step n; without a bar it costs nothing.
    pub(crate) fn reach(&mut self, n: i64) {
        if self.shown {
            let begin = *self.begin.get_or_insert_with(Instant::now);
            let part = n.unsigned_abs() as f64 / self.bar.length().unwrap_or(0) as f64;
            self.expect(in_all(begin.elapsed(), part, self.early).map(|all| begin + all));
            self.bar.set_position(n.unsigned_abs());
        }
    }

    /// Calculations of a study are done, which cost this part of all.
    pub(crate) fn show(&mut self, done: usize, all: usize, part: f64) {
        self.bar.set_prefix(format!("{done} of {all} calculations"));
        self.reach((part * LENGTH) as i64);
    }

    /// Another run as long as this one begins.
    pub(crate) fn restart(&mut self, run: String) {
        self.begin = None;
        self.expect(None);
        self.bar.set_position(0);
        self.bar.set_prefix(run);
    }

    /// Takes the bar away while something else is written.
    pub(crate) fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }

    fn expect(&self, end: Option<Instant>) {
        *self.end.lock().unwrap_or_else(PoisonError::into_inner) = end;
    }
}

/// The time of all if this part of it took `elapsed`; `None` while that is not known yet.
fn in_all(elapsed: Duration, part: f64, early: Early) -> Option<Duration> {
    if elapsed < early.0 || part < early.1 {
        return None;
    }
    Duration::try_from_secs_f64(elapsed.as_secs_f64() / part).ok()
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nine tenths of the cost are done, however many calculations that is: a ninth of the time is left.
    #[test]
    fn time_is_estimated_from_costs() {
        let seconds = Duration::from_secs;
        assert_eq!(in_all(seconds(90), 0.9, EARLY_IN_STUDY), Some(seconds(100)));
        assert_eq!(in_all(seconds(10), 0.25, EARLY_IN_RUN), Some(seconds(40)));
    }

    #[test]
    fn no_time_is_shown_before_it_means_something() {
        let seconds = Duration::from_secs;
        for (elapsed, part, early) in [
            (seconds(1), 0.5, EARLY_IN_RUN),
            (seconds(10), 0.005, EARLY_IN_RUN),
            (seconds(2), 0.5, EARLY_IN_STUDY),
            (seconds(90), 0.01, EARLY_IN_STUDY),
            (seconds(90), 0.0, EARLY_IN_STUDY),
        ] {
            assert_eq!(in_all(elapsed, part, early), None, "{elapsed:?} {part}");
        }
    }
}
