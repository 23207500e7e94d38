//! Particles of mass 0: the forces of bodies on them, which they do not return.
//!
//! A particle has an acceleration only, the limit of its force divided by its mass, and so has a momentum divided by
//! its mass: both are those of a unit mass.

use std::slice::{from_mut, from_ref};

use super::pair::{BLOCK, PairPotential};
use super::scratch::parts;
use super::{Pairs, PairsError, Which};
use crate::Rational;
use crate::number::{Number, instructions};
use crate::systems::potential::{HessianProduct, Potential};

/// The forces of some bodies on particles. The pair's properties are those of the bodies, and then [`BLOCK`] times
/// those of a particle, of mass 1.
pub(crate) struct Field<'a, P, const D: usize> {
    pub(crate) pair: &'a P,
    /// How many bodies attract.
    pub(crate) bodies: usize,
}

/// Room for the forces on W particles at once.
struct Room<N, const W: usize, const D: usize> {
    place: [[N; W]; D],
    sum: [[N; W]; D],
    difference: [[N; W]; D],
    squared: [N; W],
    slope: [N; W],
    summand: [N; W],
}

impl<N: Number, const W: usize, const D: usize> Room<N, W, D> {
    #[inline(always)]
    fn new(context: &N::Context) -> Self {
        let row = || -> [N; W] { std::array::from_fn(|_| N::zero(context)) };
        let rows = || std::array::from_fn(|_| row());
        Room { place: rows(), sum: rows(), difference: rows(), squared: row(), slope: row(), summand: row() }
    }
}

/// The properties of bodies and a particle, as [`Field`] has them, from those of the bodies.
pub(crate) fn with_a_particle<N: Number>(bodies: impl IntoIterator<Item = N>, context: &N::Context) -> Vec<N> {
    let one = N::from_rational(&Rational::from_integer(1.into()), context);
    bodies.into_iter().chain(std::iter::repeat_n(one, BLOCK)).collect()
}

