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
mod hessian;
mod listed;
mod near;
mod neighbours;
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
use blocks::{Blocks, Places, sum_of_places};
use chain::Chain;
use dual_blocks::DualBlocks;
use ends::{End, each_neighbour, each_pair};
use few::Few;
use listed::Listed;
use scratch::{Scratch, own_scratch, parts};

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
        if bodies == 0 || D == 0 {
            return Err(PairsError::Empty);
        }
        if D > 1 && pair.separation() != Separation::SquaredDistance {
            return Err(PairsError::Separation { dimensions: D });
        }
        let properties = pair.properties();
        match properties.iter().find(|count| **count != bodies) {
            Some(values) => Err(PairsError::Property { values: *values, bodies }),
            None => Ok(Pairs { pair, bodies, which, alike: properties.is_empty() }),
        }
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
    /// What u is a function of, from the difference.
    #[inline(always)]
    fn separation<'a, N: Number>(&self, difference: &'a [N::Register<'_>; D], squared: &'a mut N) -> &'a N
    where
        P: PairPotential<N>,
    {
        match self.pair.separation() {
            Separation::Difference => &difference[0],
            Separation::SquaredDistance => {
                let (first, others) = difference.split_first().expect("at least one dimension");
                squared.assign_square(first);
                for other in others {
                    squared.add_product(other, other);
                }
                squared
            }
        }
    }

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

    /// Whether the gradient of dual numbers is summed over blocks: of fewer bodies than other sums.
    fn has_blocks_of_dual<N: Number>(&self) -> bool {
        N::HAS_DERIVATIVES && self.bodies >= BLOCK
    }

    fn scratch_of_blocks<N: Number>(&self) -> usize {
        let suit = self.is_in_blocks() || self.has_blocks_of_dual::<N>();
        let in_blocks = N::IN_VECTORS && self.which == Which::All && suit;
        if in_blocks { blocks::scratch(self.bodies, D) } else { 0 }
    }

    /// The scratch space of blocks and of the pair, where the sum is over blocks.
    fn blocks<'a, N: Number>(&self, scratch: &'a mut [N]) -> Option<(&'a mut [N], &'a mut [N])> {
        let size = self.scratch_of_blocks::<N>();
        (size > 0 && self.is_in_blocks()).then(|| self.room_of_blocks(size, scratch))
    }

    fn room_of_blocks<'a, N: Number>(&self, size: usize, scratch: &'a mut [N]) -> (&'a mut [N], &'a mut [N]) {
        let (others, axes) = scratch.split_at_mut(scratch.len() - size);
        (axes, &mut others[own_scratch(D)..])
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

    fn all_blocks(&self) -> Blocks<'_, P, D> {
        Blocks { pair: &self.pair, bodies: self.bodies }
    }

    /// The ends, where the sum is over blocks of springs.
    fn chain_in_blocks<N: Number>(&self) -> Option<Ends> {
        match self.which {
            Which::Neighbours(ends) if N::IN_VECTORS && self.is_in_blocks() => Some(ends),
            _ => None,
        }
    }

    /// Visits the pairs that interact.
    fn each<'q, N>(&self, q: &'q [N], visit: impl FnMut(End<'q, N, D>, End<'q, N, D>)) {
        match self.which {
            Which::All => each_pair(q, visit),
            Which::Neighbours(ends) => each_neighbour(q, ends, visit),
        }
    }

    /// gradient ← U_q; `slope` computes a pair's.
    #[inline(always)]
    fn sum_gradient<N: Number>(
        &self,
        q: &[N],
        gradient: &mut [N],
        scratch: &mut [N],
        mut slope: impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        gradient.iter_mut().for_each(N::assign_zero);
        let (gradient, _) = gradient.as_chunks_mut::<D>();
        let mut s = parts::<N, D>(scratch);
        // a closure each, so that the loop over all pairs has its own, inlined
        match self.which {
            Which::All if self.is_in_order_of_blocks::<N>() => self.add_by_places(q, gradient, &mut s, &mut slope),
            Which::All => each_pair(q, |i, j| self.add_pair(i, j, gradient, &mut s, &mut slope)),
            Which::Neighbours(ends) => {
                each_neighbour(q, ends, |i, j| self.add_pair(i, j, gradient, &mut s, &mut slope));
            }
        }
    }

    /// Adds what a pair adds to the gradient.
    #[inline(always)]
    fn add_pair<N: Number>(
        &self,
        i: End<'_, N, D>,
        j: End<'_, N, D>,
        gradient: &mut [[N; D]],
        s: &mut Scratch<'_, N, D>,
        slope: &mut impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        self.force(i, j, s, slope);
        if let End::Body(j, _) = j {
            gradient[j].iter_mut().zip(s.difference.iter()).for_each(|(gradient, force)| gradient.add(force));
        }
        if let End::Body(i, _) = i {
            gradient[i].iter_mut().zip(s.difference.iter()).for_each(|(gradient, force)| gradient.subtract(force));
        }
    }

    /// All pairs one after the other, in the order of blocks.
    #[inline(always)]
    fn add_by_places<N: Number>(
        &self,
        q: &[N],
        gradient: &mut [[N; D]],
        s: &mut Scratch<'_, N, D>,
        slope: &mut impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        let context = q[0].context();
        let (q, _) = q.as_chunks::<D>();
        for i in 0..self.bodies {
            let mut own: Places<N, D> = std::array::from_fn(|_| std::array::from_fn(|_| N::zero(&context)));
            for j in i + 1..self.bodies {
                self.force(End::Body(i, &q[i]), End::Body(j, &q[j]), s, slope);
                let place = self.place_in_block(i, j);
                for (axis, force) in s.difference.iter().enumerate() {
                    gradient[j][axis].add(force);
                    place.map_or(&mut gradient[i][axis], |place| &mut own[axis][place]).subtract(force);
                }
            }
            gradient[i].iter_mut().zip(&mut own).for_each(|(gradient, own)| gradient.add(sum_of_places(own)));
        }
    }

    /// The force of a pair, in place of its difference.
    #[inline(always)]
    fn force<N: Number>(
        &self,
        i: End<'_, N, D>,
        j: End<'_, N, D>,
        s: &mut Scratch<'_, N, D>,
        slope: &mut impl FnMut(usize, usize, &N, &mut N, &mut N, &mut [N]),
    ) where
        P: PairPotential<N>,
    {
        End::subtract(i, j, &mut s.difference);
        let x = self.separation(&s.difference, &mut s.squared);
        slope(i.number(), j.number(), x, &mut s.slope, &mut s.result, s.pair);
        for difference in s.difference.iter_mut() {
            match self.pair.separation() {
                Separation::Difference => difference.assign(&s.slope),
                Separation::SquaredDistance => difference.multiply(&s.slope),
            }
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
        if HasVectors::<N>::PLAIN {
            if let Some((axes, pair)) = self.blocks(scratch) {
                return self.all_blocks().energy(q, energy, axes, pair);
            }
            if let Some(listed) = self.listed().filter(|_| P::SEVERAL_BLOCKS) {
                return listed.energy(q, energy, &mut scratch[own_scratch(D)..]);
            }
        }
        energy.assign_zero();
        if self.which != Which::All || !self.is_in_order_of_blocks::<N>() {
            return self.each_energy(q, scratch, |_, _, of_pair| energy.add(of_pair));
        }
        let mut sums_of_places: [N; BLOCK] = std::array::from_fn(|_| energy.clone());
        self.each_energy(q, scratch, |i, j, of_pair| {
            self.place_in_block(i, j).map_or(&mut *energy, |place| &mut sums_of_places[place]).add(of_pair);
        });
        sums_of_places.iter().for_each(|of_place| energy.add(of_place));
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let size = self.scratch_of_blocks::<N>();
        if N::IN_VECTORS && N::HAS_DERIVATIVES && size > 0 && self.has_blocks_of_dual::<N>() {
            let (axes, pair) = self.room_of_blocks(size, scratch);
            let (bodies, in_order_of_blocks) = (self.bodies, self.is_in_blocks());
            return DualBlocks::<_, D> { pair: &self.pair, bodies, in_order_of_blocks }.sum((q, gradient), axes, pair);
        }
        if N::IN_VECTORS && self.sum_in_vectors((q, gradient), None, scratch) {
            return;
        }
        N::in_widest_instructions(
            #[inline(always)]
            || {
                self.sum_gradient(q, gradient, scratch, |i, j, x, slope, _, scratch| {
                    self.pair.slope(i, j, x, slope, scratch)
                })
            },
        );
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        if !(HasVectors::<N>::PLAIN && self.sum_in_vectors((q, gradient), Some(rate), scratch)) {
            instructions::widest_for_energies::<N, _>(
                #[inline(always)]
                || self.sum_one_by_one(q, gradient, rate, scratch),
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
    /// Visits the energies of the pairs that interact.
    fn each_energy<N: Number>(&self, q: &[N], scratch: &mut [N], mut visit: impl FnMut(usize, usize, &N))
    where
        P: PairPotential<N>,
    {
        let mut s = parts::<N, D>(scratch);
        self.each(q, |i, j| {
            End::subtract(i, j, &mut s.difference);
            let x = self.separation(&s.difference, &mut s.squared);
            self.pair.energy(i.number(), j.number(), x, &mut s.result, s.pair);
            visit(i.number(), j.number(), &s.result);
        });
    }

    /// gradient ← U_q, and the sum of the summands of pairs where it is wanted, for numbers in vectors whose pairs are
    /// evaluated many at once. Whether they are.
    #[inline(always)]
    fn sum_in_vectors<N: Number>(
        &self,
        (q, gradient): (&[N], &mut [N]),
        total: Option<&mut N>,
        scratch: &mut [N],
    ) -> bool
    where
        P: PairPotential<N>,
    {
        if HasVectors::<N>::PLAIN
            && let Some((axes, pair)) = self.blocks(scratch)
        {
            self.all_blocks().sum((q, gradient), total, axes, pair);
            return true;
        }
        let pair = &mut scratch[own_scratch(D)..];
        if let Some(ends) = self.chain_in_blocks::<N>() {
            Chain { pair: &self.pair, ends }.sum((q, gradient), total, pair);
        } else if P::SEVERAL_BLOCKS
            && let Some(listed) = self.listed()
        {
            listed.sum(q, gradient, total, pair);
        } else if let Some(few) = self.few() {
            few.sum((q, gradient), total, pair);
        } else {
            return false;
        }
        true
    }

    /// The sum of one pair after the other.
    #[inline(always)]
    fn sum_one_by_one<N: Number>(&self, q: &[N], gradient: &mut [N], total: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        total.assign_zero();
        if !self.is_in_order_of_blocks::<N>() {
            return self.sum_gradient(q, gradient, scratch, |i, j, x, slope, summand, scratch| {
                self.pair.slope_and_summand(i, j, x, slope, summand, scratch);
                total.add(summand);
            });
        }
        let mut sums_of_places: [N; BLOCK] = std::array::from_fn(|_| N::zero(&q[0].context()));
        self.sum_gradient(q, gradient, scratch, |i, j, x, slope, summand, scratch| {
            self.pair.slope_and_summand(i, j, x, slope, summand, scratch);
            self.place_in_block(i, j).map_or(&mut *total, |place| &mut sums_of_places[place]).add(summand);
        });
        sums_of_places.iter().for_each(|of_place| total.add(of_place));
    }
}
