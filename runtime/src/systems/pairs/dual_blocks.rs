//! The sum over all pairs for dual numbers of a few bytes: of each body with a block of others, in one loop that the
//! compiler makes vector operations of.
//!
//! It is added up in the order in which numbers are, of many bodies that of [`Blocks`](super::blocks::Blocks), so that
//! it has the same bits.

use std::hint::black_box;

use super::blocks::sum_of_places;
use super::pair::{BLOCK, PairPotential};
use crate::number::instructions;
use crate::number::{Block, Number};
use shadowstep_schemes::symbolic::Separation;

/// A sum over all pairs of bodies in D dimensions.
pub(super) struct DualBlocks<'a, P, const D: usize> {
    pub(super) pair: &'a P,
    /// At least [`BLOCK`].
    pub(super) bodies: usize,
    /// Else in the order of the plain loop over i < j.
    pub(super) in_order_of_blocks: bool,
}

/// A number for each axis and place in a block.
type OfAxes<N, const D: usize> = [<N as Number>::Block; D];

/// The coordinates of a block of bodies, their gradient before and after forces are added, and the sums of the other
/// body, one for each place. These are variables apart, each of which few places name: so the compiler sees that
/// nothing else refers to them, and makes vector operations of the loop.
type Room<'a, N, const D: usize> = [&'a mut OfAxes<N, D>; 4];

impl<P, const D: usize> DualBlocks<'_, P, D> {
    /// gradient ← U_q; `axes` is the scratch space of blocks, `pair` the scratch space of the pair.
    pub(super) fn sum<N: Number>(&self, (q, gradient): (&[N], &mut [N]), axes: &mut [N], pair: &mut [N])
    where
        P: PairPotential<N>,
    {
        let bodies = self.bodies;
        let (q_axes, g_axes) = axes.split_at_mut(bodies * D);
        for (c, x) in q.iter().enumerate() {
            N::Block::write_one(q_axes, c % D * bodies + c / D, x);
        }
        g_axes.iter_mut().for_each(N::assign_zero);
        instructions::widest(
            #[inline(always)]
            || self.add_blocks(bodies, q_axes, g_axes, pair),
        );
        for (c, x) in gradient.iter_mut().enumerate() {
            x.assign(&N::Block::one_of_columns(g_axes, c % D * bodies + c / D));
        }
    }

    #[inline(always)]
    fn add_blocks<N: Number>(&self, bodies: usize, q: &[N], gradient: &mut [N], pair: &mut [N])
    where
        P: PairPotential<N>,
    {
        let zeros = N::Block::filled(&N::zero(&q[0].context()));
        let of_axes = || -> OfAxes<N, D> { std::array::from_fn(|_| zeros.clone()) };
        let (mut q_j, mut before, mut after, mut own) = (of_axes(), of_axes(), of_axes(), of_axes());
        let last = bodies - BLOCK;
        let one_by_one = |i: usize| i >= last || !self.in_order_of_blocks;
        for i in 0..bodies {
            for own in &mut own {
                own.clone_from(&zeros);
            }
            let q_i: [N; D] = std::array::from_fn(|axis| N::Block::one_of_columns(q, axis * bodies + i));
            let mut j = i + 1;
            while j < bodies {
                // the last bodies are in a block with some that had their turn
                let first = j.min(last);
                for axis in 0..D {
                    q_j[axis].read(q, axis * bodies + first);
                    before[axis].read(gradient, axis * bodies + first);
                }
                self.add_block((i, first), j - first, &q_i, [&mut q_j, &mut before, &mut after, &mut own], pair);
                for (axis, after) in after.iter().enumerate() {
                    after.write(gradient, axis * bodies + first);
                }
                if one_by_one(i) {
                    for (axis, own) in own.iter_mut().enumerate() {
                        let mut sum = N::Block::one_of_columns(gradient, axis * bodies + i);
                        let forces = black_box(own.clone());
                        (j - first..BLOCK).for_each(|l| sum.add(&forces.at(l)));
                        N::Block::write_one(gradient, axis * bodies + i, &sum);
                        own.clone_from(&zeros);
                    }
                }
                j = first + BLOCK;
            }
            if one_by_one(i) {
                continue;
            }
            for axis in 0..D {
                let mut sum = N::Block::one_of_columns(gradient, axis * bodies + i);
                let own = black_box(own[axis].clone());
                sum.add(sum_of_places(&mut std::array::from_fn(|l| own.at(l))));
                N::Block::write_one(gradient, axis * bodies + i, &sum);
            }
        }
    }

    /// Adds the forces of the body i at q_i with a block of bodies from `first` on, without some that had their turn.
    #[inline(always)]
    fn add_block<N: Number>(
        &self,
        (i, first): (usize, usize),
        done: usize,
        q_i: &[N; D],
        [q_j, before, after, own]: Room<'_, N, D>,
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let separation = self.pair.separation();
        self.pair.each_slope(
            (i, first),
            #[inline(always)]
            |l| {
                let mut difference = q_i.clone();
                for axis in 0..D {
                    difference[axis].assign_difference(&q_j[axis].at(l), &q_i[axis]);
                }
                let mut x = difference[0].clone();
                if separation == Separation::SquaredDistance {
                    x.assign_square(&difference[0]);
                    for component in &difference[1..] {
                        x.add_product(component, component);
                    }
                }
                (x, difference)
            },
            #[inline(always)]
            |l, mut slope, mut force| {
                if l < done {
                    slope.assign_zero();
                }
                for axis in 0..D {
                    match separation {
                        Separation::Difference => force[axis].assign(&slope),
                        Separation::SquaredDistance => force[axis].multiply(&slope),
                    }
                    let mut sum = before[axis].at(l);
                    sum.add(&force[axis]);
                    after[axis].set(l, &sum);
                    let mut sum = own[axis].at(l);
                    sum.subtract(&force[axis]);
                    own[axis].set(l, &sum);
                }
            },
            pair,
        );
    }
}
