//! Where the bodies of a run are, in double precision: at several states at once, each in a lane.

use std::array;

use shadowstep::Real;
use shadowstep::number::Lanes;

use crate::scene::split::{CanonicalCoordinates, Positions};
use crate::scene::{PotentialEnergy, System};

/// The states that are looked at together: most of them show nothing, which is found in vectors, a state in each lane.
pub(super) const STATES: usize = 8;

/// A number of each state.
pub(super) type Each = Lanes<STATES>;

/// A place in space, or in fewer dimensions with zeros.
pub(super) type Place = [f64; 3];

/// Where bodies are.
pub(super) struct Places {
    dimensions: usize,
    /// The coordinates of the steps, of planets.
    planets: Option<(CanonicalCoordinates, Positions<Each>)>,
    /// The n of the states.
    n: Vec<i64>,
    q: Vec<Each>,
    /// How many of them are those of bodies with mass.
    massive: usize,
    /// Of planets, their coordinates in an inertial frame.
    inertial: Vec<Each>,
    /// Bodies with mass, in an inertial frame.
    pub(super) bodies: Vec<[Each; 3]>,
    /// All bodies, those with mass first, relative to the centre of mass, or to the first body; of what are no planets
    /// to the origin of all.
    pub(super) relative: Vec<[Each; 3]>,
}

impl Places {
    pub(super) fn of(system: &System) -> Places {
        let planets = system.parts.planets().map(|of_all| of_all.without_particles());
        let (bodies, dimensions) = match (&planets, &system.potential) {
            (Some(planets), _) => (planets.bodies.masses().len(), planets.dimensions),
            (None, PotentialEnergy::Pairs(pairs)) => (pairs.bodies - pairs.particles, pairs.dimensions),
            (None, _) => (0, 1),
        };
        let (zero, massive) = (Each::all(0.0), bodies * dimensions);
        Places {
            dimensions,
            n: Vec::with_capacity(STATES),
            q: vec![zero; system.q.len()],
            massive,
            inertial: vec![zero; if planets.is_some() { massive } else { 0 }],
            bodies: vec![[zero; 3]; bodies],
            relative: vec![[zero; 3]; system.q.len() / dimensions],
            planets: planets.map(|planets| (planets.coordinates, planets.inertial_positions())),
        }
    }

    /// Takes the state n in the coordinates of the steps, but not one whose bodies are so far away that cubes of
    /// distances overflow. Whether there is no room for another one.
    pub(super) fn take<N: Real>(&mut self, n: i64, q: &[N]) -> bool {
        const FARTHEST: f64 = 1e100;
        let (state, mut are_near) = (self.n.len(), true);
        for (coordinate, x) in self.q.iter_mut().zip(q) {
            coordinate.0[state] = x.to_f64();
            are_near &= coordinate.0[state].abs() < FARTHEST;
        }
        if are_near {
            self.n.push(n);
        }
        self.n.len() == STATES
    }

    /// Finds where the bodies are at the states that were taken.
    pub(super) fn arrange(&mut self) {
        let Places { dimensions, planets, q, massive, inertial, bodies, relative, .. } = self;
        let (mut of_massive, particles) = q.split_at(*massive);
        let mut origin = [Each::all(0.0); 3];
        if let Some((coordinates, positions)) = planets {
            positions(of_massive, inertial);
            origin[..*dimensions].copy_from_slice(match coordinates {
                CanonicalCoordinates::Jacobi => &of_massive[..*dimensions],
                CanonicalCoordinates::DemocraticHeliocentric => &inertial[..*dimensions],
            });
            of_massive = inertial;
        }
        let copy = |to: &mut [Each; 3], from: &[Each]| to[..*dimensions].copy_from_slice(from);
        bodies.iter_mut().zip(of_massive.chunks_exact(*dimensions)).for_each(|(to, from)| copy(to, from));
        let (of_bodies, of_particles) = relative.split_at_mut(bodies.len());
        for (to, from) in of_bodies.iter_mut().zip(bodies) {
            *to = array::from_fn(|axis| Lanes(array::from_fn(|state| from[axis].0[state] - origin[axis].0[state])));
        }
        of_particles.iter_mut().zip(particles.chunks_exact(*dimensions)).for_each(|(to, from)| copy(to, from));
    }

    /// The states that were taken, each as its lane and its n.
    pub(super) fn states(&self) -> impl DoubleEndedIterator<Item = (usize, i64)> + ExactSizeIterator {
        self.n.iter().copied().enumerate()
    }

    /// Goes on to other states.
    pub(super) fn clear(&mut self) {
        self.n.clear();
    }

    /// Those of bodies with mass at a state, in the coordinates of the steps.
    pub(super) fn of_steps(&self, state: usize) -> Vec<f64> {
        self.q[..self.massive].iter().map(|x| x.0[state]).collect()
    }
}

/// Where a body is at one of the states.
pub(super) fn at(body: &[Each; 3], state: usize) -> Place {
    array::from_fn(|axis| body[axis].0[state])
}

/// The squares of the distances of two bodies.
#[inline(always)]
pub(super) fn squares(a: &[Each; 3], b: &[Each; 3]) -> Each {
    let mut squares = Each::all(0.0);
    for state in 0..STATES {
        let [x, y, z] = [a[0].0[state] - b[0].0[state], a[1].0[state] - b[1].0[state], a[2].0[state] - b[2].0[state]];
        squares.0[state] = x * x + y * y + z * z;
    }
    squares
}

#[inline(always)]
pub(super) fn roots(squares: &Each) -> Each {
    let mut roots = *squares;
    roots.0.iter_mut().for_each(|x| *x = x.sqrt());
    roots
}

/// The smaller number; `other` where x is NaN.
#[inline(always)]
pub(super) fn least_of(x: f64, other: f64) -> f64 {
    if x < other { x } else { other }
}

pub(super) fn difference(a: &Place, b: &Place) -> Place {
    array::from_fn(|axis| a[axis] - b[axis])
}

pub(super) fn dot(a: &Place, b: &Place) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
