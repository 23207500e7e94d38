//! Particles of mass 0 in the field of the bodies.

use crate::Rational;
use crate::number::Number;
use crate::systems::pairs::{Field, Gravity, PairPotential, with_a_particle};

use super::bodies::Bodies;
use super::interactions::curved;

/// The forces on particles in kicks. Their momenta and gradients are divided by their mass.
#[derive(Clone, Debug)]
pub(super) struct Particles<N, const D: usize> {
    gravity: Gravity<N>,
    scratch: Vec<N>,
    curvature_scratch: Vec<N>,
    /// The positions of what attracts, and a direction in which it moves.
    bodies: Vec<N>,
    directions: Vec<N>,
}

impl<N: Number, const D: usize> Particles<N, D> {
    /// Those of the bodies, if there are any, attracted by these masses.
    pub(super) fn new(bodies: &Bodies, attracting: &[Rational], context: &N::Context) -> Option<Box<Self>> {
        let number = |value: &Rational| N::from_rational(value, context);
        let zeros = |count| vec![N::zero(context); count];
        let gravity = Gravity { g: number(&bodies.g), m: with_a_particle(attracting.iter().map(number), context) };
        let (mut scratch, mut curvature_scratch) =
            (zeros(gravity.scratch()), zeros(curved(&gravity).curvature_scratch()));
        gravity.prepare(&mut scratch, context);
        curved(&gravity).prepare_curvature(&mut curvature_scratch, context);
        let [bodies_at, directions] = [(); 2].map(|()| zeros(attracting.len() * D));
        let particles = Particles { gravity, scratch, curvature_scratch, bodies: bodies_at, directions };
        (bodies.particles > 0).then(|| Box::new(particles))
    }

    /// The positions of what attracts, to be set.
    pub(super) fn bodies(&mut self) -> &mut [N] {
        &mut self.bodies
    }

    /// A direction in which it moves, to be set.
    pub(super) fn directions(&mut self) -> &mut [N] {
        &mut self.directions
    }

    /// gradient ← minus the accelerations of particles at q
    pub(super) fn assign_gradient(&mut self, q: &[N], gradient: &mut [N]) {
        let Particles { gravity, scratch, bodies, .. } = self;
        Field::<_, D> { pair: &*gravity, bodies: bodies.len() / D }.assign_gradient(bodies, q, gradient, scratch);
    }

    /// product ← the derivative of that in the direction in which particles at q move by v
    pub(super) fn assign_product(&mut self, [q, v]: [&[N]; 2], product: &mut [N]) {
        let Particles { gravity, curvature_scratch, bodies, directions, .. } = self;
        let field = Field::<_, D> { pair: &*gravity, bodies: bodies.len() / D };
        field.assign_product([bodies, directions], [q, v], product, curvature_scratch);
    }
}
