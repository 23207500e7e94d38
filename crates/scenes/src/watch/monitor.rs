//! The monitor of runs: by E_k with its error. With more digits than its verdict needs, the estimates have fewer.

use shadowstep::shadow::run::RunError;
use shadowstep::shadow::{Bilinear, BuildEstimator, EstimatorError, Monitor};
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{Real, StepSize};

/// The most bits of the estimates of a monitor: 327 digits, more than which only MPFR's numbers have. A verdict
/// compares changes of the modified energy with the error of H, and schemes have none that is as small; the estimated
/// errors include the round-off of the estimates.
const BITS_OF_VERDICT: u32 = 17 * 64;

/// A monitor of the states of an integrator.
pub type RunMonitor<N> = Monitor<N, <Bilinear as BuildEstimator<N>>::Estimator>;

/// An estimator for a verdict, which computes in at most [`BITS_OF_VERDICT`].
struct ForVerdict(Bilinear);

impl<N: Real> BuildEstimator<N> for ForVerdict {
    type Estimator = <Bilinear as BuildEstimator<N>>::Estimator;

    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError> {
        self.0.build(h, dimension, &N::coarser(context, BITS_OF_VERDICT))
    }
}

/// A monitor with a window every `every` steps; in a box, as those of many digits overflow the stacks of development
/// builds.
pub(crate) fn monitor<N: Real>(
    integrator: &mut VectorIntegrator<'_, N>,
    k: u32,
    every: u64,
) -> Result<Box<RunMonitor<N>>, RunError> {
    Ok(Box::new(Monitor::new(integrator, &ForVerdict(Bilinear::with_error(k)))?.every(every)))
}
