//! The positions with which those of the schemes are compared: of the exact flow where it is known, else of a scheme of
//! order 10 with more digits and small steps, with an estimate of its own error; in double precision with compensated
//! sums where forces have no more digits.

use std::time::Duration;

use num_traits::ToPrimitive;
use serde::{Deserialize, Serialize};
use shadowstep::problems::Setup;
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::States;
use shadowstep::{Rational, Real, StepSize};
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_scenes::propagator::for_system;
use shadowstep_schemes::symbolic::decimal::from_text;

use crate::Error;
use crate::work_precision::positions::{Asking, Positions, square_distance};
use crate::work_precision::problem::Problem;
use crate::work_precision::reference_scheme::{Scheme, first_steps, largest_coordinate};
use crate::work_precision::size::Size;
use crate::work_precision::timing::time_of_steps;

/// Digits beyond those of the schemes' runs.
const MORE_DIGITS: u32 = 12;
/// The digits of the reference, which its scheme's weights must have.
const MOST_REFERENCE_DIGITS: u32 = 240;

/// Numbers of the runs resolve an error that is above their last digits by this number of digits.
const ROUND_OFF_DIGITS: u32 = 4;
/// An error of a run is known if it is larger than the error of the reference by this factor; log₁₀.
const KNOWN: f64 = 0.7;
/// No run goes on beyond this multiple of the time, which the first two may take.
const LONGEST: u32 = 6;
/// A difference that half the step improves by less than this has come to round-off, or the steps are still too large;
/// log₁₀.
const STALLED: f64 = 0.3;

/// Positions q(i T/samples), i = 1, …, samples, as decimal texts, and their errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Of each sample: all coordinates.
    positions: Vec<Vec<String>>,
    /// Of each sample: the estimated error |δq|.
    errors: Vec<Size>,
    /// How it was computed.
    pub origin: Origin,
}

/// How a reference was computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Origin {
    /// It has none: no position is known.
    None,
    /// From the exact flow.
    ExactFlow,
    /// By a scheme.
    Scheme {
        /// Its name.
        name: String,
        /// The number of its steps.
        steps: u64,
        /// The digits of its numbers.
        digits: u32,
    },
}

/// How well positions are to be known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Resolution {
    /// The error.
    pub(crate) error: Size,
    /// The steps of the first run, unless they follow from the problem.
    pub(crate) steps: Option<u64>,
    /// The limit of the time.
    pub(crate) seconds: f64,
}

impl Resolution {
    /// The steps of a reference that begins with as many evaluations as a run.
    pub(crate) fn beside(problem: Problem<'_>, error: Size, evaluations: f64) -> u64 {
        let each = Scheme::of(problem, error).map_or(1.0, |(scheme, _)| scheme.evaluations);
        (evaluations / each).ceil().max(1.0).to_u64().unwrap_or(1)
    }
}

impl Reference {
    /// The reference of a problem; `time` limits what a scheme takes for it, and `continues` stops it.
    ///
    /// # Errors
    /// More digits than a reference can have; states that are not finite; a computation that is stopped.
    pub(crate) fn compute(
        problem: Problem<'_>,
        samples: u64,
        time: Duration,
        continues: &dyn Fn() -> bool,
    ) -> Result<Reference, Error> {
        let reference = match problem.exact_flow() {
            Some(setup) => of_exact_flow(problem, &setup, samples),
            None => {
                let arithmetic = more_digits(problem)?;
                let gain = !has_forces_in_doubles(problem);
                let target = f64::from(problem.arithmetic.digits() + 2);
                let enough = |error: f64, size: f64| error <= size - target;
                let steps = first_steps(problem, samples);
                let request = Halving { samples, steps, time, gain, enough: &enough, continues };
                let found = of_scheme(problem, (arithmetic, Size::ZERO), request).transpose();
                found.unwrap_or_else(|| {
                    let seconds = time.as_secs_f64();
                    let message =
                        format!("no reference is found in {seconds} s: two runs with different steps take longer");
                    Err(Error::run(message, "use a shorter time, or more seconds"))
                })
            }
        }?;
        reference.finite_in_runs(problem)
    }

