//! The newest states of a trajectory, and the products of the newest one with those before it.

use crate::number::Number;
use crate::number::saved::Fields;
use crate::systems::increments::{Increments, OwnedIncrements};

/// The newest states, as many as an estimator needs.
#[derive(Clone, Debug)]
pub(super) struct Window<N> {
    /// The state n in place n mod size.
    ring: Vec<Stored<N>>,
    pushed: usize,
    /// The increments added up.
    sum: OwnedIncrements<N>,
    /// The pairs that are being summed, in separate places: in `f64` these stay in registers of the processor.
    places: [N; AT_ONCE],
}

/// How many pairs are added up at once: sums that do not wait for one another.
const AT_ONCE: usize = 4;

#[derive(Clone, Debug)]
struct Stored<N> {
    q: Vec<N>,
    p: Vec<N>,
    /// What the step that led here added.
    increments: OwnedIncrements<N>,
}

impl<N: Number> Window<N> {
    pub(super) fn new(states: usize, dimension: usize, context: &N::Context) -> Self {
        let zero = N::zero(context);
        let numbers = || vec![zero.clone(); dimension];
        let sum = OwnedIncrements::zero(dimension, context);
        let stored = Stored { q: numbers(), p: numbers(), increments: sum.clone() };
        Window { ring: vec![stored; states], pushed: 0, sum, places: std::array::from_fn(|_| zero.clone()) }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        for Stored { q, p, increments } in &mut self.ring {
            to.numbers(q);
            to.numbers(p);
            increments.fields(to);
        }
        to.place(&mut self.pushed, usize::MAX);
    }

    /// How many states have come, those included that have gone again.
    pub(super) fn pushed(&self) -> usize {
        self.pushed
    }

    pub(super) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
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

    /// q_i·p − p_i·q + (β − β_i) for the newest state and the i-th before it, i = 1, 2, …: as many as there is room
    /// for, of those that have come. Returns how many.
    ///
    /// The first terms are also q_i·(p − p_i) − p_i·(q − q_i), and are computed so where the differences are known as
    /// sums of increments.
    pub(super) fn pairs(&mut self, pairs: &mut [N]) -> usize {
        let count = self.reach(pairs.len());
        self.sum.assign_zero();
        let (groups, rest) = pairs[..count].as_chunks_mut::<AT_ONCE>();
        for (group, pairs) in groups.iter_mut().enumerate() {
            self.add_pairs(1 + AT_ONCE * group, pairs);
        }
        let first = 1 + AT_ONCE * groups.len();
        for (i, one) in (first..).zip(rest) {
            self.add_pairs(i, std::array::from_mut(one));
        }
        count
    }

    /// How many states before the newest one have a product with it, of at most `most`.
    pub(super) fn reach(&self, most: usize) -> usize {
        let count = (self.pushed - 1).min(self.ring.len() - 1).min(most);
        (0..count).position(|back| self.begins_anew(back)).unwrap_or(count)
    }

    /// q, p and the increment of β of the newest state, of which no other increments are known; `None` where they are.
    pub(super) fn newest_with_beta(&self) -> Option<(&[N], &[N], &N)> {
        let Stored { q, p, increments } = &self.ring[self.place(0)];
        (!increments.view().has_vectors()).then_some((q, p, &increments.beta))
    }

    /// Whether a state has no increments, while the state before it or the newest one has.
    fn begins_anew(&self, back: usize) -> bool {
        let known = |back| self.ring[self.place(back)].increments.view().has_vectors();
        !known(back) && (known(back + 1) || known(0))
    }

    /// The pairs with the states `first`, `first` + 1, … before the newest; the increments after these are in the sum.
    fn add_pairs<const L: usize>(&mut self, first: usize, pairs: &mut [N; L]) {
        let places: [usize; L] = std::array::from_fn(|l| self.place(first + l));
        let after: [usize; L] = std::array::from_fn(|l| self.place(first + l - 1));
        let Window { ring, pushed, sum, places: sums } = self;
        let newest = &ring[(*pushed - 1) % ring.len()];
        let older = places.map(|place| &ring[place]);
        let increments = after.map(|place| &ring[place].increments);
        let (sums, _) = sums.split_first_chunk_mut::<L>().expect("at most as many as there are places");
        let mut sums = sums.each_mut().map(N::register);
        for (own, increments) in sums.iter_mut().zip(increments) {
            // β − β_i is the sum of the increments after i
            sum.beta.add(&increments.beta);
            own.assign(&sum.beta);
        }
        let dimension = newest.q.len();
        let q_of = older.map(|stored| &stored.q[..dimension]);
        let p_of = older.map(|stored| &stored.p[..dimension]);
        if newest.increments.view().has_vectors() {
            let dq_of = increments.map(|increments| &increments.q[..dimension]);
            let dp_of = increments.map(|increments| &increments.p[..dimension]);
            for (c, (q, p)) in sum.q.iter_mut().zip(&mut sum.p).enumerate() {
                for l in 0..L {
                    q.add(&dq_of[l][c]);
                    p.add(&dp_of[l][c]);
                    sums[l].add_product(&q_of[l][c], p);
                    sums[l].subtract_product(&p_of[l][c], q);
                }
            }
        } else {
            for (c, (q, p)) in newest.q.iter().zip(&newest.p).enumerate() {
                for l in 0..L {
                    sums[l].add_product(&q_of[l][c], p);
                    sums[l].subtract_product(&p_of[l][c], q);
                }
            }
        }
        pairs.iter_mut().zip(&sums).for_each(|(pair, own)| pair.assign(own));
    }
}
