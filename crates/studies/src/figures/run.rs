//! The runs of figures: a problem, what advances it, and the steps.

use serde::{Serialize, Serializer};
use shadowstep::number::{LimbCount, Precision};
use shadowstep::problems::{Problem, Setup};
use shadowstep::{StepSize, exact};
use shadowstep_scenes::arithmetic::GUARD_DIGITS;
pub(crate) use shadowstep_scenes::library::EXACT_FLOW;

/// The schemes of the paper's figures, with their labels.
pub(crate) const SCHEMES: [(&str, &str); 4] = [
    ("stormer-verlet", "Störmer–Verlet"),
    ("yoshida4", "Yoshida 4"),
    ("blanes-moan-s6", "Blanes–Moan S6"),
    ("blanes-moan-srkn6b", "Blanes–Moan SRKN6b"),
];

/// The name of a propagator in texts.
pub(crate) fn label(propagator: &str) -> &str {
    let known = SCHEMES.into_iter().chain([(EXACT_FLOW, "exact flow")]).find(|(name, _)| *name == propagator);
    known.map_or(propagator, |(_, label)| label)
}

/// Force evaluations per step of each.
pub(crate) const FORCES: [f64; 4] = [1.0, 3.0, 6.0, 6.0];

/// A problem with its values, what advances it, the step size, the final time, and the digits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Run {
    #[serde(serialize_with = "by_name")]
    pub(crate) problem: Problem,
    /// Values of parameters or of the initial state that differ from the defaults.
    pub(crate) set: Vec<(String, String)>,
    /// The name of a shipped scheme, or exact-flow.
    pub(crate) propagator: String,
    pub(crate) step: String,
    pub(crate) until: String,
    pub(crate) digits: u32,
}

fn by_name<S: Serializer>(problem: &Problem, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(problem.name())
}

impl Run {
    /// Over [0, 100] with 120 digits, as in the paper.
    pub(crate) fn of(problem: Problem, propagator: &str, step: impl Into<String>) -> Self {
        let (propagator, until) = (propagator.to_owned(), "100".to_owned());
        Run { problem, set: Vec::new(), propagator, step: step.into(), until, digits: 120 }
    }

    /// With another value of a parameter or of the initial state.
    pub(crate) fn with(mut self, name: &str, value: impl Into<String>) -> Self {
        self.set.push((name.to_owned(), value.into()));
        self
    }

    pub(crate) fn until(self, until: &str) -> Self {
        Run { until: until.to_owned(), ..self }
    }

    /// The exact flow at the same times.
    pub(crate) fn of_exact_flow(self) -> Self {
        Run { propagator: EXACT_FLOW.to_owned(), ..self }
    }

    pub(crate) fn digits(self, digits: u32) -> Self {
        Run { digits, ..self }
    }

    /// The step size.
    pub(crate) fn h(&self) -> StepSize {
        StepSize::try_from(self.step.as_str()).expect("figures have exact, nonzero step sizes")
    }

    /// The number of steps.
    pub(crate) fn steps(&self) -> u64 {
        let steps = (exact(&self.until).expect("figures have exact times") / self.h().exact()).floor();
        u64::try_from(steps.to_integer()).expect("figures run forward in time")
    }

    /// The number of coordinates: all problems of the figures but the pendulum are in the plane.
    pub(crate) fn dimension(&self) -> usize {
        if self.problem == Problem::Pendulum { 1 } else { 2 }
    }

    /// The cost of arithmetic beside that with 120 digits.
    pub(crate) fn digits_cost(&self) -> f64 {
        0.5 + f64::from(self.digits) / 240.0
    }

    /// About how many microseconds one step of a scheme takes.
    pub(crate) fn step_cost(&self) -> f64 {
        let cost = SCHEMES.iter().position(|(name, _)| *name == self.propagator).map_or(1.0, |at| FORCES[at]);
        if self.problem == Problem::Pendulum { 30.0 * cost } else { 5.0 * cost }
    }

    /// About how many microseconds one state of the exact flow takes.
    pub(crate) fn exact_step_cost(&self) -> f64 {
        if self.problem == Problem::Pendulum { 1500.0 } else { 250.0 }
    }

    pub(crate) fn setup(&self) -> Setup {
        let setup = self.problem.setup(&self.set, self.digits + GUARD_DIGITS);
        setup.expect("figures have values that their problems allow")
    }

    /// The numbers of the run.
    pub(crate) fn limbs(&self) -> LimbCount {
        let precision = Precision::digits(self.digits).expect("figures have digits");
        LimbCount::of_bits(precision.in_bits()).expect("figures have less than 300 digits")
    }
}
