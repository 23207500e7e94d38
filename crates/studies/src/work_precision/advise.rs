//! Advice: a scheme and a step size for an error, from runs over a part of the time, verified by one run over all of
//! it.

use std::f64::consts::TAU;
use std::ops::Range;
use std::path::PathBuf;
use std::time::Duration;

use num_traits::ToPrimitive;
use shadowstep::{Number, Rational, Scheme};
use shadowstep_scenes::library::NamedScheme;

use crate::work_precision::best::{Curve, cost_of};
use crate::work_precision::calculation::{Calculation, Outcome};
pub use crate::work_precision::choice::Choice;
use crate::work_precision::choice::last_order;
use crate::work_precision::convenient::convenient_step;
use crate::work_precision::length::length_of;
use crate::work_precision::of::Of;
use crate::work_precision::problem::Problem;
use crate::work_precision::reference::{Reference, Resolution, method_of_reference, seconds_of_reference};
use crate::work_precision::reference_scheme::largest_coordinate;
use crate::work_precision::run::{Measurement, PositionError};
use crate::work_precision::series::{End, Series, StepRange, Target, seconds_per_step, stable_step};
use crate::work_precision::size::Size;
use crate::work_precision::study::{Cost, Request, Studied, Study, proved_order};
pub use crate::work_precision::verified::Verified;
use crate::{Error, Observer, Store};

/// What is wanted.
pub struct AdviceRequest<'a> {
    /// The system, the interval of time and the number type.
    pub problem: Problem<'a>,
    /// The schemes to choose from.
    pub schemes: &'a [NamedScheme],
    /// Which error.
    pub of: Of,
    /// Its largest size.
    pub tolerance: Size,
    /// What is to be small.
    pub cost: Cost,
    /// The time for the search on all cores, in seconds: the reference, the runs of the schemes and the times of their
    /// steps. The runs that verify a choice take what they take.
    pub seconds: f64,
    /// Outcomes are saved in this folder.
    pub folder: PathBuf,
}

/// The answer.
#[derive(Debug)]
pub enum Advice<'a> {
    /// A scheme with a step that meets the tolerance, with up to two alternatives.
    Found {
        /// The best first.
        choices: Vec<Choice<'a>>,
        /// The error that a run of the first one had, from 0 to `until`.
        verified: Verified,
        /// The part of the time over which runs were made.
        part: f64,
        /// The schemes that the search had too little time for.
        unfinished: Unfinished<'a>,
    },
    /// No scheme has so small an error in this number type.
    OutOfReach {
        /// The smallest error that some scheme had, over the part of the time, and its name; `None` if there is none.
        least: Option<(Size, &'a str)>,
        /// Whether a state, its H or its error was not finite in every run.
        overflow: bool,
        /// The part of the time over which runs were made.
        part: f64,
        /// The error of the reference.
        reference: Size,
        /// Errors of positions are known above this, beside the reference.
        resolved: Size,
        /// Whether the time was over before round-off was reached.
        in_time: bool,
        /// The schemes that the search had too little time for.
        unfinished: Unfinished<'a>,
        /// How many runs over all of the time were expected to meet the tolerance, and missed it.
        missed: usize,
        /// A choice that may meet it, and above what errors are known over all of the time.
        unverified: Option<Box<(Choice<'a>, Size)>>,
    },
}

/// The schemes that a search had too little time for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Unfinished<'a> {
    /// Those without a run that has an error.
    pub untried: Vec<&'a str>,
    /// Those whose runs ended before the tolerance or round-off: their errors are extrapolated.
    pub extrapolated: Vec<&'a str>,
}

