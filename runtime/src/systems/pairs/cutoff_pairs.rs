//! The sum over the pairs of bodies that are closer than a cutoff.

use shadowstep_schemes::symbolic::Summand;

use super::cutoff::Cutoff;
use super::near::{Constants, Near, clear_far_lanes, constants, is_below};
use super::neighbours::Neighbours;
use super::pair::{BLOCK, BLOCKS_AT_ONCE, PairPotential};
use super::switch::{COEFFICIENTS, Polynomial};
use super::{Pair, PairsError};
use crate::Rational;
use crate::number::Number;
use crate::number::instructions;
use crate::number::partial_sums::add_sum;
use crate::systems::potential::{HessianProduct, Potential};

/// The potential U = Σ φ(r²) over the pairs of bodies in D dimensions that are closer than a [`Cutoff`], of r² = |q_j −
/// q_i|², in a box of the nearest images.
///
/// Pairs are found by a list of neighbours, so that the time of an evaluation grows as the number of bodies. What is
/// computed is a function of q to the last bit, whatever was computed before.
///
/// ```
/// use shadowstep::problems::LennardJones;
/// use shadowstep::systems::pairs::{Cutoff, CutoffPairs};
/// use shadowstep::{Motion, Stepper, UnitMasses, exact, tables::shipped};
///
/// // a cubic lattice of 216 atoms, each pushed a little
/// let side = exact("7.2")?;
/// let cutoff = Cutoff::<3>::at(exact("5/2")?)?.switched(exact("2")?, 3)?.in_box([side.clone(), side.clone(), side])?;
/// let fluid = CutoffPairs::new(216, LennardJones { epsilon: 1.0, sigma: 1.0 }, cutoff)?;
/// let q: Vec<f64> = (0..216).flat_map(|i| [i / 36, i / 6 % 6, i % 6].map(|cell| 1.2 * cell as f64)).collect();
/// let p: Vec<f64> = (0..648).map(|c| (7.0 * c as f64).sin()).collect();
/// let mut motion = Motion::new(fluid, UnitMasses, q, p)?;
/// let start = motion.energy();
/// let stepper = Stepper::new(shipped("stormer-verlet").unwrap(), "1/500")?;
/// (0..500).for_each(|_| stepper.step(&mut motion));
/// assert!((motion.energy() - start).abs() < 1e-4 * start.abs());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CutoffPairs<P, const D: usize> {
    pub(super) pair: P,
    pub(super) bodies: usize,
    /// Whether bodies have no properties.
    alike: bool,
    cutoff: Cutoff<D>,
    sides: Option<[f64; D]>,
    pub(super) switch: Option<Polynomial>,
    pub(super) neighbours: Neighbours,
}

impl<P: Pair, const D: usize> CutoffPairs<P, D> {
    /// Bodies that interact up to a cutoff.
    ///
    /// # Errors
    /// No bodies, no dimensions, properties of more or fewer bodies, a pair's formula in d.
    pub fn new(bodies: usize, pair: P, cutoff: Cutoff<D>) -> Result<Self, PairsError> {
        PairsError::refuse(&pair, [bodies, D, bodies], Some(PairsError::Cutoff))?;
        let alike = pair.properties().is_empty();
        let sides = cutoff.sides().map(|sides| sides.each_ref().map(double));
        let neighbours = Neighbours::new(double(cutoff.radius()));
        let switch = cutoff.switch().map(|switch| Polynomial { derivatives: switch.derivatives });
        Ok(CutoffPairs { pair, bodies, alike, cutoff, sides, switch, neighbours })
    }

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.bodies
    }

    /// The list of neighbours as it is, to compare.
    #[cfg(test)]
    pub(super) fn list_of_neighbours(&self) -> &[f64] {
        self.neighbours.listed_at()
    }

    /// Up to where they interact.
    pub fn cutoff(&self) -> &Cutoff<D> {
        &self.cutoff
    }
}

fn double(exact: &Rational) -> f64 {
    f64::from_rational(exact, &())
}

