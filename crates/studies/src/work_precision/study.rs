//! A study: the runs of several schemes on a problem, beside the same reference.

use std::path::{Path, PathBuf};
use std::time::Duration;

use num_integer::Integer;
use shadowstep::Scheme;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_scenes::{Error, System};
use shadowstep_schemes::Kinetic;

use crate::work_precision::best::{Curve, cost_of};
use crate::work_precision::calculation::{Calculation, Outcome};
use crate::work_precision::of::Of;
use crate::work_precision::order::MeasuredOrder;
use crate::work_precision::problem::{MOST_SAMPLES, Problem, most_samples};
use crate::work_precision::reference::{Reference, Resolution};
use crate::work_precision::run::Measurement;
use crate::work_precision::series::{Series, StepRange, coarsest};
use crate::work_precision::size::Size;
use crate::work_precision::timing::{SHORTEST, StepTime};
use crate::work_precision::work::Work;
use crate::{Observer, Store};

/// The coarsest run has this number of steps between samples, so that rounding to samples changes the number of steps
/// little.
const STEPS_PER_SAMPLE: u64 = 8;

/// Errors of halves of a run are known from this number of samples on.
const FEWEST_OF_GROWTH: u64 = 4;

/// The samples of runs in transformed time.
const SAMPLES_IN_TIME: u64 = 16;

/// Medians of times are at most this multiple of the shortest repeat, on a machine without other load.
const LARGEST_SPREAD: f64 = 1.3;

/// What is compared, and where the outcomes are saved.
pub struct Request<'a> {
    /// The system, the interval of time and the number type.
    pub problem: Problem<'a>,
    /// The schemes.
    pub schemes: &'a [NamedScheme],
    /// The steps.
    pub range: StepRange,
    /// The limit of the time for the reference.
    pub reference_time: Duration,
    /// An error of the reference that is small enough; without one it is below the round-off of the runs.
    pub resolution: Option<Size>,
    /// The shortest repeat of a scheme's steps that are timed; 4 ms at most.
    pub shortest_repeat: Duration,
    /// Outcomes are saved in this folder one by one; what it has already is not computed again.
    pub folder: PathBuf,
}

/// The results.
#[derive(Debug)]
pub struct Study<'a> {
    /// What was compared.
    pub problem: Problem<'a>,
    /// With what positions are compared.
    pub reference: Reference,
    /// In the order of the request; schemes that failed are left out.
    pub schemes: Vec<Studied<'a>>,
}

/// The results of a scheme.
#[derive(Debug)]
pub struct Studied<'a> {
    /// The scheme.
    pub scheme: &'a NamedScheme,
    /// Its runs.
    pub series: Series,
    /// The time of a step.
    pub time: StepTime,
}

/// What an error costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Evaluations of the gradient, and what costs about as much: Hessian–vector products, flows of a dominant part.
    Evaluations,
    /// Seconds.
    Seconds,
}

impl<'a> Request<'a> {
    /// Runs down to round-off beside a reference, for which there is this time.
    pub fn new(
        problem: Problem<'a>,
        schemes: &'a [NamedScheme],
        range: StepRange,
        reference_time: Duration,
        folder: &Path,
    ) -> Self {
        let (resolution, shortest_repeat, folder) = (None, Duration::MAX, folder.to_owned());
        Request { problem, schemes, range, reference_time, resolution, shortest_repeat, folder }
    }

    /// Makes all runs that the folder lacks, on all cores, and then times the steps of all schemes by turns.
    ///
    /// # Errors
    /// H that is not finite at t = 0; no reference; a folder that cannot be written or that another process uses; an
    /// observer that stops. A scheme that fails is reported to the observer.
    pub fn study(&self, observer: &mut dyn Observer) -> Result<Study<'a>, Error> {
        self.problem.check_energy()?;
        self.problem.check_duration()?;
        let mut store = Store::open(&self.folder, observer)?;
        let problem = self.problem;
        let wanted = match self.resolution {
            Some(error) if !error.is_finite() => {
                return self.beside(Reference::none(problem, self.samples()), store, observer);
            }
            Some(error) => {
                let resolution = Resolution { error, steps: None, seconds: self.reference_time.as_secs_f64() };
                Calculation::resolving(problem, self.samples(), resolution)
            }
            None => Calculation::reference(problem, self.samples(), self.reference_time),
        };
        let Outcome::Reference(reference) = store.compute_one(wanted, observer)? else {
            unreachable!("a reference was requested")
        };
        self.beside(reference, store, observer)
    }

    /// The runs beside a reference, and the times of their steps.
    fn beside(&self, reference: Reference, mut store: Store, observer: &mut dyn Observer) -> Result<Study<'a>, Error> {
        let problem = self.problem;
        let series = |scheme| Calculation::series(problem, scheme, &reference, &self.range);
        let found = store.compute(&self.schemes.iter().map(series).collect::<Vec<_>>(), observer)?;
        let all: Vec<(&NamedScheme, Series)> = self
            .schemes
            .iter()
            .zip(found)
            .filter_map(|(scheme, outcome)| match outcome {
                Some(Outcome::Series(series)) => Some((scheme, series)),
                _ => None,
            })
            .collect();
        let timed = all.iter().map(|(scheme, series)| (*scheme, series.runs.last().map_or(1, |run| run.steps)));
        let shortest = self.shortest_repeat.min(SHORTEST);
        let wanted = Calculation::times(problem, &timed.collect::<Vec<_>>(), shortest);
        let Outcome::Times(times) = store.compute_one(wanted, observer)? else { unreachable!("times were requested") };
        let schemes = all.into_iter().zip(times);
        let schemes = schemes.map(|((scheme, series), time)| Studied { scheme, series, time }).collect();
        Ok(Study { problem, reference, schemes })
    }

    /// The number of samples: they are at states of all runs.
    fn samples(&self) -> u64 {
        match &self.range {
            // at physical times, which no states have
            _ if self.problem.length.is_some() => SAMPLES_IN_TIME,
            StepRange::Given(steps) => {
                let common = steps.iter().fold(0, |common: u64, steps| common.gcd(steps)).max(1);
                most_samples(common)
            }
            StepRange::Automatic { target, .. } => {
                let steps = self.schemes.iter().map(|scheme| coarsest(self.problem, scheme)).fold(f64::MAX, f64::min);
                // advice needs the growth of errors
                let least = if target.is_some() { FEWEST_OF_GROWTH } else { 1 };
                (steps as u64 / STEPS_PER_SAMPLE).clamp(least, MOST_SAMPLES)
            }
        }
    }
}