/// The parts of the time of the search for the reference, for the runs, and for the times of their steps.
const OF_SEARCH: [f64; 3] = [0.08, 0.7, 0.1];
/// A run over the part of the time takes about this part of the time of a scheme.
const PART_OF_TIME: f64 = 0.125;
/// Where the time was over, errors are extrapolated by the proved order to at most this multiple of the steps.
const MOST_EXTRAPOLATED: f64 = 100.0;
/// A run that missed the tolerance is made again with at most this multiple of its steps: what it misses by more is
/// hardly of the order, but round-off.
const MOST_REFINED: f64 = 10.0;
/// A run with a small error has about this number of evaluations in a turn of the fastest oscillation.
const EVALUATIONS_PER_TURN: f64 = 400.0;
/// Runs over fewer turns say little of the growth of errors.
const FEWEST_TURNS: f64 = 8.0;
/// The predicted error is to be this part of the tolerance, log₁₀: predictions are that accurate.
const MARGIN: f64 = -0.1;
/// One choice and two alternatives.
const SHOWN: usize = 3;
/// The step is reduced so often if the verification does not meet the tolerance.
const ATTEMPTS: usize = 4;
/// An error that is smaller than the tolerance by this factor leaves room for a larger step, log₁₀.
const ROOM: f64 = -0.7;
/// The reference at the end is to have a smaller error than is predicted by this factor: predictions are that accurate.
const FINER: f64 = 60.0;
/// Round-off leaves this number of digits of a position to the errors of runs.
const ROUND_OFF: f64 = 2.0;
/// It may take this multiple of the time of the run.
const OF_RUN: f64 = 30.0;

