//! Close encounters of planets: near ones attract each other in drifts, which have substeps then.

use num_traits::Signed;

use crate::Rational;
use crate::number::Number;
use crate::systems::increments::Carried;
use crate::systems::kept::KeptForce;
use crate::systems::kinetic::General;
use crate::systems::pairs::{Cutoff, Gravity, Pairs, Shell};
use crate::systems::potential::Prepared;
use crate::systems::state::VectorState;
use crate::systems::summation::{Compensated, Half, Remainders};
use crate::systems::system::System;

use super::WisdomHolman;
use super::bodies::{Bodies, BodiesError};
use super::heliocentric::DemocraticHeliocentric;
use super::interactions::{gravity_of_planets, of_planets, scaled};
use super::particles::AttractionInShell;

/// A planetary system whose planets may come close to each other, in [`DemocraticHeliocentric`] coordinates.
///
/// The attraction u of two planets is divided by switches at distances R_0 > R_1 > …, R_(k+1) = R_k/3^(2/3): S_k falls
/// from 1 at R_(k+1) to 0 at R_k. Kicks have (1 − S_0) u; the [shells](Shells) (S_k − S_(k+1)) u are parts of A. A
/// drift is n_0 leapfrogs of shell 0 and the flow of all that is further in over this time, which is three leapfrogs of
/// shell 1 and of what is further in, and so on to the Kepler orbits (SyMBA: M. J. Duncan, H. F. Levison & M. H. Lee,
/// Astron. J. 116 (1998) 2067). n_0 is the least number of substeps that are at most τ. While no two planets can come
/// below R_k, by a bound from their speeds and accelerations, substeps of shell k are one Kepler drift, as its kicks
/// are 0.
///
/// So a step is one map for all states, a composition of exact flows: β and the modified energy are exact as elsewhere.
/// Its order in h is that of the scheme or 2, whichever is lower, but terms of order 2 from the substeps have the
/// factor (τ/h)².
///
/// Particles of mass 0 are attracted by planets in the same shells. One that may come below R_0 in a drift makes it
/// with copies of the bodies, in as many substeps as it needs: so the bodies, and other particles, have the bits that
/// they have without it.
///
/// ```
/// use shadowstep::systems::wisdom_holman::{Bodies, Encounters, Shells};
/// use shadowstep::{Stepper, System, exact, tables};
///
/// // two planets of a tenth of Jupiter's mass that meet
/// let masses = ["1", "1/10000", "1/10000"].map(|mass| exact(mass).unwrap());
/// let bodies = Bodies::new(exact("1")?, masses.to_vec())?;
/// let (q, p) = ([0.0, 0.0, 1.0, 0.0, 1.1, 0.3], [0.0, 0.0, 0.0, 1e-4, -2.6e-5, 9e-5]);
/// let shells = Shells::within(exact("1/8")?)?;
/// let mut planets = Encounters::<f64, 2>::new(&bodies, (&q, &p), &shells, &exact("1/100")?, &())?;
///
/// let before = planets.energy();
/// let stepper = Stepper::new(tables::shipped("stormer-verlet").unwrap().for_every_kinetic()?, "1/20")?;
/// for _ in 0..1000 {
///     stepper.step(&mut planets);
/// }
/// assert!((planets.energy() / before - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Encounters<N: Number, const D: usize> {
    /// With kicks of (1 − S_0) u.
    planets: WisdomHolman<N, DemocraticHeliocentric<N, D>, D>,
    shells: Vec<ShellOfPlanets<N, D>>,
    /// τ
    substep: f64,
    /// Masses of the planets, and G m_0.
    masses: Vec<f64>,
    parameter: f64,
    /// Scratch space.
    points: Vec<MovingPoint<D>>,
    /// The bodies with one particle, which takes part in the shells; `None` where there are no particles, and in this
    /// system itself.
    with_one: Option<Box<Encounters<N, D>>>,
    /// The particles that may come close to planets in a drift.
    near: Vec<usize>,
}

/// The distances of the shells.
#[derive(Clone, Debug)]
pub struct Shells {
    /// R_0, R_1, …
    radii: Vec<Rational>,
}

/// Substeps of a shell in one of the shell around it.
const RATIO: i32 = 3;

/// R_(k+1)/R_k = 3^(−2/3): a time of free fall becomes a third.
const RATIO_OF_RADII: (i64, i64) = (4807, 10000);

