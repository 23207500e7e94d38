//! What a study is made of: the reference, the runs of each scheme, the time of their steps. Each is identified by its
//! JSON.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use shadowstep_scenes::library::NamedScheme;

use crate::work_precision::problem::Problem;
use crate::work_precision::reference::{Origin, Reference, Resolution};
use crate::work_precision::series::{Series, SeriesOf, StepRange};
use crate::work_precision::size::Size;
use crate::work_precision::timing::{StepTime, time_of_steps};
use crate::{Continues, Error};

/// Outcomes of another revision are computed again; a change of what is computed needs a new one.
const REVISION: u32 = 6;

/// A calculation with what it needs.
#[derive(Serialize)]
pub(crate) struct Calculation<'a> {
    revision: u32,
    /// The fingerprint of the problem.
    on: String,
    quantity: Quantity,
    #[serde(skip)]
    problem: Problem<'a>,
    #[serde(skip)]
    schemes: Vec<&'a NamedScheme>,
    #[serde(skip)]
    reference: Option<&'a Reference>,
}

/// What is computed.
#[derive(Clone, Debug, Serialize)]
enum Quantity {
    /// The reference, with a limit in seconds.
    Reference { samples: u64, seconds: f64 },
    /// A reference with errors of about a size.
    Resolving { samples: u64, resolution: Resolution },
    /// The runs of a scheme, which is identified by its weights, beside a reference.
    Series { scheme: String, samples: u64, origin: Origin, error: Size, range: StepRange },
    /// The time of a step of each scheme, with a number of steps to the end.
    Times { schemes: Vec<(String, u64)>, shortest: Duration },
}

/// The result of a calculation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Outcome {
    Reference(Reference),
    Series(Series),
    Times(Vec<StepTime>),
}

impl<'a> Calculation<'a> {
    pub(crate) fn reference(problem: Problem<'a>, samples: u64, time: Duration) -> Self {
        let quantity = Quantity::Reference { samples, seconds: time.as_secs_f64() };
        Calculation::new(problem, quantity, Vec::new(), None)
    }

    pub(crate) fn resolving(problem: Problem<'a>, samples: u64, resolution: Resolution) -> Self {
        Calculation::new(problem, Quantity::Resolving { samples, resolution }, Vec::new(), None)
    }

    pub(crate) fn series(
        problem: Problem<'a>,
        scheme: &'a NamedScheme,
        reference: &'a Reference,
        range: &StepRange,
    ) -> Self {
        let quantity = Quantity::Series {
            scheme: scheme.identity(),
            samples: reference.samples(),
            origin: reference.origin.clone(),
            error: reference.error(),
            range: range.clone(),
        };
        Calculation::new(problem, quantity, vec![scheme], Some(reference))
    }

    pub(crate) fn times(problem: Problem<'a>, schemes: &[(&'a NamedScheme, u64)], shortest: Duration) -> Self {
        let named = schemes.iter().map(|(scheme, steps)| (scheme.identity(), *steps)).collect();
        let schemes = schemes.iter().map(|(scheme, _)| *scheme).collect();
        Calculation::new(problem, Quantity::Times { schemes: named, shortest }, schemes, None)
    }

    fn new(
        problem: Problem<'a>,
        quantity: Quantity,
        schemes: Vec<&'a NamedScheme>,
        reference: Option<&'a Reference>,
    ) -> Self {
        Calculation { revision: REVISION, on: problem.fingerprint(), quantity, problem, schemes, reference }
    }
}

impl crate::Calculation for Calculation<'_> {
    type Outcome = Outcome;
    type Shared = ();

    fn cost(&self) -> f64 {
        match &self.quantity {
            Quantity::Reference { seconds, .. }
            | Quantity::Resolving { resolution: Resolution { seconds, .. }, .. }
            | Quantity::Series { range: StepRange::Automatic { seconds, .. }, .. } => *seconds,
            Quantity::Series { range: StepRange::Given(steps), .. } => steps.iter().sum::<u64>() as f64 * 1e-6,
            Quantity::Times { schemes, .. } => schemes.len() as f64 * 0.1,
        }
    }

    fn compute(&self, (): &(), continues: Continues<'_>) -> Result<Outcome, Error> {
        match &self.quantity {
            Quantity::Reference { samples, seconds } => {
                let time = Duration::from_secs_f64(*seconds);
                Reference::compute(self.problem, *samples, time, &|| continues(0.5)).map(Outcome::Reference)
            }
            Quantity::Resolving { samples, resolution } => {
                Reference::resolving(self.problem, *samples, *resolution, &|| continues(0.5)).map(Outcome::Reference)
            }
            Quantity::Series { range, .. } => {
                let reference = self.reference.expect("a series has one");
                let series_of = SeriesOf { problem: self.problem, scheme: self.schemes[0], reference, range };
                series_of.make(continues).map(Outcome::Series)
            }
            Quantity::Times { schemes, shortest } => {
                let steps = self.schemes.iter().copied().zip(schemes.iter().map(|(_, steps)| *steps));
                time_of_steps(self.problem, &steps.collect::<Vec<_>>(), *shortest).map(Outcome::Times)
            }
        }
    }
}
