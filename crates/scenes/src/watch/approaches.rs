//! Close approaches of planets, in Hill radii, and the size of their interactions.

use serde::Serialize;
use shadowstep::number::instructions;
use shadowstep::number::saved::{Fields, optional};
use shadowstep_schemes::symbolic::decimal::significant;

use super::particles::{ParticleApproach, Particles};
use super::places::{Each, Places, STATES, at, difference, dot, least_of, roots, squares};
use crate::scene::System;
use crate::scene::split::OfPlanets;

/// The closest approach of two planets.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Approach {
    /// The state at which it was found.
    pub n: i64,
    /// The names or numbers of the bodies.
    pub bodies: [String; 2],
    /// The distance in mutual Hill radii, ((m_i + m_j)/3m_0)^(1/3) (r_i + r_j)/2.
    pub hill_radii: f64,
    /// That radius.
    pub hill_radius: f64,
}

/// What a run has shown of the planets' interactions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Interactions {
    /// ε, the largest |B_Q|/|A_Q| of a planet: its part of the force that a kick makes, beside that of its Kepler
    /// orbit. In a summary it is that of the first 4096 states, and then of every 16th one and of those where two
    /// planets are closer than before.
    pub epsilon: f64,
    /// The planet that has it.
    pub of: String,
    /// The closest approach; `None` of a single planet.
    pub closest: Option<Approach>,
    /// The closest approach of a particle of mass 0; `None` where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub particles: Option<ParticleApproach>,
    /// Planets that are nearer than this attract each other in drifts; `None` where none do.
    #[serde(skip)]
    pub(crate) in_drifts_within: Option<f64>,
}

/// Planets that are nearer, in mutual Hill radii, attract each other more than the central body's tide separates them.
const CLOSE: f64 = 1.0;

impl Interactions {
    /// The approach in which H was not a sum of Kepler orbits and small interactions, or in which attraction went from
    /// kicks to drifts.
    pub(crate) fn encounter(&self) -> Option<&Approach> {
        let is_in_drifts = |Approach { hill_radii, hill_radius, .. }: &Approach| {
            self.in_drifts_within.is_some_and(|within| hill_radii * hill_radius < within)
        };
        self.closest.as_ref().filter(|closest| closest.hill_radii < CLOSE || is_in_drifts(closest))
    }

    /// In a line, with the times of states in words.
    pub fn text(&self, time: impl Fn(i64) -> String) -> String {
        let Interactions { epsilon, of, closest, particles, .. } = self;
        let closest = closest.as_ref().map_or(String::new(), |Approach { n, bodies: [i, j], hill_radii, .. }| {
            format!("; closest approach {} Hill radii, {i} and {j} at {}", significant(*hill_radii, 4), time(*n))
        });
        let particles =
            particles.as_ref().map_or(String::new(), |ParticleApproach { n, bodies: [i, j], hill_radii, within }| {
                let of_all = if *within == 1 { "1 particle".to_owned() } else { format!("{within} particles") };
                let of_particle =
                    format!("closest approach of a particle {} Hill radii, {j} to {i}", significant(*hill_radii, 4));
                format!("; {of_particle} at {}; within 1 Hill radius {of_all}", time(*n))
            });
        format!("interactions at most {epsilon:.1e} of the Kepler force ({of}){closest}{particles}")
    }
}

/// ε is computed at each of this number of states.
const FIRST: u64 = 4096;

/// Follows the planets of a run in double precision; ε and the closest approach of planets are those of bodies with
/// mass.
pub(super) struct Approaches {
    names: Vec<String>,
    pairs: Pairs,
    epsilon: OfPlanets,
    /// ε is computed at the first states, at those whose n is a multiple of this, and where two planets are closer than
    /// before.
    every: u64,
    /// ε, and the planet that has it.
    largest: (f64, usize),
    in_drifts_within: Option<f64>,
    particles: Option<Particles>,
}

/// The closest approach so far, by the places of the bodies.
#[derive(Clone, Copy)]
struct Closest {
    n: i64,
    bodies: [usize; 2],
    hill_radii: f64,
    hill_radius: f64,
}

/// The planets and the central body, which is the first one.
struct Pairs {
    /// The distances from the central body.
    radii: Vec<Each>,
    /// For each planet j the parts ((m_i + m_j)/3m_0)^(1/3) of planets 0 < i < j.
    parts: Vec<Vec<f64>>,
    /// Whether the planet j may be closer to one before it than any two were, at each state.
    near: Vec<[bool; STATES]>,
    closest: Option<Closest>,
}

impl Pairs {
    fn new(masses: &[f64]) -> Self {
        let bodies = masses.len();
        let part = |i: usize, j: usize| ((masses[i] + masses[j]) / (3.0 * masses[0])).cbrt();
        Pairs {
            radii: vec![Each::all(0.0); bodies],
            parts: (0..bodies).map(|j| (1..j).map(|i| part(i, j)).collect()).collect(),
            near: vec![[false; STATES]; bodies],
            closest: None,
        }
    }

