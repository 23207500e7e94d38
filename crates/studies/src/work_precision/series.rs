//! The numbers of steps with which a scheme runs: equal numbers of evaluations for all schemes, from about the
//! stability limit down to round-off, or to the end of a budget of time.

use std::f64::consts::TAU;
use std::time::Duration;

use num_traits::ToPrimitive;
use serde::{Deserialize, Serialize};
use shadowstep::steps::scheme::MapKind;
use shadowstep::{Rational, Scheme};
use shadowstep_analysis::stability::Stability;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::library::NamedScheme;

use crate::work_precision::of::Of;
use crate::work_precision::problem::Problem;
use crate::work_precision::reference::Reference;
use crate::work_precision::run::Measurement;
use crate::work_precision::size::Size;
use crate::{Continues, Error};

/// Evaluations grow by the factor 2^(1/2) from run to run.
const RUNS_PER_DOUBLING: f64 = 2.0;
/// The first step is this multiple of the stability limit.
const BEYOND: f64 = 1.5;
/// Round-off is reached where this number of runs, each with more evaluations, have improved neither error.
const WITHOUT_GAIN: usize = 6;
/// A run has some precision if the error of H is below this, log₁₀.
const SOME_PRECISION: f64 = -1.0;
/// The most runs of a scheme.
const MOST_RUNS: i32 = 80;
/// A run that is timed has this number of steps: with fewer, windows of the monitor would be too close to each other.
const FEWEST_TIMED: u64 = 256;
/// Errors of two runs beside a target are close if they differ by less; log₁₀.
const CLOSE: f64 = 0.7;
/// The most runs between two runs beside a target.
const MOST_REFINED: usize = 4;

/// The runs of a scheme, the one with the fewest steps first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// What its runs have shown.
    pub runs: Vec<Measurement>,
    /// Why there are no more.
    pub end: End,
}

/// Why a series ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum End {
    /// All steps that were asked for are made.
    Complete,
    /// Round-off is reached.
    RoundOff,
    /// The time is over.
    Time,
}

/// An error that is small enough.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// Which error.
    pub of: Of,
    /// Its size.
    pub error: Size,
}

/// Which steps a scheme makes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum StepRange {
    /// From the stability limit on.
    Automatic {
        /// The time for all runs of a scheme, in seconds.
        seconds: f64,
        /// The error that is small enough; without one they go on to round-off.
        target: Option<Target>,
    },
    /// These numbers of steps.
    Given(Vec<u64>),
}

/// The runs of a scheme on a problem.
pub(crate) struct SeriesOf<'a> {
    pub(crate) problem: Problem<'a>,
    pub(crate) scheme: &'a NamedScheme,
    pub(crate) reference: &'a Reference,
    pub(crate) range: &'a StepRange,
}

impl SeriesOf<'_> {
    /// Makes the runs, which end where `continues` with the part that is done returns false.
    pub(crate) fn make(&self, continues: Continues<'_>) -> Result<Series, Error> {
        match self.range {
            StepRange::Automatic { seconds, target } => self.automatic(*seconds, *target, continues),
            StepRange::Given(steps) => {
                let mut runs = Vec::new();
                for (done, &steps) in steps.iter().enumerate() {
                    if !continues(done as f64 / self.range.len() as f64) {
                        break;
                    }
                    runs.extend(self.measure(steps, &|| true)?);
                }
                Ok(Series { runs, end: End::Complete })
            }
        }
    }

    fn automatic(&self, seconds: f64, target: Option<Target>, continues: Continues<'_>) -> Result<Series, Error> {
        let begin = CpuTime::begin();
        let mut runs: Vec<Measurement> = Vec::new();
        let mut end = End::Time;
        for index in self.first_index()..self.first_index() + MOST_RUNS {
            let steps = self.steps(index);
            if runs.last().is_some_and(|last| last.steps == steps) {
                continue;
            }
            if !continues((begin.elapsed().as_secs_f64() / seconds).min(1.0)) {
                break;
            }
            let this = CpuTime::begin();
            // a run for advice is not completed beyond its time
            let in_time = || target.is_none() || begin.elapsed().as_secs_f64() <= seconds;
            let Some(run) = self.measure(steps, &in_time)? else { break };
            runs.push(run);
            if let Some(target) = target.filter(|target| target.is_met(&runs)) {
                self.refine(&mut runs, target, &in_time)?;
                end = End::Complete;
                break;
            }
            if is_round_off(&runs) {
                end = End::RoundOff;
                break;
            }
            if begin.elapsed() + next(this.elapsed()) > Duration::from_secs_f64(seconds) {
                break;
            }
        }
        Ok(Series { runs, end })
    }

    /// Makes runs between the last one that misses the target and the first one that meets it, until their errors are
    /// close: where errors fall like exponentials of the step, an error between two that are decades apart is not
    /// known.
    fn refine(&self, runs: &mut Vec<Measurement>, target: Target, continues: &dyn Fn() -> bool) -> Result<(), Error> {
        for _ in 0..MOST_REFINED {
            let Some((at, steps)) = self.between(runs, target) else { break };
            let Some(run) = self.measure(steps, continues)? else { break };
            runs.insert(at, run);
        }
        Ok(())
    }

    /// Where a run is missing that meets the target or nearly so, and its number of steps.
    fn between(&self, runs: &[Measurement], target: Target) -> Option<(usize, u64)> {
        let error = |run: &Measurement| target.of.at_most(run).map_or(f64::INFINITY, Size::log10);
        let at = 1 + runs.iter().rposition(|run| error(run) > target.error.log10())?;
        let [before, after] = [runs.get(at - 1)?, runs.get(at)?];
        let samples = self.reference.samples();
        let mean = samples * ((before.steps as f64 * after.steps as f64).sqrt() / samples as f64).round().to_u64()?;
        let is_new = before.steps < mean && mean < after.steps;
        (error(before) - error(after) > CLOSE && is_new).then_some((at, mean))
    }

    /// The number of steps of the run with this index: the scheme's evaluations are about samples · 2^(index/2), and
    /// the samples are at states.
    fn steps(&self, index: i32) -> u64 {
        let each = self.scheme.scheme.summary().evaluations as f64;
        let per_sample = (f64::from(index) / RUNS_PER_DOUBLING).exp2() / each;
        self.reference.samples() * per_sample.round().max(1.0).to_u64().unwrap_or(1)
    }

    /// The index of the first run, whose step is below the stability limit times a factor.
    fn first_index(&self) -> i32 {
        let evaluations = self.scheme.scheme.summary().evaluations as f64;
        let steps = coarsest(self.problem, self.scheme) / self.reference.samples() as f64;
        (RUNS_PER_DOUBLING * (steps.max(1.0) * evaluations).log2()).floor().to_i32().unwrap_or(0)
    }

    fn measure(&self, steps: u64, continues: &dyn Fn() -> bool) -> Result<Option<Measurement>, Error> {
        self.problem.arithmetic.compute(Run { series_of: self, steps, continues })
    }
}

