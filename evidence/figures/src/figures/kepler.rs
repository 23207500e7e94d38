//! Shared by the figures of Kepler's problem.

use shadowstep::Real;
use shadowstep::problems::Problem;
use shadowstep::shadow::EstimatorSettings;

use crate::fit::{ExponentialDecay, decay};
use crate::measured::Energies;
use crate::numbers::number;
use crate::results::Results;
use crate::run::Run;

/// 1/h
pub(super) const STEPS: [u32; 24] =
    [4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 18, 20, 22, 24, 27, 30, 35, 40, 45, 50, 60];

/// A coarse grid.
pub(super) const FEW_STEPS: [u32; 7] = [4, 6, 10, 14, 20, 30, 40];

/// The distance of the nearest singularity of q(t) from the real axis: E = i arcosh(1/e) in t = E − e sin E.
pub(super) fn singularity(e: f64) -> f64 {
    (1.0 / e).acosh() - (1.0 - e * e).sqrt()
}

/// A run with h = 1/n, e = 0.6 and a = 1.
pub(super) fn run(propagator: &'static str, n: u32) -> Run {
    Run::of(Problem::Kepler, propagator, format!("1/{n}"))
}

/// (1/h, log₁₀ drift)
pub(super) fn drifts(
    results: &Results,
    propagator: &'static str,
    steps: &[u32],
    estimator: &EstimatorSettings,
) -> Vec<(f64, f64)> {
    steps.iter().map(|&n| (f64::from(n), results.log10_drift(&run(propagator, n), estimator))).collect()
}

/// The rate over h ≤ 1/10, of points against 1/h.
pub(super) fn rate(points: &[(f64, f64)]) -> Option<ExponentialDecay> {
    decay(&points.iter().map(|(n, y)| (1.0 / n, *y)).collect::<Vec<_>>(), 0.1)
}

/// The semi-major axis is 1: |q| is 0.4 at a pericentre and 1.6 at an apocentre.
pub(super) const NEAR: f64 = 0.8;
pub(super) const FAR: f64 = 1.5;

/// (t, log₁₀|value − reference|)
pub(super) fn off(energies: &Energies, reference: usize) -> Vec<(f64, f64)> {
    let reference = number(&energies.values[reference]);
    let sizes = energies.values.iter().map(|value| (&number(value) - &reference).log10_abs());
    energies.times.iter().copied().zip(sizes).collect()
}

/// The index of the first apocentre.
pub(super) fn apocentre(energies: &Energies) -> usize {
    energies.distances.windows(2).position(|pair| pair[1] < pair[0]).unwrap_or(0)
}
