//! Particles of mass 0 that come close to planets.

use serde::Serialize;
use shadowstep::number::saved::Fields;

use super::places::Places;

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
    /// Where each planet is, and 1/R² of its Hill radius R.
    planets: Vec<([f64; 3], f64)>,
    /// The least square of a distance in Hill radii, its state, planet and particle.
    closest: (f64, i64, [usize; 2]),
    within: Vec<bool>,
}

impl Particles {
    pub(super) fn new(masses: &[f64], particles: usize) -> Self {
        let parts = masses[1..].iter().map(|mass| (mass / (3.0 * masses[0])).powf(2.0 / 3.0)).collect();
        Particles { parts, planets: Vec::new(), closest: (f64::INFINITY, 0, [0; 2]), within: vec![false; particles] }
    }

    /// Takes the state n.
    pub(super) fn include(&mut self, n: i64, places: &Places) {
        let Particles { parts, planets, closest, within } = self;
        let (dimensions, origin) = (places.dimensions, places.origin());
        let place = |body: &[f64], origin: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|axis| body.get(axis).map_or(0.0, |x| x - origin[axis]))
        };
        let square = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>();
        let mut bodies = places.inertial().chunks_exact(dimensions).map(|body| place(body, origin));
        let central = bodies.next().unwrap_or_default();
        planets.clear();
        planets.extend(bodies.zip(parts).map(|(planet, part)| (planet, 1.0 / (*part * square(planet, central)))));
        for (k, (particle, within)) in places.particles().chunks_exact(dimensions).zip(within).enumerate() {
            let x = place(particle, [0.0; 3]);
            for (j, (planet, inverse)) in planets.iter().enumerate() {
                let found = square(x, *planet) * inverse;
                *within |= found < 1.0;
                if found < closest.0 {
                    *closest = (found, n, [j, k]);
                }
            }
        }
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        let Particles { parts, planets: _, closest: (square, n, [planet, particle]), within } = self;
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
