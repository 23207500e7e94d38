//! How a caller watches a run and stops it.

use crate::note::Note;

/// Watches a run. `()` watches nothing and never stops it.
pub trait Observer {
    /// The run has reached the state n.
    fn progress(&mut self, n: i64) {
        let _ = n;
    }

    /// The run has something to say.
    fn note(&mut self, note: &Note) {
        let _ = note;
    }

    /// Whether the run is to stop after its present state; asked once for each state.
    fn stops(&mut self) -> bool {
        false
    }
}

impl Observer for () {}