    /// Finds planets that may be closer than any two were before these states: no root of a distance and no division.
    fn find_near(&mut self, bodies: &[[Each; 3]]) {
        // squares are within some units in the last place of what they are compared with
        const ALMOST: f64 = 0.25 * (1.0 + 1e-14);
        let Pairs { radii, parts, near, closest } = self;
        let least = closest.map_or(f64::INFINITY, |closest| closest.hill_radii * closest.hill_radii) * ALMOST;
        instructions::widest(
            #[inline(always)]
            || {
                for (radius, body) in radii.iter_mut().zip(bodies) {
                    *radius = roots(&squares(body, &bodies[0]));
                }
                for (j, (near, parts)) in near.iter_mut().zip(&*parts).enumerate() {
                    let mut excess = [f64::INFINITY; STATES];
                    for (i, part) in (1..).zip(parts) {
                        let squares = squares(&bodies[i], &bodies[j]);
                        for (state, excess) in excess.iter_mut().enumerate() {
                            let radius = part * (radii[i].0[state] + radii[j].0[state]);
                            *excess = least_of(squares.0[state] - least * radius * radius, *excess);
                        }
                    }
                    *near = excess.map(|excess| excess < 0.0);
                }
            },
        );
    }

    /// Takes a state, whose number is n; whether two planets are closer than before.
    fn include(&mut self, (state, n): (usize, i64), bodies: &[[Each; 3]]) -> bool {
        let mut is_closer = false;
        for j in (2..bodies.len()).filter(|j| self.near[*j][state]) {
            for i in 1..j {
                let hill_radius = self.parts[j][i - 1] * (self.radii[i].0[state] + self.radii[j].0[state]) / 2.0;
                let way = difference(&at(&bodies[i], state), &at(&bodies[j], state));
                let hill_radii = dot(&way, &way).sqrt() / hill_radius;
                if self.closest.is_none_or(|closest| hill_radii < closest.hill_radii) {
                    self.closest = Some(Closest { n, bodies: [i, j], hill_radii, hill_radius });
                    is_closer = true;
                }
            }
        }
        is_closer
    }
}

impl Approaches {
    /// `None` of a system whose parts are T(p) and U(q).
    pub(super) fn of(system: &System, every: u64) -> Option<Approaches> {
        let (particles, planets) = (system.particles(), system.parts.planets()?.without_particles());
        let number = |mass| <f64 as shadowstep::Number>::from_rational(mass, &());
        let masses: Vec<f64> = planets.bodies.masses().iter().map(number).collect();
        Some(Approaches {
            particles: (particles > 0).then(|| Particles::new(&masses, particles)),
            pairs: Pairs::new(&masses),
            names: planets.names(&system.coordinates),
            epsilon: planets.epsilon(system),
            every,
            largest: (0.0, 1),
            in_drifts_within: planets.encounters.as_ref().map(|near| number(near.shells.radius())),
        })
    }

    /// Takes the next states.
    pub(super) fn include(&mut self, places: &Places) {
        if let Some(particles) = &mut self.particles {
            particles.include(places);
        }
        self.pairs.find_near(&places.bodies);
        for (state, n) in places.states() {
            let is_closer = self.pairs.include((state, n), &places.bodies);
            if !(is_closer || n.unsigned_abs() < FIRST || n.unsigned_abs().is_multiple_of(self.every)) {
                continue;
            }
            for (planet, epsilon) in (self.epsilon)(&places.of_steps(state)).into_iter().enumerate() {
                // forces may overflow in double precision
                if epsilon > self.largest.0 && epsilon.is_finite() {
                    self.largest = (epsilon, planet + 1);
                }
            }
        }
    }

    /// What the states so far have shown.
    pub(super) fn found(&self) -> Interactions {
        let named = |Closest { n, bodies, hill_radii, hill_radius }| {
            let bodies = bodies.map(|body: usize| self.names[body].clone());
            Approach { n, bodies, hill_radii, hill_radius }
        };
        Interactions {
            epsilon: self.largest.0,
            of: self.names[self.largest.1].clone(),
            closest: self.pairs.closest.map(named),
            particles: self.particles.as_ref().and_then(|particles| particles.found(&self.names)),
            in_drifts_within: self.in_drifts_within,
        }
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let (bodies, (epsilon, of)) = (self.pairs.parts.len(), &mut self.largest);
        to.double(epsilon);
        to.place(of, bodies);
        let none = Closest { n: 0, bodies: [0; 2], hill_radii: 0.0, hill_radius: 0.0 };
        optional(to, &mut self.pairs.closest, &none, |to, closest| {
            to.whole(&mut closest.n);
            closest.bodies.iter_mut().for_each(|body| to.place(body, bodies));
            to.double(&mut closest.hill_radii);
            to.double(&mut closest.hill_radius);
        });
        self.particles.iter_mut().for_each(|particles| particles.fields(to));
    }
}
