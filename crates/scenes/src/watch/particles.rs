//! Particles of mass 0 that come close to planets.

use serde::Serialize;
use shadowstep::number::instructions;
use shadowstep::number::saved::Fields;

use super::places::{Each, Places, STATES, at, difference, dot, least_of, squares};

/// The closest approach of a particle to a planet.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParticleApproach {
    /// The state at which it was found.
    pub n: i64,
    /// The names or numbers of the planet and the particle.
    pub bodies: [String; 2],
    /// The distance in Hill radii of the planet, (m/3m_0)^(1/3) r.
    pub hill_radii: f64,
    /// How many particles were closer than one Hill radius.
    pub within: usize,
}

/// Follows the distances of particles from planets.
pub(super) struct Particles {
    /// (m/3m_0)^(2/3) of each planet.
    parts: Vec<f64>,
    /// 1/R² of the Hill radius R of each planet.
    inverse: Vec<Each>,
    /// The least square of a distance in Hill radii, its state, planet and particle.
    closest: (f64, i64, [usize; 2]),
    within: Vec<bool>,
}

impl Particles {
    pub(super) fn new(masses: &[f64], particles: usize) -> Self {
        let parts: Vec<_> = masses[1..].iter().map(|mass| (mass / (3.0 * masses[0])).powf(2.0 / 3.0)).collect();
        let inverse = vec![Each::all(0.0); parts.len()];
        Particles { parts, inverse, closest: (f64::INFINITY, 0, [0; 2]), within: vec![false; particles] }
    }

    /// Takes the next states.
    pub(super) fn include(&mut self, places: &Places) {
        let (bodies, particles) = places.relative.split_at(self.parts.len() + 1);
        let has_news = self.find_news(bodies, particles);
        let Particles { inverse, closest, within, .. } = self;
        for (state, n) in places.states().filter(|(state, _)| has_news[*state]) {
            for (k, (particle, within)) in particles.iter().zip(&mut *within).enumerate() {
                for (j, (planet, inverse)) in bodies[1..].iter().zip(&*inverse).enumerate() {
                    let way = difference(&at(particle, state), &at(planet, state));
                    let square = dot(&way, &way) * inverse.0[state];
                    *within |= square < 1.0;
                    if square < closest.0 {
                        *closest = (square, n, [j, k]);
                    }
                }
            }
        }
    }

    /// Whether a particle is closer to a planet than any was before these states, or for the first time within its Hill
    /// radius, at each state.
    fn find_news(&mut self, bodies: &[[Each; 3]], particles: &[[Each; 3]]) -> [bool; STATES] {
        let Particles { parts, inverse, closest: (closest, ..), within } = self;
        let mut excess = [f64::INFINITY; STATES];
        instructions::widest(
            #[inline(always)]
            || {
                for ((inverse, part), planet) in inverse.iter_mut().zip(parts).zip(&bodies[1..]) {
                    let squares = squares(planet, &bodies[0]);
                    (0..STATES).for_each(|state| inverse.0[state] = 1.0 / (*part * squares.0[state]));
                }
                for (particle, within) in particles.iter().zip(within) {
                    let least = if *within { *closest } else { closest.max(1.0) };
                    for (planet, inverse) in bodies[1..].iter().zip(&*inverse) {
                        let squares = squares(particle, planet);
                        for (state, excess) in excess.iter_mut().enumerate() {
                            *excess = least_of(squares.0[state] * inverse.0[state] - least, *excess);
                        }
                    }
                }
            },
        );
        excess.map(|excess| excess < 0.0)
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let Particles { parts, inverse: _, closest: (square, n, [planet, particle]), within } = self;
        to.double(square);
        to.whole(n);
        to.place(planet, parts.len());
        to.place(particle, within.len());
        within.iter_mut().for_each(|within| to.flag(within));
    }

    /// What was found, with the names of all bodies.
    pub(super) fn found(&self, names: &[String]) -> Option<ParticleApproach> {
        let (square, n, [planet, particle]) = self.closest;
        square.is_finite().then(|| ParticleApproach {
            n,
            bodies: [planet + 1, self.parts.len() + 1 + particle].map(|body| names[body].clone()),
            hill_radii: square.sqrt(),
            within: self.within.iter().filter(|within| **within).count(),
        })
    }
}