/// What is summed: U_q, and beside it U, or r·∂u/∂r for the virial.
#[derive(Clone, Copy)]
struct Wanted {
    forces: bool,
    energy: bool,
    virial: bool,
}

impl Wanted {
    const FORCES: Wanted = Wanted { forces: true, energy: false, virial: false };
    const ENERGY: Wanted = Wanted { forces: false, energy: true, virial: false };
    const FORCES_AND_ENERGY: Wanted = Wanted { forces: true, energy: true, virial: false };
    const VIRIAL: Wanted = Wanted { forces: false, energy: false, virial: true };
}

/// A body with its gradient and its part of the other sum.
struct Own<N, const D: usize> {
    body: usize,
    gradient: [N; D],
    /// Of energies, or of r·∂u/∂r.
    sum: N,
}

impl<P, const D: usize> CutoffPairs<P, D> {
    /// The reciprocals of the sides of the box.
    pub(super) fn reciprocal_sides(&self) -> Option<[f64; D]> {
        self.sides.map(|sides| sides.map(|side| 1.0 / side))
    }

    /// virial ← −Σ r·∂u/∂r over the pairs, where r is from a body to the nearest image of the other: Clausius' virial,
    /// with which (2T + virial)/(DV) is the pressure in the box. In open space it is −qᵀU_q. It is minus the derivative
    /// by λ, at λ = 1, of U(λq) in a box of λ times the sides. The scratch space is one that
    /// [`prepare`](Potential::prepare) has prepared.
    pub fn virial<N: Number>(&mut self, q: &[N], virial: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        self.neighbours.update::<N, D>(q, self.sides.as_ref());
        virial.assign_zero();
        self.sum_one_by_one(Wanted::VIRIAL, q, &mut [], virial, scratch);
        virial.negate();
    }

    /// Adds U_q to the gradient and U to the sum, as these are wanted. Numbers in vectors have a loop of their own for
    /// each.
    fn sum<N: Number>(&self, wanted: Wanted, q: &[N], gradient: &mut [N], sum: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        match wanted {
            _ if !N::IN_VECTORS => self.sum_one_by_one(wanted, q, gradient, sum, scratch),
            Wanted { forces: true, energy: false, .. } => instructions::widest(
                #[inline(always)]
                || self.sum_in_vectors(Wanted::FORCES, q, gradient, sum, scratch),
            ),
            // tangent maps compute no energies
            _ if N::HAS_DERIVATIVES => self.sum_one_by_one(wanted, q, gradient, sum, scratch),
            Wanted { forces: true, .. } => instructions::widest(
                #[inline(always)]
                || self.sum_in_vectors(Wanted::FORCES_AND_ENERGY, q, gradient, sum, scratch),
            ),
            _ => instructions::widest(
                #[inline(always)]
                || self.sum_in_vectors(Wanted::ENERGY, q, gradient, sum, scratch),
            ),
        }
    }

    /// The same without vectors, for long numbers and for what is not computed in each step: compiled once for whatever
    /// is wanted.
    #[inline(never)]
    fn sum_one_by_one<N: Number>(&self, wanted: Wanted, q: &[N], gradient: &mut [N], sum: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        self.sum_in_blocks::<N, 1, 2>(wanted, q, gradient, sum, scratch);
    }

    /// The same in blocks of numbers in vectors.
    #[inline(always)]
    fn sum_in_vectors<N: Number>(&self, wanted: Wanted, q: &[N], gradient: &mut [N], sum: &mut N, scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        self.sum_in_blocks::<N, BLOCK, { BLOCKS_AT_ONCE + 1 }>(wanted, q, gradient, sum, scratch);
    }

