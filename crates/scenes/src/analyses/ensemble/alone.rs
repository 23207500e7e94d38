//! Trajectories one by one: of systems that are not computed in lanes.

use shadowstep::shadow::ensemble::{Outcome, outcomes};
use shadowstep::shadow::{BuildEstimator, FixedBilinear};
use shadowstep::{Integrator as _, Number as _};
use shadowstep_schemes::symbolic::Exact;

use super::settings::Observed;
use crate::run::start::{Begin, SceneIntegrator, Steps};
use crate::scene::split::ShownCoordinates;
use crate::scene::{SceneNumber, System};
use crate::texts::error::Error;

/// A system with its stepper, for one trajectory after the other.
pub(super) struct Alone {
    integrator: SceneIntegrator<f64>,
    shown: Option<ShownCoordinates<f64>>,
}

impl Alone {
    /// For these steps.
    pub(super) fn new(system: &System, steps: Steps<'_>) -> Result<Self, Error> {
        let steps = Steps { begin: Begin::Step, ..steps };
        let integrator = system.integrator(steps, system.start(&()), &())?;
        Ok(Alone { integrator, shown: system.shown(&()) })
    }

    /// What becomes of the trajectory from an initial state of the system, after this number of steps; `continues` is
    /// asked now and then.
    pub(super) fn outcome(
        &mut self,
        (system, steps): (&System, u64),
        (q, p): (&[Exact], &[Exact]),
        observed: Observed,
        continues: &dyn Fn() -> bool,
    ) -> Result<Outcome, Error> {
        let numbers = |exact: &[Exact]| exact.iter().map(|x| f64::from_rational(&x.value, &())).collect();
        let (q, p) = f64::start_at(system, (numbers(q), numbers(p)), &());
        let integrator = &mut self.integrator;
        integrator.system().state_mut().set(&q, &p);
        let dimension = integrator.system().massive_coordinates();
        let build = |k| BuildEstimator::<f64>::build(&FixedBilinear::new(k), integrator.step_size(), dimension, &());
        let estimator = observed.modified_energy.map(build).transpose();
        let estimator = estimator.map_err(|error| Error::usage(error.to_string(), "give another order"))?;
        let mut found = outcomes(&mut **integrator, (steps, observed.every), estimator.as_ref(), continues)
            .ok_or_else(|| Error::run("the ensemble was interrupted", "run it again"))?;
        let mut outcome = found.remove(0);
        if let Some(shown) = &mut self.shown {
            let (q, p) = shown.of_state(&outcome.q, &outcome.p);
            (outcome.q, outcome.p) = (q.to_vec(), p.to_vec());
        }
        Ok(outcome)
    }
}
