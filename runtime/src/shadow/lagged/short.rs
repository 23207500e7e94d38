//! The products of a short state with what the newest steps added: sums over coordinates of vectors of steps.

use crate::number::Number;
use crate::number::instructions;
use crate::number::saved::Fields;

/// As many as the most lags.
const STEPS: usize = 8;

/// A number of each of the newest steps, a ring that is stored twice, so that they are contiguous wherever they begin.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Row<N>([N; 2 * STEPS]);

impl<N: Number> Row<N> {
    /// The steps before the newest, whose place this is, the oldest first; and in place of the newest the one K steps
    /// before it.
    #[inline(always)]
    fn before<const K: usize>(&self, place: usize) -> &[N; K] {
        self.0[place % K + 1..].first_chunk().expect("K of 2 K")
    }

    #[inline(always)]
    fn keep<const K: usize>(&mut self, place: usize, newest: &N) {
        self.0[place % K].assign(newest);
        self.0[place % K + K].assign(newest);
    }
}

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

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        let ShortRows { coordinates, beta } = self;
        coordinates.iter_mut().flatten().chain([beta]).for_each(|Row(row)| to.numbers(row));
    }

    /// Takes what a step added, and the state that it led to; its products with K steps, the oldest first.
    #[inline(always)]
    pub(super) fn products<const K: usize>(
        &mut self,
        place: usize,
        [q, p]: [&[N]; 2],
        ([dq, dp], beta): ([&[N]; 2], &N),
    ) -> [N; K] {
        instructions::widest_if_long(
            N::IN_VECTORS,
            K * q.len(),
            #[inline(always)]
            || self.products_here(place, [q, p, dq, dp], beta),
        )
    }

    #[inline(always)]
    fn products_here<const K: usize>(&mut self, place: usize, [q, p, dq, dp]: [&[N]; 4], beta: &N) -> [N; K] {
        // lengths that the compiler need not check at each coordinate
        let dimension = q.len();
        let (p, dq, dp) = (&p[..dimension], &dq[..dimension], &dp[..dimension]);
        let rows = &mut self.coordinates[..dimension];
        let mut products: [N; K] = self.beta.before(place).clone();
        self.beta.keep::<K>(place, beta);
        // the newest step by itself: if it came from the rows, the processor would wait until it is written
        let mut newest = beta.clone();
        for c in 0..dimension {
            let [of_q, of_p] = &mut rows[c];
            let (steps_of_q, steps_of_p): (&[N; K], &[N; K]) = (of_q.before(place), of_p.before(place));
            for l in 0..K {
                products[l].add_product(&q[c], &steps_of_p[l]);
                products[l].subtract_product(&p[c], &steps_of_q[l]);
            }
            newest.add_product(&q[c], &dp[c]);
            newest.subtract_product(&p[c], &dq[c]);
            of_q.keep::<K>(place, &dq[c]);
            of_p.keep::<K>(place, &dp[c]);
        }
        products[K - 1] = newest;
        products
    }
}
