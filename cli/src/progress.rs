//! The progress of a run, on a terminal.

use std::fmt::Write;
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

/// A bar on stderr while a run lasts; nothing if stderr is not a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    shown: bool,
}

/// The first steps of a run, with the states that only the estimator needs, are no measure of the others: no time left is shown
/// before this, and before a hundredth of the run.
const EARLY: Duration = Duration::from_secs(2);

impl Progress {
    pub(crate) fn new(wanted: bool, run: String, steps: u64) -> Self {
        let bar = if wanted { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        let left = |state: &ProgressState, writer: &mut dyn Write| {
            let length = state.len().unwrap_or(0);
            if let Some(left) = time_left(state.elapsed(), state.pos(), length) {
                // the bar draws what it can
                let _ = write!(writer, "{} left", HumanDuration(left));
            }
        };
        let style = ProgressStyle::with_template("{prefix}  {wide_bar}  {pos}/{len}  {left}");
        bar.set_style(style.expect("the template is well formed").with_key("left", left));
        bar.set_prefix(run);
        Progress { shown: !bar.is_hidden(), bar }
    }

    /// The run is at step n; without a bar it costs nothing.
    pub(crate) fn reach(&self, n: i64) {
        if self.shown {
            self.bar.set_position(n.unsigned_abs());
        }
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