/// R is then 8e-6 of R_0, and a substep 1/4e7 of τ.
const LEVELS: usize = 17;

/// Of the switches.
const DERIVATIVES: u32 = 6;

impl Shells {
    /// Shells of planets that are closer than this distance: 17 of them, with 6 continuous derivatives.
    ///
    /// # Errors
    /// A distance that is not positive.
    pub fn within(radius: Rational) -> Result<Self, BodiesError> {
        if !radius.is_positive() {
            return Err(BodiesError::Shells);
        }
        let (numerator, denominator) = RATIO_OF_RADII;
        let ratio = Rational::new(numerator.into(), denominator.into());
        let radii = std::iter::successors(Some(radius), |radius| Some(radius * &ratio)).take(LEVELS + 1).collect();
        Ok(Shells { radii })
    }

    /// R_0
    pub fn radius(&self) -> &Rational {
        &self.radii[0]
    }

    /// Into how many parts a substep of shell 0 is divided where two planets are at a distance: 3^k between R_(k+1) and
    /// R_k. `None` beyond R_0.
    pub fn division_at(&self, distance: f64) -> Option<f64> {
        let inside = self.radii[..LEVELS].iter().take_while(|radius| distance < double(radius)).count();
        let shell = i32::try_from(inside).ok()?.checked_sub(1).filter(|shell| *shell >= 0)?;
        Some(f64::from(RATIO).powi(shell))
    }

    /// The cutoff that is S_k.
    fn cutoff<const D: usize>(&self, k: usize) -> Cutoff<D> {
        let cutoff = Cutoff::at(self.radii[k].clone());
        let switched = cutoff.and_then(|cutoff| cutoff.switched(self.radii[k + 1].clone(), DERIVATIVES));
        switched.expect("radii are positive and fall")
    }
}

/// The attraction between planets at some distances.
#[derive(Clone, Debug)]
struct ShellOfPlanets<N, const D: usize> {
    /// R_k
    radius: f64,
    /// (S_k − S_(k+1)) u, of the innermost one S_k u.
    pairs: Prepared<N, Pairs<Shell<Gravity<N>>, D>>,
    /// The same of a particle.
    particle: Option<AttractionInShell<N>>,
    /// By the positions of the planets, and of the particle.
    gradient: Vec<N>,
    rate: N,
    kept: KeptForce,
}

impl<N: Number, const D: usize> ShellOfPlanets<N, D> {
    fn new(bodies: &Bodies, shells: &Shells, k: usize, takes_a_particle: bool, context: &N::Context) -> Self {
        let (outer, inner) = (shells.cutoff(k), (k + 1 < LEVELS).then(|| shells.cutoff::<D>(k + 1)));
        let pair = Shell::new(gravity_of_planets(bodies, context), Some(&outer), inner.as_ref());
        let of_particle = || AttractionInShell::new(bodies, Some(&outer), inner.as_ref(), context);
        ShellOfPlanets {
            radius: double(&shells.radii[k]),
            pairs: of_planets(bodies, pair, context),
            particle: takes_a_particle.then(of_particle),
            gradient: vec![N::zero(context); (bodies.masses.len() - 1 + usize::from(takes_a_particle)) * D],
            rate: N::zero(context),
            kept: KeptForce::Nothing,
        }
    }

    fn evaluate(&mut self, x: &[N], augmented: bool) {
        if self.kept.suffices(augmented) {
            return;
        }
        let ShellOfPlanets { pairs, particle, gradient, rate, kept, .. } = self;
        let massive = gradient.len() - if particle.is_some() { D } else { 0 };
        let (x, of_particle) = x.split_at(massive);
        let (gradient, particle_gradient) = gradient.split_at_mut(massive);
        pairs.gradient(x, gradient, augmented.then_some(rate));
        if let Some(particle) = particle {
            particle.assign_gradient::<D>(x, of_particle, particle_gradient);
        }
        *kept = KeptForce::with(augmented);
    }
}

impl<N: Number, const D: usize> Encounters<N, D> {
    /// The system at inertial positions and momenta, body after body, with drifts of substeps of at most `substep`.
    ///
    /// # Errors
    /// A state of another number of bodies; an infinite q or p, or one that is NaN; a substep that is not positive.
    pub fn new(
        bodies: &Bodies,
        state: (&[N], &[N]),
        shells: &Shells,
        substep: &Rational,
        context: &N::Context,
    ) -> Result<Self, BodiesError> {
        let mut system = Self::with(bodies, state, (shells, substep, false), context)?;
        if bodies.particles > 0 {
            let with_one = Bodies { particles: 1, ..bodies.clone() };
            let zeros = vec![N::zero(context); with_one.count() * D];
            let with_one = Self::with(&with_one, (&zeros, &zeros), (shells, substep, true), context)?;
            system.with_one = Some(Box::new(with_one));
        }
        Ok(system)
    }

