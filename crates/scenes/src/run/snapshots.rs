//! The states that a run keeps so that it can be resumed.

use std::collections::VecDeque;

use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{Real, Remainders, VectorState};

/// The state n with its remainders.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot<N> {
    pub(crate) n: i64,
    pub(crate) q: Vec<N>,
    pub(crate) p: Vec<N>,
    pub(crate) remainders: Remainders<N>,
}

impl<N: Real> Snapshot<N> {
    pub(crate) fn of(n: i64, state: &VectorState<N>) -> Self {
        Snapshot { n, q: state.q().to_vec(), p: state.p().to_vec(), remainders: state.remainders() }
    }

    /// Becomes the state n.
    pub(crate) fn update(&mut self, n: i64, state: &VectorState<N>) {
        self.n = n;
        for (own, new) in [(&mut self.q, state.q()), (&mut self.p, state.p())] {
            own.iter_mut().zip(new).for_each(|(own, new)| own.assign(new));
        }
        self.remainders = state.remainders();
    }

    /// Sets the state of the system to this one, to the last bit.
    pub(crate) fn restore(&self, integrator: &mut VectorIntegrator<'_, N>) {
        let state = integrator.system().state_mut();
        state.set(&self.q, &self.p);
        state.set_remainders(&self.remainders);
    }
}

/// The newest states from which modified energies can be computed again: every `reach`-th.
pub(crate) struct Snapshots<N> {
    reach: i64,
    /// The oldest first.
    kept: VecDeque<Snapshot<N>>,
}

impl<N: Real> Snapshots<N> {
    /// The steps are `reach` + 1 states ahead of an estimate n, at most: of the multiples of `reach` up to there, the
    /// last one at or before n − reach is one of the newest four.
    const KEPT: usize = 4;

    /// For estimates that need `reach` states before their own.
    pub(crate) fn new(reach: i64) -> Self {
        Snapshots { reach, kept: VecDeque::new() }
    }

    /// Keeps the state from which the run was resumed.
    pub(crate) fn begin(&mut self, snapshot: Snapshot<N>) {
        self.kept.push_back(snapshot);
    }

    /// Keeps the state n if it is one of those to keep.
    pub(crate) fn offer(&mut self, n: i64, state: &VectorState<N>) {
        if n >= 0 && n % self.reach.max(1) == 0 {
            self.kept.push_back(Snapshot::of(n, state));
            if self.kept.len() > Self::KEPT {
                self.kept.pop_front();
            }
        }
    }

    /// The state from which the estimates after n can be computed: that of n + 1 needs more than `reach` states before.
    pub(crate) fn for_those_after(&self, n: i64) -> Option<&Snapshot<N>> {
        self.kept.iter().rev().find(|earlier| earlier.n + self.reach <= n)
    }
}
