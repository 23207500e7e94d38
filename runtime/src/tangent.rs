//! Tangent maps: how nearby trajectories separate, with indicators of chaos and derivatives of the end state.
//!
//! A step Φ of a scheme takes a tangent vector δ = (δq, δp) to DΦ δ: a kick is δp ← δp − h a U_qq δq, a drift δq ← δq +
//! h b T_pp δp, and other flows have the derivatives of their formulas. DΦ is symplectic, (DΦ)ᵀJ DΦ = J, whatever the
//! step size. Vectors are carried along by the numbers: of [`Dual`] numbers every system, scheme and number type has
//! its tangent map, and q and p have the bits that they have without it.
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
//! C. Skokos, *The Lyapunov characteristic exponents and their computation*, Lect. Notes Phys. 790 (2010) 63, has the
//! theory; C. Skokos, E. Gerlach, Phys. Rev. E 82 (2010) 036704 the tangent map of splitting schemes.

mod adjoint;
mod frame;
mod growth;
mod vectors;

pub use adjoint::{Adjoint, Covector, gradient};
pub use growth::{Exponent, Growth, Regularity};
pub use vectors::{vector, with_derivatives};

use std::f64::consts::LN_2;

use thiserror::Error;

use crate::number::{Dual, Number, scaled};
use crate::steps::integrator::Integrator;
use crate::systems::increments::Carried;
use frame::Frame;
use vectors::{Column, log_norm, orthonormalise, set_vector};

/// A trajectory with tangent vectors, and the indicators of chaos that follow from these.
///
/// The vectors are those of one integrator of numbers [`Dual<N, K>`], or of several at the same state with K vectors
/// each, which are counted through. Of numbers in lanes each lane is a trajectory.
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
    /// What free vectors are, of each lane: those after the first are combinations of what the integrators carry along.
    frames: Vec<Frame>,
}

