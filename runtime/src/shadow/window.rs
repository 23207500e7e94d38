//! The newest states of a trajectory, and the products of the newest one with those before it.

use crate::number::Number;

/// The newest states, as many as an estimator needs.
#[derive(Clone, Debug)]
pub(super) struct Window<N> {
    /// The state n in place n mod size.
    ring: Vec<Stored<N>>,
    pushed: usize,
    beta: N,
}

#[derive(Clone, Debug)]
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    /// What the step that led here added to β.
    beta: N,
}

impl<N: Number> Window<N> {
    pub(super) fn new(states: usize, dimension: usize, context: &N::Context) -> Self {
        let zero = N::zero(context);
        let numbers = || vec![zero.clone(); dimension];
        let stored = Stored { q: numbers(), p: numbers(), beta: zero.clone() };
        Window { ring: vec![stored; states], pushed: 0, beta: zero }
    }

    /// How many states have come, those included that have gone again.
    pub(super) fn pushed(&self) -> usize {
        self.pushed
    }

    pub(super) fn push(&mut self, q: &[N], p: &[N], beta: &N) {
        self.pushed += 1;
        let place = self.place(0);
        let stored = &mut self.ring[place];
        stored.q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        stored.p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        stored.beta.assign(beta);
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

    /// q_i·p − p_i·q + (β − β_i) for the newest state and the i-th before it, i = 1, 2, …: what has come of the window.
    /// Returns how many.
    pub(super) fn pairs(&mut self, pairs: &mut [N]) -> usize {
        let count = (self.pushed - 1).min(self.ring.len() - 1);
        self.beta.assign_zero();
        for (i, pair) in (1..=count).zip(pairs) {
            // β − β_i is the sum of the increments after i
            let after = self.place(i - 1);
            self.beta.add(&self.ring[after].beta);
            pair.assign(&self.beta);
            let (older, newest) = (&self.ring[self.place(i)], &self.ring[self.place(0)]);
            for (((q_i, p_i), q), p) in older.q.iter().zip(&older.p).zip(&newest.q).zip(&newest.p) {
                pair.add_product(q_i, p);
                pair.subtract_product(p_i, q);
            }
        }
        count
    }
}
