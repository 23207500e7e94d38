//! Tangent maps: how nearby trajectories separate, with indicators of chaos and derivatives of the end state.
//!
//! A step Φ of a scheme takes a tangent vector δ = (δq, δp) to DΦ δ: a kick is δp ← δp − h a U_qq δq, a drift δq ← δq + h b T_pp δp, and other flows have the
//! derivatives of their formulas. DΦ is symplectic, (DΦ)ᵀJ DΦ = J, whatever the step size. Vectors are carried along by the
//! numbers: of [`Dual`] numbers every system, scheme and number type has its tangent map, and q and p have the bits that they have without it.
//!
//! ```
//! use shadowstep::prelude::*;
//! use shadowstep::problems::HenonHeiles;
//! use shadowstep::tangent::{Regularity, Tangents, with_derivatives};
//!
//! let stepper = Stepper::new(shipped("yoshida4").unwrap(), "1/10")?;
//! let q = with_derivatives(&[0.0, -0.25], [&[1.0, 0.0]]);
//! let p = with_derivatives(&[0.42081, 0.0], [&[0.0, 1.0]]);
//! let motion = Motion::new(HenonHeiles, UnitMasses, q, p)?;
//! let mut tangents = Tangents::new(vec![stepper.with(motion)])?;
//! for n in 1..=20_000 {
//!     tangents.step();
//!     tangents.observe(0.1 * f64::from(n));
//! }
//! assert_eq!(tangents.growth(0, 0).regularity(), Regularity::Chaotic);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! C. Skokos, *The Lyapunov characteristic exponents and their computation*, Lect. Notes Phys. 790 (2010) 63, has the theory; C. Skokos, E. Gerlach,
//! Phys. Rev. E
//! 82 (2010) 036704 the tangent map of splitting schemes.

mod adjoint;
mod growth;
mod spectrum;
mod vectors;

pub use adjoint::{Adjoint, Covector, gradient};
pub use growth::{Exponent, Growth, Regularity};
pub use spectrum::Spectrum;
pub use vectors::{vector, with_derivatives};

use std::f64::consts::LN_2;

use thiserror::Error;

use crate::number::{Dual, Number};
use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;
use vectors::{log_norm, orthonormalise, set_vector};

/// A trajectory with tangent vectors that evolve freely, and the indicators of chaos that follow from these.
///
/// The vectors are those of one integrator of numbers [`Dual<N, K>`], or of several at the same state with K vectors each, which are counted through. Of
/// numbers in lanes each lane is a trajectory.
///
/// | indicator | vectors | |
/// | --- | --- | --- |
/// | [largest Lyapunov exponent](Growth::lyapunov), [MEGNO](Growth::megno) | 1 | [`Tangents::growth`] |
/// | SALI | 2 | [`Tangents::sali`] |
/// | GALI_k | k | [`Tangents::gali`] |
/// | all Lyapunov exponents | as many | [`Spectrum`] |
#[derive(Debug)]
pub struct Tangents<I> {
    integrators: Vec<I>,
    lanes: usize,
    /// Of the vector i and the lane l at i·lanes + l.
    growths: Vec<Growth>,
    /// By which factors, as exponents of 2, vectors were made smaller.
    scales: Vec<i64>,
}

/// Why there are no indicators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TangentError {
    /// The vector has no direction.
    #[error("the tangent vector {0} is 0 or not finite")]
    NoDirection(usize),
    /// There are no vectors.
    #[error("there are no tangent vectors")]
    NoVectors,
}

/// Beyond 2^±SCALE a vector is multiplied by a power of 2, exactly.
const SCALE: f64 = 128.0;