    /// The same, if its positions are finite in the numbers of the runs.
    fn finite_in_runs(self, problem: Problem<'_>) -> Result<Reference, Error> {
        if problem.arithmetic.compute(Overflows(&self)) {
            let message =
                format!("there is no reference: its positions overflow in {}", problem.arithmetic.described());
            return Err(Error::run(message, "use a shorter time"));
        }
        Ok(self)
    }

    /// Without knowledge of any position: for energies, or where there is no time for it.
    pub(crate) fn none(problem: Problem<'_>, samples: u64) -> Reference {
        let origin = vec!["0".to_owned(); problem.system.start::<f64>(&()).0.len()];
        let count = samples as usize;
        Reference { positions: vec![origin; count], errors: vec![Size::INFINITE; count], origin: Origin::None }
    }

    /// The same with errors of about this size: in the numbers of the runs with compensated sums, where their round-off
    /// is smaller, else with more digits. None is known where there is no time for it.
    ///
    /// # Errors
    /// As [`Reference::compute`].
    pub(crate) fn resolving(
        problem: Problem<'_>,
        samples: u64,
        resolution: Resolution,
        continues: &dyn Fn() -> bool,
    ) -> Result<Reference, Error> {
        let Resolution { error, steps, seconds } = resolution;
        let time = Duration::from_secs_f64(seconds);
        if let Some(setup) = problem.exact_flow() {
            return of_exact_flow(problem, &setup, samples)?.finite_in_runs(problem);
        }
        let steps = steps.unwrap_or_else(|| first_steps(problem, samples)).next_multiple_of(samples);
        let enough = |difference: f64, _: f64| difference <= error.log10();
        let request = |gain| Halving { samples, steps, time, gain, enough: &enough, continues };
        let mut found = None;
        if let Some(own) = resolving_numbers(problem, error) {
            let of_own = of_scheme(problem, (own, error), request(false)).ok().flatten();
            found = of_own.filter(|found| found.error().is_finite());
            if let Some(found) = found.as_ref().filter(|found| found.error() <= error) {
                return Ok(found.clone());
            }
        }
        let precise = match has_forces_in_doubles(problem) {
            true => Ok(None),
            false => more_digits(problem).and_then(|arithmetic| of_scheme(problem, (arithmetic, error), request(true))),
        };
        let best = match (precise, found) {
            (Ok(Some(precise)), Some(found)) => {
                if found.error() < precise.error() {
                    found
                } else {
                    precise
                }
            }
            (_, Some(found)) => found,
            (precise, None) => precise?.unwrap_or_else(|| Reference::none(problem, samples)),
        };
        best.finite_in_runs(problem)
    }

    /// The same at the end alone.
    pub(crate) fn last(&self) -> Reference {
        let (positions, errors) = (self.positions.last().cloned(), self.errors.last().copied());
        let origin = self.origin.clone();
        Reference { positions: positions.into_iter().collect(), errors: errors.into_iter().collect(), origin }
    }

    /// What positions are compared with, in a sentence.
    pub fn described(&self) -> String {
        match &self.origin {
            Origin::None => "No positions are compared.".to_owned(),
            Origin::ExactFlow => "Positions are compared with the exact flow.".to_owned(),
            Origin::Scheme { name, steps, digits } => format!(
                "Positions are compared with those of {name} in {steps} steps with {digits} digits, whose error is \
                    about {}.",
                self.error()
            ),
        }
    }

    /// The largest of its estimated errors.
    pub fn error(&self) -> Size {
        self.errors.iter().copied().fold(Size::ZERO, |a, b| if b > a { b } else { a })
    }

    /// Errors of runs are known above this.
    pub(crate) fn resolved(&self) -> Size {
        self.error().times_power_of_ten(KNOWN)
    }