/// The number of steps of 1.5 times the stability limit of the fastest oscillation; one in a turn of it where that is
/// solved exactly.
pub(crate) fn coarsest(problem: Problem<'_>, scheme: &NamedScheme) -> f64 {
    let step = stable_step(problem, scheme).map(|limit| BEYOND * limit);
    let turn = || problem.system.fastest_motion().filter(|_| problem.length.is_none()).map(|motion| TAU / motion.omega);
    step.or_else(turn).map_or(1.0, |step| (problem.duration() / step).max(1.0))
}

/// The largest stable step for the fastest oscillation, linearised at the initial state; `None` where nothing
/// oscillates.
pub(crate) fn stable_step(problem: Problem<'_>, scheme: &NamedScheme) -> Option<f64> {
    let stability = Stability::of_scheme(scheme.scheme.proved());
    // no limit exceeds 2 a force
    let most = 2.0 * scheme.scheme.summary().evaluations as f64;
    let limit: f64 = stability.and_then(|stability| stability.limit.parse().ok()).unwrap_or(most);
    problem.system.fastest_frequency().map(|frequency| limit / frequency.omega)
}

/// The seconds that a run of this number of steps takes for each of them with all that is measured, by the beginning of
/// the run.
pub(crate) fn seconds_per_step(
    problem: Problem<'_>,
    scheme: &NamedScheme,
    steps: u64,
    shortest: Duration,
) -> Result<f64, Error> {
    let mut made = FEWEST_TIMED.min(steps);
    loop {
        let until = problem.step_size(steps) * Rational::from_integer(made.into());
        let problem = Problem { until: &until, ..problem };
        let (reference, range) = (Reference::none(problem, 1), StepRange::Given(vec![made]));
        let begin = CpuTime::begin();
        SeriesOf { problem, scheme, reference: &reference, range: &range }.make(&|_| true)?;
        if begin.elapsed() >= shortest || made == steps {
            return Ok(begin.elapsed().as_secs_f64() / made as f64);
        }
        made = (2 * made).min(steps);
    }
}

impl Target {
    /// Two successive runs meet it, as one alone may do so by accident.
    fn is_met(self, runs: &[Measurement]) -> bool {
        let meets = |run: &Measurement| self.of.at_most(run).is_some_and(|error| error <= self.error);
        runs.len() > 1 && runs[runs.len() - 2..].iter().all(meets)
    }
}

impl StepRange {
    fn len(&self) -> usize {
        match self {
            StepRange::Automatic { .. } => 0,
            StepRange::Given(steps) => steps.len(),
        }
    }
}

/// The next run takes this longer.
fn next(last: Duration) -> Duration {
    last.mul_f64((1.0 / RUNS_PER_DOUBLING).exp2())
}

/// Whether the last runs improve neither the error of the position nor that of H.
fn is_round_off(runs: &[Measurement]) -> bool {
    let Some(first) = runs.len().checked_sub(WITHOUT_GAIN) else { return false };
    let (before, last) = runs.split_at(first);
    let least =
        |runs: &[Measurement], error: fn(&Measurement) -> f64| runs.iter().map(error).fold(f64::INFINITY, f64::min);
    let errors: [fn(&Measurement) -> f64; 2] =
        [|run| run.position.known().map_or(f64::INFINITY, Size::log10), |run| run.energy.log10()];
    before.iter().any(|run| run.energy.log10() < SOME_PRECISION)
        && errors.into_iter().all(|error| least(last, error) >= least(before, error))
}

/// One run in any number type.
struct Run<'a> {
    series_of: &'a SeriesOf<'a>,
    steps: u64,
    continues: &'a dyn Fn() -> bool,
}

impl Computation for Run<'_> {
    type Output = Result<Option<Measurement>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let SeriesOf { problem, scheme, reference, .. } = self.series_of;
        let of_output = scheme.scheme.processor().iter().filter(|(kind, _)| *kind == MapKind::Kick).count();
        // with a pre-map at the beginning and a post-map at the end
        let evaluations = self.steps * scheme.scheme.summary().evaluations as u64 + 2 * of_output as u64;
        Measurement::of::<N>(*problem, scheme, (self.steps, evaluations), reference, self.continues, context)
    }
}
