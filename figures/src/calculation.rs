//! What figures are made of: runs at many digits, each known by what it is.

use rug::Float;
use serde::{Deserialize, Serialize};
use shadowstep::number::{Number, Precision};
use shadowstep::problems::{Setup, problem};
use shadowstep::run::{Seen, States, Trajectory};
use shadowstep::shadow::{Rule, Stop};
use shadowstep::{Rational, exact};

use super::double_precision::{self, Block, Differences};
use super::work::Task;
use crate::complaint::{Complaint, of_problem};
use shadowstep_scenes::arithmetic::GUARD_DIGITS;
use shadowstep_scenes::estimator::Chosen;
use shadowstep_scenes::library::EXACT_FLOW;
use shadowstep_scenes::propagator::{Propagator, motion};
use shadowstep_scenes::run::Run;

/// Outcomes of another revision are computed again; a change of what is computed needs a new one.
const REVISION: u32 = 5;

/// A problem, what moves it on, and in which steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Setting {
    pub(crate) problem: &'static str,
    pub(crate) set: Vec<(String, String)>,
    pub(crate) propagator: &'static str,
    pub(crate) step: String,
    pub(crate) until: &'static str,
    pub(crate) digits: u32,
}

/// The estimator of the modified energy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum By {
    /// D_m
    Central { m: u32 },
    /// The m of each state with the smallest last term, as the paper has it.
    Best { largest: u32, early: bool },
    /// E_k
    Bilinear { k: u32 },
}

/// Something to compute.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Calculation {
    revision: u32,
    what: What,
}

#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum What {
    /// The drift of the modified energy.
    Drift { run: Setting, by: By },
    /// The modified energy at each step.
    Energies { run: Setting, by: By },
    /// The largest |q|.
    Farthest { run: Setting },
    /// H at the end less H at the start.
    Transit { run: Setting },
    /// The scatter and the wander of the modified energy in double precision.
    Scatter { steps: u64, differences: Differences },
}

/// What came of it; numbers of many digits are texts.
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
    /// None where the estimator tells no errors.
    pub(crate) permanent: Option<Permanent>,
    pub(crate) orders: (u32, u32),
}

/// The change between quiet states.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Permanent {
    pub(crate) change: String,
    pub(crate) largest_jump: String,
    /// What the change has to exceed.
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

/// log₁₀ of the size of a number that is a text; −∞ of 0.
pub(crate) fn log10(text: &str) -> f64 {
    number(text).log10_abs()
}

/// A number that is a text, to more digits than any run has.
pub(crate) fn number(text: &str) -> Float {
    let bits = (text.len() as f64 * std::f64::consts::LOG2_10) as u32 + 64;
    Float::with_val(bits, Float::parse(text).expect("texts are written by numbers"))
}

impl Setting {
    /// Over [0, 100] with 120 digits, as the paper has it.
    pub(crate) fn of(problem: &'static str, propagator: &'static str, step: impl Into<String>) -> Self {
        Setting { problem, set: Vec::new(), propagator, step: step.into(), until: "100", digits: 120 }
    }

    /// With another value of a parameter or of the initial state.
    pub(crate) fn with(mut self, name: &str, value: impl Into<String>) -> Self {
        self.set.push((name.to_owned(), value.into()));
        self
    }

    pub(crate) fn until(self, until: &'static str) -> Self {
        Setting { until, ..self }
    }

    pub(crate) fn digits(self, digits: u32) -> Self {
        Setting { digits, ..self }
    }

    fn step(&self) -> Rational {
        exact(&self.step).expect("figures have exact steps")
    }

    fn steps(&self) -> u64 {
        let steps = (exact(self.until).expect("figures have exact times") / self.step()).floor();
        u64::try_from(steps.to_integer()).expect("figures go forward in time")
    }

    fn setup(&self) -> Result<Setup, Complaint> {
        problem(self.problem)
            .and_then(|problem| problem.setup(&self.set, self.digits + GUARD_DIGITS))
            .map_err(of_problem)
    }

    fn precision(&self) -> Precision {
        Precision::digits(self.digits).expect("figures have digits that can be had")
    }

    /// Calls `make` with everything that a run needs.
    fn run<T>(&self, make: impl FnOnce(&Propagator, &Setup, Run<'_>) -> Result<T, Complaint>) -> Result<T, Complaint> {
        let setup = self.setup()?;
        let propagator = Propagator::read(self.propagator, &setup)?;
        let run = Run { propagator: self.propagator, h: &self.step(), steps: self.steps(), order: None };
        make(&propagator, &setup, run)
    }
}

impl By {
    fn chosen(self) -> Chosen {
        match self {
            By::Central { m } => Chosen::Central(m),
            By::Best { largest, early } => {
                Chosen::Best(largest, if early { Stop::Early } else { Stop::Full }, Rule::Least)
            }
            By::Bilinear { k } => Chosen::Bilinear(k),
        }
    }

