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

/// What tests do with scenes.
#[cfg(test)]
pub(crate) mod testing {
    use shadowstep::tables::Source;

    use super::{Observer, Summary};
    use crate::Scene;

    /// Keeps the summary of a run.
    #[derive(Default)]
    pub(crate) struct KeptSummary(pub(crate) Option<Summary>);

    impl Observer for KeptSummary {
        fn summarises(&self) -> bool {
            true
        }

        fn summary(&mut self, summary: &Summary) {
            self.0 = Some(summary.clone());
        }
    }

    /// The scene of a text without faults.
    pub(crate) fn read(text: &str) -> Scene {
        let source = Source { path: "test.toml".to_owned(), text: text.to_owned() };
        Scene::read(source).unwrap_or_else(|faults| panic!("{text}: {faults}"))
    }

    /// The rows of a scene as their cells, of which the first one has the names.
    pub(crate) fn rows(scene: &Scene) -> Vec<Vec<String>> {
        let mut rows = Vec::new();
        scene.run_into(&mut rows, &mut ()).unwrap();
        let text = String::from_utf8(rows).unwrap();
        let rows = text.lines().filter(|line| !line.starts_with('#'));
        rows.map(|line| line.split(',').map(str::to_owned).collect()).collect()
    }

    pub(crate) fn summary(scene: &Scene) -> Summary {
        let mut kept = KeptSummary::default();
        scene.run_into(&mut Vec::new(), &mut kept).unwrap();
        kept.0.unwrap()
    }
}
