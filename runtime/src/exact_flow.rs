//! States of the exact flow, whose energy is known: what an estimator shows on them is its own error.
//!
//! A scheme's trajectory lies on the flow of a modified Hamiltonian H̄ that nobody knows. The states at t = n h of the exact
//! flow of H, with β' = qᵀU_q − 2U, are a trajectory with H̄ = H.
//!
//! ```
//! use shadowstep::number::{Float, Precision};
//! use shadowstep::{exact, exact_flow::ExactFlow, problems::problem, run::ShadowRun, shadow::Bilinear};
//!
//! let kepler = problem("kepler").unwrap().setup(&[], 80).unwrap(); // H = −1/2
//! let (h, digits) = (exact("1/20").unwrap(), Precision::digits(60).unwrap());
//! let method = Bilinear::new(16);
//! let mut control = ShadowRun::<ExactFlow<Float>, _>::of_exact_flow(&kepler, &h, 126, &method, &digits).unwrap();
//! let found = control.drift(|_| {}).unwrap();
//! assert!(found.drift.to_f64() < 1e-11); // of E_16 itself
//! ```
//!
//! States are computed with MPFR, with 20 digits more than those of the run and as many as its length and its start take
//! beyond these, and rounded once: `f64` states, too, are the nearest ones.

mod kepler;
mod oscillator;
mod pendulum;

use std::fmt;

use num_traits::Zero;
use rug::Float;
use thiserror::Error;

use crate::Rational;
use crate::motion::Increments;
use crate::number::{Number, Precision, Rounded};
use crate::problems::Setup;
use crate::run::{RunError, ShadowRun, State, States, check_finite, last};
use crate::shadow::{Estimator, Method};

/// The names of the problems whose exact flow can be had.
pub const WITH_EXACT_FLOW: [&str; 3] = ["harmonic-oscillator", "pendulum", "kepler"];

/// 20 digits beyond those of the run.
const GUARD_BITS: f64 = 67.0;

/// A problem or a start whose exact flow cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ExactFlowError {
    /// The problem has no closed form.
    #[error("the exact flow of {problem} is not known; known are those of {}", WITH_EXACT_FLOW.join(", "))]
    NoClosedForm {
        /// Its name.
        problem: &'static str,
    },
    /// A Kepler orbit with H ≥ 0.
    #[error("the exact flow of kepler is that of bound orbits, and this start has H = |p|^2/2 - 1/|q| >= 0")]
    Unbound,
    /// A Kepler orbit through the centre.
    #[error("the exact flow of kepler is that of ellipses, and this start has no angular momentum: x py - y px = 0")]
    Radial,
    /// More digits would be lost than can be computed.
    #[error(
        "the exact flow from this start to this time would need {bits} more bits than the run has, of which \
         {most} can be had: it is too long, or too near to a separatrix or a collision"
    )]
    TooSensitive {
        /// The bits needed.
        bits: u64,
        /// The most that are given.
        most: u64,
    },
    /// A step of size 0.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// q and p at a time, and β since t = 0.
#[derive(Clone, Debug)]
struct Point {
    q: Vec<Float>,
    p: Vec<Float>,
    beta: Float,
}

/// A solution of the equations of motion.
trait Solution: fmt::Debug {
    /// The point at t = n h; fastest for one n after the other.
    fn at(&mut self, n: i64) -> Point;
}

/// What a solution is made for.
struct Asked<'a> {
    setup: &'a Setup,
    h: &'a Rational,
    /// The largest |t|.
    longest: f64,
    /// The bits of the run.
    bits: u32,
}

impl Asked<'_> {
    /// The precision to compute with, if errors grow by a factor of 2^`growth`, of which `most` is allowed.
    fn precision(&self, growth: f64, most: u32) -> Result<Precision, ExactFlowError> {
        let too_many = || ExactFlowError::TooSensitive { bits: growth.ceil() as u64, most: u64::from(most) };
        if growth > f64::from(most) {
            return Err(too_many());
        }
        let bits = f64::from(self.bits) + GUARD_BITS + growth.max(0.0).ceil();
        Precision::bits(bits as u32).map_err(|_| too_many())
    }

    /// With this precision sizes are found out, on which the final one depends.
    fn rough(&self) -> Result<Precision, ExactFlowError> {
        self.precision(f64::from(self.bits), u32::MAX)
    }
}

/// log₂|x|, −∞ for 0.
fn log2(x: &Float) -> f64 {
    x.log10_abs() * std::f64::consts::LOG2_10
}

