//! Where the states of a run come from: a scheme, or a recorded trajectory; watched while they are used.

use shadowstep::OwnedIncrements;
use shadowstep::number::AnyLimbs;
use shadowstep::shadow::run::{RunError, States, TrajectoryState};

/// The states of a trajectory, kept for several estimators.
#[derive(Debug)]
pub(crate) struct Recorded {
    /// How many states there are before 0, and after the last one of the run.
    reach: usize,
    states: Vec<RecordedState>,
}

#[derive(Debug)]
struct RecordedState {
    n: i64,
    q: Vec<AnyLimbs>,
    p: Vec<AnyLimbs>,
    increments: OwnedIncrements<AnyLimbs>,
}

impl Recorded {
    /// All states of a trajectory that has `reach` of them before 0, and after the last one of the run.
    pub(crate) fn of(mut states: impl States<Number = AnyLimbs>, reach: usize) -> Result<Self, RunError> {
        let mut all = Vec::new();
        while let Some(TrajectoryState { n, q, p, increments }) = states.advance()? {
            all.push(RecordedState { n, q: q.to_vec(), p: p.to_vec(), increments: increments.to_owned() });
        }
        Ok(Recorded { reach, states: all })
    }

    /// The states again, with fewer before 0 and after the last one of the run.
    pub(crate) fn states(&self, reach: usize) -> Replay<'_> {
        let left_out = self.reach.checked_sub(reach).expect("enough states are recorded");
        Replay { states: self.states[left_out..self.states.len() - left_out].iter() }
    }
}

/// Recorded states in the order of time.
#[derive(Debug)]
pub(crate) struct Replay<'a> {
    states: std::slice::Iter<'a, RecordedState>,
}

impl States for Replay<'_> {
    type Number = AnyLimbs;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, AnyLimbs>>, RunError> {
        let state = self.states.next();
        Ok(state.map(|RecordedState { n, q, p, increments }| TrajectoryState {
            n: *n,
            q,
            p,
            increments: increments.view(),
        }))
    }
}

/// States that end with an error when `continues`, which gets the n of each, is false.
pub(crate) struct Interruptible<T, F> {
    pub(crate) states: T,
    pub(crate) continues: F,
}

impl<T: States, F: FnMut(i64) -> bool> States for Interruptible<T, F> {
    type Number = T::Number;

    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, T::Number>>, RunError> {
        let Some(state) = self.states.advance()? else { return Ok(None) };
        if !(self.continues)(state.n) {
            return Err(RunError::Stopped { step: state.n });
        }
        Ok(Some(state))
    }
}
