//! Shared by the figures of the pendulum.

use std::f64::consts::PI;

/// The distance of the nearest singularity of q(t) from the real axis: K(k'), k = p(0)/2, by π/(2 AGM(1, k)).
pub(super) fn singularity(p: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, p / 2.0);
    for _ in 0..60 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    PI / (2.0 * a)
}