    /// The largest coordinate of its positions.
    pub(crate) fn size(&self) -> f64 {
        let number = |text: &String| text.parse::<f64>().map_or(0.0, f64::abs);
        self.positions.iter().flatten().map(number).fold(0.0, f64::max)
    }

    /// Errors of runs at a sample are known above this.
    pub(crate) fn resolved_at(&self, sample: usize) -> Size {
        self.errors[sample].times_power_of_ten(KNOWN)
    }

    /// The number of samples.
    pub(crate) fn samples(&self) -> u64 {
        self.positions.len() as u64
    }

    /// The positions as sums of two numbers each: rounded ones and what rounding took away.
    pub(crate) fn in_two_parts<N: Real>(&self, context: &N::Context) -> Vec<[Vec<N>; 2]> {
        let parts = |position: &Vec<String>| {
            let (mut first, mut second) = (Vec::new(), Vec::new());
            for text in position {
                let exact = from_text(text).expect("the program has written it");
                let rounded = N::from_rational(&exact, context);
                let back = from_text(&rounded.to_text()).expect("it is finite");
                second.push(N::from_rational(&(exact - back), context));
                first.push(rounded);
            }
            [first, second]
        };
        self.positions.iter().map(parts).collect()
    }
}

/// Whether a position overflows in a number type.
struct Overflows<'a>(&'a Reference);

impl Computation for Overflows<'_> {
    type Output = bool;

    fn compute<N: RunNumber>(self, context: &N::Context) -> bool {
        let exact = |text: &String| from_text(text).expect("the program has written it");
        self.0.positions.iter().flatten().any(|text| !N::from_rational(&exact(text), context).is_finite())
    }
}

/// The number type with some digits more than that of the runs.
fn precise(digits: u32) -> Result<Arithmetic, Error> {
    Arithmetic::with_digits(digits).map_err(|error| Error::usage(error.to_string(), "use fewer digits"))
}

fn of_exact_flow(problem: Problem<'_>, setup: &Setup, samples: u64) -> Result<Reference, Error> {
    let digits = problem.arithmetic.digits() + MORE_DIGITS;
    let positions = precise(digits)?.compute(ExactTexts { problem, setup, samples })?;
    Ok(Reference { errors: vec![Size::ZERO; positions.len()], positions, origin: Origin::ExactFlow })
}

/// The positions of the exact flow as texts.
struct ExactTexts<'a> {
    problem: Problem<'a>,
    setup: &'a Setup,
    samples: u64,
}

impl Computation for ExactTexts<'_> {
    type Output = Result<Vec<Vec<String>>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let ExactTexts { problem, setup, samples } = self;
        let part = problem.until / Rational::from_integer(samples.into());
        let h = StepSize::try_from(&part).expect("the run has a nonzero length");
        let failed =
            |error: String| Error::run(format!("the exact flow cannot be followed: {error}"), "use a shorter time");
        let mut flow =
            ExactFlow::<N>::new(setup, &h, samples, 0, context).map_err(|error| failed(error.to_string()))?;
        let mut positions = Vec::new();
        while let Some(state) = flow.advance().map_err(|error| failed(error.to_string()))? {
            if state.n > 0 {
                positions.push(state.q.iter().map(Real::to_text).collect());
            }
        }
        Ok(positions)
    }
}

/// Whether the forces have no more digits than double precision: a function of the caller computes them.
fn has_forces_in_doubles(problem: Problem<'_>) -> bool {
    problem.system.check_digits(Arithmetic::DOUBLE_DOUBLE).is_err()
}

/// The number type of a reference. Forces of a function stay in double precision: smaller steps of a higher order are
/// better until round-off, and its error is known by what half the step changes, which has the round-off of two runs.
fn more_digits(problem: Problem<'_>) -> Result<Arithmetic, Error> {
    if has_forces_in_doubles(problem) {
        return Ok(Arithmetic::COMPENSATED);
    }
    let digits = problem.arithmetic.digits() + MORE_DIGITS;
    if digits > MOST_REFERENCE_DIGITS {
        let most = MOST_REFERENCE_DIGITS - MORE_DIGITS;
        let message = format!("a reference is computed to {MOST_REFERENCE_DIGITS} digits at most, for runs of {most}");
        return Err(Error::usage(
            message,
            format!("use --digits {most} or less, or a problem whose exact flow is known"),
        ));
    }
    precise(digits)
}

