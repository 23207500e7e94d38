//! Schemes for Hamiltonian Monte Carlo on a Gaussian target: errors, acceptance and cost as records.

use serde::Serialize;
use shadowstep_analysis::gaussian::Gaussian;
use shadowstep_analysis::proposals::{MOST_STEPS, Proposals};

use crate::document::library::NamedScheme;
use crate::texts::error::Error;

/// What proposals are for, and which are looked for.
#[derive(Clone, Debug)]
pub struct SamplingTarget {
    gaussian: Gaussian,
    time: f64,
    wanted: Wanted,
}

/// Which number of steps is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// That with the least cost per accepted trajectory.
    LeastCost,
    /// The least with this acceptance.
    Acceptance(f64),
    /// This one.
    Steps(u64),
}

/// The proposals of a scheme.
#[derive(Clone, Debug, Serialize)]
pub struct SamplingRecord {
    /// The scheme.
    pub scheme: String,
    /// Its order for quadratic T.
    pub order: u32,
    /// The step size.
    pub step: f64,
    /// The number of steps.
    pub steps: u64,
    /// Evaluations of the gradient in a trajectory, and Hessian–vector products counted as such.
    pub gradients: u64,
    /// The expected error of the energy, in units of the temperature.
    pub error: f64,
    /// The largest for any number of steps of this size.
    pub largest_error: f64,
    /// The acceptance rate.
    pub acceptance: f64,
    /// Gradients per accepted trajectory.
    pub cost: f64,
}

impl SamplingTarget {
    /// A Gaussian with trajectories of this length, by default
    /// [a quarter of its slowest period](Gaussian::quarter_period).
    ///
    /// # Errors
    /// A time that is not positive, an acceptance that is not between 0 and 1, no steps.
    pub fn new(gaussian: Gaussian, time: Option<f64>, wanted: Wanted) -> Result<SamplingTarget, Error> {
        let time = time.unwrap_or_else(|| gaussian.quarter_period());
        if !(time > 0.0 && time.is_finite()) {
            return Err(Error::usage(format!("the time {time} is not positive and finite"), "use a time such as 10"));
        }
        match wanted {
            Wanted::Acceptance(rate) if !(rate > 0.0 && rate < 1.0) => {
                let message = format!("the acceptance {rate} is not between 0 and 1");
                Err(Error::usage(message, "use an acceptance such as 0.65"))
            }
            Wanted::Steps(0) => Err(Error::usage("the number of steps must be at least 1", "use a number such as 10")),
            _ => Ok(SamplingTarget { gaussian, time, wanted }),
        }
    }

    /// The Gaussian.
    pub fn gaussian(&self) -> &Gaussian {
        &self.gaussian
    }

    /// The length of trajectories.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Which number of steps is looked for.
    pub fn wanted(&self) -> Wanted {
        self.wanted
    }

    /// The proposals of a scheme with the number of steps that is looked for.
    ///
    /// # Errors
    /// A scheme that is not for Hamiltonian Monte Carlo, or too many or too few steps.
    pub fn record(&self, named: &NamedScheme) -> Result<SamplingRecord, Error> {
        let proved = named.scheme.proved();
        let proposals = Proposals::of(proved).map_err(|why| {
            Error::usage(format!("{} {why}", named.name), "`shadowstep sampling` lists the schemes that are suited")
        })?;
        let found = match self.wanted {
            Wanted::LeastCost => proposals.cheapest(&self.gaussian, self.time),
            Wanted::Acceptance(rate) => proposals.with_acceptance(&self.gaussian, self.time, rate),
            Wanted::Steps(steps) => proposals.proposal(&self.gaussian, self.time, steps),
        };
        let found = found.ok_or_else(|| match self.wanted {
            Wanted::Steps(steps) => {
                let message = format!("{steps} steps of {} are not stable over the time {}", named.name, self.time);
                Error::usage(message, "use more steps, or a shorter time")
            }
            _ => {
                let message = format!("trajectories of {} need more than {MOST_STEPS} steps", named.name);
                Error::usage(message, "use a shorter time, or a lower acceptance")
            }
        })?;
        Ok(SamplingRecord {
            scheme: named.name.clone(),
            order: proved.proof.quadratic.order,
            step: found.h,
            steps: found.steps,
            gradients: found.gradients,
            error: found.error,
            largest_error: found.largest_error,
            acceptance: found.acceptance,
            cost: found.cost(),
        })
    }
}

/// Whether a scheme makes proposals.
pub fn is_suited(named: &NamedScheme) -> bool {
    Proposals::of(named.scheme.proved()).is_ok()
}
