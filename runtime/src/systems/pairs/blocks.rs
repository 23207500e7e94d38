//! The sum over all pairs for numbers of a few bytes: of each body with a block of others at once, in vectors of the
//! processor.
//!
//! What a body gets from its blocks, and the summands of pairs, are added up in a sum for each place in a block: sums
//! that do not wait for one another, and that are the same whatever the vectors.

use std::hint::black_box;

use super::group::{make_forces, separations};
use super::pair::{BLOCK, BLOCKS_AT_ONCE, PairPotential};
use crate::number::Number;
use crate::number::instructions;
use crate::systems::coordinates::for_each_two;

/// How many numbers of scratch space blocks take: coordinates and gradient by axes.
pub(super) const fn scratch(bodies: usize, dimensions: usize) -> usize {
    2 * bodies * dimensions
}

/// Room for the results of B blocks.
struct Room<N, const D: usize, const B: usize> {
    difference: [[[N; BLOCK]; D]; B],
    squared: [[N; BLOCK]; B],
    slope: [[N; BLOCK]; B],
    summand: [[N; BLOCK]; B],
}

impl<N: Number, const D: usize, const B: usize> Room<N, D, B> {
    #[inline(always)]
    fn new(context: &N::Context) -> Self {
        let block = || std::array::from_fn(|_| N::zero(context));
        let blocks = || std::array::from_fn(|_| block());
        let difference = std::array::from_fn(|_| std::array::from_fn(|_| block()));
        Room { difference, squared: blocks(), slope: blocks(), summand: blocks() }
    }

    /// The forces and summands of the first block with this number of the first bodies become 0.
    #[inline(always)]
    fn clear(&mut self, count: usize) {
        for l in 0..BLOCK {
            if l < count {
                self.difference[0].iter_mut().for_each(|of_axis| of_axis[l].assign_zero());
                self.summand[0][l].assign_zero();
            }
        }
    }
}

/// A body's own gradient: a sum for each axis and place in a block.
pub(super) type Places<N, const D: usize> = [[N; BLOCK]; D];

/// The sum of the sums of places, which is put into the first one.
#[inline(always)]
pub(super) fn sum_of_places<N: Number>(places: &mut [N; BLOCK]) -> &N {
    for half in [BLOCK / 2, BLOCK / 4, BLOCK / 8] {
        for l in 0..half {
            let (sums, others) = places.split_at_mut(half);
            sums[l].add(&others[l]);
        }
    }
    &places[0]
}

/// A sum over all pairs of bodies in D dimensions.
pub(super) struct Blocks<'a, P, const D: usize> {
    pub(super) pair: &'a P,
    /// At least [`BLOCK`].
    pub(super) bodies: usize,
}

