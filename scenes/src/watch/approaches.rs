//! Close approaches of planets, in Hill radii, and the size of their interactions.

use serde::Serialize;
use shadowstep::Real;
use shadowstep::number::saved::{Fields, optional};
use shadowstep_symbolic::decimal::significant;

use super::particles::{ParticleApproach, Particles};
use crate::scene::System;
use crate::scene::split::{CanonicalCoordinates, OfPlanets, Planets, ShownCoordinates};

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
    /// ε, the largest |B_Q|/|A_Q| of a planet: its part of the force that a kick makes, beside that of its Kepler orbit.
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
    /// The approach in which H was not a sum of Kepler orbits and small interactions, or in which attraction went from kicks to drifts.
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

/// Follows the planets of a run in double precision; ε and the closest approach of planets are those of bodies with mass.
pub struct Approaches {
    planets: Planets,
    names: Vec<String>,
    masses: Vec<f64>,
    shown: ShownCoordinates<f64>,
    epsilon: OfPlanets,
    q: Vec<f64>,
    p: Vec<f64>,
    /// ε, and the planet that has it.
    largest: (f64, usize),
    closest: Option<Closest>,
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

impl Approaches {
    /// `None` of a system whose parts are T(p) and U(q).
    pub fn of(system: &System) -> Option<Approaches> {
        let (particles, planets) = (system.particles(), system.parts.planets()?.without_particles());
        let number = |mass| <f64 as shadowstep::Number>::from_rational(mass, &());
        let masses: Vec<f64> = planets.bodies.masses().iter().map(number).collect();
        let zeros = || vec![0.0; masses.len() * planets.dimensions];
        let names = planets.names(&system.coordinates);
        Some(Approaches {
            q: zeros(),
            p: zeros(),
            particles: (particles > 0).then(|| Particles::new(&masses, particles)),
            masses,
            names,
            shown: planets.inertial(&()),
            epsilon: planets.epsilon(system),
            largest: (0.0, 1),
            closest: None,
            in_drifts_within: planets.encounters.as_ref().map(|near| number(near.shells.radius())),
            planets,
        })
    }

    /// Takes the state n, in the coordinates of the steps.
    pub fn include<N: Real>(&mut self, n: i64, (q, p): (&[N], &[N])) {
        self.q.iter_mut().zip(q).for_each(|(own, q)| *own = q.to_f64());
        self.p.iter_mut().zip(p).for_each(|(own, p)| *own = p.to_f64());
        for (planet, epsilon) in (self.epsilon)(&self.q).into_iter().enumerate() {
            if epsilon > self.largest.0 {
                self.largest = (epsilon, planet + 1);
            }
        }
        let (shown, _) = self.shown.of_state(&self.q, &self.p);
        let dimensions = self.planets.dimensions;
        if let Some(particles) = &mut self.particles {
            // particles are relative to the centre of mass, or to the first body
            let origin = match self.planets.coordinates {
                CanonicalCoordinates::Jacobi => &self.q[..dimensions],
                CanonicalCoordinates::DemocraticHeliocentric => &shown[..dimensions],
            };
            let relative: Vec<_> = shown.iter().zip(origin.iter().cycle()).map(|(x, origin)| x - origin).collect();
            particles.include(n, &relative, &q[relative.len()..], dimensions);
        }
        let places: Vec<_> = shown.chunks_exact(dimensions).collect();
        let distance = |i: usize, j: usize| -> f64 {
            places[i].iter().zip(places[j]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
        };
        for j in 2..places.len() {
            for i in 1..j {
                let part = ((self.masses[i] + self.masses[j]) / (3.0 * self.masses[0])).cbrt();
                let hill_radius = part * (distance(0, i) + distance(0, j)) / 2.0;
                let hill_radii = distance(i, j) / hill_radius;
                if self.closest.is_none_or(|closest| hill_radii < closest.hill_radii) {
                    self.closest = Some(Closest { n, bodies: [i, j], hill_radii, hill_radius });
                }
            }
        }
    }

    /// What the states so far have shown.
    pub fn found(&self) -> Interactions {
        let named = |Closest { n, bodies, hill_radii, hill_radius }| {
            let bodies = bodies.map(|body: usize| self.names[body].clone());
            Approach { n, bodies, hill_radii, hill_radius }
        };
        Interactions {
            epsilon: self.largest.0,
            of: self.names[self.largest.1].clone(),
            closest: self.closest.map(named),
            particles: self.particles.as_ref().and_then(|particles| particles.found(&self.names)),
            in_drifts_within: self.in_drifts_within,
        }
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let (bodies, (epsilon, of)) = (self.masses.len(), &mut self.largest);
        to.double(epsilon);
        to.place(of, bodies);
        let none = Closest { n: 0, bodies: [0; 2], hill_radii: 0.0, hill_radius: 0.0 };
        optional(to, &mut self.closest, &none, |to, closest| {
            to.whole(&mut closest.n);
            closest.bodies.iter_mut().for_each(|body| to.place(body, bodies));
            to.double(&mut closest.hill_radii);
            to.double(&mut closest.hill_radius);
        });
        self.particles.iter_mut().for_each(|particles| particles.fields(to));
    }
}