/// By what vectors were divided when they were observed, in the order of their growths.
#[derive(Debug)]
enum Divisors {
    /// Vectors evolve freely. Exponents of 2 of the first one in each lane; 0 of the others.
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

shadowstep_schemes::debug_as_text!(TangentError);

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
        check(&logarithms)?;
        found.frames = vec![Frame::new(logarithms.len()); found.lanes];
        found.separate();
        Ok(found)
    }

    /// The same with vectors that are made orthonormal at each observation, for the Lyapunov exponents: of m vectors,
    /// at most 2n for n degrees of freedom, follow the m largest ones. Those of all 2n are pairs λ, −λ, and their sum
    /// is 0. With V = QR at each observation, λ_j is the mean rate at which Σ log R_jj grows.
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

    /// Goes on with free vectors that the [integrators](Tangents::integrators_mut) have now: with the growths of all
    /// vectors, the powers of 2 by which they [were divided](Tangents::exponents), and
    /// [what they are](Tangents::combinations), in the order of vectors and lanes. Whether these fit.
    pub fn resume(&mut self, growths: Vec<Growth>, exponents: Vec<i64>, combinations: &[Vec<f64>]) -> bool {
        let count = self.growths.len();
        let of_lane = |lane| {
            let parts: Vec<&[f64]> = combinations.iter().skip(lane).step_by(self.lanes).map(Vec::as_slice).collect();
            Frame::of_parts(&parts)
        };
        let frames: Option<Vec<_>> = (0..self.lanes).map(of_lane).collect();
        let fits = [growths.len(), exponents.len(), combinations.len()] == [count; 3];
        let Some(frames) = frames.filter(|_| fits) else { return false };
        (self.growths, self.divisors, self.frames) = (growths, Divisors::PowersOfTwo(exponents), frames);
        true
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

    /// What free vectors are: each as a combination of the vectors of the integrators, with logarithms of lengths; what
    /// [`resume`](Tangents::resume) needs.
    pub fn combinations(&self) -> Vec<Vec<f64>> {
        let vectors = 0..self.count() * usize::from(self.are_free());
        vectors.flat_map(|vector| self.frames.iter().map(move |frame| frame.parts(vector))).collect()
    }

    fn begin(integrators: Vec<I>) -> Result<Self, TangentError> {
        match integrators.len() * K {
            0 => Err(TangentError::NoVectors),
            _ => Ok(Tangents {
                integrators,
                lanes: N::LANES,
                growths: Vec::new(),
                divisors: Divisors::Norms(Vec::new()),
                frames: Vec::new(),
            }),
        }
    }

    /// One step.
    pub fn step(&mut self) {
        self.integrators.iter_mut().for_each(|integrator| integrator.step(Carried::Nothing));
    }

    /// The growth of all vectors up to the present state, at t. A free vector that became large or small is multiplied
    /// by a power of 2. Between two observations vectors should not have grown by more than some 10⁶, where there are
    /// several; see [`separate`](Tangents::separate).
    pub fn observe(&mut self, t: f64) {
        if let Divisors::Norms(_) = self.divisors {
            return self.observe_norms(t.abs());
        }
        self.separate();
        for (i, growth) in self.growths.iter_mut().enumerate() {
            growth.observe(t.abs(), self.frames[i % self.lanes].length(i / self.lanes));
        }
        if (0..self.lanes).any(|lane| is_far(self.log_of_first(lane))) {
            self.rescale();
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

    /// Takes from free vectors after the first what they have along those before, so that they do not turn to one
    /// direction: what they are stays known. An [observation](Tangents::observe) does it, too; it changes no
    /// [`growth`](Tangents::growth).
    pub fn separate(&mut self) {
        let Divisors::PowersOfTwo(exponents) = &self.divisors else { return };
        let length = |lane: usize| self.log_of_first(lane) + exponents[lane] as f64 * LN_2;
        let lengths: Vec<f64> = (0..self.lanes).map(length).collect();
        if self.count() > 1 {
            let mut vectors: Vec<_> = self.vectors().collect();
            let columns = orthonormalise(&mut vectors);
            for (i, vector) in vectors.iter().enumerate().skip(1) {
                set_vector(self.integrators[i / K].system().state_mut(), i % K, vector);
            }
            for (lane, frame) in self.frames.iter_mut().enumerate() {
                let mut diagonal: Vec<f64> = columns.iter().map(|column| column.logarithms[lane]).collect();
                // the first one is not divided by its length
                diagonal[0] = lengths[lane] - frame.length(0);
                frame.advance(&diagonal, &above(&columns, lane));
            }
        }
        self.frames.iter_mut().zip(lengths).for_each(|(frame, length)| frame.set_first_length(length));
    }

    /// log |δ| of the first vector as it is carried along.
    fn log_of_first(&self, lane: usize) -> f64 {
        let state = self.integrators[0].state();
        log_norm(state.q().iter().chain(state.p()).map(|x| &x.derivatives[0]), lane)
    }

    #[cold]
    fn rescale(&mut self) {
        let mut vector = vector(self.integrators[0].state(), 0);
        let mut factor = vector[0].clone();
        let Divisors::PowersOfTwo(exponents) = &mut self.divisors else { unreachable!("vectors are free") };
        for (lane, own) in exponents.iter_mut().enumerate().take(self.lanes) {
            let logarithm = log_norm(vector.iter(), lane);
            // others stay: a lane has the bits that it has alone
            let exponent = if is_far(logarithm) { (logarithm / LN_2).round() as i64 } else { 0 };
            factor.set_lane(lane, 1.0, -exponent);
            *own += exponent;
        }
        vector.iter_mut().for_each(|x| x.multiply(&factor));
        set_vector(self.integrators[0].system().state_mut(), 0, &vector);
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

    /// The growths of all vectors of the trajectory in a lane, those that grew most first: of orthonormal vectors they
    /// have the Lyapunov exponents.
    pub fn spectrum(&self, lane: usize) -> Vec<&Growth> {
        let mut found: Vec<_> = self.growths.iter().skip(lane).step_by(self.lanes).collect();
        found.sort_by(|a, b| b.logarithm().total_cmp(&a.logarithm()));
        found
    }

    /// Makes the vectors orthonormal; the logarithms by which they were divided, by vectors and lanes.
    fn orthonormalise(&mut self) -> Vec<Vec<f64>> {
        let mut vectors: Vec<_> = self.vectors().collect();
        let columns = orthonormalise(&mut vectors);
        for (integrator, own) in self.integrators.iter_mut().zip(vectors.chunks(K)) {
            let state = integrator.system().state_mut();
            own.iter().enumerate().for_each(|(k, vector)| set_vector(state, k, vector));
        }
        columns.into_iter().map(|column| column.logarithms).collect()
    }

    /// The vectors.
    fn vectors(&self) -> impl Iterator<Item = Vec<N>> {
        self.integrators.iter().flat_map(|integrator| (0..K).map(|k| vector(integrator.state(), k)))
    }

    /// GALI_k at the last observation, the volume of the parallelepiped of the unit vectors along the first k ones, in
    /// the trajectory of a lane. Along chaotic trajectories it goes to 0 exponentially, along regular ones of n degrees
    /// of freedom not at all for k ≤ n, and by a power of t beyond.
    ///
    /// It is a product of factors R_jj of V = QR at all observations, and has no floor by round-off: it is right to
    /// rounding down to 10⁻³⁰⁸, below which it is 0.
    ///
    /// C. Skokos, T. Bountis, C. Antonopoulos, Physica D 231 (2007) 30; by factors C. Skokos, T. Bountis, C.
    /// Antonopoulos, Eur. Phys. J. Spec. Top. 165 (2008) 5.
    ///
    /// # Panics
    /// There are not as many vectors, or they are orthonormal.
    pub fn gali(&self, k: usize, lane: usize) -> f64 {
        assert!(k <= self.count(), "there are {} vectors", self.count());
        assert!(self.are_free(), "orthonormal vectors have no GALI");
        self.frames[lane].volume(k)
    }

    /// SALI at the last observation, the smaller of |e₁ + e₂| and |e₁ − e₂| of the unit vectors along the first two:
    /// the angle between their lines. Along chaotic trajectories it goes to 0 exponentially. It has no floor, as
    /// [`gali`](Tangents::gali).
    ///
    /// C. Skokos, J. Phys. A 34 (2001) 10029.
    ///
    /// # Panics
    /// There is one vector only, or vectors are orthonormal.
    pub fn sali(&self, lane: usize) -> f64 {
        assert!(self.count() > 1, "there is one vector");
        assert!(self.are_free(), "orthonormal vectors have no SALI");
        self.frames[lane].smaller_distance()
    }
}

/// What is above the diagonal in a lane.
fn above<N: Number>(columns: &[Column<N>], lane: usize) -> Vec<Vec<f64>> {
    let number = |x: &N| {
        let (m, n) = x.lane(lane);
        scaled(m, n)
    };
    columns.iter().map(|column| column.above.iter().map(number).collect()).collect()
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