/// The numbers of the runs, with compensated sums, where they resolve an error.
fn resolving_numbers(problem: Problem<'_>, error: Size) -> Option<Arithmetic> {
    let own = if problem.arithmetic == Arithmetic::DOUBLE { Arithmetic::COMPENSATED } else { problem.arithmetic };
    let size = largest_coordinate(problem);
    let resolved = size.log10() - f64::from(own.digits().saturating_sub(ROUND_OFF_DIGITS));
    (error.log10() > resolved || has_forces_in_doubles(problem)).then_some(own)
}

/// The numbers in which a reference with errors of about this size is computed, and its scheme; `None` where the flow
/// is exact.
pub(crate) fn method_of_reference(
    problem: Problem<'_>,
    error: Size,
) -> Result<Option<(Arithmetic, &'static str)>, Error> {
    if problem.exact_flow().is_some() || !error.is_finite() {
        return Ok(None);
    }
    let arithmetic = resolving_numbers(problem, error).map_or_else(|| more_digits(problem), Ok)?;
    let (scheme, _) = Scheme::of(problem, error)?;
    Ok(Some((arithmetic, scheme.name)))
}

/// The seconds of a reference by this method: of three runs, each with half the step of the one before.
pub(crate) fn seconds_of_reference(
    problem: Problem<'_>,
    (arithmetic, name): (Arithmetic, &str),
    shortest: Duration,
) -> Result<f64, Error> {
    /// 1 + 2 + 4
    const RUNS: f64 = 7.0;
    let named = for_system(scheme(name)?, problem.system)?;
    let steps = first_steps(problem, 1);
    let time = time_of_steps(Problem { arithmetic, ..problem }, &[(&named, steps)], shortest)?;
    Ok(RUNS * steps as f64 * time[0].median)
}

/// `None` where the time is over before there are two runs.
fn of_scheme(
    problem: Problem<'_>,
    (arithmetic, error): (Arithmetic, Size),
    request: Halving<'_>,
) -> Result<Option<Reference>, Error> {
    let (scheme, named) = Scheme::of(problem, error)?;
    let problem = Problem { arithmetic, ..problem };
    arithmetic.compute(ByHalving { problem, scheme, named, request })
}

/// What two runs at round-off, which differ by this at each sample, show of the error of one of them: they may agree by
/// chance, for a while or at all samples.
fn round_off(differences: &[Size], largest: f64) -> Vec<Size> {
    /// The error beside the largest difference so far, and beside the round-off of a position; log₁₀.
    const BESIDE_DIFFERENCE: f64 = 0.3;
    const BESIDE_POSITION: f64 = 0.6;
    let least = Size::of(&f64::EPSILON).times_power_of_ten(largest + BESIDE_POSITION);
    let grow = |so_far: &mut Size, difference: &Size| {
        let difference = difference.times_power_of_ten(BESIDE_DIFFERENCE);
        *so_far = if difference > *so_far { difference } else { *so_far };
        Some(*so_far)
    };
    differences.iter().scan(least, grow).collect()
}

/// How far the step is halved.
#[derive(Clone, Copy)]
struct Halving<'a> {
    samples: u64,
    /// The steps of the first run.
    steps: u64,
    time: Duration,
    /// Whether an error is smaller than the difference where the scheme shows its order: not where it may be round-off.
    gain: bool,
    /// Whether an error is small enough beside the largest coordinate; log₁₀ of both.
    enough: &'a dyn Fn(f64, f64) -> bool,
    continues: &'a dyn Fn() -> bool,
}

