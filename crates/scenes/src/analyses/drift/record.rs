//! The result of a run as a record.

use serde::{Serialize, Serializer};
use shadowstep::number::Real;
use shadowstep::shadow::run::{EnergyDrift, Finding};

use crate::run::arithmetic::DigitsLabel;
use crate::watch::summary::{EnergySummary, Summary};

/// The result of a run in JSON; numbers of high precision are texts.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// The version of the program.
    pub shadowstep: &'static str,
    /// The name of the problem.
    pub problem: String,
    /// Parameters and initial values: names and exact texts.
    #[serde(serialize_with = "as_object")]
    pub parameters: Vec<(String, String)>,
    /// The scheme, or exact-flow.
    pub scheme: String,
    /// The step size h.
    pub step: String,
    /// The time asked for.
    pub until: String,
    /// The time of the last state: `until`, or that of the last whole step before it.
    pub end: String,
    /// The number type.
    pub digits: DigitsLabel,
    /// The estimator of the modified energy.
    pub estimator: &'static str,
    /// Its order.
    pub order: OrderLabel,
    /// How the order is chosen, as far as the estimator has such a setting; `None` if the order is fixed.
    pub max_order: Option<u32>,
    /// Where it stops.
    pub stop: Option<&'static str>,
    /// Which order is the best.
    pub rule: Option<&'static str>,
    /// Its target error.
    pub accuracy: Option<String>,
    /// H(t) − H(0); `None` for the exact flow.
    pub energy_error: Option<EnergySummary>,
    /// max − min of the modified energy (Moan & Niesen).
    pub drift: String,
    /// The least modified energy.
    pub minimum: String,
    /// The largest modified energy.
    pub maximum: String,
    /// Its n.
    pub at_minimum: i64,
    /// Its n.
    pub at_maximum: i64,
    /// The modified energy of the state 0.
    pub first: String,
    /// That of the last state.
    pub last: String,
    /// The change between states with small errors; `None` without error estimates.
    pub permanent_change: Option<Permanent>,
    /// The same on the exact flow, where that is known.
    pub control: Option<Control>,
    /// Why there is no control, where there could be one.
    pub control_left_out: Option<String>,
    /// The least order that was used.
    pub order_least: u32,
    /// The largest order that was used.
    pub order_most: u32,
    /// The number of steps.
    pub steps: u64,
    /// What the run cost.
    #[serde(flatten)]
    pub cost: Cost,
    /// What the run has shown; `None` for the exact flow, or where it is not wanted.
    pub summary: Option<Summary>,
}

impl Record {
    /// Whether the verdict, if there is one, is bounded or round-off.
    pub fn is_bounded(&self) -> bool {
        self.summary.as_ref().is_none_or(Summary::is_bounded)
    }
}

/// What a run cost.
#[derive(Clone, Debug, Serialize)]
pub struct Cost {
    /// Of the scheme; `None` for the exact flow.
    pub forces_per_step: Option<usize>,
    /// Without those for the states that only the estimator needs.
    pub own_force_evaluations: u64,
    /// Evaluations of the gradient, all of them.
    pub force_evaluations: u64,
    /// CPU time of the run.
    pub seconds: f64,
}

/// The change between states with small estimated errors.
#[derive(Clone, Debug, Serialize)]
pub struct Permanent {
    /// The change.
    pub change: String,
    /// Between the first and the last of these states.
    pub first_to_last: String,
    /// The largest change between two of them that follow each other.
    pub largest_jump: String,
    /// What can be seen: errors and round-off.
    pub resolution: String,
    /// Whether it is resolved.
    #[serde(serialize_with = "as_word")]
    pub seen: Finding,
    /// The first of these states.
    pub from: i64,
    /// The last of them.
    pub to: i64,
    /// How many there are.
    pub states: u64,
    /// In how many stretches of the run.
    pub stretches: u64,
}

/// The same estimates on the exact flow, whose energy does not change: the error of the estimator itself.
#[derive(Clone, Debug, Serialize)]
pub struct Control {
    /// max − min of the modified energy (Moan & Niesen).
    pub drift: String,
    /// The change between states with small errors; `None` without error estimates.
    pub permanent_change: Option<Permanent>,
    /// CPU time.
    pub seconds: f64,
}

impl Permanent {
    /// That of a drift, where errors are estimated.
    pub fn of<N: Real>(found: &EnergyDrift<N>) -> Option<Self> {
        let permanent = found.permanent.as_ref()?;
        Some(Permanent {
            change: permanent.change.to_text(),
            first_to_last: permanent.first_to_last.to_text(),
            largest_jump: permanent.largest_jump.to_text(),
            resolution: permanent.resolution.to_text(),
            seen: permanent.finding,
            from: permanent.between.0,
            to: permanent.between.1,
            states: permanent.states,
            stretches: permanent.intervals,
        })
    }
}

fn as_word<S: Serializer>(seen: &Finding, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match seen {
        Finding::Resolved => "resolved",
        Finding::BelowResolution => "below",
        Finding::OneSided => NOT_SEEN,
    })
}

/// All states with small errors are on one side of those with large errors.
pub const NOT_SEEN: &str = "not seen";

/// The order of an estimator.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum OrderLabel {
    /// A fixed m or k.
    Fixed(u32),
    /// `auto`
    Word(&'static str),
}

fn as_object<S: Serializer>(pairs: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}
