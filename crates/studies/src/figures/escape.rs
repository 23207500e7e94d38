//! Whether the body of Kepler's problem escapes: by the topology of the level set of its modified energy.

use serde::{Deserialize, Serialize};

/// Beyond this distance the body can escape: its orbits begin with a = 1, so that no apocentre is farther.
const BEYOND: f64 = 2.0;

/// Whether and when the body escapes.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Escape {
    /// The first time at which it is farther than [`BEYOND`], moves outward, and has a modified energy of at least 0.
    pub(crate) time: Option<f64>,
    /// How often it turned back from an apocentre before that.
    pub(crate) returns: u32,
    /// The largest |q|.
    pub(crate) farthest: f64,
    /// Whether it moves outward at the last state.
    pub(crate) outward: bool,
}

impl Escape {
    /// The next state at time t of a run with the step size h.
    pub(crate) fn include(&mut self, t: f64, h: f64, q: [f64; 2], p: [f64; 2]) {
        let r = q[0].hypot(q[1]);
        self.farthest = self.farthest.max(r);
        let outward = dot(q, p) > 0.0;
        if self.time.is_none() {
            self.returns += u32::from(self.outward && !outward);
            if r > BEYOND && outward && modified_energy(h, q, p) >= 0.0 {
                self.time = Some(t);
            }
        }
        self.outward = outward;
    }
}

/// The modified energy of Störmer–Verlet, kick–drift–kick, up to h²: H + h² (pᵀU_qq p/12 − |U_q|²/24), U = −1/r.
///
/// A level set of it reaches infinity if its value is at least 0: there H̄ → |p|²/2.
pub(crate) fn modified_energy(h: f64, q: [f64; 2], p: [f64; 2]) -> f64 {
    let r = q[0].hypot(q[1]);
    let energy = dot(p, p) / 2.0 - 1.0 / r;
    let curvature = dot(p, p) / r.powi(3) - 3.0 * dot(q, p).powi(2) / r.powi(5);
    energy + h * h * (curvature / 12.0 - 1.0 / (24.0 * r.powi(4)))
}

/// The eccentricity at which the modified energy of the start, up to h², is 0: beyond it, the level set of the start
/// is unbounded.
pub(crate) fn critical(h: f64) -> f64 {
    let at_start = |e: f64| modified_energy(h, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
    let (mut bounded, mut unbounded) = (0.0, 1.0 - 1e-9);
    for _ in 0..60 {
        let middle = f64::midpoint(bounded, unbounded);
        if at_start(middle) < 0.0 { bounded = middle } else { unbounded = middle }
    }
    f64::midpoint(bounded, unbounded)
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On parabolas and hyperbolas H ≥ 0; at the same place with less speed the body is bound, and inward it may
    /// return.
    #[test]
    fn only_unbounded_outward_motion_is_an_escape() {
        let time = |p: [f64; 2]| {
            let mut escape = Escape::default();
            escape.include(1.0, 0.1, [3.0, 0.0], p);
            escape.time
        };
        assert_eq!(time([0.9, 0.0]), Some(1.0));
        assert_eq!(time([0.7, 0.0]), None, "H < 0");
        assert_eq!(time([-0.9, 0.0]), None, "inward");
        let mut near = Escape::default();
        near.include(1.0, 0.1, [1.0, 0.0], [2.0, 0.0]);
        assert_eq!(near.time, None, "the terms beyond h² may matter");
    }

    /// At a pericentre H̄ = −1/2 + h² (1 + 2e)/(24 (1 − e)⁴): by hand, with U_qq across the radius 1/r³.
    #[test]
    fn modified_energy_of_the_start() {
        for (e, h) in [(0.0_f64, 0.1_f64), (0.6, 0.2), (0.9, 0.05)] {
            let found = modified_energy(h, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
            let expected = -0.5 + h * h * (1.0 + 2.0 * e) / (24.0 * (1.0 - e).powi(4));
            assert!((found - expected).abs() < 1e-12 * expected.abs().max(1.0), "{e} {h}: {found} {expected}");
        }
    }
}
