//! Jacobi coordinates: each planet relative to the centre of mass of the bodies before it.

use crate::Rational;
use crate::number::Number;
use crate::systems::kinetic::Quadratic;

use super::bodies::Bodies;
use super::coordinates::PlanetaryCoordinates;
use super::interactions::Interactions;
use super::orbits::{Orbit, Orbits};
use super::particles::Particles;

/// Jacobi coordinates: Q_i is the position relative to the centre of mass of the bodies 0 … i−1, and with η_i = m_0 +
/// … + m_i
///
/// P_i = (η_{i−1} p_i − m_i (p_0 + … + p_{i−1}))/η_i,
/// A = P₀²/2M + Σ (P_i²/2m_i′ − κ_i/|Q_i|), m_i′ = m_i η_{i−1}/η_i, κ_i = G m_i η_{i−1}.
///
/// B, the rest of the potential, depends on Q only: T = Σ P_i²/2m_i′ is a part of A. So schemes for quadratic T keep
/// their order: where a bracket of A and B vanishes for A = T, it vanishes for A = T + f(Q) as well, for it vanishes by
/// its degree in P. The orbits of the first two bodies have no interaction in B.
///
/// Source: Wisdom & Holman, Astron. J. 102 (1991) 1528, section 3; Rein & Tamayo, Mon. Not. R. Astron. Soc. 452 (2015)
/// 376, section 2.2.
#[derive(Clone, Debug)]
pub struct Jacobi<N, const D: usize> {
    orbits: Orbits<N>,
    /// m_i/η_i and η_{i−1}/η_i of the planets
    shares: Vec<[N; 2]>,
    interactions: Interactions<N, D>,
    /// Positions of the planets relative to the central body, and their gradient.
    relative: Vec<N>,
    slopes: Vec<N>,
    /// A direction in these coordinates, where second derivatives are wanted.
    direction: Vec<N>,
    /// A running sum.
    sum: [N; D],
    /// Particles, and what attracts them: the bodies, less the mass of all in their centre. Positions are relative to
    /// that.
    particles: Option<Box<Particles<N, D>>>,
}

impl<N: Number, const D: usize> PlanetaryCoordinates<N, D> for Jacobi<N, D> {
    type Class = Quadratic;

    const HAS_GRADIENT_KICKS: bool = true;

    fn new(bodies: &Bodies, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let (masses, sums) = (&bodies.masses, bodies.sums());
        let planet = |i: usize| {
            let reduced = &masses[i] * &sums[i - 1] / &sums[i];
            Orbit::new(&reduced, &(&bodies.g * &masses[i] * &sums[i - 1]), context)
        };
        let share = |i: usize| [number(&(&masses[i] / &sums[i])), number(&(&sums[i - 1] / &sums[i]))];
        let planets = 1..masses.len();
        // the attraction by η_{i−1}, which is that of the orbit, is subtracted: it is that by −η_{i−1}
        let negative: Vec<_> = sums.iter().map(|sum| -sum).collect();
        let attracting_one_by_one = masses.iter().chain(&negative).map(number).collect();
        let zeros = || vec![N::zero(context); planets.len() * D];
        let total = &sums[masses.len() - 1];
        let of_particles = std::iter::repeat_n(Orbit::of_particle(&bodies.g, total, context), bodies.particles);
        let attracting: Vec<_> = [&masses[0], &-total].into_iter().chain(&masses[1..]).cloned().collect();
        Jacobi {
            orbits: Orbits {
                total_mass: number(total),
                planets: planets.clone().map(planet).chain(of_particles).collect(),
                particles: bodies.particles,
            },
            particles: Particles::new(bodies, &attracting, context),
            shares: planets.clone().map(share).collect(),
            interactions: Interactions::new(bodies, attracting_one_by_one, context),
            relative: zeros(),
            slopes: zeros(),
            direction: zeros(),
            sum: std::array::from_fn(|_| N::zero(context)),
        }
    }

    fn orbits(&self) -> &Orbits<N> {
        &self.orbits
    }

