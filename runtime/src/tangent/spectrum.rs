//! All Lyapunov exponents.

use super::TangentError;
use super::growth::{Exponent, Growth};
use super::vectors::{orthonormalise, set_vector, vector};
use crate::number::{Dual, Number};
use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;

/// A trajectory with tangent vectors that are made orthonormal from time to time, and the Lyapunov exponents that follow from it.
///
/// Of m vectors, at most 2n for n degrees of freedom, follow the m largest exponents: those of all 2n are pairs λ, −λ, and their sum is 0. With V = QR at each
/// observation, λ_j is the mean rate at which Σ log R_jj grows.
///
/// G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9 and 21.
#[derive(Debug)]
pub struct Spectrum<I> {
    integrators: Vec<I>,
    lanes: usize,
    growths: Vec<Growth>,
    sums: Vec<f64>,
}

impl<I, N, const K: usize> Spectrum<I>
where
    N: Number,
    I: Integrator<Number = Dual<N, K>>,
{
    /// The trajectory of these integrators, at t = 0: of one, or of several at the same state with K vectors each, which are counted through.
    ///
    /// # Errors
    /// No vectors, or vectors that are not linearly independent.
    pub fn new(integrators: Vec<I>) -> Result<Self, TangentError> {
        if integrators.is_empty() || K == 0 {
            return Err(TangentError::NoVectors);
        }
        let count = integrators.len() * K * N::LANES;
        let mut found =
            Spectrum { integrators, lanes: N::LANES, growths: vec![Growth::new(0.0); count], sums: vec![0.0; count] };
        let first = found.orthonormalise();
        match first.iter().position(|logarithms| !logarithms.iter().all(|x| x.is_finite())) {
            Some(vector) => Err(TangentError::NoDirection(vector)),
            None => Ok(found),
        }
    }

    /// One step.
    pub fn step(&mut self) {
        self.integrators.iter_mut().for_each(|integrator| integrator.step(Carried::Nothing));
    }

    /// Makes the vectors orthonormal, and adds their growth up to the present state, at t, to that of before. Vectors should not
    /// have grown by more than some 10⁶ since the last observation.
    pub fn observe(&mut self, t: f64) {
        let logarithms = self.orthonormalise();
        for ((growth, sum), added) in self.growths.iter_mut().zip(&mut self.sums).zip(logarithms.iter().flatten()) {
            *sum += added;
            growth.observe(t.abs(), *sum);
        }
    }

    /// By vectors, and lanes.
    fn orthonormalise(&mut self) -> Vec<Vec<f64>> {
        let of = |integrator: &I| (0..K).map(|k| vector(integrator.state(), k)).collect::<Vec<_>>();
        let mut vectors: Vec<_> = self.integrators.iter().flat_map(of).collect();
        let logarithms = orthonormalise(&mut vectors);
        for (integrator, own) in self.integrators.iter_mut().zip(vectors.chunks(K)) {
            let state = integrator.system().state_mut();
            own.iter().enumerate().for_each(|(k, vector)| set_vector(state, k, vector));
        }
        logarithms
    }

    /// The integrators, at the present state.
    pub fn integrators(&self) -> &[I] {
        &self.integrators
    }

    /// The exponents over the last three quarters of the trajectory with their errors, the largest first: see [`Growth::exponent`].
    pub fn estimates(&self, lane: usize) -> Option<Vec<Exponent>> {
        self.growths(lane).into_iter().map(Growth::exponent).collect()
    }

    /// The growth of Σ log R_jj of each exponent, the largest first.
    pub fn growths(&self, lane: usize) -> Vec<&Growth> {
        let mut found: Vec<_> = self.of_lane(lane).collect();
        found.sort_by(|a, b| b.logarithm().total_cmp(&a.logarithm()));
        found
    }

    fn of_lane(&self, lane: usize) -> impl Iterator<Item = &Growth> {
        self.growths.iter().skip(lane).step_by(self.lanes)
    }
}
