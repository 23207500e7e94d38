//! The results of `drift` in JSON.

use serde::{Serialize, Serializer};
use shadowstep::number::Ordered;
use shadowstep::run::{EnergyDrift, Finding};
use shadowstep_scenes::arithmetic::DigitsLabel;
use shadowstep_scenes::{EnergySummary, Summary};

/// The result of a run in JSON; numbers of high precision are texts.
#[derive(Serialize)]
pub(super) struct Record {
    /// The version of the program.
    pub(super) shadowstep: &'static str,
    pub(super) problem: String,
    #[serde(serialize_with = "as_object")]
    pub(super) parameters: Vec<(String, String)>,
    pub(super) scheme: String,
    pub(super) step: String,
    pub(super) until: String,
    /// The time of the last state: `until`, or the last multiple of the step before it.
    pub(super) end: String,
    pub(super) digits: DigitsLabel,
    pub(super) estimator: &'static str,
    pub(super) order: OrderLabel,
    /// How the order is chosen, as far as the estimator has such a setting; `None` if the order is fixed.
    pub(super) max_order: Option<u32>,
    pub(super) stop: Option<&'static str>,
    pub(super) rule: Option<&'static str>,
    pub(super) accuracy: Option<String>,
    /// H(t) − H(0); `None` for the exact flow.
    pub(super) energy_error: Option<EnergySummary>,
    pub(super) drift: String,
    pub(super) minimum: String,
    pub(super) maximum: String,
    pub(super) at_minimum: i64,
    pub(super) at_maximum: i64,
    pub(super) first: String,
    pub(super) last: String,
    pub(super) permanent_change: Option<Permanent>,
    pub(super) control: Option<Control>,
    /// Why there is no control, where there could be one.
    pub(super) control_left_out: Option<String>,
    pub(super) order_least: u32,
    pub(super) order_most: u32,
    pub(super) steps: u64,
    #[serde(flatten)]
    pub(super) cost: Cost,
    pub(super) summary: Option<Summary>,
}

impl Record {
    /// Whether the verdict, if there is one, is not worse than fine.
    pub(super) fn is_fine(&self) -> bool {
        self.summary.as_ref().is_none_or(Summary::is_fine)
    }
}

#[derive(Serialize)]
pub(super) struct Cost {
    /// Of the scheme; `None` for the exact flow.
    pub(super) forces_per_step: Option<usize>,
    /// Without those for the states that only the estimator needs.
    pub(super) own_force_evaluations: u64,
    pub(super) force_evaluations: u64,
    /// CPU time of the run.
    pub(super) seconds: f64,
}

/// The change between states with small estimated errors.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Permanent {
    pub(super) change: String,
    pub(super) first_to_last: String,
    pub(super) largest_jump: String,
    pub(super) resolution: String,
    #[serde(serialize_with = "as_word")]
    pub(super) seen: Finding,
    pub(super) from: i64,
    pub(super) to: i64,
    pub(super) states: u64,
    pub(super) stretches: u64,
}

/// The same estimates on the exact flow, whose energy does not change: the error of the estimator itself.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Control {
    pub(super) drift: String,
    pub(super) permanent_change: Option<Permanent>,
    /// CPU time.
    pub(super) seconds: f64,
}

impl Permanent {
    pub(super) fn of<N: Ordered>(found: &EnergyDrift<N>) -> Option<Self> {
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
pub(super) const NOT_SEEN: &str = "not seen";

#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum OrderLabel {
    /// A fixed m or k.
    Fixed(u32),
    /// `auto`
    Word(&'static str),
}

fn as_object<S: Serializer>(pairs: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(pairs.iter().map(|(name, value)| (name, value)))
}
