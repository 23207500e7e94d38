//! Sums over pairs of bodies: all pairs i < j in D dimensions, or neighbours in a chain.

mod blocks;
mod chain;
mod cutoff;
mod cutoff_hessian;
mod cutoff_pairs;
#[cfg(test)]
mod cutoff_tests;
mod dual_blocks;
mod ends;
mod error;
mod few;
mod gravity;
mod group;
mod hessian;
mod listed;
mod near;
mod neighbours;
mod one_by_one;
mod pair;
mod particles;
mod scratch;
mod shell;
mod switch;
#[cfg(test)]
mod tests;

pub use cutoff::{Cutoff, CutoffError, MOST_DERIVATIVES, Switch};
pub use cutoff_pairs::CutoffPairs;
pub use error::PairsError;
pub use gravity::Gravity;
#[cfg(feature = "formulas")]
pub(crate) use pair::BLOCKS_AT_ONCE;
pub use pair::{BLOCK, Ends, Pair, PairCurvature, PairPotential};
pub use particles::PairsAndParticles;
pub(crate) use particles::{Field, with_a_particle};
pub use shadowstep_schemes::symbolic::{Separation, Summand};
pub(crate) use shell::Shell;

use std::marker::PhantomData;

use crate::number::Number;
use crate::number::instructions;
use crate::number::partial_sums::add_sum;
use crate::systems::potential::{HessianProduct, Potential};
use blocks::Blocks;
use chain::Chain;
use dual_blocks::DualBlocks;
use ends::{End, each_neighbour, each_pair};
use few::Few;
use listed::Listed;
use scratch::{own_scratch, parts};

/// The potential U = Σ u over pairs of bodies in D dimensions.
///
/// The coordinates of the first body come first, then the second's, and so on.
///
/// ```
/// use shadowstep::{DiagonalMasses, Motion, Rational, systems::pairs::Pairs, potential};
///
/// potential! {
///     /// Newton's gravity.
///     pub struct Gravity { g }
///     pair U(r2; m_i, m_j) = -g * m_i * m_j / sqrt(r2)
/// }
///
/// let gravity = Pairs::<_, 3>::all(2, Gravity { g: 1.0, m: vec![4.0, 2.0] }).unwrap();
/// let masses: Vec<_> = [4, 4, 4, 2, 2, 2].map(|m| Rational::from_integer(m.into())).into();
/// let masses = DiagonalMasses::new(&masses, &()).unwrap();
/// let mut motion = Motion::new(gravity, masses, vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0; 6]).unwrap();
/// assert_eq!(motion.energy(), -8.0 / 3.0);
/// ```
#[derive(Clone, Debug)]
pub struct Pairs<P, const D: usize> {
    pair: P,
    bodies: usize,
    which: Which,
    /// Whether bodies have no properties.
    alike: bool,
}

/// Sums of this number of bodies and more have blocks.
const LEAST_BODIES: usize = 2 * BLOCK;

/// Which sums are compiled for a number type: those behind a condition that is constant and false are not.
struct HasVectors<N>(PhantomData<N>);

impl<N: Number> HasVectors<N> {
    /// Blocks of numbers without derivatives. Dual numbers have [blocks of their own](DualBlocks) for the gradient. For
    /// their energy and β there are none, as tangent maps compute neither.
    const PLAIN: bool = N::IN_VECTORS && !N::HAS_DERIVATIVES;
}

/// The pairs that interact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    All,
    Neighbours(Ends),
}

impl<P: Pair, const D: usize> Pairs<P, D> {
    /// Every body interacts with every other one.
    ///
    /// # Errors
    /// No bodies, no dimensions, properties of more or fewer bodies, a pair's formula in d where D is not 1.
    pub fn all(bodies: usize, pair: P) -> Result<Self, PairsError> {
        Self::checked(bodies, pair, Which::All)
    }

