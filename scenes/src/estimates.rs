//! The modified energies along a run, one by one, and what the run shows.

use std::ops::ControlFlow;

use shadowstep::shadow::run::RunError;
use shadowstep::shadow::{Estimate, EstimatorSettings};
use shadowstep::steps::integrator::VectorIntegrator;

use crate::computation::RunNumber;
use crate::error::Error;
use crate::follow::Follower;
use crate::propagator::{Propagator, exact_flow};
use crate::run::Run;
use crate::scene::System;
use crate::start::{Begin, Steps};
use crate::watch::summary::{EnergySummary, Summary};
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

/// Takes each estimate with its n.
pub(crate) type Take<'a, N> = &'a mut dyn FnMut(i64, &Estimate<'_, N>) -> Result<(), Error>;

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
    pub fn take<N: RunNumber>(self, context: &N::Context, take: Take<'_, N>) -> Result<Finished, Error> {
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
                    take(n, &estimate)?;
                }
                Ok(Finished { evaluations: 0, own_evaluations: 0, energy: None, summary: None })
            }
        }
    }

    /// Those of a scheme.
    fn along<N: RunNumber>(
        self,
        integrator: &mut VectorIntegrator<'_, N>,
        context: &N::Context,
        take: Take<'_, N>,
    ) -> Result<Finished, Error> {
        let Estimates { system, run, settings, summarised, .. } = self;
        let (q, p) = system.start(context);
        let initial = integrator.energy_at(&q, &p);
        let watch = Watch::begin(integrator, run, (0, initial), Energies::All, summarised);
        let watch = watch.map_err(|error| self.failed(&error))?.of_system(system, integrator);
        let last = i64::try_from(run.steps).unwrap_or(i64::MAX);
        let mut along = Along { estimates: self, take, watch, last, at_first: 0, at_last: 0 };
        // none ends the run
        let _ = N::follow(integrator, (None, run.steps), Some(settings), &mut along)?;
        let Along { watch, at_first, at_last, .. } = along;
        Ok(Finished {
            evaluations: integrator.state().evaluations(),
            own_evaluations: at_last - at_first,
            energy: Some(watch.energy()),
            summary: watch.summary(run),
        })
    }

    fn failed(self, error: &RunError) -> Error {
        self.run.failed_naming(error, &self.system.coordinates, &self.system.momenta)
    }
}

/// Follows a run of a scheme.
struct Along<'a, N: RunNumber> {
    estimates: Estimates<'a>,
    take: Take<'a, N>,
    watch: Watch<N>,
    /// The n of the last state of the run.
    last: i64,
    /// Evaluations of the gradient before the first and after the last step of the run.
    at_first: u64,
    at_last: u64,
}

impl<N: RunNumber> Follower<N> for Along<'_, N> {
    fn state(&mut self, n: i64, integrator: &mut VectorIntegrator<'_, N>) {
        if n == 0 {
            self.at_first = integrator.state().evaluations();
        }
        if n == self.last {
            self.at_last = integrator.state().evaluations();
        }
        if 0 < n && n <= self.last {
            self.watch.include(n, integrator);
        }
    }

    fn output(
        &mut self,
        n: i64,
        estimate: Option<&Estimate<'_, N>>,
        _: &mut VectorIntegrator<'_, N>,
    ) -> Result<ControlFlow<()>, Error> {
        (self.take)(n, estimate.expect("estimates are made"))?;
        Ok(ControlFlow::Continue(()))
    }

    fn failed(&mut self, error: RunError) -> Result<(), Error> {
        Err(self.estimates.failed(&error))
    }
}
