//! A: the free motion of the centre of mass, and a Kepler orbit for each planet.

use crate::Rational;
use crate::number::Number;
use crate::systems::increments::Carried;
use crate::systems::kepler_drift::KeplerDrift;
use crate::systems::state::VectorState;
use crate::systems::summation::Half;

use super::together::Together;

/// The masses and attractions of A = P₀²/2M + Σ (P_i²/2m_i′ − κ_i/|Q_i|).
#[derive(Clone, Debug)]
pub struct Orbits<N> {
    /// M
    pub total_mass: N,
    /// For each planet, and then for each particle of mass 0, whose numbers are those of a unit mass.
    pub planets: Vec<Orbit<N>>,
    /// How many of them are particles.
    pub particles: usize,
}

impl<N> Orbits<N> {
    /// Those with an energy.
    pub(super) fn with_energy(&self) -> &[Orbit<N>] {
        &self.planets[..self.planets.len() - self.particles]
    }
}

/// A Kepler orbit with H = P²/2m − κ/|Q|.
#[derive(Clone, Debug)]
pub struct Orbit<N> {
    /// m
    pub mass: N,
    /// κ
    pub attraction: N,
    /// μ = κ/m
    pub parameter: N,
}

impl<N: Number> Orbit<N> {
    /// Each number is rounded once.
    pub(super) fn new(mass: &Rational, attraction: &Rational, context: &N::Context) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        Orbit { mass: number(mass), attraction: number(attraction), parameter: number(&(attraction / mass)) }
    }

    /// That of a particle about a mass.
    pub(super) fn of_particle(g: &Rational, mass: &Rational, context: &N::Context) -> Self {
        Orbit::new(&Rational::from_integer(1.into()), &(g * mass), context)
    }
}

/// Advances the orbits; has the scratch space for it.
#[derive(Clone, Debug)]
pub(super) struct Advance<N: Number, const D: usize> {
    kepler: KeplerDrift<N>,
    /// The first planets, if there are several that lanes compute at once.
    pub(super) together: Option<Box<Together<N, D>>>,
    place: [N; D],
    velocity: [N; D],
    /// What a drift adds.
    to_q: [N; D],
    to_v: [N; D],
    square: N,
    scratch: N,
    /// T of an energy.
    kinetic_energy: N,
}

impl<N: Number, const D: usize> Advance<N, D> {
    pub(super) fn new(orbits: &Orbits<N>, context: &N::Context) -> Self {
        let zeros = || std::array::from_fn(|_| N::zero(context));
        let planets: Vec<_> = orbits.planets.iter().map(|orbit| [&orbit.mass, &orbit.parameter]).collect();
        Advance {
            kepler: KeplerDrift::new(context),
            together: Together::new(&planets, context),
            place: zeros(),
            velocity: zeros(),
            to_q: zeros(),
            to_v: zeros(),
            square: N::zero(context),
            scratch: N::zero(context),
            kinetic_energy: N::zero(context),
        }
    }

    /// The flow of A for a time.
    pub(super) fn advance(&mut self, orbits: &Orbits<N>, time: &N, state: &mut VectorState<N>, carried: Carried) {
        for axis in 0..D {
            self.scratch.assign_quotient(&state.p()[axis], &orbits.total_mass);
            state.change(Half::Positions, axis, carried, |q| q.add_product(time, &self.scratch));
        }
        let together = self.advance_together(orbits, time, state, carried);
        for (planet, orbit) in (1..).zip(&orbits.planets).skip(together) {
            let first = planet * D;
            self.find_increments(orbit, time, (&state.q()[first..first + D], &state.p()[first..first + D]));
            for (axis, part) in self.to_q.iter().enumerate() {
                state.change(Half::Positions, first + axis, carried, |q| q.add(part));
            }
            for (axis, part) in self.to_v.iter().enumerate() {
                state.change(Half::Momenta, first + axis, carried, |p| p.add_product(&orbit.mass, part));
            }
            if planet <= orbits.with_energy().len() {
                add_to_beta(orbit, &mut self.scratch, state, carried);
            }
        }
    }

