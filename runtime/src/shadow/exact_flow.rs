//! States of the exact flow, whose energy is known: on them the variation of an estimate is the error of the estimator.
//!
//! A scheme's trajectory lies on the flow of a modified Hamiltonian H̄ that is not known. The states at t = n h of the
//! exact flow of H, with β' = qᵀU_q − 2U, are a trajectory with H̄ = H.
//!
//! ```
//! use shadowstep::number::{Limbs, Real};
//! use shadowstep::{StepSize, shadow::exact_flow::ExactFlow, problems::problem, shadow::run::ShadowRun, shadow::Bilinear};
//!
//! let kepler = problem("kepler").unwrap().setup(&[], 80).unwrap(); // H = −1/2
//! let h = StepSize::try_from("1/20").unwrap();
//! let settings = Bilinear::new(16);
//! let mut control = ShadowRun::<ExactFlow<Limbs<4>>, _>::of_exact_flow(&kepler, &h, 126, &settings, &()).unwrap();
//! let found = control.drift().unwrap();
//! assert!(found.drift.to_f64() < 1e-11); // of E_16 itself
//! ```
//!
//! States are computed with 20 digits more than the run has and as many as its length and its initial state
//! require in addition, and rounded once: also `f64` states are the nearest ones. Where that takes more than 1088 bits,
//! MPFR computes them (feature `mpfr`).

use thiserror::Error;

use crate::number::{CorrectlyRounded, Number};
use crate::shadow::run::{RunError, ShadowRun, States, TrajectoryState, last};
use crate::shadow::{BuildEstimator, Estimator, EstimatorError};
use crate::steps::step_size::StepSize;
use crate::systems::increments::OwnedIncrements;
use crate::systems::problems::exact_flow::points::Points;
use crate::systems::problems::exact_flow::solution::{Request, SolutionError};
use crate::systems::problems::exact_flow::solver::Solver;
use crate::systems::problems::{PROBLEMS, Problem, Setup};

/// A problem, initial state or time for which the exact flow cannot be computed, or settings of an estimator that are
/// not valid.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum ExactFlowError {
    /// No solution of the problem is known.
    #[error("no exact flow of {problem} is known; it is known for {known}")]
    NoSolution {
        /// Its name.
        problem: &'static str,
        /// The names of the problems whose exact flow is known, with commas between them.
        known: String,
    },
    /// The solution does not cover the initial state or the time.
    #[error(transparent)]
    Solution(#[from] SolutionError),
    /// The settings of the estimator are not valid.
    #[error(transparent)]
    Estimator(#[from] EstimatorError),
}

shadowstep_schemes::debug_as_text!(ExactFlowError);

/// The states of the exact flow of a problem in the order of time, n = −reach, …, steps + reach, with the β of each
/// step.
///
/// The flow begins at the exact initial values of the problem, to the digits that these have been computed to, not at
/// rounded ones. [`problems`] lists the problems whose exact flow is known.
#[derive(Debug)]
pub struct ExactFlow<N> {
    points: Box<dyn Points<N>>,
    n: i64,
    last: i64,
    q: Vec<N>,
    p: Vec<N>,
    increments: OwnedIncrements<N>,
}

impl<N: CorrectlyRounded> ExactFlow<N> {
    /// Begins at the initial state of the problem with steps of size h.
    ///
    /// # Errors
    /// As [`has_exact_flow`]; a time so long, or an initial state so near to a separatrix or a collision, that too many
    /// digits would be needed.
    pub fn new(
        setup: &Setup,
        h: &StepSize,
        steps: u64,
        reach: usize,
        context: &N::Context,
    ) -> Result<Self, ExactFlowError> {
        let solver = solver(setup)?;
        let last = last(steps, reach);
        let longest = (f64::from_rational(h.exact(), &()) * (last as f64 + 1.0)).abs();
        let bits = N::precision(context).in_bits();
        let points = solver.points(&Request { values: &setup.values, h: h.exact(), longest, bits })?;
        let dimension = setup.values.positions().len();
        let zeros = || vec![N::zero(context); dimension];
        let (q, p, increments) = (zeros(), zeros(), OwnedIncrements::zero(dimension, context));
        Ok(ExactFlow { points, n: -(reach as i64) - 1, last, q, p, increments })
    }
}

impl<N: CorrectlyRounded> States for ExactFlow<N> {
    type Number = N;

    /// The next state; `None` at the end.
    ///
    /// # Errors
    /// A state that is not finite, as where `f64` overflows.
    fn advance(&mut self) -> Result<Option<TrajectoryState<'_, N>>, RunError> {
        if self.n >= self.last {
            return Ok(None);
        }
        self.n += 1;
        self.points.assign(self.n, &mut self.q, &mut self.p, &mut self.increments);
        let state = TrajectoryState { n: self.n, q: &self.q, p: &self.p, increments: self.increments.view() };
        state.check()?;
        Ok(Some(state))
    }
}

impl<N: CorrectlyRounded, E: Estimator<N>> ShadowRun<ExactFlow<N>, E> {
    /// The estimates along the exact flow of a problem from its initial state. Each is H plus the error of the
    /// estimator.
    ///
    /// # Errors
    /// As [`ExactFlow::new`].
    pub fn of_exact_flow(
        setup: &Setup,
        h: &StepSize,
        steps: u64,
        settings: &impl BuildEstimator<N, Estimator = E>,
        context: &N::Context,
    ) -> Result<Self, ExactFlowError> {
        let estimator = settings.build(h, setup.values.positions().len(), context)?;
        let reach = (estimator.states() - 1) / 2;
        Ok(ShadowRun::of(ExactFlow::new(setup, h, steps, reach, context)?, estimator, h))
    }
}

/// The problems whose exact flow is known.
#[inline]
pub fn problems() -> impl Iterator<Item = Problem> {
    PROBLEMS.iter().copied().filter(|problem| problem.exact_flow().is_some())
}

/// Checks that the exact flow of a problem from its initial state is known.
///
/// # Errors
/// A problem that is not among [`problems`]; an initial state that its solution does not cover.
#[inline]
pub fn has_exact_flow(setup: &Setup) -> Result<(), ExactFlowError> {
    solver(setup).map(|_| ())
}

/// The solver of a problem, if it covers the initial state.
#[inline]
fn solver(setup: &Setup) -> Result<Solver, ExactFlowError> {
    let solver = setup.problem.exact_flow().ok_or_else(|| {
        let known: Vec<_> = problems().map(Problem::name).collect();
        ExactFlowError::NoSolution { problem: setup.problem.name(), known: known.join(", ") }
    })?;
    (solver.check)(&setup.values)?;
    Ok(solver)
}
