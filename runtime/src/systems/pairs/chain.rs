//! The sum over the neighbours in a chain on a line, for numbers of a few bytes: blocks of springs at once, in vectors
//! of the processor.
//!
//! A body's gradient is the slope of the spring before it, which is carried on, less the slope of the spring after it:
//! the bits of the plain loop.

use std::slice::{from_mut, from_ref};

use super::group::{make_forces, separations};
use super::pair::{BLOCK, Ends, PairPotential};
use crate::number::Number;
use crate::number::instructions;

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
    /// gradient ← U_q, and total ← the sum of the summands of pairs where `SUM`.
    #[inline(never)]
    pub(super) fn sum<N: Number, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        total: Option<&mut N>,
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        instructions::widest(
            #[inline(always)]
            || {
                let sum = self.add_springs::<N, SUM>((q, gradient), pair);
                if let Some(total) = total {
                    total.assign(&sum);
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
        if self.ends == Ends::Fixed {
            let [slope] = self.forces::<N, SUM, 1>(0, [q[0].clone()], from_mut(&mut sums.total), pair);
            sums.carried.add(&slope);
        }
        let mut first = 0;
        while first + BLOCK <= last {
            self.block_of_springs::<N, SUM>((q, gradient), first, &zeros, &mut sums, pair);
            first += BLOCK;
        }
        let mut difference = zero.clone();
        for i in first..last {
            difference.assign_difference(&q[i + 1], &q[i]);
            let [slope] = self.forces::<N, SUM, 1>(i, [difference.clone()], from_mut(&mut sums.total), pair);
            gradient[i].assign_difference(&sums.carried, &slope);
            sums.carried.assign_sum(&zero, &slope);
        }
        gradient[last].assign(&sums.carried);
        difference.assign(&q[last]);
        difference.negate();
        if self.ends == Ends::Periodic {
            difference.assign_difference(&q[0], &q[last]);
        }
        if self.ends != Ends::Free {
            let [slope] = self.forces::<N, SUM, 1>(0, [difference], from_mut(&mut sums.total), pair);
            gradient[last].subtract(&slope);
            if self.ends == Ends::Periodic {
                gradient[0].add(&slope);
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
        let mut difference = zeros.clone();
        for l in 0..BLOCK {
            difference[l].assign_difference(&after[l], &before[l]);
        }
        let slope = self.forces::<N, SUM, BLOCK>(first, difference, sums_of_places, pair);
        let own: &mut [N; BLOCK] = gradient[first..].first_chunk_mut().expect("the block is within the bodies");
        for l in 0..BLOCK {
            // 0 − 0 where a slope is −0; in the first place, where nothing is carried that is −0, only for the vectors
            // of the compiler
            own[l].assign_sum(&zeros[0], if l == 0 { carried } else { &slope[l - 1] });
            own[l].subtract(&slope[l]);
        }
        carried.assign_sum(&zeros[0], &slope[BLOCK - 1]);
    }

    /// The forces of springs, of which the first is after the body `first`, from their differences; adds their summands
    /// to sums.
    #[inline(always)]
    fn forces<N: Number, const SUM: bool, const W: usize>(
        &self,
        first: usize,
        difference: [N; W],
        sums: &mut [N],
        pair: &mut [N],
    ) -> [N; W]
    where
        P: PairPotential<N>,
    {
        let separation = self.pair.separation();
        let mut forces = [difference];
        let x = separations(&forces, separation);
        let (mut slope, mut summand) = (x.clone(), x.clone());
        let results = (from_mut(&mut slope), from_mut(&mut summand));
        self.pair.of_blocks::<W, true, SUM>([first, first + 1], from_ref(&x), results.0, results.1, pair);
        if SUM {
            sums.iter_mut().zip(&summand).for_each(|(sum, summand)| sum.add(summand));
        }
        make_forces(&mut forces, &slope, separation);
        let [forces] = forces;
        forces
    }
}
