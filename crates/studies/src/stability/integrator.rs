//! Systems with their steppers, as scenes make them: in a number type, or in one that is hidden, so that cases are
//! compiled once for all of them.

use shadowstep::shadow::Verdict;
use shadowstep::shadow::run::RunError;
use shadowstep::{Carried, StepSize};
use shadowstep_scenes::System;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunMonitor, RunNumber};
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::start::{Begin, SceneIntegrator, Steps};

use crate::stability::systems::rational;

/// Steps of a scheme with plain sums. Those from a state of the scheme are the steps as they stand, of a processed
/// scheme those of the kernel.
pub(crate) fn steps_of<'a>(scheme: &'a NamedScheme, h: &'a StepSize, begin: Begin) -> Steps<'a> {
    Steps { scheme: &scheme.scheme, h, compensated: false, displaced: false, begin }
}

/// A step size of a case.
pub(crate) fn step_size<H>(h: H) -> StepSize
where
    H: TryInto<StepSize, Error: std::fmt::Debug>,
{
    h.try_into().expect("cases use nonzero steps")
}

/// A system at its initial state with its stepper.
pub(crate) fn start<N: RunNumber>(system: &System, steps: Steps<'_>, context: &N::Context) -> SceneIntegrator<N> {
    system.integrator(steps, system.start(context), context).expect("cases use valid systems")
}

/// The same in the numbers of an arithmetic.
pub(crate) fn start_in(arithmetic: Arithmetic, system: &System, steps: Steps<'_>) -> Box<dyn AnyIntegrator> {
    arithmetic.compute(Start { system, steps })
}

/// Dispatches on the number type.
struct Start<'a> {
    system: &'a System,
    steps: Steps<'a>,
}

impl Computation for Start<'_> {
    type Output = Box<dyn AnyIntegrator>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Box<dyn AnyIntegrator> {
        let mut integrator = start::<N>(self.system, self.steps, context);
        let initial = integrator.system().energy();
        Box::new(InNumbers { integrator, initial, monitor: None })
    }
}

/// A system with its stepper in numbers of some type. All that is asked of a state is rounded to double precision once.
pub(crate) trait AnyIntegrator {
    /// One step.
    fn step(&mut self);

    /// A coordinate.
    fn q(&self, i: usize) -> f64;

    /// A momentum.
    fn p(&self, i: usize) -> f64;

    /// How many coordinates there are.
    fn dimension(&self) -> usize;

    /// q_i − q_j
    fn separation(&self, i: usize, j: usize) -> f64;

    /// |(q, p)|
    fn size(&self) -> f64;

    /// q and p ← q and p divided by a finite number.
    fn divide(&mut self, divisor: f64);

    /// H
    fn energy(&mut self) -> f64;

    /// H − H(0)
    fn energy_change(&mut self) -> f64;

    /// Begins a monitor by E_k with its error, with a window every `every` steps.
    ///
    /// # Panics
    /// If the state is not finite.
    fn watch(&mut self, k: u32, every: u64);

    /// One step that the monitor sees: whether it completes an estimate.
    ///
    /// # Errors
    /// A state that is not finite.
    fn watched_step(&mut self) -> Result<bool, RunError>;

    /// What the monitor has seen.
    fn monitor_outcome(&self) -> MonitorOutcome;
}

/// What a monitor reports of a run.
pub(crate) struct MonitorOutcome {
    /// The steps that were made.
    pub(crate) steps: u64,
    /// max − min of H
    pub(crate) energy_error: f64,
    /// The mean kinetic energy.
    pub(crate) kinetic: f64,
    pub(crate) verdict: Verdict,
}

struct InNumbers<N: RunNumber> {
    integrator: SceneIntegrator<N>,
    /// H(0)
    initial: N,
    monitor: Option<Box<RunMonitor<N>>>,
}

const WATCHED: &str = "the run is watched";

impl<N: RunNumber> AnyIntegrator for InNumbers<N> {
    fn step(&mut self) {
        self.integrator.step(Carried::Nothing);
    }

    fn q(&self, i: usize) -> f64 {
        self.integrator.state().q()[i].to_f64()
    }

    fn p(&self, i: usize) -> f64 {
        self.integrator.state().p()[i].to_f64()
    }

    fn dimension(&self) -> usize {
        self.integrator.state().q().len()
    }

    fn separation(&self, i: usize, j: usize) -> f64 {
        let q = self.integrator.state().q();
        let mut separation = q[i].clone();
        separation.subtract(&q[j]);
        separation.to_f64()
    }

    fn size(&self) -> f64 {
        let state = self.integrator.state();
        state.q().iter().chain(state.p()).fold(0.0, |size: f64, x| size.hypot(x.to_f64()))
    }

    fn divide(&mut self, divisor: f64) {
        let state = self.integrator.system().state_mut();
        let divisor = N::from_rational(&rational(divisor), &state.context());
        let divided = |numbers: &[N]| {
            let mut numbers = numbers.to_vec();
            numbers.iter_mut().for_each(|number| number.divide(&divisor));
            numbers
        };
        let (q, p) = (divided(state.q()), divided(state.p()));
        state.set(&q, &p);
    }

    fn energy(&mut self) -> f64 {
        self.integrator.system().energy().to_f64()
    }

    fn energy_change(&mut self) -> f64 {
        let mut change = self.integrator.system().energy();
        change.subtract(&self.initial);
        change.to_f64()
    }

    fn watch(&mut self, k: u32, every: u64) {
        self.monitor = Some(N::monitor(&mut *self.integrator, k, every).expect("initial states are finite"));
    }

    fn watched_step(&mut self) -> Result<bool, RunError> {
        let monitor = self.monitor.as_mut().expect(WATCHED);
        self.integrator.step(monitor.carried());
        N::observe(monitor, &mut *self.integrator).map(|sample| sample.is_some())
    }

    fn monitor_outcome(&self) -> MonitorOutcome {
        let monitor = self.monitor.as_ref().expect(WATCHED);
        let report = N::report(monitor);
        MonitorOutcome {
            steps: monitor.n(),
            energy_error: report.energy_error.to_f64(),
            kinetic: report.kinetic.to_f64(),
            verdict: report.verdict,
        }
    }
}
