//! Shared by the figures of estimators against the number of states that they use.

use crate::estimator::{best, bilinear, central};
use crate::results::Results;
use crate::run::Run;
use shadowstep::shadow::{EstimatorSettings, StoppingRule};

pub(super) const ORDERS: [u32; 14] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 50, 80, 130, 200];

/// Estimators of each order, and how many states one estimate uses.
pub(super) type Family = (fn(u32) -> EstimatorSettings, fn(u32) -> u32);

pub(super) const CENTRAL: Family = (central, |m| 2 * m + 1);
pub(super) const BEST_UP_TO: Family = (|largest| best(largest, StoppingRule::Full), |m| 2 * m + 1);
pub(super) const BILINEAR: Family = (bilinear, |k| k + 1);

/// (log₁₀ of the states, log₁₀ of the drift)
pub(super) fn against_states(results: &Results, run: &Run, (of, states): Family, orders: &[u32]) -> Vec<(f64, f64)> {
    let point = |&order: &u32| (f64::from(states(order)).log10(), results.log10_drift(run, &of(order)));
    orders.iter().map(point).collect()
}

/// The even orders up to 200, whose values belong to states.
pub(super) fn even(orders: &[u32]) -> Vec<u32> {
    orders.iter().map(|order| 2 * order).filter(|order| *order <= 200).collect()
}

pub(super) const STATES: &str = "states per estimate";
