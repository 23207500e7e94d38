//! The loop of every run: it makes the states in the order of time, with their modified energies if these are wanted, and gives them to a follower.

use std::ops::ControlFlow::{self, Break, Continue};

use shadowstep::shadow::run::{RunError, ShadowRun, States as _, Trajectory};
use shadowstep::shadow::{Estimate, EstimatorSettings};
use shadowstep::steps::integrator::VectorIntegrator;
use shadowstep::systems::system::Visitor;
use shadowstep::{Carried, Real};

use crate::error::Error;

/// What follows a run: it takes states as they are made, and outputs.
pub trait Follower<N: Real> {
    /// The run begins, at the state `from` or at t = 0; an estimate needs `reach` states before its own.
    fn begin(&mut self, reach: i64, integrator: &mut VectorIntegrator<'_, N>) {
        let _ = (reach, integrator);
    }

    /// What the next step is to carry along for it, where nothing is estimated.
    fn carried(&self) -> Carried {
        Carried::Nothing
    }

    /// The n of the next state that it takes after the state `n`, where nothing is estimated: those between are made at once, without increments.
    fn next(&self, n: i64) -> i64 {
        n + 1
    }

    /// What sees the states between.
    fn visitor(&mut self) -> Option<&mut dyn Visitor<N>> {
        None
    }

    /// Takes the state n, at which the system is. Where modified energies are estimated there are states before n = 0 and after the last one, which
    /// only the estimates need.
    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        let _ = (n, integrator);
    }

    /// Takes the output of n, and ends the run by `Break`. Without an estimate the system is at the state n; with one it is ahead, and the estimate has
    /// the state.
    ///
    /// # Errors
    /// What ends the run.
    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        integrator: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error>;

    /// What a state that is not finite means: an error, or the end of the run.
    ///
    /// # Errors
    /// That the run has failed.
    fn failed(&mut self, error: RunError) -> Result<(), Error>;
}

/// Makes the states n = `from`, …, steps, and gives them to the follower, with estimates if there are settings for these. The system is at the state
/// `from`, or at t = 0. Returns whether the follower ended the run.
///
/// # Errors
/// Those of the follower.
pub(crate) fn follow<N: Real + 'static, F: Follower<N> + ?Sized>(
    integrator: &mut VectorIntegrator<'_, N>,
    (from, steps): (Option<i64>, u64),
    settings: Option<&EstimatorSettings>,
    follower: &mut F,
) -> Result<ControlFlow<()>, Error> {
    let ended = match settings {
        None => plain(integrator, (from.unwrap_or(0), steps), follower),
        Some(settings) => estimated(integrator, (from, steps), settings, follower),
    };
    match ended {
        Ok(ended) => Ok(ended),
        Err(Failed::Run(error)) => follower.failed(error).map(|()| Break(())),
        Err(Failed::Follower(error)) => Err(error),
    }
}

/// Why a run ends early.
enum Failed {
    Run(RunError),
    Follower(Error),
}

impl From<RunError> for Failed {
    fn from(error: RunError) -> Self {
        Failed::Run(error)
    }
}

impl From<Error> for Failed {
    fn from(error: Error) -> Self {
        Failed::Follower(error)
    }
}

/// Without states beyond both ends, and with increments only where the follower needs them.
fn plain<N: Real, F: Follower<N> + ?Sized>(
    integrator: &mut VectorIntegrator<'_, N>,
    (from, steps): (i64, u64),
    follower: &mut F,
) -> Result<ControlFlow<()>, Failed> {
    let mut trajectory = Trajectory::plain(integrator, from, steps)?;
    let (mut reached, mut next) = (from, from);
    loop {
        if next > reached + 1 {
            trajectory.set_augmented(false);
            match follower.visitor() {
                Some(visitor) => trajectory.reach_visited(next - 1, visitor)?,
                None => trajectory.reach(next - 1)?,
            }
        }
        trajectory.set_augmented(follower.carried() == Carried::Increments);
        let Some(n) = trajectory.advance()?.map(|state| state.n) else { return Ok(Continue(())) };
        let integrator = &mut **trajectory.integrator();
        follower.state(n, integrator);
        if follower.output(n, None, integrator)?.is_break() {
            return Ok(Break(()));
        }
        reached = n;
        next = follower.next(n).min(i64::try_from(steps).unwrap_or(i64::MAX));
    }
}

/// With increments and an estimate at each state, and its error.
fn estimated<N: Real + 'static, F: Follower<N> + ?Sized>(
    integrator: &mut VectorIntegrator<'_, N>,
    (from, steps): (Option<i64>, u64),
    settings: &EstimatorSettings,
    follower: &mut F,
) -> Result<ControlFlow<()>, Failed> {
    let settings = settings.clone().with_errors(true);
    let mut run = match from {
        None => ShadowRun::new(integrator, steps, &settings)?,
        Some(from) => ShadowRun::resume(integrator, from, steps, &settings)?,
    };
    follower.begin(run.reach(), *run.integrator());
    loop {
        let next = run.advance_with(|n, trajectory| follower.state(n, *trajectory.integrator()))?;
        let Some(((n, estimate), trajectory)) = next else { return Ok(Continue(())) };
        if follower.output(n, Some(&estimate), *trajectory.integrator())?.is_break() {
            return Ok(Break(()));
        }
    }
}
