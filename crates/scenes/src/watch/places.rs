//! Where the bodies of a run are, in double precision.

use shadowstep::Real;

use crate::scene::split::{CanonicalCoordinates, Positions};
use crate::scene::{PotentialEnergy, System};

/// Where bodies are.
pub(super) struct Places {
    pub(super) dimensions: usize,
    /// The coordinates of the steps, of planets.
    planets: Option<(CanonicalCoordinates, Positions<f64>)>,
    q: Vec<f64>,
    /// How many of them are those of bodies with mass.
    massive: usize,
    /// Of planets.
    inertial: Vec<f64>,
}

impl Places {
    pub(super) fn of(system: &System) -> Places {
        let planets = system.parts.planets().map(|of_all| of_all.without_particles());
        let (bodies, dimensions) = match (&planets, &system.potential) {
            (Some(planets), _) => (planets.bodies.masses().len(), planets.dimensions),
            (None, PotentialEnergy::Pairs(pairs)) => (pairs.bodies - pairs.particles, pairs.dimensions),
            (None, _) => (0, 1),
        };
        let massive = bodies * dimensions;
        Places {
            dimensions,
            q: Vec::with_capacity(system.q.len()),
            massive,
            inertial: vec![0.0; if planets.is_some() { massive } else { 0 }],
            planets: planets.map(|planets| (planets.coordinates, planets.inertial_positions())),
        }
    }

    /// Takes a state in the coordinates of the steps; whether its bodies are so near that cubes of distances do not
    /// overflow.
    pub(super) fn take<N: Real>(&mut self, q: &[N]) -> bool {
        const FARTHEST: f64 = 1e100;
        self.q.clear();
        self.q.extend(q.iter().map(Real::to_f64));
        if let Some((_, positions)) = &mut self.planets {
            positions(&self.q[..self.massive], &mut self.inertial);
        }
        // without an end before the last one: in vectors
        self.q.iter().fold(true, |all, x| all & (x.abs() < FARTHEST))
    }

    /// Those of bodies with mass, in the coordinates of the steps.
    pub(super) fn of_steps(&self) -> &[f64] {
        &self.q[..self.massive]
    }

    /// Those of bodies with mass, in an inertial frame.
    pub(super) fn inertial(&self) -> &[f64] {
        if self.planets.is_some() { &self.inertial } else { self.of_steps() }
    }

    /// Those of particles, relative to the origin.
    pub(super) fn particles(&self) -> &[f64] {
        &self.q[self.massive..]
    }

    /// The centre of mass, or the first body; of what are no planets the origin of all.
    pub(super) fn origin(&self) -> [f64; 3] {
        let mut origin = [0.0; 3];
        if let Some((coordinates, _)) = &self.planets {
            origin[..self.dimensions].copy_from_slice(match coordinates {
                CanonicalCoordinates::Jacobi => &self.q[..self.dimensions],
                CanonicalCoordinates::DemocraticHeliocentric => &self.inertial[..self.dimensions],
            });
        }
        origin
    }
}
