//! The progress of a run, on a terminal.

use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

/// A bar on stderr while a run lasts; nothing if stderr is not a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    shown: bool,
    /// When the first state was reached: the states that only the estimator needs come before.
    begin: Arc<Mutex<Option<Instant>>>,
}

/// The first steps of a run are no measure of the others: no time left is shown before this, and before a hundredth of
/// the run.
const EARLY: Duration = Duration::from_secs(2);

impl Progress {
    pub(crate) fn new(wanted: bool, run: String, steps: u64) -> Self {
        let bar = if wanted { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        let begin: Arc<Mutex<Option<Instant>>> = Arc::default();
        let first = Arc::clone(&begin);
        let left = move |state: &ProgressState, writer: &mut dyn Write| {
            let first = *first.lock().unwrap_or_else(PoisonError::into_inner);
            let elapsed = first.map(|first| first.elapsed()).unwrap_or_default();
            if let Some(left) = time_left(elapsed, state.pos(), state.len().unwrap_or(0)) {
                // the bar draws what it can
                let _ = write!(writer, "{} left", HumanDuration(left));
            }
        };
        let style = ProgressStyle::with_template("{prefix}  {wide_bar}  {pos}/{len}  {left}");
        bar.set_style(style.expect("the template is well formed").with_key("left", left));
        bar.set_prefix(run);
        Progress { shown: !bar.is_hidden(), bar, begin }
    }

    /// The run is at step n; without a bar it costs nothing.
    pub(crate) fn reach(&self, n: i64) {
        if self.shown {
            self.begin.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(Instant::now);
            self.bar.set_position(n.unsigned_abs());
        }
    }

    /// Another run as long as this one begins.
    pub(crate) fn restart(&self, run: String) {
        self.begin.lock().unwrap_or_else(PoisonError::into_inner).take();
        self.bar.set_position(0);
        self.bar.set_prefix(run);
    }

    /// Takes the bar away while something else is written.
    pub(crate) fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }
}

/// How long the rest of a run takes if all steps take as long; `None` where that is not known yet.
fn time_left(elapsed: Duration, done: u64, all: u64) -> Option<Duration> {
    if elapsed < EARLY || done < all / 100 || done == 0 {
        return None;
    }
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * all.saturating_sub(done) as f64 / done as f64).ok()
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_time_is_shown_before_it_means_something() {
        let seconds = Duration::from_secs;
        assert_eq!(time_left(seconds(1), 50, 100), None);
        assert_eq!(time_left(seconds(10), 5, 1000), None);
        assert_eq!(time_left(seconds(10), 250, 1000), Some(seconds(30)));
    }
}