impl<I, N, const K: usize> Tangents<I>
where
    N: Number,
    I: Integrator<Number = Dual<N, K>>,
{
    /// The trajectory of these integrators, at t = 0.
    ///
    /// # Errors
    /// No vectors, or one that is 0 or not finite.
    pub fn new(integrators: Vec<I>) -> Result<Self, TangentError> {
        if integrators.is_empty() || K == 0 {
            return Err(TangentError::NoVectors);
        }
        let mut growths = Vec::new();
        for (i, integrator) in integrators.iter().enumerate() {
            for k in 0..K {
                let vector = vector(integrator.state(), k);
                let logarithms = (0..N::LANES).map(|lane| log_norm(vector.iter(), lane));
                growths.extend(logarithms.map(Growth::new));
                if !growths.iter().rev().take(N::LANES).all(Growth::is_finite) {
                    return Err(TangentError::NoDirection(i * K + k));
                }
            }
        }
        let scales = vec![0; growths.len()];
        Ok(Tangents { integrators, lanes: N::LANES, growths, scales })
    }

    /// One step.
    pub fn step(&mut self) {
        self.integrators.iter_mut().for_each(|integrator| integrator.step(Carried::Nothing));
    }

    /// The growth of all vectors up to the present state, at t. Vectors that became large or small are multiplied by a power of 2.
    pub fn observe(&mut self, t: f64) {
        for i in 0..self.integrators.len() {
            for k in 0..K {
                self.observe_vector(i, k, t.abs());
            }
        }
    }

    fn observe_vector(&mut self, i: usize, k: usize, time: f64) {
        let state = self.integrators[i].state();
        let components = state.q().iter().chain(state.p()).map(|x| &x.derivatives[k]);
        let first = (i * K + k) * self.lanes;
        let mut rescale = false;
        for lane in 0..self.lanes {
            let logarithm = log_norm(components.clone(), lane);
            self.growths[first + lane].observe(time, logarithm + self.scales[first + lane] as f64 * LN_2);
            rescale |= logarithm.abs() > SCALE * LN_2;
        }
        if rescale {
            self.rescale(i, k);
        }
    }

    #[cold]
    fn rescale(&mut self, i: usize, k: usize) {
        let state = self.integrators[i].state();
        let mut vector = vector(state, k);
        let mut factor = vector[0].clone();
        for lane in 0..self.lanes {
            let exponent = (log_norm(vector.iter(), lane) / LN_2).round();
            let exponent = if exponent.is_finite() { exponent as i64 } else { 0 };
            factor.set_lane(lane, 1.0, -exponent);
            self.scales[(i * K + k) * self.lanes + lane] += exponent;
        }
        vector.iter_mut().for_each(|x| x.multiply(&factor));
        set_vector(self.integrators[i].system().state_mut(), k, &vector);
    }

    /// How many vectors there are.
    pub fn count(&self) -> usize {
        self.growths.len() / self.lanes
    }

    /// The integrators, at the present state.
    pub fn integrators(&self) -> &[I] {
        &self.integrators
    }

    /// How the vector grew, of the trajectory in a lane, up to the last observation.
    ///
    /// # Panics
    /// There are not as many vectors, or lanes.
    pub fn growth(&self, vector: usize, lane: usize) -> &Growth {
        assert!(lane < self.lanes, "there are {} lanes", self.lanes);
        &self.growths[vector * self.lanes + lane]
    }

    /// The vectors.
    fn vectors(&self) -> impl Iterator<Item = Vec<N>> {
        self.integrators.iter().flat_map(|integrator| (0..K).map(|k| vector(integrator.state(), k)))
    }

    /// GALI_k, the volume of the parallelepiped of the unit vectors along the first k ones, in the trajectory of a lane. Along chaotic trajectories it
    /// goes to 0
    /// exponentially, along regular ones of n degrees of freedom not at all for k ≤ n, and by a power of t beyond.
    ///
    /// C. Skokos, T. Bountis, C. Antonopoulos, Physica D 231 (2007) 30.
    ///
    /// # Panics
    /// There are not as many vectors.
    pub fn gali(&self, k: usize, lane: usize) -> f64 {
        assert!(k <= self.count(), "there are {} vectors", self.count());
        let mut vectors: Vec<_> = self.vectors().take(k).collect();
        let norms: f64 = vectors.iter().map(|vector| log_norm(vector.iter(), lane)).sum();
        let volume: f64 = orthonormalise(&mut vectors).iter().map(|logarithms| logarithms[lane]).sum();
        (volume - norms).exp().min(1.0)
    }

    /// SALI, the smaller of |e₁ + e₂| and |e₁ − e₂| of the unit vectors along the first two: the angle between their lines. Along chaotic trajectories
    /// it goes to 0 exponentially.
    ///
    /// C. Skokos, J. Phys. A 34 (2001) 10029.
    ///
    /// # Panics
    /// There is one vector only.
    pub fn sali(&self, lane: usize) -> f64 {
        let sine = self.gali(2, lane);
        sine / ((1.0 + (1.0 - sine * sine).sqrt()) / 2.0).sqrt()
    }
}
