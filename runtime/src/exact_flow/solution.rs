//! What a problem provides for its exact flow: a solution of its equations of motion, computed with MPFR.

use std::fmt;

use rug::Float;
use thiserror::Error;

use crate::Rational;
use crate::number::{Ordered, Precision};
use crate::problems::values::Values;
use crate::shadow::EstimatorError;

/// 20 digits beyond those of the run.
const GUARD_BITS: f64 = 67.0;

/// A problem, initial state or time for which the exact flow cannot be computed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ExactFlowError {
    /// No solution of the problem is known.
    #[error("no exact flow of {problem} is known; it is known for {known}")]
    NoSolution {
        /// Its name.
        problem: &'static str,
        /// The names of the problems whose exact flow is known, with commas between them.
        known: String,
    },
    /// An initial state that the solution does not cover, with the reason.
    #[error("{0}")]
    InitialState(&'static str),
    /// More digits would be lost than can be computed.
    #[error(
        "the exact flow from this initial state to this time needs {bits} more bits than the run has, and at most {most} \
         are allowed: the time is too long, or the state is too near to a separatrix or a collision"
    )]
    TooSensitive {
        /// The bits needed.
        bits: u64,
        /// The largest number of additional bits that is allowed.
        most: u64,
    },
    /// The settings of the estimator are not valid.
    #[error(transparent)]
    Estimator(#[from] EstimatorError),
}

/// q and p at a time, and β since t = 0.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) q: Vec<Float>,
    pub(crate) p: Vec<Float>,
    pub(crate) beta: Float,
}

/// A solution of the equations of motion from the initial state of a problem.
pub(crate) trait Solution: fmt::Debug {
    /// Refuses initial states that the solution does not cover.
    fn check(values: &Values) -> Result<(), ExactFlowError>
    where
        Self: Sized,
    {
        let _ = values;
        Ok(())
    }

    /// The solution at the times and with the digits that are requested.
    fn new(request: &Request<'_>) -> Result<Self, ExactFlowError>
    where
        Self: Sized;

    /// The point at t = n h; fastest for consecutive n.
    fn at(&mut self, n: i64) -> Point;
}

/// A type of [`Solution`], as the definition of a problem names it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solver {
    pub(super) check: fn(&Values) -> Result<(), ExactFlowError>,
    pub(super) solve: fn(&Request<'_>) -> Result<Box<dyn Solution>, ExactFlowError>,
}

impl Solver {
    pub(crate) const fn of<S: Solution + 'static>() -> Self {
        Solver { check: S::check, solve: |request| Ok(Box::new(S::new(request)?)) }
    }
}

/// The initial values, times and digits for which a solution is made.
pub(crate) struct Request<'a> {
    pub(crate) values: &'a Values,
    pub(crate) h: &'a Rational,
    /// The largest |t|.
    pub(crate) longest: f64,
    /// The bits of the run.
    pub(crate) bits: u32,
}

impl Request<'_> {
    /// The precision to compute with, if errors grow by a factor of 2^`growth`, of which `most` is allowed.
    pub(crate) fn precision(&self, growth: f64, most: u32) -> Result<Precision, ExactFlowError> {
        let too_many = || ExactFlowError::TooSensitive { bits: growth.ceil() as u64, most: u64::from(most) };
        if growth > f64::from(most) {
            return Err(too_many());
        }
        let bits = f64::from(self.bits) + GUARD_BITS + growth.max(0.0).ceil();
        Precision::bits(bits as u32).map_err(|_| too_many())
    }

    /// The precision at which sizes are estimated, on which the final precision depends.
    pub(crate) fn rough(&self) -> Result<Precision, ExactFlowError> {
        self.precision(f64::from(self.bits), u32::MAX)
    }
}

/// log₂|x|, −∞ for 0.
pub(crate) fn log2(x: &Float) -> f64 {
    x.log10_abs() * std::f64::consts::LOG2_10
}
