//! What H of more states than those of the windows shows.

use super::thresholds::{PERMANENT_LIMIT, ROUND_OFF_FACTOR};
use super::verdict::{Criterion, Verdict};
use crate::shadow::rules::KINETIC_LIMIT;

/// What H of all states of a run at which it was computed shows, besides that of the [windows](super::Report).
#[derive(Clone, Copy, Debug)]
pub struct WholeRun {
    /// max − min of H; `None` where these states are not those that the monitor follows, as of a processed scheme.
    pub range: Option<f64>,
    /// The largest |H(t) − H(0)|, as a part of the mean kinetic energy.
    pub largest: f64,
    /// The last one.
    pub last: f64,
    /// Whether H is that of transformed time, which is 0 but for round-off.
    pub transformed: bool,
}

impl WholeRun {
    /// Before a run was followed.
    pub(super) const NOTHING: WholeRun =
        WholeRun { range: None, largest: f64::NAN, last: f64::NAN, transformed: false };
}

/// What a verdict on a run is based on.
pub(super) struct OfRun {
    /// The verdict on the windows.
    pub(super) found: Verdict,
    pub(super) run: WholeRun,
    /// max − min of H, where it is more than in the windows.
    pub(super) wider: Option<f64>,
    /// The energy error as a part of the mean kinetic energy.
    pub(super) of_kinetic: f64,
    /// The expected effect of round-off, and the permanent change or 0.
    pub(super) round_off: f64,
    pub(super) permanent: f64,
}

impl OfRun {
    /// Whether the windows show a bounded energy; one with a lost coordinate is bounded in them.
    pub(super) fn is_well(&self) -> bool {
        self.found.is_bounded() || self.found == Verdict::TooLarge(Criterion::Lost)
    }

    /// Whether what is round-off in the windows is little of the error.
    pub(super) fn is_no_round_off(&self) -> bool {
        self.found == Verdict::RoundOff && self.wider.is_some_and(|range| ROUND_OFF_FACTOR * self.round_off < range)
    }

    /// Whether what is a permanent change in the windows is little of the error.
    pub(super) fn hardly_changes(&self) -> bool {
        let changes = matches!(self.found, Verdict::NotConserved | Verdict::TooLarge(Criterion::Moved));
        changes && self.wider.is_some_and(|range| self.permanent < PERMANENT_LIMIT * range)
    }
}

/// Whether a part of the mean kinetic energy is too large.
pub(super) fn is_large(part: f64) -> bool {
    part.is_finite() && part >= KINETIC_LIMIT
}
