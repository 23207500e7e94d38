//! A figure of the list.

use crate::results::Results;
use shadowstep_studies::finding::Finding;

/// A figure by its name.
pub(crate) struct Figure {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    /// The figure of the paper, such as `figure 3, left`; empty for an additional one.
    pub(crate) of_paper: &'static str,
    /// Requests the results that it needs, and draws those that are there. It is called again until none is missing, so
    /// that it may request more depending on those.
    pub(crate) draw: fn(&Results) -> Finding,
}
