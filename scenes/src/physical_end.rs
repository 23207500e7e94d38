//! The end of a run in transformed time: how many steps fit before a physical time, and the last step to that time.

use std::ops::ControlFlow::{self, Break, Continue};

use num_traits::Signed;
use shadowstep::shadow::Estimate;
use shadowstep::shadow::run::RunError;
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::steps::step_to_time;
use shadowstep::{Rational, Real};

use crate::computation::{Computation, RunNumber};
use crate::error::Error;
use crate::follow::Follower;
use crate::run::Run;
use crate::scene;
use crate::steps::MOST_STEPS;

impl scene::Scene {
    /// The number of steps. Of a run in transformed time that ends at a physical time, the first call makes them all to count them;
    /// another step of the exact remainder then ends the run.
    pub fn steps(&self) -> u64 {
        *self.steps.get_or_init(|| self.until.as_ref().map_or(0, |until| self.count_steps(until)))
    }

    /// The physical time of the last step, where time is transformed and the run ends there.
    pub(crate) fn physical_end(&self) -> Option<&Rational> {
        self.until.as_ref().filter(|_| self.system.transformed_time().is_some())
    }

    /// The number of steps that end at or before `until`. They are made once, in the numbers of the run: a step has no known time before.
    fn count_steps(&self, until: &Rational) -> u64 {
        self.arithmetic.compute(Counting { scene: self, until })
    }
}

struct Counting<'a> {
    scene: &'a scene::Scene,
    until: &'a Rational,
}

impl Computation for Counting<'_> {
    type Output = u64;

    fn compute<N: RunNumber>(self, context: &N::Context) -> u64 {
        let Counting { scene, until } = self;
        let Ok(mut integrator) = scene.integrator::<N>(context) else { return 0 };
        steps_to(&mut *integrator, until, context)
    }
}

/// How many steps end at or before a physical time; they are made.
pub(crate) fn steps_to<N: RunNumber>(
    integrator: &mut VectorIntegrator<'_, N>,
    until: &Rational,
    context: &N::Context,
) -> u64 {
    let forward = until.is_positive();
    let mut count = StepsTo { until: N::from_rational(until, context), forward, steps: 0 };
    // a step whose state is not finite counts, so that the run finds it
    let _ = N::follow(integrator, (None, MOST_STEPS), None, &mut count);
    count.steps
}

/// Counts the steps that end at or before a physical time.
struct StepsTo<N> {
    until: N,
    forward: bool,
    steps: u64,
}

impl<N: Real> Follower<N> for StepsTo<N> {
    fn output(
        &mut self,
        n: i64,
        _: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        let t = integrator.state().q().last().expect("time is a coordinate");
        if if self.forward { *t > self.until } else { *t < self.until } {
            return Ok(Break(()));
        }
        self.steps = n.unsigned_abs();
        Ok(Continue(()))
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        if let RunError::NotFinite { step, .. } = error {
            self.steps = step.unsigned_abs();
        }
        Ok(())
    }
}

/// Makes the last step from a state, unless its time is `until` already: then false.
///
/// # Errors
/// A state that is not finite on the way.
pub(crate) fn last_step<N: Real>(
    integrator: &mut VectorIntegrator<'_, N>,
    (q, p): (&[N], &[N]),
    (run, until): (Run<'_>, &Rational),
) -> Result<bool, Error> {
    let until = N::from_rational(until, &integrator.state().context());
    integrator.system().state_mut().set(q, p);
    if q.last() == Some(&until) {
        return Ok(false);
    }
    match step_to_time(integrator, &until) {
        Some(_) => Ok(true),
        None => {
            let message = format!("{}: no last step to t = {until} has a finite state", run.name());
            Err(Error::run(message, "try a smaller step size"))
        }
    }
}
