//! The modified energies along a run, one by one, and what the run shows.

use shadowstep::Integrator as _;
use shadowstep::integrator::VectorIntegrator;
use shadowstep::number::Rounded;
use shadowstep::run::{RunError, ShadowRun};
use shadowstep::shadow::{Estimate, EstimatorSettings};

use crate::error::Error;
use crate::propagator::{Propagator, exact_flow};
use crate::run::Run;
use crate::scene::System;
use crate::start::{Begin, Steps};
use crate::summary::{EnergySummary, Summary};
use crate::watch::{Energies, Watch};

/// A run whose modified energies are estimated.
#[derive(Clone, Copy)]
pub struct Estimates<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The scheme, or the exact flow.
    pub propagator: &'a Propagator,
    /// The steps.
    pub run: Run<'a>,
    /// Whether q and p are sums with remainders.
    pub compensated: bool,
    /// The estimator.
    pub settings: &'a EstimatorSettings,
    /// Whether a summary is made.
    pub summarised: bool,
}

/// What is known at the end of a run.
#[derive(Clone, Debug)]
pub struct Finished {
    /// Evaluations of the gradient, those for the states before and after the run included.
    pub evaluations: u64,
    /// Those for the steps of the run alone.
    pub own_evaluations: u64,
    /// The error of H; `None` for the exact flow.
    pub energy: Option<EnergySummary>,
    /// What the run has shown, if that is wanted; `None` for the exact flow.
    pub summary: Option<Summary>,
}

impl Estimates<'_> {
    /// Gives each estimate with its n to `take`.
    ///
    /// # Errors
    /// A state or a modified energy that is not finite, an exact flow that cannot be followed, and those of `take`.
    ///
    /// # Panics
    /// If the scheme is the exact flow of a system that has none, which [`Propagator::of_system`] excludes.
    pub fn take<N: Rounded + 'static>(
        self,
        context: &N::Context,
        mut take: impl FnMut(i64, Estimate<'_, N>) -> Result<(), Error>,
    ) -> Result<Finished, Error> {
        let Estimates { system, propagator, run, settings, .. } = self;
        match propagator {
            Propagator::Scheme(named) => {
                let (compensated, begin) = (self.compensated, Begin::InitialState);
                let steps = Steps { scheme: &named.scheme, h: run.h, compensated, displaced: false, begin };
                let mut integrator = system.integrator(steps, system.start(context), context)?;
                self.along(&mut *integrator, context, take)
            }
            Propagator::ExactFlow => {
                let setup = system.setup().expect("the exact flow was read for this system");
                let mut shadow = exact_flow(&setup, run, settings, context)?;
                while let Some((n, estimate)) = shadow.advance().map_err(|error| run.failed(&error))? {
                    take(n, estimate)?;
                }
                Ok(Finished { evaluations: 0, own_evaluations: 0, energy: None, summary: None })
            }
        }
    }

    /// Those of a scheme.
    fn along<N: Rounded + 'static>(
        self,
        integrator: &mut VectorIntegrator<'_, N>,
        context: &N::Context,
        mut take: impl FnMut(i64, Estimate<'_, N>) -> Result<(), Error>,
    ) -> Result<Finished, Error> {
        let Estimates { system: described, run, settings, summarised, .. } = self;
        let failed = |error: RunError| run.failed_naming(&error, &described.coordinates, &described.momenta);
        let (q, p) = described.start(context);
        let initial = integrator.system().energy_at(&q, &p);
        let watch = Watch::begin(integrator, run, (0, initial), Energies::All, summarised);
        let mut watch = watch.map_err(failed)?.of_system(described);
        let mut evaluations = Evaluations::default();
        let mut shadow = ShadowRun::new(integrator, run.steps, settings).map_err(failed)?;
        let last = i64::try_from(run.steps).unwrap_or(i64::MAX);
        while let Some((n, estimate)) = shadow
            .advance_with(|n, trajectory| {
                let integrator = &mut **trajectory.integrator();
                evaluations.count(n, last, integrator.state().evaluations());
                if 0 < n && n <= last {
                    watch.include(n, integrator);
                }
            })
            .map_err(failed)?
        {
            take(n, estimate)?;
        }
        Ok(Finished {
            evaluations: shadow.integrator().state().evaluations(),
            own_evaluations: evaluations.at_last - evaluations.at_first,
            energy: Some(watch.energy()),
            summary: watch.summary(run),
        })
    }
}

/// Evaluations of the gradient before the first and after the last step of the run.
#[derive(Default)]
struct Evaluations {
    at_first: u64,
    at_last: u64,
}

impl Evaluations {
    fn count(&mut self, n: i64, last: i64, evaluations: u64) {
        if n == 0 {
            self.at_first = evaluations;
        }
        if n == last {
            self.at_last = evaluations;
        }
    }
}
