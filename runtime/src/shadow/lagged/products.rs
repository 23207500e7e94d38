//! The products of a state with what the newest steps added.

use super::long::LongRows;
use crate::number::Number;

/// What the newest steps added to β, q and p.
#[derive(Clone, Debug)]
pub(super) struct LaggedProducts<N> {
    /// For short states, a row for each number: a ring of all steps that is stored twice, so that the newest ones are contiguous wherever they begin.
    short: Vec<N>,
    /// For long states.
    long: LongRows<N>,
}

/// A state of fewer coordinates is short.
const LONG: usize = 8;

impl<N: Number> LaggedProducts<N> {
    pub(super) fn new(lags: usize, dimension: usize, context: &N::Context) -> Self {
        let (short, long) = if dimension < LONG { (dimension, 0) } else { (0, dimension) };
        LaggedProducts {
            short: vec![N::zero(context); 2 * lags * (2 * short + 1)],
            long: LongRows::new(lags, long, context),
        }
    }

    /// Takes what a step added, and the state that it led to; q·δp − p·δq + δβ of the newest K = `lags` steps, the oldest first. Steps have the places
    /// 0 to K − 1 in turn. Those before the newest `known` steps may be left out.
    #[inline(always)]
    pub(super) fn of_state<const K: usize>(
        &mut self,
        place: usize,
        state: [&[N]; 2],
        (added, beta): ([&[N]; 2], &N),
        known: usize,
    ) -> [N; K] {
        if state[0].len() < LONG {
            self.of_short_state(place, state, added, beta)
        } else {
            self.long.keep(place, added, beta);
            self.long.products(place, state, known)
        }
    }

    #[inline(always)]
    fn of_short_state<const K: usize>(
        &mut self,
        place: usize,
        [q, p]: [&[N]; 2],
        [dq, dp]: [&[N]; 2],
        beta: &N,
    ) -> [N; K] {
        let dimension = q.len();
        let mut products: [N; K] = std::array::from_fn(|_| N::zero(&beta.context()));
        // the newest one not from the rows: the processor would wait until it is written
        let (last, others) = products.split_last_mut().expect("there are lags");
        others.iter_mut().zip(self.of_row::<K>(0, place)).for_each(|(product, beta)| product.assign(beta));
        last.assign(beta);
        for c in 0..dimension {
            let rows = self.of_row::<K>(1 + c, place).iter().zip(self.of_row::<K>(1 + dimension + c, place));
            for (product, (dq, dp)) in others.iter_mut().zip(rows) {
                product.add_product(&q[c], dp);
                product.subtract_product(&p[c], dq);
            }
            last.add_product(&q[c], &dp[c]);
            last.subtract_product(&p[c], &dq[c]);
        }
        let (rows, _) = self.short.as_chunks_mut::<K>();
        let (rows, _) = rows[..2 * (2 * dimension + 1)].as_chunks_mut::<2>();
        let added = std::iter::once(beta).chain(&dq[..dimension]).chain(&dp[..dimension]);
        for (row, added) in rows.iter_mut().zip(added) {
            row[0][place].assign(added);
            row[1][place].assign(added);
        }
        products
    }

    /// The steps in a row of short states, the oldest first, as the newest one is at this place.
    #[inline(always)]
    fn of_row<const K: usize>(&self, number: usize, newest: usize) -> &[N; K] {
        self.short[2 * K * number + newest + 1..].first_chunk().expect("they are there twice")
    }
}