    /// How many states an estimate needs.
    pub(crate) fn states(self) -> u32 {
        match self {
            By::Central { m } | By::Best { largest: m, .. } => 2 * m + 1,
            By::Bilinear { k } => k + 1,
        }
    }

    /// Of a drift only the bilinear estimator's own errors are needed, for the permanent change.
    fn has_errors(self) -> bool {
        matches!(self, By::Bilinear { .. })
    }

    /// Multiplications of numbers a step and coordinate, about.
    fn cost(self) -> f64 {
        match self {
            By::Central { m } => 6.0 * f64::from(m),
            By::Best { largest, .. } => 12.0 * f64::from(largest),
            By::Bilinear { k } => 4.0 * f64::from(k) + f64::from(k) * f64::from(k) / 2.0,
        }
    }
}

impl What {
    pub(crate) fn calculation(self) -> Calculation {
        Calculation { revision: REVISION, what: self }
    }
}

impl Task for Calculation {
    type Outcome = Outcome;

    fn cost(&self) -> f64 {
        let numbers = |run: &Setting, by: f64, states: u32| {
            // a step of the exact flow is a series
            let step = if run.propagator == EXACT_FLOW { 3000.0 } else { 60.0 };
            (run.steps() as f64 + f64::from(states)) * (by + step) * f64::from(run.digits)
        };
        match &self.what {
            What::Drift { run, by } | What::Energies { run, by } => numbers(run, by.cost(), by.states()),
            What::Farthest { run } | What::Transit { run } => numbers(run, 0.0, 0),
            What::Scatter { steps, .. } => *steps as f64 * 200.0,
        }
    }

    fn compute(&self) -> Result<Outcome, Complaint> {
        match &self.what {
            What::Drift { run, by } => drift(run, *by),
            What::Energies { run, by } => energies(run, *by),
            What::Farthest { run } => farthest(run),
            What::Transit { run } => transit(run),
            What::Scatter { steps, differences } => {
                Ok(Outcome::Blocks(double_precision::scatter(*steps, *differences)?))
            }
        }
    }
}

fn drift(run: &Setting, by: By) -> Result<Outcome, Complaint> {
    let method = by.chosen().method(by.has_errors());
    let context = run.precision();
    let found =
        run.run(|propagator, setup, of| propagator.energy_drift::<Float>(setup, of, &method, &context, |_| ()))?;
    let permanent = found.permanent.map(|permanent| Permanent {
        change: permanent.change.to_text(),
        largest_jump: permanent.largest_jump.to_text(),
        resolution: permanent.resolution.to_text(),
        resolved: permanent.seen == Seen::Resolved,
    });
    Ok(Outcome::Drift(Drift { drift: found.drift.to_text(), permanent, orders: found.orders }))
}

fn energies(run: &Setting, by: By) -> Result<Outcome, Complaint> {
    let method = by.chosen().method(true);
    let context = run.precision();
    let mut all = Energies::default();
    let size = |number: Option<&Float>| number.map(Number::log10_abs).filter(|size| size.is_finite());
    run.run(|propagator, setup, of| {
        propagator.estimates::<Float>(setup, of, &method, &context, |n, estimate| {
            all.times.push(f64::from_rational(&of.time_of_value(n, &by.chosen()), &()));
            all.distances.push(estimate.q.iter().map(|q| q.to_f64().powi(2)).sum::<f64>().sqrt());
            all.values.push(estimate.value.to_text());
            all.orders.push(estimate.order);
            all.errors.push(size(estimate.error));
            all.last_terms.push(size(estimate.last_term));
            Ok(())
        })
    })?;
    Ok(Outcome::Energies(all))
}

fn farthest(run: &Setting) -> Result<Outcome, Complaint> {
    let mut farthest = Float::new(53);
    states(run, |_, q| {
        let square = q.iter().fold(Float::new(53), |sum, q| sum + q.clone().square());
        farthest.max_mut(&square.sqrt());
    })?;
    Ok(Outcome::Number(farthest.to_text()))
}

fn transit(run: &Setting) -> Result<Outcome, Complaint> {
    let (setup, context) = (run.setup()?, run.precision());
    let mut system = motion::<Float>(&setup, &context);
    let first = system.energy();
    let last = states(run, |_, _| ())?;
    Ok(Outcome::Number((system.energy_of(&last.0, &last.1) - first).to_text()))
}

/// Gives n and q of each state, without modified energies; returns the last q and p.
fn states(run: &Setting, mut take: impl FnMut(i64, &[Float])) -> Result<(Vec<Float>, Vec<Float>), Complaint> {
    let context = run.precision();
    run.run(|propagator, setup, of| {
        let scheme = &propagator.scheme().expect("states are asked of schemes").scheme;
        let begin = motion::<Float>(setup, &context);
        let failed = |error| of.failed(&error);
        let mut trajectory = Trajectory::plain(scheme, begin, of.h, 0, of.steps).map_err(failed)?;
        while let Some(state) = trajectory.advance().map_err(failed)? {
            take(state.n, state.q);
        }
        Ok((trajectory.motion().q().to_vec(), trajectory.motion().p().to_vec()))
    })
}
