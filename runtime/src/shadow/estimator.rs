//! What an estimator of the modified energy is: built from settings, fed with states, read as estimates.

use thiserror::Error;

use crate::number::Number;
use crate::steps::step_size::StepSize;
use crate::systems::increments::Increments;

/// Settings of an estimator, from which it is built for a step size, a dimension and a number type.
pub trait BuildEstimator<N: Number> {
    /// The estimator.
    type Estimator: Estimator<N>;

    /// An estimator for steps of size h and states of `dimension` coordinates.
    ///
    /// # Errors
    /// Settings that are not valid.
    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError>;
}

/// Settings of an estimator that are not valid.
#[derive(Clone, PartialEq, Eq, Error)]
pub enum EstimatorError {
    /// An order, or a largest order, that is too small.
    #[error("{name} must be at least {least}, not {found}")]
    Order {
        /// Its name: m, k, the largest m or the largest k.
        name: &'static str,
        /// The smallest valid value.
        least: u32,
        /// The value.
        found: u32,
    },
    /// An order, or a largest order, that is too large.
    #[error("{name} must be at most {most}, not {found}: the cost of a state grows like the square of it")]
    HighOrder {
        /// Its name: k or the largest k.
        name: &'static str,
        /// The largest valid value.
        most: u32,
        /// The value.
        found: u32,
    },
    /// A negative target error.
    #[error("the target error must not be negative")]
    NegativeAccuracy,
}

shadowstep_schemes::debug_as_text!(EstimatorError);

impl EstimatorError {
    /// Checks that an order is not too small.
    pub(super) fn check_order(name: &'static str, found: u32, least: u32) -> Result<(), EstimatorError> {
        if found >= least { Ok(()) } else { Err(EstimatorError::Order { name, least, found }) }
    }

    /// Checks that an order is not too large.
    pub(super) fn check_high_order(name: &'static str, found: u32, most: u32) -> Result<(), EstimatorError> {
        if found <= most { Ok(()) } else { Err(EstimatorError::HighOrder { name, most, found }) }
    }
}

/// Computes modified energies from the states of a trajectory.
///
/// States come in the order of time, each with what the step that led to it added to q, p and β. Once `states` of them
/// have come, every one completes an estimate: of the middle of the newest `states`, which is a state if they are odd
/// in number, and else half a step after one.
pub trait Estimator<N: Number> {
    /// How many states an estimate needs: at least 2.
    fn states(&self) -> usize;

    /// Takes the next state; gives the estimate that it completes.
    ///
    /// All states come with increments of q and p, or none of them does; the latter are subtracted from one another. A
    /// state that comes without them after one with them starts a new sequence: estimates that need states from before
    /// it are not valid.
    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>>;

    /// As [`push`](Estimator::push), for all states of a trajectory, where q and p of the estimates are not used: they
    /// may be empty, so that no state needs to be kept for them.
    #[inline(always)]
    fn push_for_value(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.push(q, p, increments)
    }
}

impl<N: Number, E: Estimator<N> + ?Sized> Estimator<N> for Box<E> {
    fn states(&self) -> usize {
        (**self).states()
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        (**self).push(q, p, increments)
    }

    fn push_for_value(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        (**self).push_for_value(q, p, increments)
    }
}

/// The modified energy at a state.
#[derive(Clone, Copy, Debug)]
pub struct Estimate<'a, N> {
    /// The modified energy.
    pub value: &'a N,
    /// Size of the last term, |T_{m,m} − T_{m−1,m−1}| or |E_k − E_{k−1}|, where it is known: by this the best m is
    /// selected. It is not an estimate of the error, which can be larger by many orders of magnitude.
    pub last_term: Option<&'a N>,
    /// An estimate of the error, see [Errors](crate::shadow#errors); `None` where it is not computed, and where none is
    /// reliable: for m = 1 and k = 1.
    pub error: Option<&'a N>,
    /// The m of D_m, the k of the bilinear estimator.
    pub order: u32,
    /// Positions of the state in the middle, or just before it.
    pub q: &'a [N],
    /// Momenta of that state.
    pub p: &'a [N],
    /// Positions and momenta of particles of mass 0 in it, which follow these and have no part in the estimate: of a
    /// [`ShadowRun`](crate::shadow::run::ShadowRun).
    pub particles: (&'a [N], &'a [N]),
}

impl<'a, N> Estimate<'a, N> {
    /// Positions of the state, those of particles last, and momenta.
    pub fn state(&self) -> [impl Iterator<Item = &'a N> + use<'a, N>; 2] {
        [self.q.iter().chain(self.particles.0), self.p.iter().chain(self.particles.1)]
    }
}
