//! Shared by the figures of Kepler's problem.

use crate::figures::prelude::*;

/// The distance of the nearest singularity of q(t) from the real axis: E = i arcosh(1/e) in t = E − e sin E.
pub(super) fn singularity(e: f64) -> f64 {
    (1.0 / e).acosh() - (1.0 - e * e).sqrt()
}

/// A run with h = 1/n, e = 0.6 and a = 1.
pub(super) fn run(propagator: &str, n: u32) -> Run {
    Run::of(Problem::Kepler, propagator, format!("1/{n}"))
}

/// The points with h ≤ 1/10.
pub(super) fn fine(points: &[(f64, f64)]) -> Points {
    points.iter().copied().filter(|(n, _)| *n >= 10.0).collect()
}

/// The rate over h ≤ 1/10, of points against 1/h.
pub(super) fn rate(points: &[(f64, f64)]) -> Option<ExponentialDecay> {
    decay(&by_step(points), 0.1)
}

/// The semi-major axis is 1: |q| is 0.4 at a pericentre and 1.6 at an apocentre.
pub(super) const NEAR: f64 = 0.8;
pub(super) const FAR: f64 = 1.5;

/// (t, log₁₀|value − reference|)
pub(super) fn off(energies: &Energies, reference: usize) -> Points {
    let reference = number(&energies.values[reference]);
    let sizes = energies.values.iter().map(|value| (&number(value) - &reference).log10_abs());
    energies.times.iter().copied().zip(sizes).collect()
}

/// The index of the first apocentre.
pub(super) fn apocentre(energies: &Energies) -> usize {
    energies.distances.windows(2).position(|pair| pair[1] < pair[0]).unwrap_or(0)
}