    fn assign_positions(&mut self, q: &[N], own: &mut [N]) {
        let ((q, _), (own_q, _)) = (q.as_chunks::<D>(), own.as_chunks_mut::<D>());
        for axis in 0..D {
            let mut centre = q[0][axis].clone();
            for (i, [own, _]) in (1..).zip(&self.shares) {
                own_q[i][axis].assign_difference(&q[i][axis], &centre);
                centre.add_product(own, &own_q[i][axis]);
            }
            own_q[0][axis].assign(&centre);
            for i in self.shares.len() + 1..q.len() {
                own_q[i][axis].assign_difference(&q[i][axis], &centre);
            }
        }
    }

    fn assign_momenta(&mut self, p: &[N], own: &mut [N]) {
        let ((p, _), (own_p, _)) = (p.as_chunks::<D>(), own.as_chunks_mut::<D>());
        for axis in 0..D {
            let mut momentum = p[0][axis].clone();
            for (i, [own, inner]) in (1..).zip(&self.shares) {
                own_p[i][axis].assign_product(inner, &p[i][axis]);
                own_p[i][axis].subtract_product(own, &momentum);
                momentum.add(&p[i][axis]);
            }
            own_p[0][axis].assign(&momentum);
            // the velocity of the centre of mass
            momentum.divide(&self.orbits.total_mass);
            for i in self.shares.len() + 1..p.len() {
                own_p[i][axis].assign_difference(&p[i][axis], &momentum);
            }
        }
    }

    fn assign_inertial_positions(&mut self, own: &[N], q: &mut [N]) {
        let ((own_q, _), (q, _)) = (own.as_chunks::<D>(), q.as_chunks_mut::<D>());
        for axis in 0..D {
            let mut centre = own_q[0][axis].clone();
            for (before, [own, _]) in self.shares.iter().enumerate().rev() {
                let i = before + 1;
                centre.subtract_product(own, &own_q[i][axis]);
                q[i][axis].assign_sum(&centre, &own_q[i][axis]);
            }
            q[0][axis].assign(&centre);
            for i in self.shares.len() + 1..q.len() {
                q[i][axis].assign_sum(&own_q[0][axis], &own_q[i][axis]);
            }
        }
    }

    fn assign_inertial_momenta(&mut self, own: &[N], p: &mut [N]) {
        let ((own_p, _), (p, _)) = (own.as_chunks::<D>(), p.as_chunks_mut::<D>());
        for axis in 0..D {
            let mut momentum = own_p[0][axis].clone();
            for (before, [own, _]) in self.shares.iter().enumerate().rev() {
                let i = before + 1;
                p[i][axis].assign(&own_p[i][axis]);
                p[i][axis].add_product(own, &momentum);
                momentum.subtract(&p[i][axis]);
            }
            p[0][axis].assign(&momentum);
            momentum.assign_quotient(&own_p[0][axis], &self.orbits.total_mass);
            for i in self.shares.len() + 1..p.len() {
                p[i][axis].assign_sum(&momentum, &own_p[i][axis]);
            }
        }
    }

    fn gradient_and_rate(&mut self, q: &[N], gradient: &mut [N], mut rate: Option<&mut N>) {
        let Jacobi { shares, interactions, relative, slopes, sum, particles, .. } = self;
        assign_relative(shares, q, relative, sum);
        let bodies = shares.len() + 1;
        if let Some(particles) = particles {
            assign_attracting((relative, sum), particles.bodies());
            particles.assign_gradient(&q[bodies * D..], &mut gradient[bodies * D..]);
        }
        interactions.assign_gradient(relative, slopes, rate.as_deref_mut());
        let ((relative, _), (slopes, _)) = (relative.as_chunks::<D>(), slopes.as_chunks_mut::<D>());
        let ((q, _), (gradient, _)) = (q.as_chunks::<D>(), gradient.as_chunks_mut::<D>());
        gradient[0].iter_mut().for_each(N::assign_zero);
        sum.iter_mut().for_each(N::assign_zero);
        for i in (1..bodies).rev() {
            // of the first planet the attraction to the central body is that of its orbit
            if i > 1 {
                interactions.add_single((0, i), &relative[i - 1], &mut slopes[i - 1], rate.as_deref_mut());
            }
            gather(&shares[i - 1][0], &slopes[i - 1], sum, &mut gradient[i]);
            if i > 1 {
                interactions.add_single((i, bodies + i - 1), &q[i], &mut gradient[i], rate.as_deref_mut());
            }
        }
    }

