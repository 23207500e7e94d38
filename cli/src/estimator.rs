//! The estimator of the modified energy that is asked for.

use shadowstep::number::Number;
use shadowstep::shadow::{
    Bilinear, BilinearEstimator, Central, CentralEstimator, Estimate, Estimator, Method, Rule, Stop,
};
use shadowstep::{Increments, Rational};

/// Beyond this order the exact weights take longer than any run.
pub(crate) const HIGHEST_ORDER: u32 = 1000;

/// The largest m that is tried where none is asked for.
pub(crate) const DEFAULT_LARGEST_M: u32 = 200;

/// An estimator with its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chosen {
    /// D_m
    Central(u32),
    /// The best m of each state, at most this.
    Best(u32, Stop, Rule),
    /// E_k
    Bilinear(u32),
}

/// What makes it; an estimate of the error costs more.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Made {
    Central(Central),
    Bilinear(Bilinear),
}

impl Chosen {
    /// The method, which estimates its error only if asked to.
    pub(crate) fn method(self, with_error: bool) -> Made {
        match self {
            Chosen::Central(m) => Made::Central(Central::Fixed { m, with_error }),
            Chosen::Best(largest, stop, rule) => Made::Central(Central::Best { largest, stop, rule, with_error }),
            Chosen::Bilinear(k) => Made::Bilinear(Bilinear { k, with_error }),
        }
    }

    /// Whether it can estimate its error; a series of one term cannot.
    pub(crate) fn tells_error(self) -> bool {
        !matches!(self, Chosen::Central(1) | Chosen::Bilinear(1))
    }

    /// Whether its values belong to the times between the states.
    pub(crate) fn is_between(self) -> bool {
        matches!(self, Chosen::Bilinear(k) if k % 2 == 1)
    }
}

impl<N: Number> Method<N> for Made {
    type Estimator = Either<N>;

    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> Either<N> {
        match self {
            Made::Central(method) => Either::Central(method.estimator(h, dimension, context)),
            Made::Bilinear(method) => Either::Bilinear(method.estimator(h, dimension, context)),
        }
    }
}

/// One of the estimators.
pub(crate) enum Either<N> {
    Central(CentralEstimator<N>),
    Bilinear(BilinearEstimator<N>),
}

impl<N: Number> Estimator<N> for Either<N> {
    fn states(&self) -> usize {
        match self {
            Either::Central(estimator) => estimator.states(),
            Either::Bilinear(estimator) => estimator.states(),
        }
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        match self {
            Either::Central(estimator) => estimator.push(q, p, increments),
            Either::Bilinear(estimator) => estimator.push(q, p, increments),
        }
    }
}