impl<P, const D: usize> Blocks<'_, P, D> {
    /// gradient ← U_q where `FORCES`, and total ← the sum of the summands of pairs where `SUM`, without forces of their
    /// energies; `axes` is the scratch space of blocks, `pair` that of the pair.
    #[inline(never)]
    pub(super) fn sum<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        total: Option<&mut N>,
        axes: &mut [N],
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let (q_axes, g_axes) = axes.split_at_mut(self.bodies * D);
        transpose(q, D, q_axes);
        g_axes.iter_mut().for_each(N::assign_zero);
        let mut sum = N::zero(&q[0].context());
        instructions::widest(
            #[inline(always)]
            || {
                if P::SEVERAL_BLOCKS {
                    self.add_blocks::<N, FORCES, SUM, BLOCKS_AT_ONCE>(q_axes, g_axes, &mut sum, pair);
                } else {
                    self.add_blocks::<N, FORCES, SUM, 1>(q_axes, g_axes, &mut sum, pair);
                }
            },
        );
        if FORCES {
            transpose(g_axes, self.bodies, gradient);
        }
        if let Some(total) = total {
            total.assign(&sum);
        }
    }

    /// Adds the pairs, up to B blocks at once.
    #[inline(always)]
    fn add_blocks<N: Number, const FORCES: bool, const SUM: bool, const B: usize>(
        &self,
        q: &[N],
        gradient: &mut [N],
        total: &mut N,
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let (bodies, last) = (self.bodies, self.bodies - BLOCK);
        let mut room = Room::<N, D, B>::new(&q[0].context());
        // made once: calls of `from_fn` are not inlined into other codegen units
        let zeros: Places<N, D> = room.difference[0].clone();
        let mut sums_of_places = room.summand[0].clone();
        let mut q_i: [N; D] = std::array::from_fn(|_| N::zero(&q[0].context()));
        for i in 0..bodies {
            let mut own = zeros.clone();
            for axis in 0..D {
                q_i[axis].assign(&q[axis * bodies + i]);
            }
            let mut j = i + 1;
            while j + BLOCK <= bodies {
                let blocks = if B == 1 { 1 } else { B.min((bodies - j) / BLOCK) };
                self.forces::<N, FORCES, SUM, B>((i, j, blocks), q, &q_i, &mut room, pair);
                for block in 0..blocks {
                    self.add_block::<N, FORCES, SUM, B>((j, block), &room, gradient, (&mut own, &mut sums_of_places));
                    j += BLOCK;
                }
            }
            if j < bodies {
                // the last bodies are in a block with some that had their turn
                self.forces::<N, FORCES, SUM, B>((i, last, 1), q, &q_i, &mut room, pair);
                room.clear(j - last);
                if i < last {
                    self.add_block::<N, FORCES, SUM, B>((last, 0), &room, gradient, (&mut own, &mut sums_of_places));
                } else {
                    self.add_block::<N, FORCES, false, B>((last, 0), &room, gradient, (&mut own, &mut sums_of_places));
                    if SUM {
                        black_box(room.summand[0].clone())[j - last..].iter().for_each(|summand| total.add(summand));
                    }
                }
            }
            if FORCES {
                // the sums in memory: stores side by side are what the compiler makes vectors of, in the loop before
                let mut own = black_box(own);
                for (axis, own) in own.iter_mut().enumerate() {
                    let sum = &mut gradient[axis * bodies + i];
                    if i < last {
                        sum.add(sum_of_places(own));
                    } else {
                        own[i + 1 - last..].iter().for_each(|of_place| sum.add(of_place));
                    }
                }
            }
        }
        sums_of_places.iter().for_each(|of_place| total.add(of_place));
    }

    /// Adds the forces and summands of a block of bodies from j on with a body, whose own sums are `own`.
    #[inline(always)]
    fn add_block<N: Number, const FORCES: bool, const SUM: bool, const B: usize>(
        &self,
        (j, block): (usize, usize),
        room: &Room<N, D, B>,
        gradient: &mut [N],
        (own, sums_of_places): (&mut Places<N, D>, &mut [N; BLOCK]),
    ) {
        if FORCES {
            for (axis, forces) in room.difference[block].iter().enumerate() {
                let of_axis: &mut [N; BLOCK] =
                    gradient[axis * self.bodies + j..].first_chunk_mut().expect("the block is within the bodies");
                // read before anything is written: for all that the compiler knows they are in one place
                let (forces, mut sums, mut own_sums) = (forces.clone(), of_axis.clone(), own[axis].clone());
                for_each_two(&mut sums, &forces, N::add);
                for_each_two(&mut own_sums, &forces, N::subtract);
                *of_axis = sums;
                own[axis] = own_sums;
            }
        }
        if SUM {
            for_each_two(sums_of_places, &room.summand[block], N::add);
        }
    }

    /// The forces of the body i at q_i with a block of bodies from j on, in place of their differences, and their
    /// summands; without forces, their energies.
    #[inline(always)]
    fn forces<N: Number, const FORCES: bool, const SUM: bool, const B: usize>(
        &self,
        (i, j, blocks): (usize, usize, usize),
        q: &[N],
        q_i: &[N; D],
        Room { difference, squared, slope, summand }: &mut Room<N, D, B>,
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let separation = self.pair.separation();
        for number in 0..blocks {
            let mut differences = difference[number].clone();
            for axis in 0..D {
                let q_j = block(q, axis * self.bodies + j + number * BLOCK);
                for l in 0..BLOCK {
                    differences[axis][l].assign_difference(&q_j[l], &q_i[axis]);
                }
            }
            squared[number] = separations(&differences, separation);
            difference[number] = differences;
        }
        let (x, slopes, summands) = (&squared[..blocks], &mut slope[..blocks], &mut summand[..blocks]);
        self.pair.of_blocks::<BLOCK, FORCES, SUM>([i, j], x, slopes, summands, pair);
        if !FORCES {
            return;
        }
        for number in 0..blocks {
            let (mut forces, slopes) = (difference[number].clone(), slope[number].clone());
            make_forces(&mut forces, &slopes, separation);
            difference[number] = forces;
        }
    }
}

#[inline(always)]
fn block<N>(numbers: &[N], first: usize) -> &[N; BLOCK] {
    numbers[first..].first_chunk().expect("the block is within the bodies")
}

/// Rows of this length become columns.
fn transpose<N: Number>(from: &[N], length: usize, to: &mut [N]) {
    let rows = from.len() / length;
    for (r, row) in from.chunks_exact(length).enumerate() {
        for (c, x) in row.iter().enumerate() {
            to[c * rows + r].assign(x);
        }
    }
}
