//! Democratic heliocentric coordinates: each planet relative to the central body, with its barycentric momentum.

use crate::Rational;
use crate::number::Number;
use crate::systems::kinetic::General;
use crate::systems::pairs::Cutoff;

use super::bodies::Bodies;
use super::coordinates::PlanetaryCoordinates;
use super::interactions::Interactions;
use super::orbits::{Orbit, Orbits};
use super::particles::Particles;

/// Democratic heliocentric coordinates: Q_i = q_i − q_0 and P_i = p_i − (m_i/M) P₀, so that
///
/// A = P₀²/2M + Σ (P_i²/2m_i − G m_0 m_i/|Q_i|), B = |Σ P_i|²/2m_0 − G Σ_{i<j} m_i m_j/|Q_i − Q_j|, where all sums are
/// over the planets.
///
/// The first term of B is the kinetic energy of the central body. It commutes with the second one: it moves all planets
/// alike, which changes none of their differences, and the attraction between them does not change the sum of their
/// momenta. So a kick is the *jump* by Σ P_i/m_0 and then the attraction, together the exact flow of B; the jump is a
/// quadratic form and adds nothing to β. B depends on P, hence schemes for quadratic T only are refused.
///
/// The order of the planets has no meaning here, which suits orbits that cross. The error in ε is larger than in
/// [Jacobi](super::Jacobi) coordinates.
///
/// Source: Duncan, Levison & Lee, Astron. J. 116 (1998) 2067.
#[derive(Clone, Debug)]
pub struct DemocraticHeliocentric<N, const D: usize> {
    orbits: Orbits<N>,
    central_mass: N,
    /// m_i/M of the planets
    shares: Vec<N>,
    interactions: Interactions<N, D>,
    /// Particles, which the planets attract.
    particles: Option<Box<Particles<N, D>>>,
    sum: [N; D],
    scratch: N,
}

impl<N: Number, const D: usize> PlanetaryCoordinates<N, D> for DemocraticHeliocentric<N, D> {
    type Class = General;

    const HAS_GRADIENT_KICKS: bool = false;

    fn new(bodies: &Bodies, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let (central, planets) = bodies.masses.split_first().expect("two bodies or more");
        let total: Rational = bodies.masses.iter().sum();
        let orbit = |mass| Orbit::new(mass, &(&bodies.g * central * mass), context);
        let of_particles = std::iter::repeat_n(Orbit::of_particle(&bodies.g, central, context), bodies.particles);
        DemocraticHeliocentric {
            orbits: Orbits {
                total_mass: number(&total),
                planets: planets.iter().map(orbit).chain(of_particles).collect(),
                particles: bodies.particles,
            },
            particles: Particles::new(bodies, planets, context),
            central_mass: number(central),
            shares: planets.iter().map(|mass| number(&(mass / &total))).collect(),
            interactions: Interactions::new(bodies, Vec::new(), context),
            sum: std::array::from_fn(|_| N::zero(context)),
            scratch: N::zero(context),
        }
    }

    fn orbits(&self) -> &Orbits<N> {
        &self.orbits
    }

    fn assign_positions(&mut self, q: &[N], own: &mut [N]) {
        let ((q, _), (own_q, _)) = (q.as_chunks::<D>(), own.as_chunks_mut::<D>());
        for axis in 0..D {
            own_q[0][axis].assign(&q[0][axis]);
            for (i, share) in (1..).zip(&self.shares) {
                self.scratch.assign_difference(&q[i][axis], &q[0][axis]);
                own_q[i][axis].assign(&self.scratch);
                own_q[0][axis].add_product(share, &self.scratch);
            }
            for i in self.shares.len() + 1..q.len() {
                own_q[i][axis].assign_difference(&q[i][axis], &q[0][axis]);
            }
        }
    }

    fn assign_momenta(&mut self, p: &[N], own: &mut [N]) {
        let ((p, _), (own_p, _)) = (p.as_chunks::<D>(), own.as_chunks_mut::<D>());
        for axis in 0..D {
            own_p[0][axis].assign_zero();
            p[..=self.shares.len()].iter().for_each(|p| own_p[0][axis].add(&p[axis]));
            for (i, share) in (1..).zip(&self.shares) {
                self.scratch.assign(&p[i][axis]);
                self.scratch.subtract_product(share, &own_p[0][axis]);
                own_p[i][axis].assign(&self.scratch);
            }
            // the velocity of the centre of mass
            self.scratch.assign_quotient(&own_p[0][axis], &self.orbits.total_mass);
            for i in self.shares.len() + 1..p.len() {
                own_p[i][axis].assign_difference(&p[i][axis], &self.scratch);
            }
        }
    }