    fn with(
        bodies: &Bodies,
        state: (&[N], &[N]),
        (shells, substep, takes_a_particle): (&Shells, &Rational, bool),
        context: &N::Context,
    ) -> Result<Self, BodiesError> {
        let mut planets = WisdomHolman::<N, DemocraticHeliocentric<N, D>, D>::new(bodies, state, context)?;
        planets.interaction.coordinates.leave_near(bodies, &shells.cutoff(0), context);
        if !substep.is_positive() {
            return Err(BodiesError::Substep);
        }
        Ok(Encounters {
            planets,
            shells: (0..LEVELS).map(|k| ShellOfPlanets::new(bodies, shells, k, takes_a_particle, context)).collect(),
            substep: double(substep),
            // the momentum of a particle is its velocity
            masses: bodies.masses[1..].iter().map(double).chain(takes_a_particle.then_some(1.0)).collect(),
            parameter: double(&bodies.g) * double(&bodies.masses[0]),
            points: Vec::new(),
            with_one: None,
            near: Vec::new(),
        })
    }

    /// The same system with [compensated sums](crate::systems::summation::Compensated).
    #[must_use]
    pub fn compensated(mut self) -> Self {
        self.planets = self.planets.compensated();
        self.with_one = self.with_one.map(|with_one| Box::new(with_one.compensated()));
        self
    }

    /// The inertial positions and momenta.
    pub fn inertial(&mut self) -> (Vec<N>, Vec<N>) {
        self.planets.inertial()
    }

    /// gradient ← ∂B/∂Q at a Q, of the part of kicks that depends on Q.
    pub fn assign_gradient(&mut self, q: &[N], gradient: &mut [N]) {
        self.planets.assign_gradient(q, gradient);
    }

    /// The kick of a shell.
    fn kick_shell(&mut self, k: usize, weight: &N, carried: Carried) {
        let Encounters { planets, shells, .. } = self;
        let augmented = carried.has_increments();
        let shell = &mut shells[k];
        shell.evaluate(&planets.at.state.q[D..], augmented);
        for (index, slope) in (D..).zip(&shell.gradient) {
            planets.at.state.change(Half::Momenta, index, carried, |p| p.subtract_product(weight, slope));
        }
        if augmented {
            planets.at.state.increments.beta.add_product(weight, &shell.rate);
        }
    }

    /// The Kepler orbits for a time.
    fn drift_alone(&mut self, weight: &N, carried: Carried) {
        self.planets.drift(weight, carried);
        self.forget();
    }

    fn forget(&mut self) {
        self.shells.iter_mut().for_each(|shell| shell.kept = KeptForce::Nothing);
    }

    /// The flow of the Kepler orbits and of the shells from k on, in this number of substeps of shell k.
    fn drift_in(&mut self, k: usize, weight: &N, count: i32, carried: Carried) {
        if k == LEVELS {
            return self.drift_alone(weight, carried);
        }
        let mut each = weight.clone();
        each.divide_integer(count);
        let mut half = each.clone();
        half.divide_integer(2);
        let (mut left, substep) = (count, size(&each));
        while left > 0 {
            let free = self.free_substeps(self.shells[k].radius, substep, left);
            if free == count {
                self.drift_alone(weight, carried);
            } else if free > 0 {
                let mut together = each.clone();
                together.multiply_integer(free);
                self.drift_alone(&together, carried);
            } else {
                self.kick_shell(k, &half, carried);
                self.drift_in(k + 1, &each, RATIO, carried);
                self.kick_shell(k, &half, carried);
            }
            left -= free.max(1);
        }
    }

