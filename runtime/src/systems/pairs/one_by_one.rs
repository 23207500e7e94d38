//! The sum of one pair after the other, for all numbers: in the order in which blocks are added up, where several of
//! these numbers in lanes are to have the bits of one.

use shadowstep_schemes::symbolic::Separation;

use super::blocks::{Places, sum_of_places};
use super::ends::{End, each_neighbour, each_pair};
use super::pair::{BLOCK, PairPotential};
use super::scratch::{Scratch, parts, separated};
use super::{HasVectors, Pairs, Which};
use crate::number::Number;

impl<P, const D: usize> Pairs<P, D> {
    /// gradient ← U_q where `FORCES`, and total ← the sum of the summands of pairs where `SUM`, without forces of their
    /// energies.
    #[inline(always)]
    pub(super) fn sum_one_by_one<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        mut total: Option<&mut N>,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        gradient.iter_mut().for_each(N::assign_zero);
        if let Some(total) = &mut total {
            total.assign_zero();
        }
        let (gradient, _) = gradient.as_chunks_mut::<D>();
        let mut s = parts::<N, D>(scratch);
        // numbers in vectors are in blocks; energies of chains are added up one after the other in all numbers
        if !HasVectors::<N>::PLAIN && self.is_in_order_of_blocks::<N>() && (FORCES || self.which == Which::All) {
            return self.add_by_places::<N, FORCES, SUM>(q, gradient, total, &mut s);
        }
        // a closure each, so that the loop over all pairs has its own, inlined
        match self.which {
            Which::All => each_pair(
                q,
                #[inline(always)]
                |i, j| self.add_pair::<N, FORCES, SUM>((i, j), gradient, total.as_deref_mut(), &mut s),
            ),
            Which::Neighbours(ends) => each_neighbour(
                q,
                ends,
                #[inline(always)]
                |i, j| self.add_pair::<N, FORCES, SUM>((i, j), gradient, total.as_deref_mut(), &mut s),
            ),
        }
    }

    #[inline(always)]
    fn add_pair<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        (i, j): (End<'_, N, D>, End<'_, N, D>),
        gradient: &mut [[N; D]],
        total: Option<&mut N>,
        s: &mut Scratch<'_, N, D>,
    ) where
        P: PairPotential<N>,
    {
        self.evaluate::<N, FORCES, SUM>(i, j, s);
        if let Some(total) = total.filter(|_| SUM) {
            total.add(&s.result);
        }
        if FORCES {
            add_to(j, gradient, &s.difference, N::add);
            add_to(i, gradient, &s.difference, N::subtract);
        }
    }

    /// The pairs, added up by their places in blocks.
    #[inline(always)]
    fn add_by_places<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        q: &[N],
        gradient: &mut [[N; D]],
        mut total: Option<&mut N>,
        s: &mut Scratch<'_, N, D>,
    ) where
        P: PairPotential<N>,
    {
        let zero = N::zero(&q[0].context());
        let zeros = || -> [N; BLOCK] { std::array::from_fn(|_| zero.clone()) };
        let (mut sums_of_places, mut own): (_, Places<N, D>) = (zeros(), std::array::from_fn(|_| zeros()));
        self.each(
            q,
            #[inline(always)]
            |i, j| {
                self.evaluate::<N, FORCES, SUM>(i, j, s);
                let place = self.place_in_block(i.number(), j.number());
                if let Some(total) = total.as_deref_mut().filter(|_| SUM) {
                    place.map_or(total, |place| &mut sums_of_places[place]).add(&s.result);
                }
                if !FORCES {
                    return;
                }
                add_to(j, gradient, &s.difference, N::add);
                let Some(place) = place.filter(|_| self.which == Which::All) else {
                    return add_to(i, gradient, &s.difference, N::subtract);
                };
                own.iter_mut().zip(s.difference.iter()).for_each(|(own, force)| own[place].subtract(force));
                if j.number() == self.bodies - 1 {
                    for (gradient, own) in gradient[i.number()].iter_mut().zip(&mut own) {
                        gradient.add(sum_of_places(own));
                        own.iter_mut().for_each(N::assign_zero);
                    }
                }
            },
        );
        if let Some(total) = total {
            sums_of_places.iter().for_each(|of_place| total.add(of_place));
        }
    }

    /// The force of a pair, in place of its difference, and its summand; without forces, its energy.
    #[inline(always)]
    fn evaluate<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        i: End<'_, N, D>,
        j: End<'_, N, D>,
        Scratch { difference, squared, slope, result, pair }: &mut Scratch<'_, N, D>,
    ) where
        P: PairPotential<N>,
    {
        End::subtract(i, j, difference);
        let separation = self.pair.separation();
        let x = separated::<N, D>(difference, squared, separation);
        self.pair.of_one::<FORCES, SUM>([i.number(), j.number()], x, slope, result, pair);
        if !FORCES {
            return;
        }
        for difference in difference.iter_mut() {
            match separation {
                Separation::Difference => difference.assign(slope),
                Separation::SquaredDistance => difference.multiply(slope),
            }
        }
    }
}

/// Adds the force to the gradient of a body, or subtracts it.
#[inline(always)]
fn add_to<N: Number, const D: usize>(
    end: End<'_, N, D>,
    gradient: &mut [[N; D]],
    force: &[N::Register<'_>; D],
    add: impl Fn(&mut N, &N),
) {
    if let End::Body(number, _) = end {
        gradient[number].iter_mut().zip(force).for_each(|(gradient, force)| add(gradient, force));
    }
}
