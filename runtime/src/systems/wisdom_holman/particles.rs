//! Particles of mass 0 in the field of the bodies.

use crate::Rational;
use crate::number::Number;
use crate::systems::pairs::{Cutoff, Field, Gravity, PairPotential, Shell, with_a_particle};

use super::bodies::Bodies;
use super::interactions::{are_near, curved};

/// The forces on particles in kicks. Their momenta and gradients are divided by their mass.
#[derive(Clone, Debug)]
pub(super) struct Particles<N, const D: usize> {
    gravity: Gravity<N>,
    scratch: Vec<N>,
    /// What kicks have of it, where close planets attract particles in drifts: below this distance.
    kicks: Option<(AttractionInShell<N>, f64)>,
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
        let particles = Particles { gravity, scratch, kicks: None, curvature_scratch, bodies: bodies_at, directions };
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

    /// Leaves what a cutoff has of the attraction to others, which is switched.
    pub(super) fn leave_near(&mut self, bodies: &Bodies, cutoff: &Cutoff<D>, context: &N::Context) {
        let radius = <f64 as Number>::from_rational(cutoff.radius(), &());
        self.kicks = Some((AttractionInShell::new(bodies, None, Some(cutoff), context), radius));
    }

    /// gradient ← minus the accelerations of particles at q
    pub(super) fn assign_gradient(&mut self, q: &[N], gradient: &mut [N]) {
        let Particles { gravity, scratch, kicks, bodies, .. } = self;
        Field::<_, D> { pair: &*gravity, bodies: bodies.len() / D }.assign_gradient(bodies, q, gradient, scratch);
        let Some((kicks, radius)) = kicks else { return };
        // one by one, so that the bits of a particle do not depend on others
        for (q, gradient) in q.chunks_exact(D).zip(gradient.chunks_exact_mut(D)) {
            if bodies.chunks_exact(D).any(|body| are_near(body, q, *radius)) {
                kicks.assign_gradient::<D>(bodies, q, gradient);
            }
        }
    }

    /// product ← the derivative of that in the direction in which particles at q move by v
    pub(super) fn assign_product(&mut self, [q, v]: [&[N]; 2], product: &mut [N]) {
        let Particles { gravity, curvature_scratch, bodies, directions, .. } = self;
        let field = Field::<_, D> { pair: &*gravity, bodies: bodies.len() / D };
        field.assign_product([bodies, directions], [q, v], product, curvature_scratch);
    }
}

/// The attraction of a particle by planets at some distances.
#[derive(Clone, Debug)]
pub(super) struct AttractionInShell<N> {
    pair: Shell<Gravity<N>>,
    scratch: Vec<N>,
}

impl<N: Number> AttractionInShell<N> {
    /// Between the switches of these cutoffs.
    pub(super) fn new<const D: usize>(
        bodies: &Bodies,
        outer: Option<&Cutoff<D>>,
        inner: Option<&Cutoff<D>>,
        context: &N::Context,
    ) -> Self {
        let number = |value: &Rational| N::from_rational(value, context);
        let gravity =
            Gravity { g: number(&bodies.g), m: with_a_particle(bodies.masses[1..].iter().map(number), context) };
        let pair = Shell::new(gravity, outer, inner);
        let mut scratch = vec![N::zero(context); pair.scratch()];
        pair.prepare(&mut scratch, context);
        AttractionInShell { pair, scratch }
    }

    /// gradient ← minus the acceleration of a particle at q
    pub(super) fn assign_gradient<const D: usize>(&mut self, planets: &[N], q: &[N], gradient: &mut [N]) {
        let field = Field::<_, D> { pair: &self.pair, bodies: planets.len() / D };
        field.assign_gradient(planets, q, gradient, &mut self.scratch);
    }
}
