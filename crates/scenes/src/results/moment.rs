//! A moment of a run from which it can be resumed.

use std::time::{Duration, Instant};

use shadowstep::VectorState;

use crate::run::saved_state::{SavedState, SavedVector};
use crate::run::saved_summary::SavedSummary;
use crate::run::snapshots::{Snapshot, Snapshots};
use crate::scene::{CheckpointInterval, SceneNumber};

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

/// Where a state takes longer than this, each has its moment: a program that is asked to end may not wait for the next
/// one.
const LONG: Duration = Duration::from_millis(500);

/// Which moments of a run are kept.
pub(crate) struct Moments<N> {
    interval: Option<CheckpointInterval>,
    /// The states from which estimates can be computed again; `None` where there are none.
    snapshots: Option<Snapshots<N>>,
    last_moment: Instant,
    last_state: Instant,
    /// Whether the last state was kept as that.
    pub(crate) is_kept_at_end: bool,
}

impl<N: SceneNumber> Moments<N> {
    pub(crate) fn new(interval: Option<CheckpointInterval>) -> Self {
        let now = Instant::now();
        Moments { interval, snapshots: None, last_moment: now, last_state: now, is_kept_at_end: false }
    }

    /// There are estimates, which need `reach` states before their own; `first` is the state from which the run is
    /// resumed.
    pub(crate) fn estimate(&mut self, reach: i64, first: Option<Snapshot<N>>) {
        let snapshots = self.snapshots.insert(Snapshots::new(reach));
        first.into_iter().for_each(|first| snapshots.begin(first));
    }

    /// The steps are at the state n.
    pub(crate) fn offer(&mut self, n: i64, state: &VectorState<N>) {
        self.snapshots.iter_mut().for_each(|snapshots| snapshots.offer(n, state));
    }

    /// Whether the moment of the state n is kept.
    pub(crate) fn is_due(&mut self, n: i64, last: i64) -> bool {
        let Some(interval) = self.interval else { return false };
        let now = Instant::now();
        let took = now.duration_since(std::mem::replace(&mut self.last_state, now));
        n == last
            || took >= LONG
            || match interval {
                CheckpointInterval::Steps(every) => n.unsigned_abs().is_multiple_of(every),
                CheckpointInterval::Time(time) => now.duration_since(self.last_moment) >= time,
            }
    }

    /// The moment of the last state is to be kept, and was not: that it is the last one was not known.
    pub(crate) fn lacks_end(&self) -> bool {
        self.interval.is_some() && !self.is_kept_at_end
    }

    /// The state from which a run is resumed after the state n, which `state` gives; with estimates an earlier one, or
    /// the one at t = 0. `None` if it cannot be saved.
    pub(crate) fn begin(&mut self, n: i64, state: impl FnOnce() -> Snapshot<N>) -> Option<Option<SavedState>> {
        self.last_moment = Instant::now();
        let state = match &self.snapshots {
            None => Some(SavedState::of(&state())),
            Some(snapshots) => snapshots.for_those_after(n).map(SavedState::of),
        };
        match state {
            None => Some(None),
            Some(saved) => saved.map(Some),
        }
    }
}