    /// The same in blocks of W pairs of a body, added one after the other, so that sums do not depend on blocks.
    #[inline(always)]
    fn sum_in_blocks<N: Number, const W: usize, const B: usize>(
        &self,
        wanted: Wanted,
        q: &[N],
        gradient: &mut [N],
        sum: &mut N,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let (constants, pair) = Constants::<N, D>::split(scratch);
        let reciprocal_sides = self.reciprocal_sides();
        let (q, _) = q.as_chunks::<D>();
        let (gradient, _) = gradient.as_chunks_mut::<D>();
        let zero = N::zero(&constants.squares[0].context());
        let mut near = Near::<N, D, W, B>::new(&zero);
        for body in 0..self.bodies {
            let mut own = Own { body, gradient: std::array::from_fn(|_| zero.clone()), sum: zero.clone() };
            for others in self.neighbours.of(body).chunks(W) {
                near.add(others, &q[body], q, &constants, reciprocal_sides.as_ref());
                if near.count >= Near::<N, D, W, B>::FULL {
                    self.add_blocks(wanted, &near, Near::<N, D, W, B>::FULL, &constants, (gradient, &mut own), pair);
                    near.drop_full();
                }
            }
            if near.count > 0 {
                self.add_blocks(wanted, &near, near.count, &constants, (gradient, &mut own), pair);
                near.count = 0;
            }
            if wanted.forces {
                gradient[body].iter_mut().zip(&own.gradient).for_each(|(gradient, own)| gradient.add(own));
            }
            if wanted.energy || wanted.virial {
                sum.add(&own.sum);
            }
        }
    }

    /// Adds the first pairs that are near.
    #[inline(always)]
    fn add_blocks<N: Number, const W: usize, const B: usize>(
        &self,
        wanted: Wanted,
        near: &Near<N, D, W, B>,
        count: usize,
        constants: &Constants<'_, N, D>,
        (gradient, own): (&mut [[N; D]], &mut Own<N, D>),
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let blocks = count.div_ceil(W);
        let others = near.others.as_flattened();
        let x = &near.squared[..blocks];
        let [_, from, _] = constants.squares;
        let switch = self.switch.filter(|_| x.as_flattened()[..count].iter().any(|x| is_below(from, x)));
        let (mut slopes, mut energies) = (near.squared.clone(), near.squared.clone());
        let (slopes, energies) = (&mut slopes[..blocks], &mut energies[..blocks]);
        let (pairs, results) = ((own.body, others), (&mut *slopes, &mut *energies));
        match (wanted.forces || wanted.virial, wanted.energy || switch.is_some()) {
            (true, false) => self.evaluate::<N, W, true, false>(pairs, x, results, pair),
            (true, true) => self.evaluate::<N, W, true, true>(pairs, x, results, pair),
            (false, _) => self.evaluate::<N, W, false, true>(pairs, x, results, pair),
        }
        if let Some(polynomial) = switch {
            for block in 0..blocks {
                add_switch(polynomial, &x[block], constants, (&mut slopes[block], &mut energies[block]));
            }
        }
        if N::LANES > 1 {
            clear_far_lanes(x.as_flattened(), &constants.squares[0], slopes.as_flattened_mut());
            clear_far_lanes(x.as_flattened(), &constants.squares[0], energies.as_flattened_mut());
        }
        let slopes = slopes.as_flattened_mut();
        if wanted.forces {
            for l in 0..count {
                let other = &mut gradient[others[l] as usize];
                for (axis, other) in other.iter_mut().enumerate() {
                    let mut force = near.difference[axis].as_flattened()[l].clone();
                    force.multiply(&slopes[l]);
                    own.gradient[axis].add(&force);
                    other.subtract(&force);
                }
            }
        }
        if wanted.virial {
            slopes[..count].iter().zip(x.as_flattened()).for_each(|(slope, x)| own.sum.add_product(slope, x));
        }
        if wanted.energy {
            energies.as_flattened()[..count].iter().for_each(|of_pair| own.sum.add(of_pair));
        }
    }

