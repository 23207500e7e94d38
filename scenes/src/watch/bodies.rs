//! The bodies of a run about a central one: how close they come to each other, and whether the steps resolve that.

use shadowstep::Real;
use shadowstep::number::saved::Fields;

use super::approaches::{Approaches, Interactions};
use super::light::{LightBodies, LightBody};
use crate::scene::split::{CanonicalCoordinates, Positions};
use crate::scene::{PotentialEnergy, System};

/// Follows the bodies of a run in double precision.
pub struct Bodies {
    places: Places,
    approaches: Option<Approaches>,
    light: Option<LightBodies>,
}

impl Bodies {
    /// `None` of a system without planets and light bodies. ε of planets, which costs as much as the forces of a step, is that of some thousand states, and then of
    /// those whose n is a multiple of `every`; light bodies are followed in steps of h, if that is given.
    pub fn of(system: &System, every: u64, h: Option<f64>) -> Option<Bodies> {
        let approaches = Approaches::of(system, every);
        let light = h.and_then(|h| LightBodies::of(system, h));
        (approaches.is_some() || light.is_some()).then(|| Bodies { places: Places::of(system), approaches, light })
    }

    /// Takes the state n after the last one, in the coordinates of the steps.
    pub fn include<N: Real>(&mut self, n: i64, q: &[N]) {
        let Bodies { places, approaches, light } = self;
        places.take(q);
        approaches.iter_mut().for_each(|approaches| approaches.include(n, places));
        light.iter_mut().for_each(|light| light.include(n, places));
    }

    /// What the states so far have shown of planets.
    pub fn interactions(&self) -> Option<Interactions> {
        self.approaches.as_ref().map(Approaches::found)
    }

    /// What they have shown of light bodies that were near a planet.
    pub fn light(&self) -> Vec<LightBody> {
        self.light.as_ref().map_or(Vec::new(), LightBodies::found)
    }

    pub(super) fn fields<N>(&mut self, to: &mut dyn Fields<N>) {
        self.approaches.iter_mut().for_each(|approaches| approaches.fields(to));
        self.light.iter_mut().for_each(|light| light.fields(to));
    }
}

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
    fn of(system: &System) -> Places {
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

    fn take<N: Real>(&mut self, q: &[N]) {
        self.q.clear();
        self.q.extend(q.iter().map(Real::to_f64));
        if let Some((_, positions)) = &mut self.planets {
            positions(&self.q[..self.massive], &mut self.inertial);
        }
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