    /// By the chain rule: as the gradient, with second derivatives in the direction that v has in heliocentric
    /// positions.
    fn hessian_product(&mut self, q: &[N], v: &[N], product: &mut [N]) {
        let Jacobi { shares, interactions, relative, slopes, direction, sum, particles, .. } = self;
        let bodies = shares.len() + 1;
        assign_relative(shares, q, relative, sum);
        if let Some(particles) = particles {
            assign_attracting((relative, sum), particles.bodies());
        }
        assign_relative(shares, v, direction, sum);
        if let Some(particles) = particles {
            assign_attracting((direction, sum), particles.directions());
            particles.assign_product([q, v].map(|all| &all[bodies * D..]), &mut product[bodies * D..]);
        }
        interactions.assign_hessian_product(relative, direction, slopes);
        let ((relative, _), (direction, _)) = (relative.as_chunks::<D>(), direction.as_chunks::<D>());
        let ((slopes, _), (product, _)) = (slopes.as_chunks_mut::<D>(), product.as_chunks_mut::<D>());
        let ((q, _), (v, _)) = (q.as_chunks::<D>(), v.as_chunks::<D>());
        product[0].iter_mut().for_each(N::assign_zero);
        sum.iter_mut().for_each(N::assign_zero);
        for i in (1..bodies).rev() {
            if i > 1 {
                interactions.add_single_product((0, i), &relative[i - 1], &direction[i - 1], &mut slopes[i - 1]);
            }
            gather(&shares[i - 1][0], &slopes[i - 1], sum, &mut product[i]);
            if i > 1 {
                interactions.add_single_product((i, bodies + i - 1), &q[i], &v[i], &mut product[i]);
            }
        }
    }

    fn assign_interaction_energy(&mut self, (q, _): (&[N], &[N]), energy: &mut N) {
        let Jacobi { shares, interactions, relative, sum, .. } = self;
        assign_relative(shares, q, relative, sum);
        interactions.assign_energy(relative, energy);
        let bodies = shares.len() + 1;
        let ((relative, _), (q, _)) = (relative.as_chunks::<D>(), q.as_chunks::<D>());
        for i in 2..bodies {
            energy.add(interactions.single_energy((0, i), &relative[i - 1]));
            energy.add(interactions.single_energy((i, bodies + i - 1), &q[i]));
        }
    }
}

/// relative ← q_i − q_0 = Q_i + Σ_{j<i} m_j/η_j Q_j
fn assign_relative<N: Number, const D: usize>(shares: &[[N; 2]], q: &[N], relative: &mut [N], sum: &mut [N; D]) {
    sum.iter_mut().for_each(N::assign_zero);
    let planets = q.as_chunks::<D>().0[1..].iter().zip(relative.as_chunks_mut::<D>().0);
    for ([own, _], (q, relative)) in shares.iter().zip(planets) {
        for ((relative, q), sum) in relative.iter_mut().zip(q).zip(&mut *sum) {
            relative.assign_sum(q, sum);
            sum.add_product(own, q);
        }
    }
}

/// attracting ← the positions of the central body, the centre of mass and the planets, relative to the second of these;
/// from those of the centre and the planets relative to the first.
fn assign_attracting<N: Number, const D: usize>((relative, centre): (&[N], &[N; D]), attracting: &mut [N]) {
    let (fixed, planets) = attracting.split_at_mut(2 * D);
    let (central, own) = fixed.split_at_mut(D);
    own.iter_mut().for_each(N::assign_zero);
    for (axis, centre) in centre.iter().enumerate() {
        central[axis].assign(centre);
        central[axis].negate();
    }
    for (planet, relative) in planets.as_chunks_mut::<D>().0.iter_mut().zip(relative.as_chunks::<D>().0) {
        for axis in 0..D {
            planet[axis].assign_difference(&relative[axis], &centre[axis]);
        }
    }
}

/// The derivative by Q_i from that by x_i = Q_i + Σ_{j<i} m_j/η_j Q_j, from the last planet to the first; `sum` is that
/// by all x_k, k > i.
#[inline(always)]
fn gather<N: Number, const D: usize>(share: &N, slope: &[N; D], sum: &mut [N; D], gradient: &mut [N; D]) {
    for ((gradient, slope), sum) in gradient.iter_mut().zip(slope).zip(sum) {
        gradient.assign(slope);
        gradient.add_product(share, sum);
        sum.add(slope);
    }
}
