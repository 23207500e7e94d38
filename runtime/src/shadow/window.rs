//! The newest states of a trajectory, and the products of the newest one with those before it.

use crate::motion::Increments;
use crate::number::Number;

/// The newest states, as many as an estimator needs.
#[derive(Clone, Debug)]
pub(super) struct Window<N> {
    /// The state n in place n mod size.
    ring: Vec<Stored<N>>,
    pushed: usize,
    /// The increments added up.
    sum: Increments<N>,
}

#[derive(Clone, Debug)]
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    /// What the step that led here added.
    increments: Increments<N>,
}

impl<N: Number> Window<N> {
    pub(super) fn new(states: usize, dimension: usize, context: &N::Context) -> Self {
        let zero = N::zero(context);
        let numbers = || vec![zero.clone(); dimension];
        let sum = Increments::zero(dimension, context);
        let stored = Stored { q: numbers(), p: numbers(), increments: sum.clone() };
        Window { ring: vec![stored; states], pushed: 0, sum }
    }

    /// How many states have come, those included that have gone again.
    pub(super) fn pushed(&self) -> usize {
        self.pushed
    }

    pub(super) fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) {
        self.pushed += 1;
        let place = self.place(0);
        let stored = &mut self.ring[place];
        stored.q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        stored.p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        stored.increments.assign(increments);
    }

    /// The place of the state `back` places before the newest.
    pub(super) fn place(&self, back: usize) -> usize {
        (self.pushed - 1 - back) % self.ring.len()
    }

    /// Positions and momenta of the state `back` places before the newest.
    pub(super) fn state(&self, back: usize) -> (&[N], &[N]) {
        let stored = &self.ring[self.place(back)];
        (&stored.q, &stored.p)
    }

    /// q_i·p − p_i·q + (β − β_i) for the newest state and the i-th before it, i = 1, 2, …: as many as there is room for, of those
    /// that have come. Returns how many.
    ///
    /// The first terms are also q_i·(p − p_i) − p_i·(q − q_i), and are computed so where the differences are known as sums
    /// of increments.
    pub(super) fn pairs(&mut self, pairs: &mut [N]) -> usize {
        let count = (self.pushed - 1).min(self.ring.len() - 1).min(pairs.len());
        self.sum.assign_zero();
        let newest = &self.ring[self.place(0)];
        for (i, pair) in (1..=count).zip(pairs) {
            // β − β_i is the sum of the increments after i
            self.sum.add(&self.ring[self.place(i - 1)].increments);
            pair.assign(&self.sum.beta);
            let (q, p) =
                if newest.increments.has_vectors() { (&self.sum.q, &self.sum.p) } else { (&newest.q, &newest.p) };
            let older = &self.ring[self.place(i)];
            for (((q_i, p_i), q), p) in older.q.iter().zip(&older.p).zip(q).zip(p) {
                pair.add_product(q_i, p);
                pair.subtract_product(p_i, q);
            }
        }
        count
    }
}
