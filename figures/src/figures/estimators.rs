//! Shared by the figures of estimators against the number of states that they use.

use crate::results::Results;
use crate::run::{Estimator, Run};

pub(super) const ORDERS: [u32; 14] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 50, 80, 130, 200];

/// (log₁₀ of the states, log₁₀ of the drift)
pub(super) fn against_states(
    results: &Results,
    run: &Run,
    by: &dyn Fn(u32) -> Estimator,
    orders: &[u32],
) -> Vec<(f64, f64)> {
    let point = |&order: &u32| (f64::from(by(order).states()).log10(), results.log10_drift(run, by(order)));
    orders.iter().map(point).collect()
}

/// The even orders up to 200, whose values belong to states.
pub(super) fn even(orders: &[u32]) -> Vec<u32> {
    orders.iter().map(|order| 2 * order).filter(|order| *order <= 200).collect()
}

pub(super) const STATES: &str = "states per estimate";