    /// Each body interacts with the next one.
    ///
    /// # Errors
    /// As [`Pairs::all`]; fixed ends where the bodies have properties, as walls have none.
    pub fn neighbours(bodies: usize, pair: P, ends: Ends) -> Result<Self, PairsError> {
        if ends == Ends::Fixed && !pair.properties().is_empty() {
            return Err(PairsError::WallsWithoutProperties);
        }
        Self::checked(bodies, pair, Which::Neighbours(ends))
    }

    fn checked(bodies: usize, pair: P, which: Which) -> Result<Self, PairsError> {
        let formula_in_d = (D > 1).then_some(PairsError::Separation { dimensions: D });
        PairsError::refuse(&pair, [bodies, D, bodies], formula_in_d)?;
        let alike = pair.properties().is_empty();
        Ok(Pairs { pair, bodies, which, alike })
    }

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// The pair's energy.
    pub fn pair(&self) -> &P {
        &self.pair
    }
}

impl<P, const D: usize> Pairs<P, D> {
    /// Whether numbers of a few bytes are summed over blocks: all pairs of many bodies, and chains on a line of many
    /// bodies without properties, so that all springs are alike.
    fn is_in_blocks(&self) -> bool {
        let suits = match self.which {
            Which::All => true,
            Which::Neighbours(_) => D == 1 && self.alike,
        };
        suits && self.bodies >= LEAST_BODIES
    }

    /// Whether sums over pairs are in the order of blocks: several numbers in lanes have the bits of one.
    fn is_in_order_of_blocks<N: Number>(&self) -> bool {
        N::KEEPS_INCREMENTS && self.is_in_blocks()
    }

    /// The place of a pair in its block; `None` for the pairs that are left over. The last bodies are in a block with
    /// some that had their turn, if there are as many after the body i.
    fn place_in_block(&self, i: usize, j: usize) -> Option<usize> {
        let (place, count) = match self.which {
            Which::All => (j - i - 1, self.bodies - i - 1),
            Which::Neighbours(_) if j == i + 1 => (i, self.bodies - 1),
            Which::Neighbours(_) => return None,
        };
        match self.which {
            _ if place < count - count % BLOCK => Some(place % BLOCK),
            Which::All if count >= BLOCK => Some(j + BLOCK - self.bodies),
            _ => None,
        }
    }

    /// Sums over all pairs of many bodies are over blocks, if numbers are in vectors; the gradient of dual numbers also
    /// that of a few.
    fn scratch_of_blocks<N: Number>(&self) -> usize {
        let suit = self.is_in_blocks() || N::HAS_DERIVATIVES && self.bodies >= BLOCK;
        let in_blocks = N::IN_VECTORS && self.which == Which::All && suit;
        if in_blocks { blocks::scratch(self.bodies, D) } else { 0 }
    }

    /// The scratch space of blocks and of the pair, where the sum is over blocks.
    fn room_of_blocks<'a, N: Number>(&self, scratch: &'a mut [N]) -> Option<(&'a mut [N], &'a mut [N])> {
        let size = self.scratch_of_blocks::<N>();
        (size > 0).then(|| {
            let (others, axes) = scratch.split_at_mut(scratch.len() - size);
            (axes, &mut others[own_scratch(D)..])
        })
    }

    /// The sum over all pairs of a few bodies, whose pairs are best evaluated many at once.
    #[inline(always)]
    fn listed(&self) -> Option<Listed<'_, P, D>> {
        let are_few = self.which == Which::All && (listed::LEAST_BODIES..LEAST_BODIES).contains(&self.bodies);
        are_few.then_some(Listed { pair: &self.pair, bodies: self.bodies })
    }

    /// The sum over all pairs of a few bodies that are not listed.
    #[inline(always)]
    fn few(&self) -> Option<Few<'_, P, D>> {
        let are_few = self.which == Which::All && (3..=few::MOST_BODIES).contains(&self.bodies);
        are_few.then_some(Few { pair: &self.pair, bodies: self.bodies })
    }

    /// The ends, where the sum is over blocks of springs.
    fn chain_in_blocks<N: Number>(&self) -> Option<Ends> {
        match self.which {
            Which::Neighbours(ends) if N::IN_VECTORS && self.is_in_blocks() => Some(ends),
            _ => None,
        }
    }

    /// Visits the pairs that interact.
    #[inline(always)]
    fn each<'q, N>(&self, q: &'q [N], visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
        match self.which {
            Which::All => each_pair(q, visit),
            Which::Neighbours(ends) => each_neighbour(q, ends, visit),
        }
    }
}

