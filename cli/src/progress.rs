//! How far a run is, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar on stderr while a run lasts; nothing where stderr is no terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub(crate) fn new(wanted: bool, run: String, steps: u64) -> Self {
        let bar = if wanted { ProgressBar::new(steps) } else { ProgressBar::hidden() };
        let style = ProgressStyle::with_template("{prefix}  {wide_bar}  {pos}/{len}  {eta} left");
        bar.set_style(style.expect("the template is well formed"));
        bar.set_prefix(run);
        Progress { bar }
    }

    /// What is called at each step; without a bar it costs nothing.
    pub(crate) fn listener(&self) -> impl Fn(i64) + '_ {
        let shown = !self.bar.is_hidden();
        move |n| {
            if shown {
                self.bar.set_position(n.unsigned_abs());
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
