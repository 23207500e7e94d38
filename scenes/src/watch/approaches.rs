//! Close approaches of planets, in Hill radii, and the size of their interactions.

use serde::Serialize;
use shadowstep::Real;

use crate::scene::System;
use crate::scene::split::{OfPlanets, Planets, ShownCoordinates};

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
    /// Whether planets that are near attract each other in drifts.
    #[serde(skip)]
    pub(crate) near_in_drifts: bool,
}

/// Planets that are nearer, in mutual Hill radii, attract each other more than the central body's tide separates them.
const CLOSE: f64 = 1.0;

impl Interactions {
    /// The approach in which H was not a sum of Kepler orbits and small interactions.
    pub(crate) fn encounter(&self) -> Option<&Approach> {
        self.closest.as_ref().filter(|closest| closest.hill_radii < CLOSE)
    }

    /// In a line, with the times of states in words.
    pub fn text(&self, time: impl Fn(i64) -> String) -> String {
        let Interactions { epsilon, of, closest, .. } = self;
        let closest = closest.as_ref().map_or(String::new(), |Approach { n, bodies: [i, j], hill_radii, .. }| {
            format!("; closest approach {hill_radii:.3} Hill radii, {i} and {j} at {}", time(*n))
        });
        format!("interactions at most {epsilon:.1e} of the Kepler force ({of}){closest}")
    }
}

/// Follows the planets of a run in double precision.
pub struct Approaches {
    planets: Planets,
    names: Vec<String>,
    masses: Vec<f64>,
    shown: ShownCoordinates<f64>,
    epsilon: OfPlanets,
    q: Vec<f64>,
    p: Vec<f64>,
    found: Interactions,
}

impl Approaches {
    /// `None` of a system whose parts are T(p) and U(q).
    pub fn of(system: &System) -> Option<Approaches> {
        let planets = system.parts.planets()?;
        let masses = planets.bodies.masses().iter().map(|mass| <f64 as shadowstep::Number>::from_rational(mass, &()));
        let names = planets.names(&system.coordinates);
        let of = names[1].clone();
        Some(Approaches {
            masses: masses.collect(),
            names,
            shown: planets.inertial(&()),
            epsilon: planets.epsilon(system),
            planets: planets.clone(),
            q: vec![0.0; system.coordinates.len()],
            p: vec![0.0; system.coordinates.len()],
            found: Interactions { epsilon: 0.0, of, closest: None, near_in_drifts: planets.encounters.is_some() },
        })
    }

    /// Takes the state n, in the coordinates of the steps.
    pub fn include<N: Real>(&mut self, n: i64, (q, p): (&[N], &[N])) {
        self.q.iter_mut().zip(q).for_each(|(own, q)| *own = q.to_f64());
        self.p.iter_mut().zip(p).for_each(|(own, p)| *own = p.to_f64());
        for (planet, epsilon) in (self.epsilon)(&self.q).into_iter().enumerate() {
            if epsilon > self.found.epsilon {
                (self.found.epsilon, self.found.of) = (epsilon, self.names[planet + 1].clone());
            }
        }
        let (q, _) = self.shown.of_state(&self.q, &self.p);
        let places: Vec<_> = q.chunks_exact(self.planets.dimensions).collect();
        let distance = |i: usize, j: usize| -> f64 {
            places[i].iter().zip(places[j]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
        };
        for j in 2..places.len() {
            for i in 1..j.min(self.masses.len()) {
                let part = ((self.masses[i] + self.masses.get(j).unwrap_or(&0.0)) / (3.0 * self.masses[0])).cbrt();
                let hill_radius = part * (distance(0, i) + distance(0, j)) / 2.0;
                let hill_radii = distance(i, j) / hill_radius;
                if self.found.closest.as_ref().is_none_or(|closest| hill_radii < closest.hill_radii) {
                    let bodies = [i, j].map(|body| self.names[body].clone());
                    self.found.closest = Some(Approach { n, bodies, hill_radii, hill_radius });
                }
            }
        }
    }

    /// What the states so far have shown.
    pub fn found(&self) -> &Interactions {
        &self.found
    }
}