impl<P, const D: usize> Field<'_, P, D> {
    /// gradient ← minus the acceleration of each particle; `scratch` is the pair's.
    pub(crate) fn assign_gradient<N: Number>(
        &self,
        bodies: &[N],
        particles: &[N],
        gradient: &mut [N],
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let Some(first) = particles.first() else { return };
        let context = first.context();
        let bodies = bodies.as_chunks::<D>().0;
        let (particles, gradient) = (particles.as_chunks::<D>().0, gradient.as_chunks_mut::<D>().0);
        let in_blocks = if N::IN_VECTORS { particles.len() - particles.len() % BLOCK } else { 0 };
        let (blocks, others) = particles.split_at(in_blocks);
        let (of_blocks, of_others) = gradient.split_at_mut(in_blocks);
        if N::IN_VECTORS {
            instructions::widest_if_long(
                true,
                blocks.len(),
                #[inline(always)]
                || {
                    let mut room = Room::<N, BLOCK, D>::new(&context);
                    let blocks = blocks.as_chunks::<BLOCK>().0.iter().zip(of_blocks.as_chunks_mut::<BLOCK>().0);
                    for (block, gradient) in blocks {
                        self.assign_block(bodies, block, gradient, &mut room, scratch);
                    }
                },
            );
        }
        let mut room = Room::<N, 1, D>::new(&context);
        for (one, gradient) in others.as_chunks::<1>().0.iter().zip(of_others.as_chunks_mut::<1>().0) {
            self.assign_block(bodies, one, gradient, &mut room, scratch);
        }
    }

    #[inline(always)]
    fn assign_block<N: Number, const W: usize>(
        &self,
        bodies: &[[N; D]],
        particles: &[[N; D]; W],
        gradient: &mut [[N; D]; W],
        Room { place, sum, difference, squared, slope, summand }: &mut Room<N, W, D>,
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        for axis in 0..D {
            for l in 0..W {
                place[axis][l].assign(&particles[l][axis]);
                sum[axis][l].assign_zero();
            }
        }
        for (i, body) in bodies.iter().enumerate() {
            squared.iter_mut().for_each(N::assign_zero);
            for axis in 0..D {
                for l in 0..W {
                    difference[axis][l].assign_difference(&place[axis][l], &body[axis]);
                    squared[l].add_product(&difference[axis][l], &difference[axis][l]);
                }
            }
            let results = (from_mut(slope), from_mut(summand));
            self.pair.of_blocks::<W, true, false>([i, self.bodies], from_ref(squared), results.0, results.1, scratch);
            for axis in 0..D {
                for l in 0..W {
                    sum[axis][l].add_product(&slope[l], &difference[axis][l]);
                }
            }
        }
        for axis in 0..D {
            for l in 0..W {
                gradient[l][axis].assign(&sum[axis][l]);
            }
        }
    }

    /// product ← the derivative of that in a direction, in which bodies and particles move; `scratch` is that of the
    /// pair's second derivatives.
    pub(crate) fn assign_product<N: Number>(
        &self,
        [bodies, of_bodies]: [&[N]; 2],
        [particles, of_particles]: [&[N]; 2],
        product: &mut [N],
        scratch: &mut [N],
    ) where
        P: PairPotential<N>,
    {
        let curved = self.pair.curved().expect("the potential has a Hessian–vector product only then");
        let Some(first) = particles.first() else { return };
        let zero = N::zero(&first.context());
        let zeros = || -> [N; D] { std::array::from_fn(|_| zero.clone()) };
        let [mut x, mut v] = [zeros(), zeros()];
        let [mut squared, mut along, mut slope, mut curvature] = std::array::from_fn(|_| zero.clone());
        let places = particles.as_chunks::<D>().0.iter().zip(of_particles.as_chunks::<D>().0);
        for ((place, direction), product) in places.zip(product.as_chunks_mut::<D>().0) {
            product.iter_mut().for_each(N::assign_zero);
            let bodies = bodies.as_chunks::<D>().0.iter().zip(of_bodies.as_chunks::<D>().0);
            for (i, (body, of_body)) in bodies.enumerate() {
                squared.assign_zero();
                along.assign_zero();
                for axis in 0..D {
                    x[axis].assign_difference(&place[axis], &body[axis]);
                    v[axis].assign_difference(&direction[axis], &of_body[axis]);
                    squared.add_product(&x[axis], &x[axis]);
                    along.add_product(&x[axis], &v[axis]);
                }
                curved.curvature(i, self.bodies, &squared, &mut slope, &mut curvature, scratch);
                curvature.multiply(&along);
                for axis in 0..D {
                    product[axis].add_product(&slope, &v[axis]);
                    product[axis].add_product(&curvature, &x[axis]);
                }
            }
        }
    }
}

/// All pairs of bodies, and after them particles of mass 0, which the bodies move and which move no body: U is that of
/// the bodies.
///
/// The gradient of a particle is minus its acceleration, of bodies that of [`Pairs`], with the same bits. So a sum over
/// b bodies and n particles has b(b − 1)/2 + b n pairs.
#[derive(Clone, Debug)]
pub struct PairsAndParticles<P, const D: usize> {
    pairs: Pairs<P, D>,
    particles: usize,
}

