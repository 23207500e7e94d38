//! What a problem provides for its exact flow: a solution of its equations of motion.

use std::fmt;

use thiserror::Error;

use crate::Rational;
use crate::number::value::Value;
use crate::number::{HighPrecision, Real};
use crate::systems::problems::values::Values;

/// 20 digits more than the run has.
const GUARD_BITS: f64 = 67.0;

/// An initial state or time for which the exact flow of a problem cannot be computed.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum SolutionError {
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
    /// More digits are needed than numbers of a fixed number of limbs have.
    #[error("the exact flow from this initial state to this time needs {bits} bits: build with the feature `mpfr`")]
    NeedsMpfr {
        /// The bits needed.
        bits: u32,
    },
}

shadowstep_schemes::debug_as_text!(SolutionError);

/// q and p at a time, and β since t = 0.
#[derive(Clone, Debug)]
pub(crate) struct Point<R> {
    pub(crate) q: Vec<Value<R>>,
    pub(crate) p: Vec<Value<R>>,
    pub(crate) beta: Value<R>,
}

/// A solution of the equations of motion from the initial state of a problem, in numbers of type R.
pub(crate) trait Solution<R>: fmt::Debug {
    /// The point at t = n h; fastest for consecutive n.
    fn at(&mut self, n: i64) -> Point<R>;
}

/// A method that solves the equations of motion of a problem.
pub(crate) trait Method {
    /// What it makes.
    type Solution<R: HighPrecision>: Solution<R> + 'static;

    /// Refuses initial states that the solution does not cover.
    fn check(values: &Values) -> Result<(), SolutionError> {
        let _ = values;
        Ok(())
    }

    /// The bits to compute with; `rough` makes numbers with which sizes are estimated.
    fn bits<R: HighPrecision>(request: &Request<'_>, rough: &R::Context) -> Result<u32, SolutionError>;

    /// The solution, computed with numbers of the context.
    fn solve<R: HighPrecision>(request: &Request<'_>, context: R::Context) -> Self::Solution<R>;
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
    /// The bits to compute with, if errors grow by a factor of 2^`growth`, of which `most` is allowed.
    pub(crate) fn bits(&self, growth: f64, most: u32) -> Result<u32, SolutionError> {
        if growth > f64::from(most) {
            return Err(SolutionError::TooSensitive { bits: growth.ceil() as u64, most: u64::from(most) });
        }
        Ok((f64::from(self.bits) + GUARD_BITS + growth.max(0.0).ceil()) as u32)
    }
}

/// log₂|x|, −∞ for 0.
pub(crate) fn log2(x: &impl Real) -> f64 {
    x.log10_abs() * std::f64::consts::LOG2_10
}
