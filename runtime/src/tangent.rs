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
mod vectors;

pub use adjoint::{Adjoint, Covector, gradient};
pub use growth::{Exponent, Growth, Regularity};
pub use vectors::{vector, with_derivatives};

use std::f64::consts::LN_2;

use thiserror::Error;

use crate::number::{Dual, Number};
use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;
use vectors::{log_norm, orthonormalise, set_vector};

/// A trajectory with tangent vectors, and the indicators of chaos that follow from these.
///
/// The vectors are those of one integrator of numbers [`Dual<N, K>`], or of several at the same state with K vectors each, which are counted through. Of
/// numbers in lanes each lane is a trajectory.
///
/// | indicator | vectors | |
/// | --- | --- | --- |
/// | [largest Lyapunov exponent](Growth::lyapunov), [MEGNO](Growth::megno) | 1, [free](Tangents::new) | [`Tangents::growth`] |
/// | SALI | 2, free | [`Tangents::sali`] |
/// | GALI_k | k, free | [`Tangents::gali`] |
/// | all Lyapunov exponents | as many, [orthonormal](Tangents::orthonormal) | [`Tangents::spectrum`] |
#[derive(Debug)]
pub struct Tangents<I> {
    integrators: Vec<I>,
    lanes: usize,
    /// Of the vector i and the lane l at i·lanes + l.
    growths: Vec<Growth>,
    divisors: Divisors,
}

/// By what vectors were divided when they were observed, in the order of their growths.
#[derive(Debug)]
enum Divisors {
    /// Vectors evolve freely. Exponents of 2.
    PowersOfTwo(Vec<i64>),
    /// Vectors are made orthonormal. Logarithms: Σ log R_jj of V = QR.
    Norms(Vec<f64>),
}

/// Why there are no indicators.
#[derive(Clone, Copy, PartialEq, Eq, Error)]
pub enum TangentError {
    /// The vector has no direction.
    #[error("the tangent vector {0} is 0 or not finite")]
    NoDirection(usize),
    /// There are no vectors.
    #[error("there are no tangent vectors")]
    NoVectors,
}

shadowstep_symbolic::debug_as_text!(TangentError);

/// Beyond 2^±SCALE a vector is multiplied by a power of 2, exactly.
const SCALE: f64 = 128.0;