    /// Finds the particles that may come below R_0 of a planet in a time.
    fn find_near_particles(&mut self, time: f64) {
        let Encounters { planets, shells, masses, parameter, near, .. } = self;
        let state = &planets.at.state;
        let (first, bodies, distance) = (masses.len() + 1, state.q.len() / D, shells[0].radius);
        near.clear();
        for lane in 0..N::LANES {
            let point = |body| MovingPoint::<D>::of(state, (body, lane), masses, *parameter);
            let points: Vec<_> = (1..first).map(point).collect();
            let comes_close = |particle: usize| {
                let particle = point(particle);
                // NaN is close
                let meets = |planet: &MovingPoint<D>| {
                    let is_apart = particle.stays_apart(planet, distance, time)
                        || particle.time_apart(planet, distance) * (1.0 - 1e-9) > time;
                    !is_apart
                };
                points.iter().any(meets)
            };
            near.extend((first..bodies).filter(|particle| comes_close(*particle)));
        }
        near.sort_unstable();
        near.dedup();
    }

    /// The drift of a near particle, with the bodies as they were before it.
    fn drift_near(&mut self, particle: usize, before: &VectorState<N>, (weight, count): (&N, i32), carried: Carried) {
        let Some(with_one) = &mut self.with_one else { return };
        let (massive, at) = ((self.masses.len() + 1) * D, particle * D);
        let own = |all: &[N]| [&all[..massive], &all[at..at + D]].concat();
        let remainders = before.remainders();
        let of_own = |all: &[N]| if all.is_empty() { Vec::new() } else { own(all) };
        let state = with_one.state_mut();
        state.set(&own(before.q()), &own(before.p()));
        state.set_remainders(&Remainders { q: of_own(&remainders.q), p: of_own(&remainders.p) });
        state.clear_increments();
        with_one.drift_in(0, weight, count, carried);
        let (made, state) = (&with_one.planets.at.state, &mut self.planets.at.state);
        let (made_remainders, mut remainders) = (made.remainders(), state.remainders());
        for (place, axis) in (at..at + D).zip(massive..) {
            state.q[place].assign(&made.q[axis]);
            state.p[place].assign(&made.p[axis]);
            for (own, made) in [(&mut remainders.q, &made_remainders.q), (&mut remainders.p, &made_remainders.p)] {
                own.iter_mut().skip(place).take(1).zip(made.get(axis)).for_each(|(own, made)| own.assign(made));
            }
            if N::KEEPS_INCREMENTS && carried.has_increments() {
                let (own, before) = (&mut state.increments, &before.increments);
                own.q[place].assign_sum(&before.q[place], &made.increments.q[axis]);
                own.p[place].assign_sum(&before.p[place], &made.increments.p[axis]);
            }
        }
        state.set_remainders(&remainders);
    }

    /// In how many of the next substeps no two planets can come below a distance, of at most `most`.
    fn free_substeps(&mut self, distance: f64, substep: f64, most: i32) -> i32 {
        let mut free = f64::from(most);
        let Encounters { planets, points, masses, parameter, .. } = self;
        for lane in 0..N::LANES {
            let point = |body| MovingPoint::of(&planets.at.state, (body, lane), masses, *parameter);
            points.clear();
            points.extend((1..=masses.len()).map(point));
            let all = substep * f64::from(most);
            for (i, one) in points.iter().enumerate() {
                for other in points[..i].iter().filter(|other| !one.stays_apart(other, distance, all)) {
                    // round-off of the bound
                    free = free.min(one.time_apart(other, distance) * (1.0 - 1e-9) / substep);
                }
            }
        }
        // NaN is 0
        free.max(0.0) as i32
    }
}

fn double(value: &Rational) -> f64 {
    <f64 as Number>::from_rational(value, &())
}

/// |x|, the largest of all lanes.
fn size<N: Number>(number: &N) -> f64 {
    (0..N::LANES).map(|lane| scaled(number.lane(lane)).abs()).fold(0.0, f64::max)
}

/// A planet on its Kepler orbit, in double precision.
#[derive(Clone, Debug)]
struct MovingPoint<const D: usize> {
    position: [f64; D],
    velocity: [f64; D],
    /// The distance from the star.
    radius: f64,
    speed: f64,
    /// The largest acceleration on the orbit, that at the pericentre.
    acceleration: f64,
    /// A bound of the acceleration for a time, as r does not fall below half of its present value; where that is less
    /// than the largest.
    soon: Option<(f64, f64)>,
}

/// |a − b|²
fn square_distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

impl<const D: usize> MovingPoint<D> {
    /// A body in a lane of a state; that which has no mass in the list is a particle, whose momentum is its velocity.
    fn of<N: Number>(
        state: &VectorState<N>,
        (body, lane): (usize, usize),
        masses: &[f64],
        parameter: f64,
    ) -> MovingPoint<D> {
        let number = |number: &N| scaled(number.lane(lane));
        let mass = masses.get(body - 1).copied().unwrap_or(1.0);
        let [q, p] = [state.q(), state.p()].map(|all| &all.as_chunks::<D>().0[body]);
        MovingPoint::new(q.each_ref().map(number), p.each_ref().map(|p| number(p) / mass), parameter)
    }