/// Halves the step until the error is small enough, or the time is over.
struct ByHalving<'a> {
    problem: Problem<'a>,
    scheme: Scheme,
    named: NamedScheme,
    request: Halving<'a>,
}

impl Computation for ByHalving<'_> {
    type Output = Result<Option<Reference>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let ByHalving { problem, scheme, named, request } = self;
        let Halving { samples, mut steps, time, continues, .. } = request;
        let begin = CpuTime::begin();
        let (mut last, mut last_difference): (Option<Vec<Vec<N>>>, f64) = (None, f64::INFINITY);
        let (mut best, mut are_finite, mut stalled): (Option<Reference>, bool, u32) = (None, false, 0);
        while continues() {
            let in_time = || begin.elapsed() < time * LONGEST;
            let Some(found) = positions::<N>(problem, &named, (steps, samples), &in_time, context)? else { break };
            are_finite |= found.len() as u64 == samples;
            if let Some(before) = last.filter(|before| before.len() == found.len() && found.len() as u64 == samples) {
                let differences = distances(&before, &found, context);
                let difference = differences.iter().map(|size| size.log10()).fold(f64::NEG_INFINITY, f64::max);
                let shows_order = last_difference - difference >= scheme.gain;
                let gain = if shows_order && request.gain { scheme.gain } else { 0.0 };
                let errors = match has_forces_in_doubles(problem) {
                    true => round_off(&differences, largest(&found)),
                    false => differences.iter().map(|size| size.times_power_of_ten(-gain)).collect(),
                };
                let texts = |position: &Vec<N>| position.iter().map(Real::to_text).collect();
                let origin =
                    Origin::Scheme { name: scheme.name.to_owned(), steps, digits: problem.arithmetic.digits() };
                best = Some(Reference { positions: found.iter().map(texts).collect(), errors, origin });
                stalled = if last_difference - difference < STALLED { stalled + 1 } else { 0 };
                // with few digits that is round-off
                if (request.enough)(difference - gain, largest(&found)) || stalled > 1 && !request.gain {
                    break;
                }
                last_difference = difference;
            }
            // the next one takes twice as long as this
            if best.is_some() && begin.elapsed() * 2 > time || begin.elapsed() > time * 4 {
                break;
            }
            last = Some(found);
            steps *= 2;
        }
        match best {
            None if !are_finite && begin.elapsed() <= time => {
                Err(Error::run("there is no reference: its states are not finite", "use a shorter time"))
            }
            best => Ok(best),
        }
    }
}

/// The positions of a run at its samples; fewer where they are not finite. `None` if it was not to continue.
fn positions<N: RunNumber>(
    problem: Problem<'_>,
    named: &NamedScheme,
    (steps, samples): (u64, u64),
    continues: &dyn Fn() -> bool,
    context: &N::Context,
) -> Result<Option<Vec<Vec<N>>>, Error> {
    let h = problem.h(steps);
    let mut positions = Positions::new(problem, named, (steps, samples), context)?;
    let posed = problem.posed(named, (&h, steps));
    match N::follow(&posed, context, &mut [&mut positions], &mut Asking::new(continues)) {
        Ok(followed) if followed.is_stopped => Ok(None),
        Ok(_) | Err(Error::Run { .. }) => Ok(Some(positions.found)),
        Err(error) => Err(error),
    }
}

/// |a − b| of each sample.
fn distances<N: Real>(a: &[Vec<N>], b: &[Vec<N>], context: &N::Context) -> Vec<Size> {
    let distance = |(a, b): (&Vec<N>, &Vec<N>)| {
        let square = square_distance(a, b, context);
        let mut distance = square.clone();
        distance.assign_sqrt(&square);
        Size::of(&distance)
    };
    a.iter().zip(b).map(distance).collect()
}

/// log₁₀ of the largest coordinate.
fn largest<N: Real>(positions: &[Vec<N>]) -> f64 {
    positions.iter().flatten().map(Real::log10_abs).fold(f64::NEG_INFINITY, f64::max)
}