/// The states of the exact flow of a problem in the order of time, n = −reach, …, steps + reach, with the β of each step.
///
/// Kepler's problem (bound, with any angular momentum but 0) and the harmonic oscillator have closed forms; the pendulum is
/// integrated by its Taylor series, see [`WITH_EXACT_FLOW`]. The flow begins at the exact initial values of the problem, as far
/// as these have been computed, not at rounded ones.
#[derive(Debug)]
pub struct ExactFlow<N> {
    solution: Box<dyn Solution>,
    n: i64,
    last: i64,
    q: Vec<N>,
    p: Vec<N>,
    increments: Increments<N>,
    /// The state n; none before the first.
    present: Option<Point>,
}

impl<N: Rounded> ExactFlow<N> {
    /// Begins at the initial state of the problem with steps of size h.
    ///
    /// # Errors
    /// As [`has_exact_flow`]; a step of size 0; a time so long, or a start so near to a separatrix, that the digits do not
    /// suffice.
    pub fn new(
        setup: &Setup,
        h: &Rational,
        steps: u64,
        reach: usize,
        context: &N::Context,
    ) -> Result<Self, ExactFlowError> {
        has_exact_flow(setup)?;
        if h.is_zero() {
            return Err(RunError::ZeroStep.into());
        }
        let last = last(steps, reach);
        let longest = (f64::from_rational(h, &()) * (last as f64 + 1.0)).abs();
        let asked = Asked { setup, h, longest, bits: N::precision(context).in_bits() };
        let solution: Box<dyn Solution> = match setup.problem.name {
            "kepler" => Box::new(kepler::Ellipse::new(&asked)?),
            "pendulum" => Box::new(pendulum::Series::new(&asked)?),
            _ => Box::new(oscillator::Rotation::new(&asked)?),
        };
        let dimension = setup.positions().len();
        let zeros = || vec![N::zero(context); dimension];
        let (q, p, increments) = (zeros(), zeros(), Increments::zero(dimension, context));
        Ok(ExactFlow { solution, n: -(reach as i64) - 1, last, q, p, increments, present: None })
    }
}

fn assign_rounded<N: Rounded>(numbers: &mut [N], values: &[Float]) {
    numbers.iter_mut().zip(values).for_each(|(own, value)| own.assign_rounded(value));
}

impl<N: Rounded> Increments<N> {
    /// What leads from one point to the next, each rounded once.
    fn assign_differences(&mut self, next: &Point, last: &Point) {
        let vectors = self.q.iter_mut().zip(&next.q).zip(&last.q).chain(self.p.iter_mut().zip(&next.p).zip(&last.p));
        vectors.for_each(|((own, next), last)| own.assign_rounded(&(next.clone() - last)));
        self.beta.assign_rounded(&(next.beta.clone() - &last.beta));
    }
}

impl<N: Rounded> States for ExactFlow<N> {
    type Number = N;

    /// Goes to the next state; `None` at the end.
    ///
    /// # Errors
    /// A state that is not finite, as where `f64` overflows.
    fn advance(&mut self) -> Result<Option<State<'_, N>>, RunError> {
        if self.n >= self.last {
            return Ok(None);
        }
        let before = self.present.take().unwrap_or_else(|| self.solution.at(self.n));
        self.n += 1;
        let present = self.solution.at(self.n);
        assign_rounded(&mut self.q, &present.q);
        assign_rounded(&mut self.p, &present.p);
        self.increments.assign_differences(&present, &before);
        self.present = Some(present);
        let state = State { n: self.n, q: &self.q, p: &self.p, increments: &self.increments };
        check_finite(&state)?;
        Ok(Some(state))
    }
}

impl<N: Rounded, E: Estimator<N>> ShadowRun<ExactFlow<N>, E> {
    /// The estimates along the exact flow of a problem from its initial state: without the estimator's own error each of them
    /// would be H.
    ///
    /// # Errors
    /// As [`ExactFlow::new`].
    pub fn of_exact_flow(
        setup: &Setup,
        h: &Rational,
        steps: u64,
        method: &impl Method<N, Estimator = E>,
        context: &N::Context,
    ) -> Result<Self, ExactFlowError> {
        // the estimator is known only where h is known to be no 0
        if h.is_zero() {
            return Err(RunError::ZeroStep.into());
        }
        let estimator = method.estimator(h, setup.positions().len(), context);
        let reach = (estimator.states() - 1) / 2;
        Ok(ShadowRun::of(ExactFlow::new(setup, h, steps, reach, context)?, estimator, h))
    }
}

/// Whether the exact flow of a problem from its initial state can be had.
///
/// # Errors
/// A problem that is none of [`WITH_EXACT_FLOW`]; a Kepler orbit that is not bound or goes through the centre.
pub fn has_exact_flow(setup: &Setup) -> Result<(), ExactFlowError> {
    let problem = setup.problem.name;
    match problem {
        "kepler" => kepler::is_ellipse(setup),
        _ if WITH_EXACT_FLOW.contains(&problem) => Ok(()),
        _ => Err(ExactFlowError::NoClosedForm { problem }),
    }
}
