//! The products of a state with what the newest steps added.

use crate::instructions;
use crate::number::Number;

/// Coordinates of long states are added up in so many sums that do not wait for one another, on all machines.
const LANES: usize = 8;
/// So many lags of long states take turns.
const AT_ONCE: usize = 4;

/// What the newest steps added to β, q and p.
#[derive(Clone, Debug)]
pub(super) struct LaggedProducts<N> {
    lags: usize,
    /// The place of the newest step.
    newest: usize,
    /// Of long states a row for each step in turn: δβ, δq and δp. Of short ones a row for each of these numbers: all steps in turn, and once
    /// more, so that the newest ones are together wherever they begin.
    rows: Vec<N>,
    /// Partial sums of long states, side by side: the compiler makes vectors of them.
    sums: [[N; LANES]; AT_ONCE],
}

fn is_short(dimension: usize) -> bool {
    dimension < LANES
}

impl<N: Number> LaggedProducts<N> {
    pub(super) fn new(lags: usize, dimension: usize, context: &N::Context) -> Self {
        let times = if is_short(dimension) { 2 } else { 1 };
        LaggedProducts {
            lags,
            newest: 0,
            rows: vec![N::zero(context); times * lags * (2 * dimension + 1)],
            sums: std::array::from_fn(|_| std::array::from_fn(|_| N::zero(context))),
        }
    }

    /// Takes what a step added, and the state that it led to; q·δp − p·δq + δβ of the newest K = `lags` steps, the oldest first.
    #[inline(always)]
    pub(super) fn of_state<const K: usize>(&mut self, state: [&[N]; 2], added: [&[N]; 2], beta: &N) -> [N; K] {
        self.newest = if self.newest + 1 < K { self.newest + 1 } else { 0 };
        if is_short(state[0].len()) {
            self.of_short_state(state, added, beta)
        } else {
            self.keep_row(added, beta);
            self.of_long_state(state)
        }
    }

    #[inline(always)]
    fn of_short_state<const K: usize>(&mut self, [q, p]: [&[N]; 2], [dq, dp]: [&[N]; 2], beta: &N) -> [N; K] {
        let (dimension, newest) = (q.len(), self.newest);
        let mut products: [N; K] = std::array::from_fn(|_| N::zero(&beta.context()));
        // the newest one not from the rows: the processor would wait until it is written
        let (last, others) = products.split_last_mut().expect("there are lags");
        others.iter_mut().zip(self.of_row::<K>(0)).for_each(|(product, beta)| product.assign(beta));
        last.assign(beta);
        for c in 0..dimension {
            let rows = self.of_row::<K>(1 + c).iter().zip(self.of_row::<K>(1 + dimension + c));
            for (product, (dq, dp)) in others.iter_mut().zip(rows) {
                product.add_product(&q[c], dp);
                product.subtract_product(&p[c], dq);
            }
            last.add_product(&q[c], &dp[c]);
            last.subtract_product(&p[c], &dq[c]);
        }
        let (rows, _) = self.rows.as_chunks_mut::<K>();
        let (rows, _) = rows[..2 * (2 * dimension + 1)].as_chunks_mut::<2>();
        let added = std::iter::once(beta).chain(&dq[..dimension]).chain(&dp[..dimension]);
        for (row, added) in rows.iter_mut().zip(added) {
            row[0][newest].assign(added);
            row[1][newest].assign(added);
        }
        products
    }

    /// The newest steps in a row of short states.
    #[inline(always)]
    fn of_row<const K: usize>(&self, number: usize) -> &[N; K] {
        self.rows[2 * K * number + self.newest + 1..].first_chunk().expect("they are there twice")
    }

    fn keep_row(&mut self, [q, p]: [&[N]; 2], beta: &N) {
        let length = 2 * q.len() + 1;
        let (own_beta, others) = self.rows[self.newest * length..][..length].split_first_mut().expect("δβ is there");
        let (own_q, own_p) = others.split_at_mut(q.len());
        own_beta.assign(beta);
        own_q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        own_p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
    }

    #[inline(never)]
    fn of_long_state<const K: usize>(&mut self, [q, p]: [&[N]; 2]) -> [N; K] {
        let mut products = std::array::from_fn(|_| N::zero(&q[0].context()));
        instructions::widest_if_long(
            N::IN_VECTORS,
            q.len(),
            #[inline(always)]
            || self.add_groups(q, p, &mut products),
        );
        products
    }

    #[inline(always)]
    fn add_groups<const K: usize>(&mut self, q: &[N], p: &[N], products: &mut [N; K]) {
        for (group, products) in products.as_chunks_mut::<AT_ONCE>().0.iter_mut().enumerate() {
            self.add_group(group * AT_ONCE, (q, p), products);
        }
    }

    /// The products with the steps `first`, `first` + 1, … of the newest ones, the oldest being number 0.
    #[inline(always)]
    fn add_group(&mut self, first: usize, (q, p): (&[N], &[N]), products: &mut [N; AT_ONCE]) {
        let (dimension, context) = (q.len(), q[0].context());
        let length = 2 * dimension + 1;
        let rows: [&[N]; AT_ONCE] = std::array::from_fn(|i| {
            let place = self.newest + 1 + first + i;
            let place = if place < self.lags { place } else { place - self.lags };
            &self.rows[place * length..][..length]
        });
        let [dq, dp] = [1, 1 + dimension].map(|begin| rows.map(|row| &row[begin..][..dimension]));
        let mut sums: [[N; LANES]; AT_ONCE] = std::array::from_fn(|_| std::array::from_fn(|_| N::zero(&context)));
        let [dq_lanes, dp_lanes] = [dq, dp].map(|of_rows| of_rows.map(|of_row| of_row.as_chunks::<LANES>().0));
        let (q_lanes, p_lanes) = (q.as_chunks::<LANES>().0, p.as_chunks::<LANES>().0);
        for (c, (q, p)) in q_lanes.iter().zip(p_lanes).enumerate() {
            for i in 0..AT_ONCE {
                let (dq, dp) = (&dq_lanes[i][c], &dp_lanes[i][c]);
                for l in 0..LANES {
                    sums[i][l].add_product(&q[l], &dp[l]);
                    sums[i][l].subtract_product(&p[l], &dq[l]);
                }
            }
        }
        self.sums = sums;
        for i in 0..AT_ONCE {
            let product = &mut products[i];
            product.assign(&rows[i][0]);
            for c in dimension - dimension % LANES..dimension {
                product.add_product(&q[c], &dp[i][c]);
                product.subtract_product(&p[c], &dq[i][c]);
            }
            self.sums[i].iter().for_each(|sum| product.add(sum));
        }
    }
}
