//! The states that a run keeps so that it can be resumed.

use std::collections::VecDeque;

use shadowstep::Number;

/// n, q and p.
pub(crate) type State<'a, N> = (i64, &'a [N], &'a [N]);

/// The newest states from which modified energies can be computed again: every `reach`-th.
pub(crate) struct Snapshots<N> {
    reach: i64,
    /// The oldest first.
    kept: VecDeque<(i64, Vec<N>, Vec<N>)>,
}

impl<N: Number> Snapshots<N> {
    /// The last state at or before n − reach is the newest kept one or the one before it.
    const KEPT: usize = 2;

    /// For estimates that need `reach` states before their own.
    pub(crate) fn new(reach: i64) -> Self {
        Snapshots { reach, kept: VecDeque::new() }
    }

    /// Keeps the state from which the run was resumed.
    pub(crate) fn begin(&mut self, n: i64, q: &[N], p: &[N]) {
        self.kept.push_back((n, q.to_vec(), p.to_vec()));
    }

    /// Keeps this state, if it is one of those to keep.
    pub(crate) fn offer(&mut self, n: i64, q: &[N], p: &[N]) {
        if n % self.reach.max(1) == 0 {
            self.kept.push_back((n, q.to_vec(), p.to_vec()));
            if self.kept.len() > Self::KEPT {
                self.kept.pop_front();
            }
        }
    }

    /// The state from which the estimates after n can be computed: that of n + 1 needs more than `reach` states before.
    pub(crate) fn for_those_after(&self, n: i64) -> Option<State<'_, N>> {
        let (n, q, p) = self.kept.iter().rev().find(|(earlier, ..)| earlier + self.reach <= n)?;
        Some((*n, q, p))
    }
}
