//! What follows a run, in the number types of runs. It is compiled in this crate, once for each, and not again in every
//! crate that uses it.

use shadowstep::number::saved::Saved;
use shadowstep::shadow::run::RunError;
use shadowstep::shadow::{
    Bilinear, BuildEstimator, Estimator, EstimatorError, EstimatorSettings, Monitor, Report, Sample,
};
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::{Real, StepSize};

use crate::run::arithmetic::number_types;
use crate::scene::SceneNumber;

/// A number type of runs.
pub trait RunNumber: SceneNumber {
    /// The estimator of these settings: see [`BuildEstimator::build`].
    ///
    /// # Errors
    /// As there.
    fn estimator(
        settings: &EstimatorSettings,
        h: &StepSize,
        dimension: usize,
        context: &Self::Context,
    ) -> Result<Box<dyn Estimator<Self>>, EstimatorError>;

    /// A monitor by E_k with its error, with a window every `every` steps. With more digits than its verdict needs, the
    /// estimates have fewer.
    ///
    /// # Errors
    /// As [`Monitor::new`].
    fn monitor(
        integrator: &mut VectorIntegrator<'_, Self>,
        k: u32,
        every: u64,
    ) -> Result<Box<dyn Monitoring<Self>>, RunError>;
}

/// The most bits of the estimates of a monitor: 327 digits, more than which only MPFR's numbers have. A verdict
/// compares changes of the modified energy with the error of H, and schemes have none that is as small; the estimated
/// errors include the round-off of the estimates.
const BITS_OF_VERDICT: u32 = 17 * 64;

/// An estimator for a verdict, which computes in at most [`BITS_OF_VERDICT`].
struct ForVerdict(Bilinear);

impl<N: Real> BuildEstimator<N> for ForVerdict {
    type Estimator = <Bilinear as BuildEstimator<N>>::Estimator;

    fn build(&self, h: &StepSize, dimension: usize, context: &N::Context) -> Result<Self::Estimator, EstimatorError> {
        self.0.build(h, dimension, &N::coarser(context, BITS_OF_VERDICT))
    }
}

/// A [`Monitor`] of the states of an integrator, as an object: crates that name its type compile it once more for each
/// number type, `stability` and `work-precision` 1.7 to 2 MB of code each.
pub trait Monitoring<N: RunNumber>: Saved<N> {
    /// [`Monitor::step`]
    ///
    /// # Errors
    /// As there.
    fn step(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Option<Sample<'_, N>>, RunError>;

    /// [`Monitor::observe`]
    ///
    /// # Errors
    /// As there.
    fn observe(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Option<Sample<'_, N>>, RunError>;

    /// [`Monitor::needs_increments`]
    fn needs_increments(&self) -> bool;

    /// [`Monitor::idle`]
    fn idle(&self) -> u64;

    /// [`Monitor::takes_kinetic`]
    fn takes_kinetic(&self, n: u64) -> bool;

    /// [`Monitor::pass`]
    fn pass(&mut self, states: u64);

    /// [`Monitor::n`]
    fn n(&self) -> u64;

    /// [`Monitor::report`]
    fn report(&self) -> Report<N>;
}

impl<N: RunNumber> Monitoring<N> for Monitor<N, <Bilinear as BuildEstimator<N>>::Estimator> {
    fn step(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Option<Sample<'_, N>>, RunError> {
        Monitor::step(self, integrator)
    }

    fn observe(&mut self, integrator: &mut VectorIntegrator<'_, N>) -> Result<Option<Sample<'_, N>>, RunError> {
        Monitor::observe(self, integrator.system())
    }

    fn needs_increments(&self) -> bool {
        Monitor::needs_increments(self)
    }

    fn idle(&self) -> u64 {
        Monitor::idle(self)
    }

    fn takes_kinetic(&self, n: u64) -> bool {
        Monitor::takes_kinetic(self, n)
    }

    fn pass(&mut self, states: u64) {
        Monitor::pass(self, states);
    }

    fn n(&self) -> u64 {
        Monitor::n(self)
    }

    fn report(&self) -> Report<N> {
        Monitor::report(self)
    }
}

// not inlined: callers in other crates would compile what is called, and the methods of a `dyn`, once more
macro_rules! run_numbers {
    ($($number:ty),*) => {$(
        impl RunNumber for $number {
            #[inline(never)]
            fn estimator(
                settings: &EstimatorSettings,
                h: &StepSize,
                dimension: usize,
                context: &Self::Context,
            ) -> Result<Box<dyn Estimator<Self>>, EstimatorError> {
                settings.build(h, dimension, context)
            }

            #[inline(never)]
            fn monitor(
                integrator: &mut VectorIntegrator<'_, Self>,
                k: u32,
                every: u64,
            ) -> Result<Box<dyn Monitoring<Self>>, RunError> {
                Ok(Box::new(Monitor::new(integrator, &ForVerdict(Bilinear::with_error(k)))?.every(every)))
            }
        }
    )*};
}

number_types!(run_numbers);