    /// The same of the first planets, with the same bits; how many are computed together is returned.
    fn advance_together(
        &mut self,
        orbits: &Orbits<N>,
        time: &N,
        state: &mut VectorState<N>,
        carried: Carried,
    ) -> usize {
        let Advance { together, scratch, .. } = self;
        let Some(together) = together else { return 0 };
        let [q, p] = [state.q(), state.p()].map(|numbers| &numbers[D..]);
        together.find_increments(time, (q, p));
        for (half, increments) in [(Half::Positions, &together.to_q), (Half::Momenta, &together.to_p)] {
            for (index, part) in (D..).zip(increments) {
                state.change(half, index, carried, |x| x.add(part));
            }
        }
        for (orbit, s) in orbits.with_energy().iter().zip(&together.anomalies) {
            scratch.assign(s);
            add_to_beta(orbit, scratch, state, carried);
        }
        together.anomalies.len()
    }

    /// What the drift adds to a planet's position and velocity, and its universal anomaly in the scratch number.
    ///
    /// The velocity is the true quotient of momentum and mass: a product with 1/m, rounded, would let the energy drift.
    fn find_increments(&mut self, orbit: &Orbit<N>, time: &N, (q, p): (&[N], &[N])) {
        let Advance { kepler, place, velocity, to_q, to_v, scratch, .. } = self;
        place.iter_mut().zip(q).for_each(|(place, q)| place.assign(q));
        velocity.iter_mut().zip(p).for_each(|(v, p)| v.assign_quotient(p, &orbit.mass));
        to_q.iter_mut().chain(&mut *to_v).for_each(N::assign_zero);
        scratch.assign(kepler.advance_augmented(&orbit.parameter, time, place, velocity, to_q, to_v));
    }

    /// kinetic ← T
    pub(super) fn assign_kinetic_energy(&mut self, orbits: &Orbits<N>, p: &[N], kinetic: &mut N) {
        assign_kinetic_energy::<N, D>([&mut self.square, &mut self.scratch], orbits, p, kinetic);
    }

    /// energy ← energy + A
    pub(super) fn add_energy(&mut self, orbits: &Orbits<N>, (q, p): (&[N], &[N]), energy: &mut N) {
        let Advance { square, scratch, kinetic_energy, .. } = self;
        assign_kinetic_energy::<N, D>([square, scratch], orbits, p, kinetic_energy);
        energy.add(kinetic_energy);
        for (orbit, q) in orbits.with_energy().iter().zip(&q.as_chunks::<D>().0[1..]) {
            assign_square_sum(square, q);
            scratch.assign_reciprocal_sqrt(square);
            energy.subtract_product(&orbit.attraction, scratch);
        }
    }
}

/// kinetic ← T
fn assign_kinetic_energy<N: Number, const D: usize>(
    [square, scratch]: [&mut N; 2],
    orbits: &Orbits<N>,
    p: &[N],
    kinetic: &mut N,
) {
    let masses = std::iter::once(&orbits.total_mass).chain(orbits.with_energy().iter().map(|orbit| &orbit.mass));
    kinetic.assign_zero();
    for (mass, p) in masses.zip(p.as_chunks::<D>().0) {
        assign_square_sum(square, p);
        scratch.assign_quotient(square, mass);
        kinetic.add(scratch);
    }
    kinetic.divide_integer(2);
}

/// β ← β + 3κ s, if increments are carried along; s is lost.
fn add_to_beta<N: Number>(orbit: &Orbit<N>, s: &mut N, state: &mut VectorState<N>, carried: Carried) {
    if carried.has_increments() {
        s.multiply(&orbit.attraction);
        s.multiply_integer(3);
        state.increments.beta.add(s);
    }
}

/// sum ← Σ x²
fn assign_square_sum<N: Number>(sum: &mut N, values: &[N]) {
    sum.assign_zero();
    values.iter().for_each(|x| sum.add_product(x, x));
}
