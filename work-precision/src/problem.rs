//! What schemes are compared on: a system, an interval of time, a number type.

use num_traits::Signed;
use shadowstep::{Number, Rational, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::RunNumber;
use shadowstep_scenes::library::{NamedScheme, fingerprint};
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};
use shadowstep_scenes::{Error, System};
use shadowstep_symbolic::decimal::to_text;

/// Errors along a run are taken at this number of times at most.
pub(crate) const MOST_SAMPLES: u64 = 64;

/// A system from t = 0 to `until` in a number type.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The end of the runs; negative for runs back in time.
    pub until: &'a Rational,
    /// The number type.
    pub arithmetic: Arithmetic,
}

impl Problem<'_> {
    /// |until| as an `f64`.
    pub(crate) fn duration(&self) -> f64 {
        <f64 as Number>::from_rational(self.until, &()).abs()
    }

    /// The step size of this number of steps.
    pub(crate) fn step_size(&self, steps: u64) -> Rational {
        self.until / Rational::from_integer(steps.into())
    }

    /// The system at t = 0 with a scheme that makes this number of steps.
    pub(crate) fn integrator<N: RunNumber>(
        &self,
        named: &NamedScheme,
        steps: u64,
        context: &N::Context,
    ) -> Result<SceneIntegrator<N>, Error> {
        let h = StepSize::try_from(self.step_size(steps)).expect("the run has a nonzero length");
        let compensated = self.arithmetic.is_compensated();
        let (displaced, begin) = (false, Begin::InitialState);
        let steps = Steps { scheme: &named.scheme, h: &h, compensated, displaced, begin };
        Ok(self.system.integrator(steps, self.system.start(context), context)?)
    }

    /// Whether the runs go forward in time.
    pub(crate) fn is_forward(&self) -> bool {
        self.until.is_positive()
    }

    /// What distinguishes its results from those of all other problems.
    pub(crate) fn fingerprint(&self) -> String {
        let all = format!("{:?} {} {:?}", self.system, to_text(self.until), self.arithmetic.label());
        fingerprint(&all)
    }
}

/// The most samples that are at states of a run with this number of steps.
pub(crate) fn most_samples(steps: u64) -> u64 {
    (1..=MOST_SAMPLES).rev().find(|samples| steps.is_multiple_of(*samples)).unwrap_or(1)
}
