//! The positions with which those of the schemes are compared: of the exact flow where it is known, else of a scheme of order 10
//! with more digits and small steps, with an estimate of its own error.

use std::time::Duration;

use num_traits::ToPrimitive;
use serde::{Deserialize, Serialize};
use shadowstep::problems::Setup;
use shadowstep::shadow::exact_flow::ExactFlow;
use shadowstep::shadow::run::States;
use shadowstep::{Real, StepSize};
use shadowstep_scenes::Error;
use shadowstep_scenes::arithmetic::Arithmetic;
use shadowstep_scenes::computation::{Computation, RunNumber};
use shadowstep_scenes::cpu_time::CpuTime;
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_scenes::propagator::{for_system, with_exact_flow};
use shadowstep_symbolic::decimal::from_text;

use crate::positions::{at_samples, square_distance};
use crate::problem::Problem;
use crate::size::Size;

/// Of order 10 for every T(p); its weights have 250 digits.
const SCHEME: &str = "sofroniou-spaletta10-35";
/// Digits beyond those of the schemes' runs.
const MORE_DIGITS: u32 = 12;
/// The digits of the reference, which its scheme's weights must have.
const MOST_REFERENCE_DIGITS: u32 = 240;
/// Halving the step of a scheme of order 10 divides its error by 1024; where it divides the differences by this and more, the scheme shows
/// its order, and the error is less than the last difference by this factor.
const GAIN: f64 = 256.0;

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
        let reference = match with_exact_flow(problem.system) {
            Some(setup) => of_exact_flow(problem, &setup, samples),
            None => of_scheme(problem, samples, time, continues),
        }?;
        if problem.arithmetic.compute(Overflows(&reference)) {
            let message =
                format!("there is no reference: its positions overflow in {}", problem.arithmetic.described());
            return Err(Error::run(message, "use a shorter time"));
        }
        Ok(reference)
    }

    /// The positions of a run in the number type of the problem, with no estimate of their error.
    pub(crate) fn of_run(problem: Problem<'_>, named: &NamedScheme, run: (u64, u64)) -> Result<Reference, Error> {
        let positions = problem.arithmetic.compute(Texts { problem, named, run })?;
        let origin = Origin::Scheme { name: named.name.clone(), steps: run.1, digits: problem.arithmetic.digits() };
        Ok(Reference { errors: vec![Size::ZERO; positions.len()], positions, origin })
    }

    /// What positions are compared with, in a sentence.
    pub fn described(&self) -> String {
        match &self.origin {
            Origin::ExactFlow => "Positions are compared with the exact flow.".to_owned(),
            Origin::Scheme { name, steps, digits } => format!(
                "Positions are compared with those of {name} in {steps} steps with {digits} digits, whose error is about {}.",
                self.error()
            ),
        }
    }

    /// The largest of its estimated errors.
    pub fn error(&self) -> Size {
        self.errors.iter().copied().fold(Size::ZERO, |a, b| if b > a { b } else { a })
    }

    /// The largest coordinate of its positions.
    pub(crate) fn size(&self) -> f64 {
        let number = |text: &String| text.parse::<f64>().map_or(0.0, f64::abs);
        self.positions.iter().flatten().map(number).fold(0.0, f64::max)
    }

    /// The estimated error of a sample.
    pub(crate) fn error_at(&self, sample: usize) -> Size {
        self.errors[sample]
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

/// The positions of a run as texts, in any number type.
struct Texts<'a> {
    problem: Problem<'a>,
    named: &'a NamedScheme,
    /// Samples and steps.
    run: (u64, u64),
}

impl Computation for Texts<'_> {
    type Output = Result<Vec<Vec<String>>, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let Texts { problem, named, run: (samples, steps) } = self;
        let found = positions::<N>(problem, named, (steps, samples), context)?;
        if (found.len() as u64) < samples {
            return Err(Error::run("the states of a run with half the step are not finite", "use a shorter time"));
        }
        Ok(found.iter().map(|position| position.iter().map(Real::to_text).collect()).collect())
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
        let h = StepSize::try_from(&problem.step_size(samples)).expect("the run has a nonzero length");
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

