//! The progress of a run, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar on stderr while a run lasts; nothing if stderr is not a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    shown: bool,
}

impl Progress {
    pub(crate) fn new(wanted: bool, run: String, steps: u64) -> Self {
        let bar = if wanted { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        let style = ProgressStyle::with_template("{prefix}  {wide_bar}  {pos}/{len}  {eta} left");
        bar.set_style(style.expect("the template is well formed"));
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

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
