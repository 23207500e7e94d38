//! The solution of a problem in the smallest numbers that have the digits needed.

use super::points::{Points, PointsOf};
use super::solution::{Method, Request, SolutionError};
use crate::number::{AnyLimbs, CorrectlyRounded, HighPrecision, LimbCount};
use crate::systems::problems::values::Values;

/// A [`Method`], as the definition of a problem names it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solver {
    pub(crate) check: fn(&Values) -> Result<(), SolutionError>,
    bits: fn(&Request<'_>) -> Result<u32, SolutionError>,
    limbs: Solve<AnyLimbs>,
    #[cfg(feature = "mpfr")]
    mpfr: Solve<rug::Float>,
}

type Solve<R> = fn(&Request<'_>, bits: u32) -> Option<PointsOf<R>>;

impl Solver {
    pub(crate) const fn of<M: Method>() -> Self {
        Solver {
            check: M::check,
            bits: bits::<M>,
            limbs: solve::<M, _>,
            #[cfg(feature = "mpfr")]
            mpfr: solve::<M, _>,
        }
    }

    /// The points of the solution, to be rounded to numbers of type N.
    pub(crate) fn points<N: CorrectlyRounded>(
        &self,
        request: &Request<'_>,
    ) -> Result<Box<dyn Points<N>>, SolutionError> {
        let bits = (self.bits)(request)?;
        let found = boxed((self.limbs)(request, bits));
        #[cfg(feature = "mpfr")]
        let found = found.or_else(|| boxed((self.mpfr)(request, bits)));
        found.ok_or(SolutionError::NeedsMpfr { bits })
    }
}

fn solve<M: Method, R: HighPrecision>(request: &Request<'_>, bits: u32) -> Option<PointsOf<R>> {
    R::context_of(bits).map(|context| PointsOf::new(Box::new(M::solve::<R>(request, context))))
}

fn boxed<N: CorrectlyRounded, R: HighPrecision>(points: Option<PointsOf<R>>) -> Option<Box<dyn Points<N>>> {
    points.map(|points| Box::new(points) as Box<dyn Points<N>>)
}

/// The bits needed, by an estimate with numbers of twice the bits of the run.
fn bits<M: Method>(request: &Request<'_>) -> Result<u32, SolutionError> {
    #[cfg(feature = "mpfr")]
    {
        let rough = request.bits(f64::from(request.bits), u32::MAX)?;
        if let (None, Some(context)) = (AnyLimbs::context_of(rough), rug::Float::context_of(rough)) {
            return M::bits::<rug::Float>(request, &context);
        }
    }
    // without MPFR there are no more bits
    M::bits::<AnyLimbs>(request, &LimbCount::MOST)
}
