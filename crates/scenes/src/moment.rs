//! A moment of a run from which it can be resumed.

use crate::saved_state::{SavedState, SavedVector};
use crate::saved_summary::SavedSummary;

/// All states up to n were shown.
#[derive(Clone, Debug)]
pub struct Moment {
    pub(crate) n: i64,
    /// Whether this is the last state.
    pub(crate) is_last: bool,
    /// The state to begin with; `None` for the one at t = 0.
    pub(crate) state: Option<SavedState>,
    pub(crate) vectors: Vec<SavedVector>,
    /// What the summary needs of the states so far; `None` of a run without one.
    pub(crate) summary: Option<SavedSummary>,
}