impl<I, N, const K: usize> Tangents<I>
where
    N: Number,
    I: Integrator<Number = Dual<N, K>>,
{
    /// The trajectory of these integrators, at t = 0, with vectors that evolve freely.
    ///
    /// # Errors
    /// No vectors, or one that is 0 or not finite.
    pub fn new(integrators: Vec<I>) -> Result<Self, TangentError> {
        let mut found = Tangents::begin(integrators)?;
        let logarithms: Vec<_> = found.vectors().map(|vector| logarithms(&vector)).collect();
        found.growths = logarithms.iter().flatten().map(|logarithm| Growth::new(*logarithm)).collect();
        found.divisors = Divisors::PowersOfTwo(vec![0; found.growths.len()]);
        check(&logarithms).map(|()| found)
    }

    /// The same with vectors that are made orthonormal at each observation, for the Lyapunov exponents: of m vectors, at most 2n for n degrees of freedom,
    /// follow the m largest ones. Those of all 2n are pairs λ, −λ, and their sum is 0. With V = QR at each observation, λ_j is the mean rate at which
    /// Σ log R_jj grows.
    ///
    /// G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Meccanica 15 (1980) 9 and 21.
    ///
    /// # Errors
    /// No vectors, or vectors that are not linearly independent.
    pub fn orthonormal(integrators: Vec<I>) -> Result<Self, TangentError> {
        let mut found = Tangents::begin(integrators)?;
        let logarithms = found.orthonormalise();
        let count = logarithms.iter().flatten().count();
        found.growths = vec![Growth::new(0.0); count];
        found.divisors = Divisors::Norms(vec![0.0; count]);
        check(&logarithms).map(|()| found)
    }

    /// Goes on with free vectors that the [integrators](Tangents::integrators_mut) have now: with the growths of all vectors, and the powers of 2 by which they
    /// [were divided](Tangents::exponents), in the order of vectors and lanes.
    ///
    /// # Panics
    /// Numbers of growths or exponents that are not those of the vectors.
    pub fn resume(&mut self, growths: Vec<Growth>, exponents: Vec<i64>) {
        let count = self.growths.len();
        assert_eq!((growths.len(), exponents.len()), (count, count), "there is one for each vector and lane");
        (self.growths, self.divisors) = (growths, Divisors::PowersOfTwo(exponents));
    }

    /// Whether vectors evolve freely.
    pub fn are_free(&self) -> bool {
        self.exponents().is_some()
    }

    /// By which powers of 2 free vectors were divided so far; `None` of orthonormal ones.
    pub fn exponents(&self) -> Option<&[i64]> {
        match &self.divisors {
            Divisors::PowersOfTwo(exponents) => Some(exponents),
            Divisors::Norms(_) => None,
        }
    }

    fn begin(integrators: Vec<I>) -> Result<Self, TangentError> {
        match integrators.len() * K {
            0 => Err(TangentError::NoVectors),
            _ => Ok(Tangents {
                integrators,
                lanes: N::LANES,
                growths: Vec::new(),
                divisors: Divisors::Norms(Vec::new()),
            }),
        }
    }

    /// One step.
    pub fn step(&mut self) {
        self.integrators.iter_mut().for_each(|integrator| integrator.step(Carried::Nothing));
    }

    /// The growth of all vectors up to the present state, at t. Free vectors that became large or small are multiplied by a power of 2; orthonormal ones
    /// should not have grown by more than some 10⁶ since the last observation.
    pub fn observe(&mut self, t: f64) {
        if let Divisors::Norms(_) = self.divisors {
            return self.observe_norms(t.abs());
        }
        for i in 0..self.integrators.len() {
            for k in 0..K {
                self.observe_vector(i, k, t.abs());
            }
        }
    }

    fn observe_norms(&mut self, time: f64) {
        let logarithms = self.orthonormalise();
        let Divisors::Norms(sums) = &mut self.divisors else { unreachable!("vectors are orthonormal") };
        for ((growth, sum), added) in self.growths.iter_mut().zip(sums).zip(logarithms.iter().flatten()) {
            *sum += added;
            growth.observe(time, *sum);
        }
    }

    fn observe_vector(&mut self, i: usize, k: usize, time: f64) {
        let state = self.integrators[i].state();
        let components = state.q().iter().chain(state.p()).map(|x| &x.derivatives[k]);
        let first = (i * K + k) * self.lanes;
        let Divisors::PowersOfTwo(exponents) = &self.divisors else { unreachable!("vectors are free") };
        let mut rescale = false;
        for lane in 0..self.lanes {
            let logarithm = log_norm(components.clone(), lane);
            self.growths[first + lane].observe(time, logarithm + exponents[first + lane] as f64 * LN_2);
            rescale |= is_far(logarithm);
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
        let Divisors::PowersOfTwo(exponents) = &mut self.divisors else { unreachable!("vectors are free") };
        for lane in 0..self.lanes {
            let logarithm = log_norm(vector.iter(), lane);
            // others stay: a lane has the bits that it has alone
            let exponent = if is_far(logarithm) { (logarithm / LN_2).round() as i64 } else { 0 };
            factor.set_lane(lane, 1.0, -exponent);
            exponents[(i * K + k) * self.lanes + lane] += exponent;
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

    /// The integrators, to set their states with their vectors.
    pub fn integrators_mut(&mut self) -> &mut [I] {
        &mut self.integrators
    }

    /// How the vector grew, of the trajectory in a lane, up to the last observation.
    ///
    /// # Panics
    /// There are not as many vectors, or lanes.
    pub fn growth(&self, vector: usize, lane: usize) -> &Growth {
        assert!(lane < self.lanes, "there are {} lanes", self.lanes);
        &self.growths[vector * self.lanes + lane]
    }

    /// The growths of all vectors of the trajectory in a lane, those that grew most first: of orthonormal vectors they have the Lyapunov exponents.
    pub fn spectrum(&self, lane: usize) -> Vec<&Growth> {
        let mut found: Vec<_> = self.growths.iter().skip(lane).step_by(self.lanes).collect();
        found.sort_by(|a, b| b.logarithm().total_cmp(&a.logarithm()));
        found
    }

    /// Makes the vectors orthonormal; the logarithms by which they were divided, by vectors and lanes.
    fn orthonormalise(&mut self) -> Vec<Vec<f64>> {
        let mut vectors: Vec<_> = self.vectors().collect();
        let logarithms = orthonormalise(&mut vectors);
        for (integrator, own) in self.integrators.iter_mut().zip(vectors.chunks(K)) {
            let state = integrator.system().state_mut();
            own.iter().enumerate().for_each(|(k, vector)| set_vector(state, k, vector));
        }
        logarithms
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

/// Whether a vector with this log |δ| is to be multiplied by a power of 2.
fn is_far(logarithm: f64) -> bool {
    logarithm.is_finite() && logarithm.abs() > SCALE * LN_2
}

fn logarithms<N: Number>(vector: &[N]) -> Vec<f64> {
    (0..N::LANES).map(|lane| log_norm(vector.iter(), lane)).collect()
}

/// Refuses vectors without a direction.
fn check(logarithms: &[Vec<f64>]) -> Result<(), TangentError> {
    match logarithms.iter().position(|of_lanes| !of_lanes.iter().all(|x| x.is_finite())) {
        Some(vector) => Err(TangentError::NoDirection(vector)),
        None => Ok(()),
    }
}