impl<P: super::Pair, const D: usize> PairsAndParticles<P, D> {
    /// Of bodies with these masses, where `pair` makes the energy of two bodies from the masses of all: the energy is
    /// proportional to both.
    ///
    /// ```
    /// use shadowstep::systems::kinetic::WithParticles;
    /// use shadowstep::systems::pairs::{Gravity, PairsAndParticles};
    /// use shadowstep::{DiagonalMasses, Motion, System, exact};
    ///
    /// // a body of mass 4, a planet, and a particle
    /// let gravity = PairsAndParticles::<_, 2>::new(vec![4.0, 0.5], 1, |m| Gravity { g: 1.0, m }, &())?;
    /// let masses = ["4", "4", "0.5", "0.5", "1", "1"].map(|mass| exact(mass).unwrap());
    /// let kinetic = WithParticles::new(DiagonalMasses::new(&masses, &())?, 4);
    /// let q = vec![0.0, 0.0, 2.0, 0.0, 0.0, 3.0];
    /// let mut motion = Motion::new(gravity, kinetic, q, vec![0.0, 0.0, 0.0, 1.0, 1.0, 0.0])?;
    /// assert_eq!(motion.energy(), 1.0 - 1.0);
    /// assert_eq!(motion.massive_coordinates(), 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pairs::all`]; a formula in d.
    pub fn new<N: Number>(
        masses: Vec<N>,
        particles: usize,
        pair: impl FnOnce(Vec<N>) -> P,
        context: &N::Context,
    ) -> Result<Self, PairsError> {
        let bodies = masses.len();
        let pair = pair(with_a_particle(masses, context));
        let formula_in_d = Some(PairsError::Separation { dimensions: D });
        PairsError::refuse(&pair, [bodies, D, bodies + BLOCK], formula_in_d)?;
        Ok(PairsAndParticles { pairs: Pairs { pair, bodies, which: Which::All, alike: false }, particles })
    }

    /// The coordinates of the bodies among those of all.
    fn own(&self) -> usize {
        self.pairs.bodies * D
    }

    fn field(&self) -> Field<'_, P, D> {
        Field { pair: &self.pairs.pair, bodies: self.pairs.bodies }
    }

    fn assign_of_particles<N: Number>(&self, q: &[N], gradient: &mut [N], scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        let (bodies, particles) = q.split_at(self.own());
        let scratch = parts::<N, D>(scratch).pair;
        self.field().assign_gradient(bodies, particles, &mut gradient[self.own()..], scratch);
    }
}

impl<N: Number, P: PairPotential<N>, const D: usize> Potential<N> for PairsAndParticles<P, D> {
    fn dimension(&self) -> usize {
        self.own() + self.particles * D
    }

    fn scratch(&self) -> usize {
        Potential::<N>::scratch(&self.pairs)
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        Potential::<N>::prepare(&self.pairs, scratch, context);
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        self.pairs.energy(&q[..self.own()], energy, scratch);
    }

    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        self.pairs.gradient(&q[..self.own()], &mut gradient[..self.own()], scratch);
        self.assign_of_particles(q, gradient, scratch);
    }

    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.pairs.gradient_and_rate(&q[..self.own()], &mut gradient[..self.own()], rate, scratch);
        self.assign_of_particles(q, gradient, scratch);
    }

    fn hessian(&self) -> Option<&dyn HessianProduct<N>> {
        Potential::<N>::hessian(&self.pairs).map(|_| self as &dyn HessianProduct<N>)
    }
}

/// The derivatives of the gradient, whose rows of particles have columns of bodies, and not the other way round.
impl<N: Number, P: PairPotential<N>, const D: usize> HessianProduct<N> for PairsAndParticles<P, D> {
    fn hessian_scratch(&self) -> usize {
        HessianProduct::<N>::hessian_scratch(&self.pairs)
    }

    fn prepare_hessian(&self, scratch: &mut [N], context: &N::Context) {
        HessianProduct::<N>::prepare_hessian(&self.pairs, scratch, context);
    }

    fn hessian_product(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N]) {
        let own = self.own();
        self.pairs.hessian_product(&q[..own], &v[..own], &mut product[..own], scratch);
        self.assign_products(q, v, product, scratch);
    }

    fn hessian_product_and_rate(&self, q: &[N], v: &[N], product: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let own = self.own();
        self.pairs.hessian_product_and_rate(&q[..own], &v[..own], &mut product[..own], rate, scratch);
        self.assign_products(q, v, product, scratch);
    }
}

impl<P, const D: usize> PairsAndParticles<P, D> {
    fn assign_products<N: Number>(&self, q: &[N], v: &[N], product: &mut [N], scratch: &mut [N])
    where
        P: PairPotential<N>,
    {
        let own = self.own();
        let scratch = super::hessian::scratch_of_pair::<N, D>(scratch);
        let [(q, x), (v, w)] = [q, v].map(|vector| vector.split_at(own));
        self.field().assign_product([q, v], [x, w], &mut product[own..], scratch);
    }
}