    /// The slopes 2u′(r²) where `FORCES` and the energies u(r²) where `SUM` of a body with others.
    #[inline(always)]
    fn evaluate<N: Number, const W: usize, const FORCES: bool, const SUM: bool>(
        &self,
        (body, others): (usize, &[u32]),
        x: &[[N; W]],
        (slopes, energies): (&mut [[N; W]], &mut [[N; W]]),
        pair: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        if self.alike {
            self.pair.of_blocks::<W, FORCES, SUM>([0, 0], x, slopes, energies, pair);
        } else {
            self.pair.of_places::<W, FORCES, SUM>(|l| [others[l] as usize, body], x, slopes, energies, pair);
        }
        if FORCES && SUM && self.pair.summand() == Summand::Rate {
            // 2r²u′ − 2u
            for block in 0..x.len() {
                let (x, slopes, energies) = (&x[block], &slopes[block], &mut energies[block]);
                for l in 0..W {
                    energies[l].negate();
                    energies[l].add_product(&x[l], &slopes[l]);
                    energies[l].divide_integer(2);
                }
            }
        }
    }
}

/// The slopes and energies of S u in place of those of u.
#[inline(always)]
fn add_switch<N: Number, const D: usize, const W: usize>(
    polynomial: Polynomial,
    x: &[N; W],
    constants: &Constants<'_, N, D>,
    (slopes, energies): (&mut [N; W], &mut [N; W]),
) {
    let [cutoff, _, reciprocal] = constants.squares;
    let (mut t, mut values, mut rises) = (x.clone(), x.clone(), x.clone());
    for l in 0..W {
        t[l].assign_difference(cutoff, &x[l]);
        t[l].multiply(reciprocal);
    }
    polynomial.assign(constants.coefficients, &t, &mut values, &mut rises);
    for l in 0..W {
        // 2 (S u)′ = S 2u′ − 2S′ u/(r_c² − r_s²)
        rises[l].multiply(reciprocal);
        rises[l].multiply_integer(2);
        slopes[l].multiply(&values[l]);
        slopes[l].subtract_product(&rises[l], &energies[l]);
        energies[l].multiply(&values[l]);
    }
}

impl<N: Number, P: PairPotential<N>, const D: usize> Potential<N> for CutoffPairs<P, D> {
    fn dimension(&self) -> usize {
        self.bodies * D
    }

    fn scratch(&self) -> usize {
        constants(D) + self.pair.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        let (own, pair) = scratch.split_at_mut(constants(D));
        let (squares, rest) = own.split_at_mut(3);
        let (coefficients, sides) = rest.split_at_mut(COEFFICIENTS);
        let assign = |places: &mut [N], values: &mut dyn Iterator<Item = Rational>| {
            places.iter_mut().zip(values).for_each(|(place, value)| *place = N::from_rational(&value, context));
        };
        assign(squares, &mut self.cutoff.squares().into_iter());
        if let Some(polynomial) = self.switch {
            assign(coefficients, &mut polynomial.coefficients());
        }
        if let Some(of_box) = self.cutoff.sides() {
            assign(sides, &mut of_box.iter().cloned());
        }
        self.pair.prepare(pair, context);
    }

    fn update(&mut self, q: &[N]) {
        self.neighbours.update::<N, D>(q, self.sides.as_ref());
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        energy.assign_zero();
        self.sum(Wanted::ENERGY, q, &mut [], energy, scratch);
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        gradient.iter_mut().for_each(N::assign_zero);
        let mut none = N::zero(&q[0].context());
        self.sum(Wanted::FORCES, q, gradient, &mut none, scratch);
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        gradient.iter_mut().for_each(N::assign_zero);
        rate.assign_zero();
        self.sum(Wanted::FORCES_AND_ENERGY, q, gradient, rate, scratch);
        // qᵀU_q − 2U of the unwrapped positions, which is not the sum of the pairs' rates, those of the nearest images
        rate.multiply_integer(-2);
        add_sum(rate, [q, gradient], |[q, gradient], rate| rate.add_product(q, gradient));
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        self.pair.curved().map(|_| self as &dyn HessianProduct<N>)
    }
}
