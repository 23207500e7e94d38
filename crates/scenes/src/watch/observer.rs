//! How a caller watches a run and stops it.

use crate::run::Run;
use crate::run::note::Note;
use crate::texts::error::Error;
use crate::watch::summary::Summary;

/// Watches a run. `()` watches nothing and never stops it.
pub trait Observer {
    /// The run has reached the state n. Between states that it needs one by one it makes many at once, and reports the
    /// last.
    fn progress(&mut self, n: i64) {
        let _ = n;
    }

    /// The run has something to say.
    fn note(&mut self, note: &Note) {
        let _ = note;
    }

    /// Whether a summary is wanted, for which the run computes some energies and modified energies besides its output.
    fn summarises(&self) -> bool {
        false
    }

    /// What a complete run has shown, if [that is wanted](Observer::summarises).
    fn summary(&mut self, summary: &Summary) {
        let _ = summary;
    }

    /// Whether the run is to stop after its present state; asked at each of the first 256 states, then some hundred
    /// times a second.
    fn stops(&mut self) -> bool {
        false
    }
}

impl Observer for () {}

/// Reports progress at the state n of a run into memory.
///
/// # Errors
/// That the observer stops it.
pub(crate) fn report(observer: &mut dyn Observer, run: Run<'_>, n: u64) -> Result<(), Error> {
    observer.progress(i64::try_from(n).unwrap_or(i64::MAX));
    if observer.stops() { Err(interrupted(run, n)) } else { Ok(()) }
}

/// That the observer has stopped a run into memory.
pub(crate) fn interrupted(run: Run<'_>, n: u64) -> Error {
    let message = format!("{}: interrupted at n = {n}", run.name());
    Error::run(message, "run it again, over a shorter time for example")
}

/// Keeps the summary of a run.
#[cfg(test)]
#[derive(Default)]
pub(crate) struct KeptSummary(pub(crate) Option<Summary>);

#[cfg(test)]
impl Observer for KeptSummary {
    fn summarises(&self) -> bool {
        true
    }

    fn summary(&mut self, summary: &Summary) {
        self.0 = Some(summary.clone());
    }
}
