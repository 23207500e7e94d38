//! What figures are made of: runs at many digits, and one in double precision; each is identified by its JSON.

use rug::Float;
use serde::{Deserialize, Serialize};
use shadowstep::number::Number;
use shadowstep::problems::Setup;
use shadowstep::run::{Finding, States, Trajectory};
use shadowstep::shadow::EstimatorSettings;
use shadowstep_scenes::library::EXACT_FLOW;
use shadowstep_scenes::propagator::{Propagator, motion, stepper};
use shadowstep_scenes::run::Run as Steps;

use crate::Error;
use crate::estimator;
use crate::noise::{self, Block, Differences};
use crate::run::Run;
use crate::tasks::Task;

/// Outcomes of another revision are computed again; a change of what is computed needs a new one.
const REVISION: u32 = 5;

/// Something to compute.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Calculation {
    revision: u32,
    quantity: Quantity,
}

/// What is computed, of which run.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Quantity {
    /// The drift of the modified energy.
    Drift { run: Run, estimator: EstimatorSettings },
    /// The modified energy at each step.
    Energies { run: Run, estimator: EstimatorSettings },
    /// The largest |q|.
    Farthest { run: Run },
    /// H at the end less H at the start.
    Transit { run: Run },
    /// The scatter and the wander of the modified energy in double precision.
    Noise { steps: u64, differences: Differences },
}

/// The result of a calculation; numbers of many digits are texts.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Outcome {
    Drift(Drift),
    Energies(Energies),
    Number(String),
    Blocks(Vec<Block>),
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Drift {
    pub(crate) drift: String,
    /// None where the estimator gives no errors.
    pub(crate) permanent: Option<Permanent>,
    pub(crate) orders: (u32, u32),
}

/// The permanent change of the modified energy: that between states with small estimated errors.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Permanent {
    pub(crate) change: String,
    pub(crate) largest_jump: String,
    /// The change is resolved if it exceeds this.
    pub(crate) resolution: String,
    pub(crate) resolved: bool,
}

/// One value a step, or between the steps.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Energies {
    pub(crate) times: Vec<f64>,
    /// |q|
    pub(crate) distances: Vec<f64>,
    pub(crate) values: Vec<String>,
    pub(crate) orders: Vec<u32>,
    /// log₁₀ of the estimated errors and of the last terms; none of 0, and where none is known.
    pub(crate) errors: Vec<Option<f64>>,
    pub(crate) last_terms: Vec<Option<f64>>,
}

impl Quantity {
    pub(crate) fn calculation(self) -> Calculation {
        Calculation { revision: REVISION, quantity: self }
    }
}

impl Task for Calculation {
    type Outcome = Outcome;

    fn cost(&self) -> f64 {
        let numbers = |run: &Run, estimator: f64, states: f64| {
            // a step of the exact flow is a series
            let step = if run.propagator == EXACT_FLOW { 3000.0 } else { 60.0 };
            (run.steps() as f64 + states) * (estimator + step) * f64::from(run.digits)
        };
        match &self.quantity {
            Quantity::Drift { run, estimator } | Quantity::Energies { run, estimator } => {
                numbers(run, estimator::cost(estimator), estimator::states(estimator))
            }
            Quantity::Farthest { run } | Quantity::Transit { run } => numbers(run, 0.0, 0.0),
            Quantity::Noise { steps, .. } => *steps as f64 * 200.0,
        }
    }

    fn compute(&self) -> Result<Outcome, Error> {
        match &self.quantity {
            Quantity::Drift { run, estimator } => drift(run, estimator).map(Outcome::Drift),
            Quantity::Energies { run, estimator } => energies(run, estimator).map(Outcome::Energies),
            Quantity::Farthest { run } => farthest(run).map(|number| Outcome::Number(number.to_text())),
            Quantity::Transit { run } => transit(run).map(|number| Outcome::Number(number.to_text())),
            Quantity::Noise { steps, differences } => noise::blocks(*steps, *differences).map(Outcome::Blocks),
        }
    }
}

/// Calls `make` with what a run needs.
fn with<T>(run: &Run, make: impl FnOnce(&Propagator, &Setup, Steps<'_>) -> Result<T, Error>) -> Result<T, Error> {
    let setup = run.setup();
    let propagator = Propagator::read(run.propagator, &setup)?;
    make(&propagator, &setup, Steps { propagator: run.propagator, h: &run.h(), steps: run.steps(), order: None })
}

fn drift(run: &Run, settings: &EstimatorSettings) -> Result<Drift, Error> {
    let settings = settings.clone().with_errors(estimator::is_bilinear(settings));
    let context = run.precision();
    let found = with(run, |propagator, setup, steps| {
        propagator.energy_drift::<Float>(setup, steps, &settings, &context, |_| ())
    })?;
    let permanent = found.permanent.map(|permanent| Permanent {
        change: permanent.change.to_text(),
        largest_jump: permanent.largest_jump.to_text(),
        resolution: permanent.resolution.to_text(),
        resolved: permanent.finding == Finding::Resolved,
    });
    Ok(Drift { drift: found.drift.to_text(), permanent, orders: found.orders })
}

fn energies(run: &Run, settings: &EstimatorSettings) -> Result<Energies, Error> {
    let settings = settings.clone().with_errors(true);
    let context = run.precision();
    let mut all = Energies::default();
    let size = |number: Option<&Float>| number.map(Number::log10_abs).filter(|size| size.is_finite());
    with(run, |propagator, setup, steps| {
        propagator.estimates::<Float>(setup, steps, &settings, &context, |n, estimate| {
            all.times.push(f64::from_rational(&steps.time_of_value(n, &settings), &()));
            all.distances.push(estimate.q.iter().map(|q| q.to_f64().powi(2)).sum::<f64>().sqrt());
            all.values.push(estimate.value.to_text());
            all.orders.push(estimate.order);
            all.errors.push(size(estimate.error));
            all.last_terms.push(size(estimate.last_term));
            Ok(())
        })
    })?;
    Ok(all)
}

fn farthest(run: &Run) -> Result<Float, Error> {
    let mut farthest = Float::new(53);
    states(run, |q| {
        let square = q.iter().fold(Float::new(53), |sum, q| sum + q.clone().square());
        farthest.max_mut(&square.sqrt());
    })?;
    Ok(farthest)
}

fn transit(run: &Run) -> Result<Float, Error> {
    let mut system = motion::<Float>(&run.setup(), &run.precision());
    let first = system.energy();
    let (q, p) = states(run, |_| ())?;
    Ok(system.energy_at(&q, &p) - first)
}

/// Gives q of each state, without modified energies, to `take`; returns the last q and p.
fn states(run: &Run, mut take: impl FnMut(&[Float])) -> Result<(Vec<Float>, Vec<Float>), Error> {
    with(run, |propagator, setup, steps| {
        let scheme = propagator.scheme().expect("states are those of schemes");
        let stepper = stepper(scheme, steps, &run.precision());
        let start = motion::<Float>(setup, &run.precision());
        let failed = |error| steps.failed(&error);
        let mut trajectory = Trajectory::plain(&stepper, start, 0, steps.steps).map_err(failed)?;
        while let Some(state) = trajectory.advance().map_err(failed)? {
            take(state.q);
        }
        Ok((trajectory.system().q().to_vec(), trajectory.system().p().to_vec()))
    })
}