/// The proved order of a scheme for the kinetic energy of a problem; of a processed scheme the effective one, as its
/// runs are read through the post-map.
pub(crate) fn proved_order(scheme: &NamedScheme, problem: Problem<'_>) -> u32 {
    if let Some(effective) = &scheme.scheme.proved().proof.effective {
        let kinetic = if problem.system.has_general_kinetic() { Kinetic::Any } else { Kinetic::Quadratic };
        return effective.for_kinetic(kinetic).order;
    }
    let summary = scheme.scheme.summary();
    if problem.system.has_general_kinetic() { summary.order } else { summary.order_quadratic }
}

impl Study<'_> {
    /// The schemes that meet an error, with their costs, the cheapest first.
    pub fn cheapest(&self, of: Of, cost: Cost, error: Size) -> Vec<(&Studied<'_>, f64)> {
        let cost_of =
            |studied| Some((studied, cost_of(&Studied::curve(studied, of, cost, self.problem.system), error)?));
        let mut all: Vec<(&Studied<'_>, f64)> = self.schemes.iter().filter_map(cost_of).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        all
    }

    /// A remark where the times of steps vary by so much that they say little of the schemes.
    pub fn remark_on_times(&self) -> Option<String> {
        let spread = self.schemes.iter().map(|studied| studied.time.median / studied.time.least).fold(1.0, f64::max);
        (spread > LARGEST_SPREAD).then(|| {
            format!(
                "Medians of times are up to {spread:.1} times the shortest repeat: the machine has other load, \
                and times mean little."
            )
        })
    }

    /// The decades of an error that some scheme reaches, from the largest one.
    pub(crate) fn decades(&self, of: Of) -> impl Iterator<Item = Size> {
        let errors = self.schemes.iter().flat_map(|studied| &studied.series.runs).filter_map(|run| of.error(run));
        let logs = errors.map(Size::log10).filter(|log10| log10.is_finite());
        let (least, most) =
            logs.fold((f64::INFINITY, -1.0_f64), |(least, most), log10| (least.min(log10), most.max(log10)));
        // relative errors above 1/10 are no precision
        let most = most.min(-1.0).floor() as i32;
        let least = if least.is_finite() { least.ceil() as i32 } else { most + 1 };
        (least..=most).rev().map(|exponent| Size::power_of_ten(f64::from(exponent)))
    }
}

impl Studied<'_> {
    /// The seconds of a run without anything but its steps.
    pub fn seconds(&self, run: &Measurement) -> f64 {
        self.time.median * run.steps as f64
    }

    /// The proved order for the kinetic energy of the problem.
    pub fn proved_order(&self, problem: Problem<'_>) -> u32 {
        proved_order(self.scheme, problem)
    }

    /// Evaluations of the gradient in a step.
    pub fn evaluations_per_step(&self) -> u64 {
        self.scheme.scheme.summary().evaluations as u64
    }

    /// The measured order with the steps at which it holds, of the position or of H.
    pub fn order(&self, problem: Problem<'_>, of: Of) -> Option<MeasuredOrder> {
        let step = |run: &Measurement| problem.size() / run.steps as f64;
        let points = self.series.runs.iter().filter_map(|run| Some((step(run), of.error(run)?.log10())));
        MeasuredOrder::of(&points.filter(|(_, error)| error.is_finite()).collect::<Vec<_>>())
    }

    /// Costs and log₁₀ of errors, in the order of cost.
    pub(crate) fn curve(&self, of: Of, cost: Cost, system: &System) -> Curve {
        let Work { products, flows, .. } = Work::of_step(self.scheme, system);
        let cost = |run: &Measurement| match cost {
            Cost::Evaluations => (run.evaluations + run.steps * (products + flows)) as f64,
            Cost::Seconds => self.seconds(run),
        };
        self.series.runs.iter().filter_map(|run| Some((cost(run), of.error(run)?.log10()))).collect()
    }
}