impl<N: Number, P: PairPotential<N>, const D: usize> Potential<N> for Pairs<P, D> {
    fn dimension(&self) -> usize {
        self.bodies * D
    }

    fn scratch(&self) -> usize {
        own_scratch(D) + self.pair.scratch() + self.scratch_of_blocks::<N>()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.pair.prepare(parts::<N, D>(scratch).pair, context);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        if !(HasVectors::<N>::PLAIN && self.sum_in_vectors::<N, false, true>((q, &mut []), Some(energy), scratch)) {
            self.sum_one_by_one::<N, false, true>((q, &mut []), Some(energy), scratch);
        }
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        if N::IN_VECTORS
            && N::HAS_DERIVATIVES
            && let Some((axes, pair)) = self.room_of_blocks(scratch)
        {
            let (bodies, in_order_of_blocks) = (self.bodies, self.is_in_blocks());
            return DualBlocks::<_, D> { pair: &self.pair, bodies, in_order_of_blocks }.sum((q, gradient), axes, pair);
        }
        if !(N::IN_VECTORS && self.sum_in_vectors::<N, true, false>((q, gradient), None, scratch)) {
            N::in_widest_instructions(
                #[inline(always)]
                || self.sum_one_by_one::<N, true, false>((q, gradient), None, scratch),
            );
        }
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        if !(HasVectors::<N>::PLAIN && self.sum_in_vectors::<N, true, true>((q, gradient), Some(rate), scratch)) {
            instructions::widest_for_energies::<N, _>(
                #[inline(always)]
                || self.sum_one_by_one::<N, true, true>((q, gradient), Some(rate), scratch),
            );
        }
        if self.pair.summand() == Summand::Energy {
            // qᵀU_q − 2U
            rate.multiply_integer(-2);
            instructions::widest_for_energies::<N, _>(
                #[inline(always)]
                || add_sum(rate, [q, gradient], |[q, gradient], rate| rate.add_product(q, gradient)),
            );
        }
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        self.pair.curved().map(|_| self as &dyn HessianProduct<N>)
    }
}

impl<P, const D: usize> Pairs<P, D> {
    /// gradient ← U_q where `FORCES`, and total ← the sum of the summands of pairs where `SUM`, without forces of their
    /// energies, for numbers in vectors whose pairs are evaluated many at once. Whether they are.
    #[inline(always)]
    fn sum_in_vectors<N: Number, const FORCES: bool, const SUM: bool>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        total: Option<&mut N>,
        scratch: &mut [N],
    ) -> bool
    where
        P: PairPotential<N>,
    {
        if P::SEVERAL_BLOCKS
            && let Some(listed) = self.listed()
        {
            listed.sum::<N, FORCES, SUM>((q, gradient), total, &mut scratch[own_scratch(D)..]);
        } else if HasVectors::<N>::PLAIN
            && let Some((axes, pair)) = self.room_of_blocks(scratch)
        {
            let blocks = Blocks::<P, D> { pair: &self.pair, bodies: self.bodies };
            blocks.sum::<N, FORCES, SUM>((q, gradient), total, axes, pair);
        } else if FORCES && let Some(ends) = self.chain_in_blocks::<N>() {
            Chain { pair: &self.pair, ends }.sum::<N, SUM>((q, gradient), total, &mut scratch[own_scratch(D)..]);
        } else if FORCES && let Some(few) = self.few() {
            few.sum::<N, SUM>((q, gradient), total, &mut scratch[own_scratch(D)..]);
        } else {
            return false;
        }
        true
    }
}
