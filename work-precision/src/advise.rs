//! Advice: a scheme and a step size for an error, from runs over a part of the time, verified by one run over all of it.

use std::f64::consts::TAU;
use std::path::PathBuf;
use std::time::Duration;

use num_traits::ToPrimitive;
use shadowstep::{Number, Rational, Scheme};
use shadowstep_scenes::Error;
use shadowstep_scenes::library::NamedScheme;
use shadowstep_studies::{Observer, Store};

use crate::best::cost_of;
use crate::calculation::{Calculation, Outcome};
use crate::convenient::convenient_step;
use crate::length::length_of;
use crate::of::Of;
use crate::problem::Problem;
use crate::reference::{Reference, Resolution};
use crate::run::{Measurement, PositionError};
use crate::series::{End, StepRange, Target, stable_step};
use crate::size::Size;
use crate::study::{Cost, Request, Studied, Study, proved_order};
use crate::timing::time_of_steps;

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
    /// The time for the runs of a scheme, in seconds.
    pub seconds: f64,
    /// Outcomes are saved in this folder.
    pub folder: PathBuf,
}

/// A scheme and a step size with what is expected of them.
#[derive(Clone, Debug)]
pub struct Choice<'a> {
    /// The scheme.
    pub scheme: &'a NamedScheme,
    /// The exact step size.
    pub step: Rational,
    /// The number of steps.
    pub steps: u64,
    /// The predicted error at the end.
    pub error: Size,
    /// Seconds for a step alone.
    pub seconds_per_step: f64,
    /// The largest stable step for the fastest oscillation, linearised at the start; `None` where nothing oscillates.
    pub stable_step: Option<f64>,
    /// The largest step of the scheme up to which the monitor's verdict was fine; `None` if it was at no step.
    pub conserved_up_to: Option<f64>,
    /// The smallest step whose verdict was another one than fine or undecided.
    pub lost_from: Option<f64>,
}

impl Choice<'_> {
    /// Evaluations of the gradient in the run.
    pub fn evaluations(&self) -> f64 {
        self.steps as f64 * self.scheme.scheme.summary().evaluations as f64
    }

    /// Seconds of the run, for its steps alone.
    pub fn seconds(&self) -> f64 {
        self.steps as f64 * self.seconds_per_step
    }

    /// |h|
    pub fn size(&self) -> f64 {
        <f64 as Number>::from_rational(&self.step, &()).abs()
    }
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
    },
    /// No scheme has so small an error in this number type.
    OutOfReach {
        /// The smallest error that some scheme had, over the part of the time, and its name; `None` if there is none.
        least: Option<(Size, &'a str)>,
        /// The part of the time over which runs were made.
        part: f64,
        /// The error of the reference.
        reference: Size,
        /// Whether the time was over before round-off was reached.
        in_time: bool,
        /// How many runs over all of the time were expected to meet the tolerance, and missed it.
        missed: usize,
    },
}

/// The error of a run over all of the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verified {
    /// This, to a tenth: the error of the reference is less than a 20th of it.
    Error(Size),
    /// At most this: the reference resolves no more.
    AtMost(Size),
}

impl Verified {
    /// The error, or what it is at most.
    pub fn size(self) -> Size {
        match self {
            Verified::Error(size) | Verified::AtMost(size) => size,
        }
    }

    /// Of a position beside a reference with this error; `None` where it is not known, or the run failed.
    fn of_position(position: PositionError, error: Size) -> Option<Verified> {
        let ten = |size: Size| 10_f64.powf(size.log10());
        match position {
            PositionError::Known(size) if error.log10() <= size.log10() - RESOLVED.log10() => {
                Some(Verified::Error(size))
            }
            PositionError::Known(size) => {
                Some(Verified::AtMost(size.times_power_of_ten((1.0 + ten(error) / ten(size)).log10())))
            }
            // below five times the error, of which one is that of the reference
            PositionError::Below(size) => Some(Verified::AtMost(size.times_power_of_ten(1.2_f64.log10()))),
            PositionError::None => None,
        }
    }
}

