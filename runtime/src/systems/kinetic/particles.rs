//! T of bodies, with particles of mass 0 after them.

use super::{InverseMasses, Kinetic};
use crate::number::Number;

/// T of the first coordinates. Those after them are of particles of mass 0, whose momenta are divided by their mass:
/// they have no energy, and drift by K as those of mass 1.
///
/// See [`PairsAndParticles`](crate::systems::pairs::PairsAndParticles).
#[derive(Clone, Debug)]
pub struct WithParticles<K> {
    kinetic: K,
    massive: usize,
}

impl<K> WithParticles<K> {
    /// With a K of all coordinates, the first `massive` of which have an energy.
    pub fn new(kinetic: K, massive: usize) -> Self {
        WithParticles { kinetic, massive }
    }
}

impl<N: Number, K: Kinetic<N>> Kinetic<N> for WithParticles<K> {
    type Class = K::Class;

    fn dimension(&self) -> Option<usize> {
        self.kinetic.dimension()
    }

    fn scratch(&self) -> usize {
        self.kinetic.scratch()
    }

    fn prepare(&self, scratch: &mut [N], context: &N::Context) {
        self.kinetic.prepare(scratch, context);
    }

    #[inline(always)]
    fn drift(&self, weight: &N, p: &[N], q: &mut [N], scratch: &mut [N]) {
        self.kinetic.drift(weight, p, q, scratch);
    }

    /// T is quadratic: it adds nothing to β.
    fn drift_augmented(&self, weight: &N, p: &[N], q: &mut [N], _: &mut N, scratch: &mut [N]) {
        self.kinetic.drift(weight, p, q, scratch);
    }

    fn energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        self.kinetic.energy(&p[..self.massive], energy, scratch);
    }

    fn exchanged_energy(&self, p: &[N], energy: &mut N, scratch: &mut [N]) {
        self.kinetic.exchanged_energy(&p[..self.massive], energy, scratch);
    }

    fn inverse_masses(&self) -> Option<InverseMasses<'_, N>> {
        self.kinetic.inverse_masses()
    }

    fn massive_coordinates(&self, _: usize) -> usize {
        self.massive
    }
}