    fn new(position: [f64; D], velocity: [f64; D], parameter: f64) -> Self {
        let dot = |one: &[f64; D], other: &[f64; D]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        let (r2, v2) = (dot(&position, &position), dot(&velocity, &velocity));
        // h² = r²v² − (r·v)², e² = 1 + 2Eh²/μ², and h²/(μ (1 + e)) at the pericentre
        let momentum = (r2 * v2 - dot(&position, &velocity).powi(2)).max(0.0);
        let energy = v2 / 2.0 - parameter / r2.sqrt();
        let eccentricity = (1.0 + 2.0 * energy * momentum / (parameter * parameter)).max(0.0).sqrt();
        let pericentre = momentum / (parameter * (1.0 + eccentricity));
        let (radius, speed) = (r2.sqrt(), v2.sqrt());
        let near = 4.0 * parameter / r2;
        let soon = (2.0 * pericentre < radius).then(|| (near, time_of(radius / 2.0, speed, near)));
        let acceleration = parameter / (pericentre * pericentre);
        MovingPoint { position, velocity, radius, speed, acceleration, soon }
    }

    /// Whether two planets stay apart for a time because even opposite velocities would not bring them together: the
    /// common case, at little cost.
    fn stays_apart(&self, other: &Self, distance: f64, time: f64) -> bool {
        let acceleration = self.acceleration + other.acceleration;
        let way = (self.speed + other.speed + acceleration * time / 2.0) * time;
        let reach = (distance + way) * (1.0 + 1e-9);
        square_distance(&self.position, &other.position) > reach * reach
    }

    /// A time in which two planets do not come below a distance: their distance falls by at most v t + a t²/2 in the
    /// time t, with their present relative speed and their largest accelerations.
    fn time_apart(&self, other: &Self, distance: f64) -> f64 {
        let room = square_distance(&self.position, &other.position).sqrt() - distance;
        if room <= 0.0 {
            return 0.0;
        }
        let speed = square_distance(&self.velocity, &other.velocity).sqrt();
        let apart = time_of(room, speed, self.acceleration + other.acceleration);
        if self.soon.is_none() && other.soon.is_none() && self.is_beside(other) {
            return apart;
        }
        let [(one, until), (another, until_other)] = [self, other].map(MovingPoint::largest_soon);
        let soon = time_of(room, speed, one + another).min(until).min(until_other);
        apart.max(soon).max(self.time_between(other, distance))
    }

    /// Whether neither is much nearer to the star.
    fn is_beside(&self, other: &Self) -> bool {
        const MUCH: f64 = 4.0;
        self.radius * MUCH > other.radius && other.radius * MUCH > self.radius
    }

    /// The largest acceleration for a time.
    fn largest_soon(&self) -> (f64, f64) {
        self.soon.unwrap_or((self.acceleration, f64::INFINITY))
    }

    /// A time in which the inner one does not come near to the outer one, as the speed of an orbit falls with the
    /// distance from the star: the inner one gets further from it by at most v t, however near to it, and how fast, it
    /// is before.
    fn time_between(&self, other: &Self, distance: f64) -> f64 {
        let (inner, outer) = if self.radius < other.radius { (self, other) } else { (other, self) };
        let room = outer.radius - inner.radius - distance;
        if room <= 0.0 {
            return 0.0;
        }
        let (acceleration, until) = outer.largest_soon();
        time_of(room, inner.speed + outer.speed, acceleration).min(until)
    }
}

/// The least t with v t + a t²/2 = way.
fn time_of(way: f64, speed: f64, acceleration: f64) -> f64 {
    2.0 * way / (speed + (speed * speed + 2.0 * acceleration * way).sqrt())
}

impl<N: Number, const D: usize> System for Encounters<N, D> {
    type Number = N;
    type Class = General;
    type Coordinates = Vec<N>;
    type Summation = Option<Compensated<N, Vec<N>>>;

    fn state(&self) -> &VectorState<N> {
        self.planets.state()
    }

    fn state_mut(&mut self) -> &mut VectorState<N> {
        self.forget();
        self.planets.state_mut()
    }