/// A run over the part of the time takes about this part of the time of a scheme.
const PART_OF_TIME: f64 = 0.125;
/// The reference may take this multiple of the time of a scheme.
const REFERENCE: f64 = 5.0;
/// Where the time was over, errors are extrapolated by the proved order to at most this multiple of the steps.
const MOST_EXTRAPOLATED: f64 = 100.0;
/// A run with a small error has about this number of evaluations in a turn of the fastest oscillation.
const EVALUATIONS_PER_TURN: f64 = 400.0;
/// The predicted error is to be this part of the tolerance, log₁₀: predictions are that accurate.
const MARGIN: f64 = -0.1;
/// One choice and two alternatives.
const SHOWN: usize = 3;
/// The step is reduced so often if the verification does not meet the tolerance.
const ATTEMPTS: usize = 4;
/// The error of a position is this multiple of that of the reference, where it is said to be known.
const RESOLVED: f64 = 20.0;
/// The reference at the end is to have a smaller error than is predicted by this factor: predictions are that accurate.
const FINER: f64 = 60.0;
/// It may take this multiple of the time of the run.
const OF_RUN: f64 = 30.0;

impl<'a> AdviceRequest<'a> {
    /// Studies the schemes over a part of the time that takes seconds, extrapolates to all of it, and verifies the best.
    ///
    /// # Errors
    /// As [`Request::study`].
    pub fn run(&self, observer: &mut dyn Observer) -> Result<Advice<'a>, Error> {
        let halvings = self.halvings()?;
        let until = self.problem.until / Rational::from_integer((1_i64 << halvings).into());
        let length = length_of(self.problem.system, &until)?;
        let problem = Problem { until: &until, length: length.as_ref(), ..self.problem };
        let study = self.request(problem, halvings).study(observer)?;
        let part = 0.5_f64.powi(halvings);
        let mut choices: Vec<Choice<'a>> =
            study.schemes.iter().filter_map(|studied| self.choice(&study, studied, halvings)).collect();
        let mut missed = 0;
        while missed < ATTEMPTS {
            choices.sort_by(|a, b| self.cost_of(a).total_cmp(&self.cost_of(b)));
            let Some(best) = choices.first_mut() else { break };
            let verified = self.verify(best, &study, halvings, observer)?;
            let error = verified.map(Verified::size);
            if let Some(verified) = verified.filter(|verified| verified.size() <= self.tolerance) {
                choices.truncate(SHOWN);
                return Ok(Advice::Found { choices, verified, part });
            }
            self.reduce(best, error);
            missed += 1;
        }
        let runs = study.schemes.iter().flat_map(|studied| studied.series.runs.iter().map(move |run| (studied, run)));
        let errors = runs.filter_map(|(studied, run)| Some((self.of.error(run)?, self.named(studied).name.as_str())));
        Ok(Advice::OutOfReach {
            least: errors.min_by(|a, b| a.0.log10().total_cmp(&b.0.log10())),
            part,
            reference: study.reference.error(),
            in_time: study.schemes.iter().all(|studied| studied.series.end != End::Time),
            missed,
        })
    }

    /// How often the time is halved, so that runs over the part take about a second.
    fn halvings(&self) -> Result<i32, Error> {
        let Some(frequency) = self.problem.system.fastest_frequency() else { return Ok(0) };
        let evaluations = EVALUATIONS_PER_TURN * frequency.omega * self.problem.duration() / TAU;
        let steps = evaluations.to_u64().unwrap_or(u64::MAX).max(1);
        let first = &self.schemes[0];
        let time = time_of_steps(self.problem, &[(first, steps)])?[0].median;
        let seconds = time * evaluations / first.scheme.summary().evaluations as f64;
        Ok((seconds / (PART_OF_TIME * self.seconds)).log2().ceil().clamp(0.0, 40.0) as i32)
    }

    /// Runs until the error over the part is small enough for the whole.
    fn request<'b>(&'b self, problem: Problem<'b>, halvings: i32) -> Request<'b> {
        // positions err like the square of the time at most, where the motion is regular
        let growth = f64::from(halvings) * 2_f64.log10();
        let growth = match self.of {
            Of::Position => 2.0 * growth,
            Of::Energy => 0.5 * growth,
            Of::Permanent => growth,
        };
        let error = self.tolerance.times_power_of_ten(MARGIN - growth);
        let range = StepRange::Automatic { seconds: self.seconds, target: Some(Target { of: self.of, error }) };
        // energies need no positions of a reference
        let reference = if self.of == Of::Position { REFERENCE } else { REFERENCE / 50.0 };
        let reference_time = Duration::from_secs_f64(reference * self.seconds);
        Request { problem, schemes: self.schemes, range, reference_time, folder: self.folder.clone() }
    }

    /// The largest step of a scheme that is expected to meet the tolerance.
    fn choice(&self, study: &Study<'_>, studied: &Studied<'_>, halvings: i32) -> Option<Choice<'a>> {
        let whole = |run: &Measurement| {
            let error = self.of.error(run)?;
            Some((run.steps as f64, error.log10() + f64::from(halvings) * self.of.growth(run).log10()))
        };
        let curve: Vec<(f64, f64)> = studied.series.runs.iter().filter_map(whole).collect();
        let error = self.tolerance.times_power_of_ten(MARGIN);
        let steps = cost_of(&curve, error).or_else(|| self.extrapolated(studied, &curve, error))?;
        let largest = study.problem.size() / steps;
        let size = |run: &Measurement| study.problem.size() / run.steps as f64;
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
        };
        Some(self.with_step(&choice, largest))
    }

    /// The number of steps for an error that no run had the time for, by Richardson's rule with the proved order.
    fn extrapolated(&self, studied: &Studied<'_>, curve: &[(f64, f64)], error: Size) -> Option<f64> {
        let (steps, last) = curve.last().filter(|_| studied.series.end == End::Time)?;
        let more = 10_f64.powf((last - error.log10()) / self.order(studied.scheme));
        (1.0..=MOST_EXTRAPOLATED).contains(&more).then_some(steps * more)
    }

    /// The same scheme with a step of at most h, at which its error is known.
    fn with_step(&self, choice: &Choice<'a>, h: f64) -> Choice<'a> {
        // where time is transformed, the last step is of another size
        let time = self.problem.length.is_none().then_some(self.problem.until);
        let step = convenient_step(h.min(self.problem.size()), time);
        let size = <f64 as Number>::from_rational(&step, &());
        let step = if self.problem.is_forward() { step } else { -step };
        let steps = (self.problem.size() / size).round().to_u64().unwrap_or(u64::MAX).max(1);
        let error = choice.error.times_power_of_ten(self.order(choice.scheme) * (size / h).log10());
        Choice { step, steps, error, ..choice.clone() }
    }

    /// A smaller step, so that an error of this size comes to the tolerance as the order says; at least an eighth smaller.
    fn reduce(&self, choice: &mut Choice<'a>, error: Option<Size>) {
        let error = error.unwrap_or(Size::power_of_ten(0.0)).log10();
        let target = self.tolerance.times_power_of_ten(2.0 * MARGIN);
        let factor = 10_f64.powf((target.log10() - error) / self.order(choice.scheme)).min(0.89);
        let h = choice.size() * factor;
        *choice = self.with_step(&Choice { error: target, ..choice.clone() }, h);
    }

    /// The error of a run over all of the time; of positions beside the reference of the study where that is one over all of the time and
    /// resolves it, else beside one at the end alone. `None` where the run has no finite states there.
    fn verify(
        &self,
        choice: &Choice<'a>,
        study: &Study<'_>,
        halvings: i32,
        observer: &mut dyn Observer,
    ) -> Result<Option<Verified>, Error> {
        let mut store = Store::open(&self.folder, observer)?;
        if self.of != Of::Position {
            let run = self.run_beside(&study.reference.of_energies(), choice, &mut store, observer)?;
            return Ok(run.and_then(|run| self.of.error(&run)).map(Verified::Error));
        }
        let beside = |reference: &Reference, store: &mut Store, observer: &mut dyn Observer| {
            let run = self.run_beside(reference, choice, store, observer)?;
            let position = run.map_or(PositionError::None, |run| run.position);
            Ok::<_, Error>(Verified::of_position(position, reference.error()))
        };
        let of_study = if halvings == 0 { beside(&study.reference.last(), &mut store, observer)? } else { None };
        if let Some(Verified::Error(_)) = of_study {
            return Ok(of_study);
        }
        // one that is not found is reported to the observer
        let found = store.compute(&[self.at_end(choice, study)], observer)?.pop().flatten();
        let Some(Outcome::Reference(reference)) = found else { return Ok(of_study) };
        Ok(match (of_study, beside(&reference, &mut store, observer)?) {
            (Some(a), Some(b)) => Some(if a.size() < b.size() { a } else { b }),
            (a, b) => a.or(b),
        })
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
    fn at_end(&self, choice: &Choice<'a>, study: &Study<'_>) -> Calculation<'a> {
        let error = choice.error.times_power_of_ten(-FINER.log10());
        let seconds = (REFERENCE * self.seconds).max(OF_RUN * choice.seconds());
        let (steps, size) = (Resolution::beside(choice.evaluations()), Size::of(&study.reference.size()));
        Calculation::at_end(self.problem, Resolution { error, size, steps, seconds })
    }

    fn cost_of(&self, choice: &Choice<'_>) -> f64 {
        match self.cost {
            Cost::Evaluations => choice.evaluations(),
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
