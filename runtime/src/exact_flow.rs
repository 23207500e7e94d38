//! States of the exact flow, whose energy is known: on them the variation of an estimate is the error of the estimator.
//!
//! A scheme's trajectory lies on the flow of a modified Hamiltonian H̄ that is not known. The states at t = n h of the exact
//! flow of H, with β' = qᵀU_q − 2U, are a trajectory with H̄ = H.
//!
//! ```
//! use shadowstep::number::{Float, Precision};
//! use shadowstep::{StepSize, exact_flow::ExactFlow, problems::problem, run::ShadowRun, shadow::Bilinear};
//!
//! let kepler = problem("kepler").unwrap().setup(&[], 80).unwrap(); // H = −1/2
//! let (h, digits) = (StepSize::try_from("1/20").unwrap(), Precision::digits(60).unwrap());
//! let settings = Bilinear::new(16);
//! let mut control = ShadowRun::<ExactFlow<Float>, _>::of_exact_flow(&kepler, &h, 126, &settings, &digits).unwrap();
//! let found = control.drift().unwrap();
//! assert!(found.drift.to_f64() < 1e-11); // of E_16 itself
//! ```
//!
//! States are computed with MPFR, with 20 digits more than the run has and as many as its length and its initial state
//! require in addition, and rounded once: also `f64` states are the nearest ones.

pub(crate) mod solution;

use rug::Float;

use crate::number::{Number, Rounded};
use crate::problems::{PROBLEMS, Problem, Setup};
use crate::run::{RunError, ShadowRun, State, States, last};
use crate::shadow::{BuildEstimator, Estimator};
use crate::step_size::StepSize;
use crate::system::OwnedIncrements;
use solution::{Point, Request, Solution, Solver};

pub use solution::ExactFlowError;

/// The states of the exact flow of a problem in the order of time, n = −reach, …, steps + reach, with the β of each step.
///
/// The flow begins at the exact initial values of the problem, to the digits that these have been computed to, not at
/// rounded ones. [`problems`] lists the problems whose exact flow is known.
#[derive(Debug)]
pub struct ExactFlow<N> {
    solution: Box<dyn Solution>,
    n: i64,
    last: i64,
    q: Vec<N>,
    p: Vec<N>,
    increments: OwnedIncrements<N>,
    /// The state n; none before the first.
    present: Option<Point>,
}

impl<N: Rounded> ExactFlow<N> {
    /// Begins at the initial state of the problem with steps of size h.
    ///
    /// # Errors
    /// As [`has_exact_flow`]; a time so long, or an initial state so near to a separatrix or a collision, that too many digits
    /// would be needed.
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
        let solution = (solver.solve)(&Request { values: &setup.values, h: h.exact(), longest, bits })?;
        let dimension = setup.values.positions().len();
        let zeros = || vec![N::zero(context); dimension];
        let (q, p, increments) = (zeros(), zeros(), OwnedIncrements::zero(dimension, context));
        Ok(ExactFlow { solution, n: -(reach as i64) - 1, last, q, p, increments, present: None })
    }
}

fn assign_rounded<N: Rounded>(numbers: &mut [N], values: &[Float]) {
    numbers.iter_mut().zip(values).for_each(|(own, value)| own.assign_rounded(value));
}

impl<N: Rounded> OwnedIncrements<N> {
    /// The increments from one point to the next, each rounded once.
    fn assign_differences(&mut self, next: &Point, last: &Point) {
        let vectors = self.q.iter_mut().zip(&next.q).zip(&last.q).chain(self.p.iter_mut().zip(&next.p).zip(&last.p));
        vectors.for_each(|((own, next), last)| own.assign_rounded(&(next.clone() - last)));
        self.beta.assign_rounded(&(next.beta.clone() - &last.beta));
    }
}

impl<N: Rounded> States for ExactFlow<N> {
    type Number = N;

    /// The next state; `None` at the end.
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
        let state = State { n: self.n, q: &self.q, p: &self.p, increments: self.increments.view() };
        state.check()?;
        Ok(Some(state))
    }
}

impl<N: Rounded, E: Estimator<N>> ShadowRun<ExactFlow<N>, E> {
    /// The estimates along the exact flow of a problem from its initial state. Each is H plus the error of the estimator.
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
pub fn problems() -> impl Iterator<Item = Problem> {
    PROBLEMS.iter().copied().filter(|problem| problem.exact_flow().is_some())
}

/// Checks that the exact flow of a problem from its initial state is known.
///
/// # Errors
/// A problem that is not among [`problems`]; an initial state that its solution does not cover.
pub fn has_exact_flow(setup: &Setup) -> Result<(), ExactFlowError> {
    solver(setup).map(|_| ())
}

/// The solver of a problem, if it covers the initial state.
fn solver(setup: &Setup) -> Result<Solver, ExactFlowError> {
    let solver = setup.problem.exact_flow().ok_or_else(|| {
        let known: Vec<_> = problems().map(Problem::name).collect();
        ExactFlowError::NoSolution { problem: setup.problem.name(), known: known.join(", ") }
    })?;
    (solver.check)(&setup.values)?;
    Ok(solver)
}
