//! What figures are made of: runs at many digits, and one in double precision; each is identified by its JSON.

use serde::{Deserialize, Serialize};
use shadowstep::shadow::EstimatorSettings;

use crate::Continues;
use crate::Error;
use crate::figures::escape::Escape;
use crate::figures::estimator;
use crate::figures::measured::{Drift, Energies, Measure, Orbit};
use crate::figures::noise::{self, Block, Differences};
use crate::figures::run::{EXACT_FLOW, Run};
use crate::figures::series;
use crate::figures::states::Recorded;

/// Outcomes of another revision are computed again; a change of what is computed needs a new one.
const REVISION: u32 = 6;

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
    /// Whether the body of Kepler's problem escapes.
    Escape { run: Run },
    /// The positions of a body in the plane.
    Orbit { run: Run },
    /// The largest |q − q of the exact flow|.
    CoordinateError { run: Run },
    /// H at the end less H at the start.
    Transit { run: Run },
    /// max − min of the modified Hamiltonian as a series, up to several powers of h.
    Series { run: Run },
    /// The scatter and the wander of the modified energy in double precision.
    Noise { steps: u64, differences: Differences },
}

/// The result of a calculation; numbers of many digits are texts.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Outcome {
    Drift(Drift),
    Energies(Energies),
    Escape(Escape),
    Orbit(Orbit),
    Number(String),
    Numbers(Vec<String>),
    Blocks(Vec<Block>),
}

impl Quantity {
    pub(crate) fn calculation(self) -> Calculation {
        Calculation { revision: REVISION, quantity: self }
    }

    /// The run and its estimator, if it has one.
    fn estimated(&self) -> Option<(&Run, &EstimatorSettings)> {
        match self {
            Quantity::Drift { run, estimator } | Quantity::Energies { run, estimator } => Some((run, estimator)),
            _ => None,
        }
    }

    /// The exact flow that it needs, which can be shared.
    fn flow(&self) -> Option<Run> {
        match self {
            Quantity::CoordinateError { run } => Some(run.clone().of_exact_flow()),
            _ => self.estimated().map(|(run, _)| run.clone()).filter(|run| run.propagator == EXACT_FLOW),
        }
    }

    /// The settings of the estimator, with errors where these are used.
    fn settings(&self) -> Option<EstimatorSettings> {
        match self {
            Quantity::Drift { estimator, .. } => Some(estimator.clone().with_errors(estimator::is_bilinear(estimator))),
            Quantity::Energies { estimator, .. } => Some(estimator.clone().with_errors(true)),
            _ => None,
        }
    }

    /// The time without that of an exact flow, in microseconds of one core of 2026.
    fn own_cost(&self) -> f64 {
        match self {
            Quantity::Drift { run, estimator } | Quantity::Energies { run, estimator } => {
                let states = run.steps() as f64 + estimator::states(estimator);
                states * (estimator::cost(estimator, run.dimension()) * run.digits_cost() + run.step_cost())
            }
            Quantity::Escape { run }
            | Quantity::Orbit { run }
            | Quantity::CoordinateError { run }
            | Quantity::Transit { run } => run.steps() as f64 * run.step_cost(),
            // a formula takes about as long as an estimate
            Quantity::Series { run } => run.steps() as f64 * (run.step_cost() + 300.0 * run.digits_cost()),
            Quantity::Noise { steps, .. } => *steps as f64 * 0.3,
        }
    }

    /// What it measures; an exact flow may have been recorded.
    fn compute(&self, flow: Option<&Recorded>, continues: Continues<'_>) -> Result<Outcome, Error> {
        let of = |run| Measure { run, flow, continues };
        let settings = || self.settings().expect("it has an estimator");
        match self {
            Quantity::Drift { run, .. } => of(run).drift(&settings()).map(Outcome::Drift),
            Quantity::Energies { run, .. } => of(run).energies(&settings()).map(Outcome::Energies),
            Quantity::Escape { run } => of(run).escape().map(Outcome::Escape),
            Quantity::Orbit { run } => of(run).orbit().map(Outcome::Orbit),
            Quantity::CoordinateError { run } => of(run).coordinate_error().map(Outcome::Number),
            Quantity::Transit { run } => of(run).transit().map(Outcome::Number),
            Quantity::Series { run } => series::variations(run, continues).map(Outcome::Numbers),
            Quantity::Noise { steps, differences } => {
                noise::blocks(*steps, *differences, continues).map(Outcome::Blocks)
            }
        }
    }
}

impl crate::Calculation for Calculation {
    type Outcome = Outcome;
    /// The exact flow, if they need one.
    type Shared = Option<Result<Recorded, Error>>;

    /// All that needs one exact flow, whose states cost more than what is done with them.
    fn group(&self) -> Option<String> {
        self.quantity.flow().map(|run| serde_json::to_string(&run).expect("a run can be written as JSON"))
    }

    fn share(group: &[&Self], continues: Continues<'_>) -> Self::Shared {
        let run = group[0].quantity.flow()?;
        let settings = group.iter().filter_map(|calculation| calculation.quantity.settings());
        let reach = settings.map(|settings| estimator::most_reach(&settings)).max().unwrap_or(0);
        Some(Measure { run: &run, flow: None, continues }.recorded(reach))
    }

    fn cost_of_shared(group: &[&Self]) -> f64 {
        let Some(run) = group[0].quantity.flow() else { return 0.0 };
        let states =
            group.iter().filter_map(|calculation| Some(estimator::states(calculation.quantity.estimated()?.1)));
        (run.steps() as f64 + states.fold(0.0, f64::max)) * run.exact_step_cost()
    }

    fn cost(&self) -> f64 {
        self.quantity.own_cost()
    }

    fn compute(&self, flow: &Self::Shared, continues: Continues<'_>) -> Result<Outcome, Error> {
        match flow {
            Some(Err(error)) => Err(Error::run(error.to_string(), "try a shorter time")),
            Some(Ok(flow)) => self.quantity.compute(Some(flow), continues),
            None => self.quantity.compute(None, continues),
        }
    }
}
