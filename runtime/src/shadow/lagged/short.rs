//! The products of a short state with what the newest steps added: sums over coordinates of vectors of steps.

use super::form::StateProducts;
use crate::number::Number;
use crate::number::instructions;

/// As many as the most lags.
const STEPS: usize = 8;

/// A number of each of the newest steps, at their places in turn: a line of a processor's cache, which vectors of `f64` then do not cross.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Row<N>([N; STEPS]);

/// What the newest steps added.
#[derive(Clone, Debug)]
pub(super) struct ShortRows<N> {
    /// To q and p of each coordinate.
    coordinates: Vec<[Row<N>; 2]>,
    beta: Row<N>,
}

impl<N: Number> ShortRows<N> {
    pub(super) fn new(dimension: usize, context: &N::Context) -> Self {
        let row = || Row(std::array::from_fn(|_| N::zero(context)));
        ShortRows { coordinates: vec![[row(), row()]; dimension], beta: row() }
    }

    /// Takes what a step added, and the state that it led to; its products with K steps.
    #[inline(always)]
    pub(super) fn products<const K: usize>(
        &mut self,
        place: usize,
        [q, p]: [&[N]; 2],
        ([dq, dp], beta): ([&[N]; 2], &N),
    ) -> StateProducts<N, K> {
        instructions::widest_if_long(
            N::IN_VECTORS,
            K * q.len(),
            #[inline(always)]
            || self.products_here(place, [q, p, dq, dp], beta),
        )
    }

    #[inline(always)]
    fn products_here<const K: usize>(
        &mut self,
        place: usize,
        [q, p, dq, dp]: [&[N]; 4],
        beta: &N,
    ) -> StateProducts<N, K> {
        // lengths and a place that the compiler need not check at each coordinate
        let (dimension, place) = (q.len(), place % K);
        let (p, dq, dp) = (&p[..dimension], &dq[..dimension], &dp[..dimension]);
        let rows = &mut self.coordinates[..dimension];
        let mut products: [N; K] = self.beta.0.first_chunk().expect("K steps").clone();
        self.beta.0[place].assign(beta);
        // the newest step by itself: if it came from the rows, the processor would wait until it is written
        let mut newest = beta.clone();
        for c in 0..dimension {
            let [Row(of_q), Row(of_p)] = &mut rows[c];
            for l in 0..K {
                products[l].add_product(&q[c], &of_p[l]);
                products[l].subtract_product(&p[c], &of_q[l]);
            }
            newest.add_product(&q[c], &dp[c]);
            newest.subtract_product(&p[c], &dq[c]);
            of_q[place].assign(&dq[c]);
            of_p[place].assign(&dp[c]);
        }
        StateProducts { by_places: products, newest }
    }
}