fn of_scheme(
    problem: Problem<'_>,
    samples: u64,
    time: Duration,
    continues: &dyn Fn() -> bool,
) -> Result<Reference, Error> {
    let digits = problem.arithmetic.digits() + MORE_DIGITS;
    if digits > MOST_REFERENCE_DIGITS {
        let most = MOST_REFERENCE_DIGITS - MORE_DIGITS;
        let message = format!("a reference is computed to {MOST_REFERENCE_DIGITS} digits at most, for runs of {most}");
        return Err(Error::usage(
            message,
            format!("use --digits {most} or less, or a problem whose exact flow is known"),
        ));
    }
    let arithmetic = precise(digits)?;
    let (target, named) = (f64::from(problem.arithmetic.digits() + 2), for_system(scheme(SCHEME)?, problem.system)?);
    let problem = Problem { arithmetic, ..problem };
    arithmetic.compute(ByHalving { problem, named, digits, target, samples, time, continues })
}

/// Halves the step until the error is below the round-off of the schemes' runs, or the time is over.
struct ByHalving<'a> {
    problem: Problem<'a>,
    named: NamedScheme,
    digits: u32,
    /// The error is to be below the largest coordinate by this number of digits.
    target: f64,
    samples: u64,
    time: Duration,
    continues: &'a dyn Fn() -> bool,
}

impl Computation for ByHalving<'_> {
    type Output = Result<Reference, Error>;

    fn compute<N: RunNumber>(self, context: &N::Context) -> Self::Output {
        let ByHalving { problem, named, digits, target, samples, time, continues } = self;
        let begin = CpuTime::begin();
        let mut steps = first_steps(problem, samples);
        let (mut last, mut last_difference): (Option<Vec<Vec<N>>>, f64) = (None, f64::INFINITY);
        let (mut best, mut are_finite): (Option<Reference>, bool) = (None, false);
        while continues() {
            let found = positions::<N>(problem, &named, (steps, samples), context)?;
            are_finite |= found.len() as u64 == samples;
            if let Some(before) = last.filter(|before| before.len() == found.len() && found.len() as u64 == samples) {
                let differences = distances(&before, &found, context);
                let difference = differences.iter().map(|size| size.log10()).fold(f64::NEG_INFINITY, f64::max);
                let shows_order = last_difference - difference >= GAIN.log10();
                let gain = if shows_order { GAIN.log10() } else { 0.0 };
                let errors = differences.iter().map(|size| size.times_power_of_ten(-gain)).collect();
                let texts = |position: &Vec<N>| position.iter().map(Real::to_text).collect();
                let origin = Origin::Scheme { name: SCHEME.to_owned(), steps, digits };
                best = Some(Reference { positions: found.iter().map(texts).collect(), errors, origin });
                if difference - gain <= largest(&found) - target {
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
        best.ok_or_else(|| match are_finite {
            true => Error::run(
                format!("no reference is found in {} s: two runs with different steps take longer", time.as_secs_f64()),
                "use a shorter time, or more seconds",
            ),
            false => Error::run("there is no reference: its states are not finite", "use a shorter time"),
        })
    }
}

/// The number of steps for which the fastest oscillation turns by about a radian in each; one a sample where none is known.
fn first_steps(problem: Problem<'_>, samples: u64) -> u64 {
    let omega = problem.system.fastest_frequency().map_or(0.0, |frequency| frequency.omega);
    let per_sample = (omega * problem.duration() / samples as f64).ceil().to_u64().unwrap_or(1);
    samples * per_sample.max(1)
}

fn positions<N: RunNumber>(
    problem: Problem<'_>,
    named: &NamedScheme,
    (steps, samples): (u64, u64),
    context: &N::Context,
) -> Result<Vec<Vec<N>>, Error> {
    let mut integrator = problem.integrator(named, steps, context)?;
    Ok(at_samples(&mut *integrator, steps, samples))
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
