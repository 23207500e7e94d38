//! A potential beside the attraction of the bodies, as a part of B.
//!
//! It is a function V(x) of the inertial positions x = LQ, which are linear in those of the steps. So V_Q = LᵀV_x,
//! which is how momenta are converted, V_QQ v = LᵀV_xx Lv, and the rate of β is the same in both: QᵀV_Q − 2V = xᵀV_x −
//! 2V.

use crate::number::Number;
use crate::systems::potential::{Potential, Prepared};

use super::coordinates::PlanetaryCoordinates;

/// That there is no potential beside the attraction.
#[derive(Clone, Copy, Debug)]
pub enum NoPotential {}

impl<N: Number> Potential<N> for NoPotential {
    fn dimension(&self) -> usize {
        match *self {}
    }

    fn energy(&self, _: &[N], _: &mut N, _: &mut [N]) {
        match *self {}
    }

    fn gradient(&self, _: &[N], _: &mut [N], _: &mut [N]) {
        match *self {}
    }
}

/// A potential of inertial positions with its scratch space.
#[derive(Clone, Debug)]
pub(super) struct Beside<N, P> {
    potential: Prepared<N, P>,
    /// x, and a direction there.
    positions: Vec<N>,
    direction: Vec<N>,
    /// V_x or V_xx Lv, and the same by Q.
    slopes: Vec<N>,
    converted: Vec<N>,
    /// The rate, or V.
    sum: N,
}

impl<N: Number, P: Potential<N>> Beside<N, P> {
    pub(super) fn new(potential: P, context: &N::Context) -> Self {
        let [positions, direction, slopes, converted] = [(); 4].map(|()| vec![N::zero(context); potential.dimension()]);
        let potential = Prepared::new(potential, context);
        Beside { potential, positions, direction, slopes, converted, sum: N::zero(context) }
    }

    pub(super) fn has_hessian(&self) -> bool {
        self.potential.function.hessian().is_some()
    }

    /// Adds V_Q to a gradient and, if asked for, QᵀV_Q − 2V to a rate.
    pub(super) fn add_gradient<C: PlanetaryCoordinates<N, D>, const D: usize>(
        &mut self,
        coordinates: &mut C,
        q: &[N],
        gradient: &mut [N],
        rate: Option<&mut N>,
    ) {
        let Beside { potential, positions, slopes, sum, .. } = self;
        coordinates.assign_inertial_positions(q, positions);
        potential.gradient(positions, slopes, rate.is_some().then_some(&mut *sum));
        rate.into_iter().for_each(|rate| rate.add(sum));
        self.add_slopes::<C, D>(coordinates, gradient);
    }

    /// Adds V_QQ v to a product.
    pub(super) fn add_hessian_product<C: PlanetaryCoordinates<N, D>, const D: usize>(
        &mut self,
        coordinates: &mut C,
        (q, v): (&[N], &[N]),
        product: &mut [N],
    ) {
        let Beside { potential, positions, direction, slopes, .. } = self;
        coordinates.assign_inertial_positions(q, positions);
        coordinates.assign_inertial_positions(v, direction);
        potential.hessian_product(positions, direction, slopes, None);
        self.add_slopes::<C, D>(coordinates, product);
    }

    /// Adds V to an energy; q may have the bodies with mass alone, as particles have no energy.
    pub(super) fn add_energy<C: PlanetaryCoordinates<N, D>, const D: usize>(
        &mut self,
        coordinates: &mut C,
        q: &[N],
        energy: &mut N,
    ) {
        let Beside { potential, positions, sum, .. } = self;
        coordinates.assign_inertial_positions(q, &mut positions[..q.len()]);
        potential.energy(positions, sum);
        energy.add(sum);
    }

    fn add_slopes<C: PlanetaryCoordinates<N, D>, const D: usize>(&mut self, coordinates: &mut C, sums: &mut [N]) {
        coordinates.assign_momenta(&self.slopes, &mut self.converted);
        sums.iter_mut().zip(&self.converted).for_each(|(sum, slope)| sum.add(slope));
    }
}