    fn assign_inertial_positions(&mut self, own: &[N], q: &mut [N]) {
        let ((own_q, _), (q, _)) = (own.as_chunks::<D>(), q.as_chunks_mut::<D>());
        for axis in 0..D {
            q[0][axis].assign(&own_q[0][axis]);
            for (q_i, share) in own_q[1..].iter().zip(&self.shares) {
                q[0][axis].subtract_product(share, &q_i[axis]);
            }
            for i in 1..own_q.len() {
                self.scratch.assign_sum(&q[0][axis], &own_q[i][axis]);
                q[i][axis].assign(&self.scratch);
            }
        }
    }

    fn assign_inertial_momenta(&mut self, own: &[N], p: &mut [N]) {
        let ((own_p, _), (p, _)) = (own.as_chunks::<D>(), p.as_chunks_mut::<D>());
        for axis in 0..D {
            p[0][axis].assign(&own_p[0][axis]);
            for (i, share) in (1..).zip(&self.shares) {
                self.scratch.assign(&own_p[i][axis]);
                self.scratch.add_product(share, &own_p[0][axis]);
                p[i][axis].assign(&self.scratch);
                p[0][axis].subtract(&self.scratch);
            }
            self.scratch.assign_quotient(&own_p[0][axis], &self.orbits.total_mass);
            for i in self.shares.len() + 1..p.len() {
                p[i][axis].assign_sum(&self.scratch, &own_p[i][axis]);
            }
        }
    }

    fn gradient_and_rate(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        let bodies = (self.shares.len() + 1) * D;
        let (own, of_particles) = gradient.split_at_mut(bodies);
        let (centre, planets) = own.split_at_mut(D);
        centre.iter_mut().for_each(N::assign_zero);
        self.interactions.assign_gradient(&q[D..bodies], planets, rate);
        if let Some(particles) = &mut self.particles {
            particles.bodies().iter_mut().zip(&q[D..bodies]).for_each(|(own, q)| own.assign(q));
            particles.assign_gradient(&q[bodies..], of_particles);
        }
    }

    fn hessian_product(&mut self, q: &[N], v: &[N], product: &mut [N]) {
        let bodies = (self.shares.len() + 1) * D;
        let (own, of_particles) = product.split_at_mut(bodies);
        let (centre, planets) = own.split_at_mut(D);
        centre.iter_mut().for_each(N::assign_zero);
        self.interactions.assign_hessian_product(&q[D..bodies], &v[D..bodies], planets);
        if let Some(particles) = &mut self.particles {
            particles.bodies().iter_mut().zip(&q[D..bodies]).for_each(|(own, q)| own.assign(q));
            particles.directions().iter_mut().zip(&v[D..bodies]).for_each(|(own, v)| own.assign(v));
            particles.assign_product([q, v].map(|all| &all[bodies..]), of_particles);
        }
    }

    fn jump(&mut self, p: &[N]) -> Option<&[N; D]> {
        self.assign_sum_of_momenta(p);
        self.sum.iter_mut().for_each(|sum| sum.divide(&self.central_mass));
        Some(&self.sum)
    }

    fn assign_interaction_energy(&mut self, (q, p): (&[N], &[N]), energy: &mut N) {
        self.assign_sum_of_momenta(p);
        self.interactions.assign_energy(&q[D..(self.shares.len() + 1) * D], energy);
        self.scratch.assign_zero();
        self.sum.iter().for_each(|sum| self.scratch.add_product(sum, sum));
        self.scratch.divide(&self.central_mass);
        self.scratch.divide_integer(2);
        energy.add(&self.scratch);
    }
}

impl<N: Number, const D: usize> DemocraticHeliocentric<N, D> {
    /// Kicks by the attraction between the planets without what a cutoff has of it, which is switched.
    pub(super) fn leave_near(&mut self, bodies: &Bodies, cutoff: &Cutoff<D>, context: &N::Context) {
        self.interactions.leave_near(bodies, cutoff, context);
        self.particles.iter_mut().for_each(|particles| particles.leave_near(bodies, cutoff, context));
    }

    /// sum ← Σ P_i of the planets
    fn assign_sum_of_momenta(&mut self, p: &[N]) {
        self.sum.iter_mut().for_each(N::assign_zero);
        for planet in &p.as_chunks::<D>().0[1..=self.shares.len()] {
            self.sum.iter_mut().zip(planet).for_each(|(sum, p)| sum.add(p));
        }
    }
}
