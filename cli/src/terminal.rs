//! Studies on a terminal: how far their calculations are, notes and failures, Ctrl-C; the folder of what is saved.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use shadowstep_scenes::Temporary;
use shadowstep_studies::files::refuse_foreign;
use shadowstep_studies::{Error, Observer, Progress};
use tempfile::TempDir;

use crate::interrupt::Interrupt;
use crate::report::{self, Status};

/// Shows on stderr what happens, and ends on Ctrl-C.
pub(crate) struct Terminal {
    /// While there are calculations.
    bar: Option<Bar>,
    /// The worst that has happened.
    pub(crate) status: Status,
    interrupt: Interrupt,
}

/// The folder of saved outcomes: that of `--out`, or one that is removed at the end of the program, however that comes.
pub(crate) struct Folder {
    path: PathBuf,
    _removed: Option<(Temporary, TempDir)>,
}

impl Folder {
    pub(crate) fn of(out: Option<&Path>) -> Result<Self, Error> {
        if let Some(path) = out {
            return Ok(Folder { path: path.to_owned(), _removed: None });
        }
        let folder = tempfile::tempdir().map_err(|error| {
            Error::usage(format!("no temporary folder can be created: {error}"), "give a folder with --out DIR")
        })?;
        Ok(Folder { path: folder.path().to_owned(), _removed: Some((Temporary::of(folder.path()), folder)) })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
}

/// Makes a study in the folder of `--out`, or in one that is removed afterwards, and shows its progress; returns what
/// it has found, and the worst that has happened. Files of these names that others wrote are refused, unless it is
/// forced.
pub(crate) fn study_in<T>(
    out: Option<&Path>,
    force: bool,
    written: impl Iterator<Item = String>,
    study: impl FnOnce(&Path, &mut Terminal) -> Result<T, Error>,
) -> Result<(T, Status), Error> {
    if let Some(folder) = out.filter(|_| !force) {
        refuse_foreign(folder, written)?;
    }
    let mut terminal = Terminal::listen(out.map_or(NOT_SAVED, |_| SAVED));
    let folder = Folder::of(out)?;
    Ok((study(folder.path(), &mut terminal)?, terminal.status))
}

/// What can be done after an interruption.
pub(crate) const SAVED: &str = "the same command computes what is not saved yet";

/// The same without a folder.
pub(crate) const NOT_SAVED: &str = "begin again; with --out DIR what is computed is saved";

impl Terminal {
    /// After an interruption, `hint` can be done.
    pub(crate) fn listen(hint: &str) -> Self {
        Terminal { bar: None, status: Status::Success, interrupt: Interrupt::listen("the command", hint) }
    }
}

impl Observer for Terminal {
    fn progress(&mut self, progress: Progress) {
        self.bar.get_or_insert_with(Bar::new).show(progress);
        if progress.done == progress.all {
            self.bar = None;
        }
    }

    fn stops(&mut self) -> bool {
        let asked = self.interrupt.asked();
        if asked {
            self.bar = None;
        }
        asked
    }

    fn note(&mut self, note: &str) {
        report::note(note);
    }

    fn failed(&mut self, error: &Error) {
        self.bar = None;
        self.status = self.status.max(report::error(error));
    }
}

/// A bar on stderr, if that is a terminal; its length is the cost of all calculations, not their number.
struct Bar {
    bar: ProgressBar,
    /// The time that all calculations take together, as estimated from what is done.
    expected: Arc<Mutex<Option<Duration>>>,
}

impl Bar {
    /// The positions of the bar.
    const LENGTH: f64 = 10_000.0;

    fn new() -> Bar {
        let bar = ProgressBar::new(Self::LENGTH as u64);
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
        Bar { bar, expected }
    }

    fn show(&self, Progress { done, all, fraction }: Progress) {
        *self.expected.lock().unwrap_or_else(PoisonError::into_inner) = in_all(self.bar.elapsed(), fraction);
        self.bar.set_prefix(format!("{done} of {all} calculations"));
        self.bar.set_position((fraction * Self::LENGTH) as u64);
    }
}

/// The time of all calculations if a fraction of their cost took `elapsed`; `None` while that cannot be estimated: the
/// first calculations may be cheaper or more expensive than those that follow.
fn in_all(elapsed: Duration, fraction: f64) -> Option<Duration> {
    if elapsed < Duration::from_secs(3) || fraction < 0.05 {
        return None;
    }
    Duration::try_from_secs_f64(elapsed.as_secs_f64() / fraction).ok()
}

impl Drop for Bar {
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
        assert_eq!(in_all(Duration::from_secs(90), 0.9), Some(Duration::from_secs(100)));
        assert_eq!(in_all(Duration::from_secs(90), 0.0), None);
    }

    #[test]
    fn no_time_is_estimated_at_the_start() {
        assert_eq!(in_all(Duration::from_secs(2), 0.5), None);
        assert_eq!(in_all(Duration::from_secs(90), 0.01), None);
    }
}
