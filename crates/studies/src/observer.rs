//! How a caller follows the computation.

use crate::Error;

/// Receives what happens during calculations; `()` ignores it. Calls come from several threads, one at a time.
pub trait Observer: Send {
    /// Some calculations are due, or one of them is done.
    fn progress(&mut self, progress: Progress) {
        let _ = progress;
    }

    /// Whether the computation is to stop. What is complete by then is saved, and the call ends with an error.
    fn stops(&mut self) -> bool {
        false
    }

    /// Something that the user should know of a computation that continues.
    fn note(&mut self, note: &str) {
        let _ = note;
    }

    /// A calculation failed; the others continue, and its values are missing from the results.
    fn failed(&mut self, error: &Error) {
        let _ = error;
    }
}

impl Observer for () {}

/// How many of the calculations that are due are done, and how much of their cost, that of unfinished ones included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The number of calculations that are done.
    pub done: usize,
    /// The number of all calculations.
    pub all: usize,
    /// The part of the estimated cost of all calculations that is done, from 0 to 1.
    pub fraction: f64,
}
