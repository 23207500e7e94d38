//! Studies on a terminal: how far their calculations are, notes and failures, Ctrl-C; the folder of what is saved.

use std::path::{Path, PathBuf};

use shadowstep_scenes::Temporary;
use shadowstep_studies::files::refuse_foreign;
use shadowstep_studies::{Error, Observer, Progress};
use tempfile::TempDir;

use crate::interrupt::Interrupt;
use crate::progress;
use crate::report::{self, Status};

/// Shows on stderr what happens, and ends on Ctrl-C.
pub(crate) struct Terminal {
    /// While there are calculations.
    bar: Option<progress::Progress>,
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
    fn progress(&mut self, Progress { done, all, fraction }: Progress) {
        self.bar.get_or_insert_with(progress::Progress::of_study).show(done, all, fraction);
        if done == all {
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