    fn clear_increments(&mut self) {
        self.planets.clear_increments();
    }

    fn kick(&mut self, weight: &N, carried: Carried) {
        // the jump moves all planets alike, but the last bits of their differences
        self.forget();
        self.planets.kick(weight, carried);
    }

    fn drift(&mut self, weight: &N, carried: Carried) {
        // a quotient that is a whole number but for round-off is this number
        let count = ((size(weight) / self.substep * (1.0 - 1e-12)).ceil() as i32).max(1);
        if self.with_one.is_some() {
            self.find_near_particles(size(weight));
        }
        let before = (!self.near.is_empty()).then(|| self.planets.at.state.clone());
        self.drift_in(0, weight, count, carried);
        if let Some(before) = before {
            for place in 0..self.near.len() {
                self.drift_near(self.near[place], &before, (weight, count), carried);
            }
            self.forget();
        }
    }

    fn assign_energy(&mut self, at: Option<(&[N], &[N])>, energy: &mut N) {
        self.planets.assign_energy(at, energy);
    }

    fn assign_kinetic_energy(&mut self, at: Option<(&[N], &[N])>, kinetic: &mut N) {
        self.planets.assign_kinetic_energy(at, kinetic);
    }

    fn massive_coordinates(&self) -> usize {
        self.planets.massive_coordinates()
    }
}

#[cfg(test)]
mod tests {
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    use super::MovingPoint;
    use crate::systems::kepler_drift::KeplerDrift;

    /// Points on Kepler orbits, at 200 times before the one that is returned.
    #[test]
    fn planets_stay_apart_for_the_time_that_is_returned() {
        let mut random = Pcg64Mcg::seed_from_u64(35);
        let mut uniform = |a: f64, b: f64| a + (b - a) * (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut kepler = KeplerDrift::<f64>::new(&());
        let (mut longest, mut shortest) = (0.0f64, 1.0f64);
        for case in 0..1500 {
            // planets; two comets; a planet, and a body that passes close to the star
            let [least, slowest] = [[0.3, 0.2], [0.3, 1e-3], [1e-4, 1e-3]][case % 3];
            let mut point = |least: f64| {
                let r = if uniform(0.0, 1.0) < 0.5 { least + uniform(0.0, 0.1) } else { uniform(0.3, 2.0) };
                let position = [r, uniform(-0.2, 0.2) * r, uniform(-0.1, 0.1) * r];
                let velocity = [uniform(-0.8, 0.8), uniform(slowest, 1.2), uniform(-0.2, 0.2)];
                MovingPoint::new(position, velocity.map(|v| v / r.sqrt()), 1.0)
            };
            let (one, other) = (point(least), point(0.3));
            let distance = 0.05;
            let time = one.time_apart(&other, distance);
            (longest, shortest) = (longest.max(time), shortest.min(time));
            let mut at = |point: &MovingPoint<3>, t: f64| {
                let (mut q, mut v) = ([0.0; 3], [0.0; 3]);
                let (mut position, mut velocity) = (point.position, point.velocity);
                kepler.advance_augmented(&1.0, &t, &mut position, &mut velocity, &mut q, &mut v);
                std::array::from_fn::<f64, 3, _>(|axis| point.position[axis] + q[axis])
            };
            for part in 0..=200 {
                let t = time * f64::from(part) / 200.0;
                let (a, b) = (at(&one, t), at(&other, t));
                let apart = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                assert!(time == 0.0 || apart >= distance * (1.0 - 1e-12), "{apart} at {t} of {time}");
            }
        }
        assert!(longest > 0.3 && shortest < 0.05, "{shortest} to {longest}");
    }

    /// A body near the star, and a planet: the time is a part of the way, and not of the time of its fall.
    #[test]
    fn what_is_near_the_star_is_not_near_a_planet() {
        let planet = MovingPoint::new([0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], 1.0);
        for near in [1e-2, 1e-4, 1e-8f64] {
            let body = MovingPoint::new([near, 0.0, 0.0], [0.0, 1.5 / near.sqrt(), 0.0], 1.0);
            let time = body.time_apart(&planet, 0.01);
            assert!(time > 0.5 * body.speed.recip(), "{time} at {near}");
            // on its way out
            let far = MovingPoint::new([0.0, -3.0, 0.0], [0.0, -1.1, near], 1.0);
            let time = far.time_apart(&planet, 0.01);
            assert!(time > 0.5, "{time} at {near}");
        }
    }
}
