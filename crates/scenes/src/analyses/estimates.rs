//! The modified energies along a run, one by one, and what the run shows.

use shadowstep::Rational;
use shadowstep::shadow::run::ShadowRun;
use shadowstep::shadow::{Estimate, EstimatorSettings};

use crate::columns::at::{At, Place};
use crate::columns::column::Column;
use crate::document::library::NamedScheme;
use crate::execution::computation::RunNumber;
use crate::execution::posed::{Followed, Posed};
use crate::motion::propagator::Propagator;
use crate::run::Run;
use crate::run::arithmetic::Arithmetic;
use crate::scene::System;
use crate::texts::error::Error;
use crate::watch::Energies;
use crate::watch::summary::{EnergySummary, Summary};

/// A run whose modified energies are estimated.
#[derive(Clone, Copy)]
pub struct Estimates<'a> {
    /// H and the initial state.
    pub system: &'a System,
    /// The scheme, or the exact flow.
    pub propagator: &'a Propagator,
    /// The steps.
    pub run: Run<'a>,
    /// The number type.
    pub arithmetic: Arithmetic,
    /// The estimator.
    pub settings: &'a EstimatorSettings,
    /// Whether a summary is made.
    pub summarised: bool,
    /// The physical time at which the run ends, where time is transformed.
    pub until: Option<&'a Rational>,
}

/// Takes each estimate with its n.
pub(crate) type Take<'a, N> = &'a mut dyn FnMut(i64, &Estimate<'_, N>) -> Result<(), Error>;

/// What is known at the end of a run.
#[derive(Clone, Debug)]
pub struct Finished<N> {
    /// The number of steps.
    pub steps: u64,
    /// Evaluations of the gradient, those for the states before and after the run included.
    pub evaluations: u64,
    /// Those for the steps of the run alone.
    pub own_evaluations: u64,
    /// The error of H; `None` for the exact flow.
    pub energy: Option<EnergySummary>,
    /// What the run has shown, if that is wanted; `None` for the exact flow.
    pub summary: Option<Summary>,
    /// The physical time of the last state, where time is transformed.
    pub end: Option<N>,
    /// q and p at [`until`](Estimates::until); `None` without a step to it.
    pub at_until: Option<(Vec<N>, Vec<N>)>,
}

impl Estimates<'_> {
    /// Whether q and p are sums with remainders.
    pub(crate) fn is_compensated(&self) -> bool {
        self.arithmetic.is_compensated() && self.propagator.scheme().is_some()
    }

    /// Gives each estimate with its n to `take`.
    ///
    /// # Errors
    /// A state or a modified energy that is not finite, an exact flow that cannot be followed, and those of `take`.
    ///
    /// # Panics
    /// If the scheme is the exact flow of a system that has none, which [`Propagator::of_system`] excludes.
    pub fn take<N: RunNumber>(self, context: &N::Context, take: Take<'_, N>) -> Result<Finished<N>, Error> {
        let Estimates { system, propagator, run, settings, .. } = self;
        match propagator {
            Propagator::Scheme(named) => self.along(named, context, take),
            Propagator::ExactFlow => {
                let setup = system.setup().expect("the exact flow was read for this system");
                let shadow = ShadowRun::of_exact_flow(&setup, run.h, run.steps, settings, context);
                let mut shadow = shadow.map_err(|error| run.not_followed(&error))?;
                while let Some((n, estimate)) = shadow.advance().map_err(|error| run.failed(&error))? {
                    take(n, &estimate)?;
                }
                let (energy, summary, end, at_until) = (None, None, None, None);
                Ok(Finished { steps: run.steps, evaluations: 0, own_evaluations: 0, energy, summary, end, at_until })
            }
        }
    }

    /// Those of a scheme.
    fn along<N: RunNumber>(
        self,
        named: &NamedScheme,
        context: &N::Context,
        take: Take<'_, N>,
    ) -> Result<Finished<N>, Error> {
        let Estimates { system, run, settings, arithmetic, summarised, until, .. } = self;
        let posed = Posed {
            estimator: Some(settings),
            energies: Some(Energies::All),
            summarised,
            until,
            ..Posed::new(system, &named.scheme, run, (arithmetic, false))
        };
        let mut taking = Taking { take, end: None, at_until: None };
        let Followed { n, evaluations, own_evaluations, energy, summary, .. } =
            N::follow(&posed, context, &mut [&mut taking], &mut ())?;
        let Taking { end, at_until, .. } = taking;
        Ok(Finished { steps: n.unsigned_abs(), evaluations, own_evaluations, energy, summary, end, at_until })
    }
}

/// Takes the estimates of a run of a scheme.
struct Taking<'a, N: RunNumber> {
    take: Take<'a, N>,
    /// The physical time of the last state, where time is transformed.
    end: Option<N>,
    /// q and p at the physical end.
    at_until: Option<(Vec<N>, Vec<N>)>,
}

impl<N: RunNumber> Column<N> for Taking<'_, N> {
    fn next(&self, n: i64) -> i64 {
        n + 1
    }

    fn take(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        if at.place == Place::PhysicalEnd {
            let (q, p) = at.state();
            self.at_until = Some((q.to_vec(), p.to_vec()));
        }
        at.estimate.map_or(Ok(()), |estimate| (self.take)(at.n, estimate))
    }

    fn end(&mut self, at: &mut At<'_, '_, N>) -> Result<(), Error> {
        let system = at.system;
        self.end = system.time_of(at.state().0).cloned();
        Ok(())
    }
}
