//! The end of a run in transformed time: how many steps fit before a physical time, and the last step to that time.

use shadowstep::number::Rounded;
use shadowstep::transformed_time::step_to_time;
use shadowstep::{Number, Ordered, Rational, Scheme, Stepper, System, ValidFor};

use crate::arithmetic::Computation;
use crate::error::Error;
use crate::run::Run;
use crate::scene;
use crate::start::{Begin, Steps, Work};
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
    ///
    /// A step whose state is not finite counts, so that the run finds it.
    fn count_steps(&self, until: &Rational) -> u64 {
        let compensated = self.arithmetic.is_compensated();
        let (displaced, begin) = (self.displaced, Begin::InitialState);
        let steps = Steps { scheme: &self.scheme.scheme, h: &self.h, compensated, displaced, begin };
        self.arithmetic.compute(Counting { system: &self.system, steps, until })
    }
}

struct Counting<'a> {
    system: &'a scene::System,
    steps: Steps<'a>,
    until: &'a Rational,
}

impl Computation for Counting<'_> {
    type Output = u64;

    fn compute<N: Rounded + 'static>(self, context: &N::Context) -> u64 {
        let Counting { system, steps, until } = self;
        let until = Until(N::from_rational(until, context));
        system.with(steps, system.start(context), context, until).unwrap_or(0)
    }
}

/// The physical time of the end.
struct Until<N>(N);

impl<N: Ordered> Work<N> for Until<N> {
    type Output = u64;

    fn with<S, M>(self, stepper: &Stepper<S, N>, mut system: M) -> u64
    where
        S: Scheme + Clone + ValidFor<M::Class> + 'static,
        M: System<Number = N> + 'static,
    {
        let zero = N::zero(&system.state().context());
        let forward = N::from_rational(stepper.h(), &system.state().context()) > zero;
        for n in 1..=MOST_STEPS {
            stepper.step(&mut system);
            let Some(t) = system.q().last().filter(|t| t.is_finite()) else { return n };
            if (forward && *t > self.0) || (!forward && *t < self.0) {
                return n - 1;
            }
        }
        MOST_STEPS
    }
}

/// Makes the last step from a state, unless its time is `until` already: then false.
///
/// # Errors
/// A state that is not finite on the way.
pub(crate) fn last_step<S, M>(
    stepper: &Stepper<S, M::Number>,
    system: &mut M,
    (q, p): (&[M::Number], &[M::Number]),
    (run, until): (Run<'_>, &Rational),
) -> Result<bool, Error>
where
    S: Scheme + Clone + ValidFor<M::Class>,
    M: System<Number: Ordered>,
{
    let until = <M::Number as Number>::from_rational(until, &system.state().context());
    system.state_mut().set(q, p);
    if q.last() == Some(&until) {
        return Ok(false);
    }
    match step_to_time(stepper, system, &until) {
        Some(_) => Ok(true),
        None => {
            let message = format!("{}: no last step to t = {until} has a finite state", run.name());
            Err(Error::run(message, "try a smaller step size"))
        }
    }
}
