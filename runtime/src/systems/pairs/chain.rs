//! The sum over the neighbours in a chain on a line, for numbers of a few bytes: blocks of springs at once, in vectors
//! of the processor.
//!
//! A body's gradient is the slope of the spring before it, which is carried on, less the slope of the spring after it:
//! the bits of the plain loop.

use std::slice::{from_mut, from_ref};

use super::pair::{BLOCK, Ends, PairPotential};
use crate::number::Number;
use crate::number::instructions;
use shadowstep_schemes::symbolic::Separation;

/// The chain's sums; the sum of the summands of pairs is split by places in a block.
struct Sums<N> {
    /// What the springs before a body add to its gradient.
    carried: N,
    sums_of_places: [N; BLOCK],
    total: N,
}

/// A sum over the neighbours in a chain.
pub(super) struct Chain<'a, P> {
    pub(super) pair: &'a P,
    pub(super) ends: Ends,
}

impl<P> Chain<'_, P> {
    /// gradient ← U_q, and the sum of the summands of pairs where it is wanted.
    pub(super) fn sum<N: Number>(&self, (q, gradient): (&[N], &mut [N]), total: Option<&mut N>, pair: &mut [N])
    where
        P: PairPotential<N>,
    {
        instructions::widest(
            #[inline(always)]
            || match total {
                Some(total) => {
                    let sum = self.add_springs::<N, true>((q, gradient), pair);
                    total.assign(&sum);
                }
                None => {
                    self.add_springs::<N, false>((q, gradient), pair);
                }
            },
        );
    }

    #[inline(always)]
    fn add_springs<N: Number, const SUM: bool>(&self, (q, gradient): (&[N], &mut [N]), pair: &mut [N]) -> N
    where
        P: PairPotential<N>,
    {
        let zero = N::zero(&q[0].context());
        // made once: calls of `from_fn` are not inlined into other codegen units
        let zeros: [N; BLOCK] = std::array::from_fn(|_| zero.clone());
        let mut sums = Sums { carried: zero.clone(), sums_of_places: zeros.clone(), total: zero.clone() };
        let last = q.len() - 1;
        let mut slope = zero.clone();
        if self.ends == Ends::Fixed {
            slope.assign(&q[0]);
            self.spring::<N, SUM>(&mut slope, &mut sums.total, pair);
            sums.carried.add(&slope);
        }
        let mut first = 0;
        while first + BLOCK <= last {
            self.block_of_springs::<N, SUM>((q, gradient), first, &zeros, &mut sums, pair);
            first += BLOCK;
        }
        for i in first..last {
            slope.assign_difference(&q[i + 1], &q[i]);
            self.spring::<N, SUM>(&mut slope, &mut sums.total, pair);
            gradient[i].assign_difference(&sums.carried, &slope);
            sums.carried.assign_sum(&zero, &slope);
        }
        gradient[last].assign(&sums.carried);
        match self.ends {
            Ends::Free => {}
            Ends::Fixed => {
                slope.assign(&q[last]);
                slope.negate();
                self.spring::<N, SUM>(&mut slope, &mut sums.total, pair);
                gradient[last].subtract(&slope);
            }
            Ends::Periodic => {
                slope.assign_difference(&q[0], &q[last]);
                self.spring::<N, SUM>(&mut slope, &mut sums.total, pair);
                gradient[0].add(&slope);
                gradient[last].subtract(&slope);
            }
        }
        sums.sums_of_places.iter().for_each(|of_place| sums.total.add(of_place));
        sums.total
    }

    /// A block of springs, of which the first is after the body `first`.
    #[inline(always)]
    fn block_of_springs<N: Number, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        first: usize,
        zeros: &[N; BLOCK],
        Sums { carried, sums_of_places, .. }: &mut Sums<N>,
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let before: &[N; BLOCK] = q[first..].first_chunk().expect("the block is within the bodies");
        let after: &[N; BLOCK] = q[first + 1..].first_chunk().expect("the block is within the bodies");
        let [mut difference, mut squared, mut slope, mut summand] =
            [zeros.clone(), zeros.clone(), zeros.clone(), zeros.clone()];
        for l in 0..BLOCK {
            difference[l].assign_difference(&after[l], &before[l]);
        }
        let x = match self.pair.separation() {
            Separation::Difference => &difference,
            Separation::SquaredDistance => {
                for l in 0..BLOCK {
                    squared[l].assign_square(&difference[l]);
                }
                &squared
            }
        };
        if SUM {
            let (slopes, summands) = (from_mut(&mut slope), from_mut(&mut summand));
            self.pair.slopes_and_summands(first, first + 1, from_ref(x), slopes, summands, pair);
            for l in 0..BLOCK {
                sums_of_places[l].add(&summand[l]);
            }
        } else {
            self.pair.slopes(first, first + 1, from_ref(x), from_mut(&mut slope), pair);
        }
        if self.pair.separation() == Separation::SquaredDistance {
            for l in 0..BLOCK {
                slope[l].multiply(&difference[l]);
            }
        }
        let own: &mut [N; BLOCK] = gradient[first..].first_chunk_mut().expect("the block is within the bodies");
        for l in 0..BLOCK {
            // 0 − 0 where a slope is −0; in the first place, where nothing is carried that is −0, only for the vectors
            // of the compiler
            own[l].assign_sum(&zeros[0], if l == 0 { carried } else { &slope[l - 1] });
            own[l].subtract(&slope[l]);
        }
        carried.assign_sum(&zeros[0], &slope[BLOCK - 1]);
    }

    /// difference ← the force of a spring, which was its difference; adds its summand.
    #[inline(always)]
    fn spring<N: Number, const SUM: bool>(&self, difference: &mut N, total: &mut N, pair: &mut [N])
    where
        P: PairPotential<N>,
    {
        let zero = N::zero(&difference.context());
        let (mut x, mut slope, mut summand) = (zero.clone(), zero.clone(), zero);
        match self.pair.separation() {
            Separation::Difference => x.assign(difference),
            Separation::SquaredDistance => x.assign_square(difference),
        }
        if SUM {
            self.pair.slope_and_summand(0, 1, &x, &mut slope, &mut summand, pair);
            total.add(&summand);
        } else {
            self.pair.slope(0, 1, &x, &mut slope, pair);
        }
        match self.pair.separation() {
            Separation::Difference => difference.assign(&slope),
            Separation::SquaredDistance => difference.multiply(&slope),
        }
    }
}
