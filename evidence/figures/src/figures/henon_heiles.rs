//! Shared by the figures of the Hénon–Heiles problem.

use crate::results::Results;
use crate::run::Run;
use shadowstep::problems::Problem;
use shadowstep::shadow::EstimatorSettings;

/// 1/h
pub(super) const STEPS: [u32; 22] = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 25, 28];

/// A coarse grid.
pub(super) const FEW_STEPS: [u32; 7] = [2, 4, 6, 9, 12, 16, 25];

pub(super) fn run(scheme: &'static str, n: u32) -> Run {
    Run::of(Problem::HenonHeiles, scheme, format!("1/{n}"))
}

/// (1/h, log₁₀ drift) and (h, log₁₀ drift)
pub(super) fn drifts(
    results: &Results,
    scheme: &'static str,
    steps: &[u32],
    estimator: &EstimatorSettings,
) -> [Vec<(f64, f64)>; 2] {
    let drift = |n: u32| results.log10_drift(&run(scheme, n), estimator);
    let of = |x: &dyn Fn(f64) -> f64| steps.iter().map(|&n| (x(f64::from(n)), drift(n))).collect();
    [of(&|n| n), of(&|n| 1.0 / n)]
}