impl<'a> AdviceRequest<'a> {
    /// Studies the schemes over a part of the time that takes seconds, extrapolates to all of it, and verifies the
    /// best.
    ///
    /// # Errors
    /// As [`Request::study`].
    pub fn run(&self, observer: &mut dyn Observer) -> Result<Advice<'a>, Error> {
        self.problem.check_energy()?;
        self.problem.check_duration()?;
        let halvings = self.halvings()?;
        let until = self.problem.until / Rational::from_integer((1_i64 << halvings).into());
        let length = length_of(self.problem.system, &until)?;
        let problem = Problem { until: &until, length: length.as_ref(), ..self.problem };
        let study = self.request(problem, halvings).study(observer)?;
        let part = 0.5_f64.powi(halvings);
        let unfinished = self.unfinished(&study);
        let mut choices: Vec<Choice<'a>> =
            study.schemes.iter().filter_map(|studied| self.choice(&study, studied, halvings)).collect();
        let (mut missed, mut unverified) = (0, None);
        let mut reference = (halvings == 0).then(|| study.reference.last());
        while missed < ATTEMPTS {
            choices.sort_by(|a, b| self.cost_of(a).total_cmp(&self.cost_of(b)));
            let Some(best) = choices.first_mut() else { break };
            let verified = self.verify(best, &mut reference, observer)?;
            let resolved = reference.as_ref().map_or(Size::ZERO, Reference::resolved);
            if resolved > self.tolerance && matches!(verified, Some(Verified::Unresolved(_))) {
                unverified = Some(Box::new((best.clone(), resolved)));
                break;
            }
            if let Some(mut verified) = verified.filter(|verified| verified.size() <= self.tolerance) {
                if let Some(larger) = self.with_larger_step(best, verified.size())
                    && let Some(found) = self.verify(&larger, &mut reference, observer)?
                    && found.size() <= self.tolerance
                {
                    (*best, verified) = (larger, found);
                }
                choices.truncate(SHOWN);
                return Ok(Advice::Found { choices, verified, part, unfinished });
            }
            *best = self.with_smaller_step(best, verified.map(Verified::size));
            missed += 1;
        }
        let runs = study.schemes.iter().flat_map(|studied| studied.series.runs.iter().map(move |run| (studied, run)));
        let overflow = runs.clone().next().is_some() && runs.clone().all(|(_, run)| run.failed.is_some());
        let errors = runs.filter_map(|(studied, run)| Some((self.of.error(run)?, self.named(studied).name.as_str())));
        Ok(Advice::OutOfReach {
            least: errors.min_by(|a, b| a.0.log10().total_cmp(&b.0.log10())),
            overflow,
            part,
            reference: study.reference.error(),
            resolved: study.reference.resolved(),
            in_time: study.schemes.iter().all(|studied| studied.series.end != End::Time),
            unfinished,
            missed,
            unverified,
        })
    }

    fn unfinished(&self, study: &Study<'_>) -> Unfinished<'a> {
        let ended = |has_error: bool| {
            let is = move |studied: &&Studied<'_>| {
                let Series { runs, end } = &studied.series;
                *end == End::Time && runs.iter().any(|run| self.of.error(run).is_some()) == has_error
            };
            study.schemes.iter().filter(is).map(|studied| self.named(studied).name.as_str()).collect()
        };
        Unfinished { untried: ended(false), extrapolated: ended(true) }
    }

    /// The time for the runs of a scheme, in seconds.
    fn seconds_each(&self) -> f64 {
        let [_, runs, _] = OF_SEARCH;
        let threads = rayon::current_num_threads().min(self.schemes.len());
        runs * self.seconds * threads as f64 / self.schemes.len() as f64
    }

    /// The shortest repeat of a scheme's steps, of all that are timed.
    fn shortest_repeat(&self) -> Duration {
        let [_, _, times] = OF_SEARCH;
        // repeats, and those that find how many steps are enough
        Duration::from_secs_f64(times * self.seconds / (16 * self.schemes.len()) as f64)
    }

    /// How often the time is halved, so that the runs over the part and their reference have the time for it.
    fn halvings(&self) -> Result<i32, Error> {
        let Some(motion) = self.problem.system.fastest_motion().filter(|_| self.problem.length.is_none()) else {
            return Ok(0);
        };
        let evaluations = EVALUATIONS_PER_TURN * motion.omega * self.problem.duration() / TAU;
        let first = &self.schemes[0];
        let steps = evaluations / first.scheme.summary().evaluations as f64;
        let whole = steps.to_u64().unwrap_or(u64::MAX).max(1);
        let seconds = steps * seconds_per_step(self.problem, first, whole, self.shortest_repeat())?;
        let for_runs = seconds / (PART_OF_TIME * self.seconds_each());
        let most = (evaluations / (EVALUATIONS_PER_TURN * FEWEST_TURNS)).log2().floor().clamp(0.0, 40.0) as i32;
        let halvings = (for_runs.log2().ceil() as i32).clamp(0, most);
        self.with_reference(halvings..most)?.map_or(Ok(most), Ok)
    }

    /// The first of these numbers of halvings with a part whose reference has the time for it.
    fn with_reference(&self, halvings: Range<i32>) -> Result<Option<i32>, Error> {
        // over all of the time
        let mut known = None;
        for halvings in halvings {
            // a shorter part needs a better reference, perhaps in more digits or by another scheme
            let Some(method) = method_of_reference(self.problem, self.resolution(halvings))? else {
                return Ok(Some(halvings));
            };
            let seconds = match known.filter(|(known, _)| *known == method) {
                Some((_, seconds)) => seconds,
                None => seconds_of_reference(self.problem, method, self.shortest_repeat())?,
            };
            if seconds <= self.seconds_for_reference() * 2_f64.powi(halvings) {
                return Ok(Some(halvings));
            }
            known = Some((method, seconds));
        }
        Ok(None)
    }

    /// The time for the reference, in seconds.
    fn seconds_for_reference(&self) -> f64 {
        OF_SEARCH[0] * self.seconds
    }

    /// The error over the part that becomes the tolerance over all of the time.
    fn error_over_part(&self, halvings: i32) -> Size {
        // positions err like the square of the time at most, where the motion is regular
        let growth = f64::from(halvings) * 2_f64.log10();
        let growth = match self.of {
            Of::Position => 2.0 * growth,
            Of::Energy => 0.5 * growth,
            Of::Permanent => growth,
        };
        // runs have no smaller ones
        let round_off = self.below_digits(ROUND_OFF);
        let error = self.tolerance.times_power_of_ten(MARGIN - growth);
        if halvings > 0 && error < round_off { round_off } else { error }
    }

    /// The last digit of a position, with this number of others; 0 for energies.
    fn below_digits(&self, others: f64) -> Size {
        match self.of {
            Of::Position => largest_coordinate(self.problem)
                .times_power_of_ten(others - f64::from(self.problem.arithmetic.digits())),
            Of::Energy | Of::Permanent => Size::ZERO,
        }
    }

    /// The error of the reference; energies need no positions of one.
    fn resolution(&self, halvings: i32) -> Size {
        match self.of {
            Of::Position => self.error_over_part(halvings).times_power_of_ten(-FINER.log10()),
            Of::Energy | Of::Permanent => Size::INFINITE,
        }
    }

    /// Runs until the error over the part is small enough for the whole.
    fn request<'b>(&'b self, problem: Problem<'b>, halvings: i32) -> Request<'b> {
        let target = Target { of: self.of, error: self.error_over_part(halvings) };
        let range = StepRange::Automatic { seconds: self.seconds_each(), target: Some(target) };
        let reference_time = Duration::from_secs_f64(self.seconds_for_reference());
        let resolution = Some(self.resolution(halvings));
        let (schemes, folder, shortest_repeat) = (self.schemes, self.folder.clone(), self.shortest_repeat());
        Request { problem, schemes, range, reference_time, resolution, shortest_repeat, folder }
    }

    /// The largest step of a scheme that is expected to meet the tolerance.
    fn choice(&self, study: &Study<'_>, studied: &Studied<'_>, halvings: i32) -> Option<Choice<'a>> {
        let whole = |run: &Measurement| {
            let error = self.of.at_most(run)?;
            Some((run.steps as f64, error.log10() + f64::from(halvings) * self.of.growth(run).log10()))
        };
        let curve: Curve = studied.series.runs.iter().filter_map(whole).collect();
        let error = self.tolerance.times_power_of_ten(MARGIN);
        // an error of a run that is smaller is one by accident
        if error < self.below_digits(0.0) {
            return None;
        }
        let steps = cost_of(&curve, error).or_else(|| self.extrapolated(studied, &curve, error))?;
        let length = study.problem.size();
        let size = |run: &Measurement| length / run.steps as f64;
        let fine = studied.series.runs.iter().rev().take_while(|run| run.fine).last();
        let lost = studied.series.runs.iter().rev().find(|run| !run.fine && !run.undecided);
        let choice = Choice {
            scheme: self.named(studied),
            step: Rational::from_integer(0.into()),
            steps: 0,
            error,
            seconds_per_step: studied.time.median,
            stable_step: stable_step(self.problem, studied.scheme),
            conserved_up_to: fine.map(size),
            lost_from: lost.map(size),
            over_part: halvings > 0,
            missed: false,
            curve,
            length,
            order: self.order(studied.scheme),
        };
        Some(self.with_step(&choice, length / steps))
    }

    /// The number of steps for an error that no run had the time for.
    fn extrapolated(&self, studied: &Studied<'_>, curve: &Curve, error: Size) -> Option<f64> {
        let (steps, last) = curve.last().filter(|_| studied.series.end == End::Time)?;
        let more = 10_f64.powf((last - error.log10()) / last_order(curve, self.order(studied.scheme)));
        (1.0..=MOST_EXTRAPOLATED).contains(&more).then_some(steps * more)
    }

    /// The same scheme with a step of at most h.
    fn with_step(&self, choice: &Choice<'a>, h: f64) -> Choice<'a> {
        // where time is transformed, the last step is of another size
        let time = self.problem.length.is_none().then_some(self.problem.until);
        let step = convenient_step(h.min(self.problem.size()), time);
        let size = <f64 as Number>::from_rational(&step, &());
        let step = if self.problem.is_forward() { step } else { -step };
        let steps = (self.problem.size() / size).round().to_u64().unwrap_or(u64::MAX).max(1);
        let error = Size::power_of_ten(choice.predicted(size));
        Choice { step, steps, error, ..choice.clone() }
    }

    /// A smaller step for a run that had this error; at least an eighth smaller.
    fn with_smaller_step(&self, choice: &Choice<'a>, error: Option<Size>) -> Choice<'a> {
        let error = error.filter(|error| error.is_finite()).unwrap_or(Size::power_of_ten(0.0));
        let target = self.tolerance.times_power_of_ten(2.0 * MARGIN);
        let corrected = choice.corrected(error);
        let by_order = choice.size() * 10_f64.powf((target.log10() - error.log10()) / choice.order);
        let h = corrected.largest_step(target).unwrap_or(by_order);
        let h = h.clamp(choice.size() / MOST_REFINED, 0.89 * choice.size());
        self.with_step(&Choice { curve: corrected.curve, missed: true, ..choice.clone() }, h)
    }

    /// A larger step, where a run had an error that leaves room for one.
    fn with_larger_step(&self, choice: &Choice<'a>, error: Size) -> Option<Choice<'a>> {
        let target = self.tolerance.times_power_of_ten(MARGIN);
        if error.log10() > self.tolerance.log10() + ROOM {
            return None;
        }
        let corrected = choice.corrected(error);
        let h = corrected.largest_step(target)?;
        let larger = self.with_step(&Choice { curve: corrected.curve, ..choice.clone() }, h);
        (larger.steps < choice.steps).then_some(larger)
    }

    /// The error of a run over all of the time; of positions beside a reference over all of it, which becomes a better
    /// one where it does not resolve the error. `None` where the run has no finite states there.
    fn verify(
        &self,
        choice: &Choice<'a>,
        reference: &mut Option<Reference>,
        observer: &mut dyn Observer,
    ) -> Result<Option<Verified>, Error> {
        let mut store = Store::open(&self.folder, observer)?;
        if self.of != Of::Position {
            let run = self.run_beside(&Reference::none(self.problem, 1), choice, &mut store, observer)?;
            return Ok(run.and_then(|run| self.of.error(&run)).map(Verified::Error));
        }
        let beside = |reference: &Reference, store: &mut Store, observer: &mut dyn Observer| {
            let run = self.run_beside(reference, choice, store, observer)?;
            let position = run.map_or(PositionError::None, |run| run.position);
            Ok::<_, Error>(Verified::of_position(position, reference.error()))
        };
        let found = reference.as_ref().map(|known| beside(known, &mut store, observer)).transpose()?.flatten();
        if let Some(Verified::Error(_)) = found {
            return Ok(found);
        }
        // one that is not found is reported to the observer
        let computed = store.compute(&[self.at_end(choice)], observer)?.pop().flatten();
        let Some(Outcome::Reference(better)) = computed.filter(|outcome| is_better(outcome, reference.as_ref())) else {
            return Ok(found);
        };
        beside(reference.insert(better), &mut store, observer)
    }

    /// The run of a choice.
    fn run_beside(
        &self,
        reference: &Reference,
        choice: &Choice<'a>,
        store: &mut Store,
        observer: &mut dyn Observer,
    ) -> Result<Option<Measurement>, Error> {
        let range = StepRange::Given(vec![choice.steps]);
        let length = self.problem.length.map(|_| &choice.step * Rational::from_integer(choice.steps.into()));
        let problem = Problem { length: length.as_ref(), ..self.problem };
        let wanted = Calculation::series(problem, choice.scheme, reference, &range);
        let Outcome::Series(series) = store.compute_one(wanted, observer)? else {
            unreachable!("a series was requested")
        };
        Ok(series.runs.into_iter().next())
    }

    /// A reference at the end that resolves the predicted error.
    fn at_end(&self, choice: &Choice<'a>) -> Calculation<'a> {
        let error = choice.error.times_power_of_ten(-FINER.log10());
        let seconds = self.seconds.max(OF_RUN * choice.seconds());
        let steps = Some(Resolution::beside(self.problem, error, choice.evaluations()));
        Calculation::resolving(self.problem, 1, Resolution { error, steps, seconds })
    }

    fn cost_of(&self, choice: &Choice<'_>) -> f64 {
        match self.cost {
            Cost::Evaluations => choice.work(self.problem.system).total() as f64,
            Cost::Seconds => choice.seconds(),
        }
    }

    /// The proved order.
    fn order(&self, scheme: &NamedScheme) -> f64 {
        f64::from(proved_order(scheme, self.problem))
    }

    fn named(&self, studied: &Studied<'_>) -> &'a NamedScheme {
        self.schemes.iter().find(|scheme| scheme.name == studied.scheme.name).expect("it was studied")
    }
}

/// Whether this is a reference whose error is smaller.
fn is_better(outcome: &Outcome, reference: Option<&Reference>) -> bool {
    let Outcome::Reference(found) = outcome else { return false };
    reference.is_none_or(|reference| found.error() < reference.error())
}
