//! A step of the harmonic oscillator in f64: its matrix, trace and phase at a given hω.
//!
//! [`crate::trace`] has the trace as an exact polynomial, [`crate::stability`] decides where the step is stable.

use std::f64::consts::TAU;

use num_traits::ToPrimitive;
use shadowstep_schemes::map::Map;
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::{MapKind, Proved};

/// Points at which the limit of stability is looked for.
const POINTS_OF_LIMIT: u32 = 400;

/// A peak of the trace between points is not much higher than at the points.
const NEAR_TWO: f64 = 1.8;

/// Rounding of a trace that only touches ±2, with room.
const TOUCHES: f64 = 1e-12;

/// The step that some maps make for H = (p² + ω²q²)/2, with weights in f64.
#[derive(Clone, Debug)]
pub struct Oscillator {
    maps: Vec<(MapKind, f64)>,
}

impl Oscillator {
    /// The step of these maps; `nearest` rounds a weight to the nearest f64.
    pub fn of(maps: &[Map], nearest: impl Fn(&Rational) -> f64) -> Oscillator {
        Oscillator { maps: maps.iter().map(|map| (map.kind, nearest(&map.weight))).collect() }
    }

    /// The step of maps whose weights are in f64 already.
    pub(crate) fn of_floats(maps: &[(MapKind, f64)]) -> Oscillator {
        Oscillator { maps: maps.to_vec() }
    }

    /// The least hω up to `most` where the trace leaves [−2, 2], looked for at some points and at the largest |tr|
    /// between three of them. What is narrower than about 1e-6 is not found; [`crate::stability`] decides exactly.
    pub(crate) fn limit(&self, most: f64) -> f64 {
        let at = |n: u32| most * f64::from(n) / f64::from(POINTS_OF_LIMIT);
        let size = |h_omega: f64| self.trace(h_omega).abs();
        let is_unstable = |h_omega: f64| size(h_omega) > 2.0 + TOUCHES;
        let (mut last, mut now) = (2.0, size(at(1)));
        for n in 1..=POINTS_OF_LIMIT {
            let next = size(at(n + 1));
            let peak = if now > NEAR_TWO && now >= last && now >= next {
                largest_between(size, at(n - 1), at(n + 1))
            } else {
                at(n)
            };
            if is_unstable(peak) {
                return bisected(is_unstable, at(n - 1), peak);
            }
            (last, now) = (now, next);
        }
        most
    }

    /// The step of a scheme with weights rounded to f64; of a processed one that of its kernel.
    pub(crate) fn of_scheme(proved: &Proved) -> Oscillator {
        Oscillator::of(&proved.scheme.maps(), |weight| weight.to_f64().unwrap_or(f64::NAN))
    }

    /// Where a step with ω = 1 takes (q, p) = (1, 0) and (0, 1): the columns of its matrix, which for every ω acts on
    /// (ωq, p).
    pub(crate) fn columns(&self, h_omega: f64) -> [[f64; 2]; 2] {
        let mut columns = [[1.0, 0.0], [0.0, 1.0]];
        for (kind, weight) in &self.maps {
            for [q, p] in &mut columns {
                match kind {
                    MapKind::Kick => *p -= weight * h_omega * *q,
                    MapKind::Drift => *q += weight * h_omega * *p,
                    // U_qq M⁻¹U_q = q
                    MapKind::GradientKick => *p += 2.0 * weight * h_omega.powi(3) * *q,
                }
            }
        }
        columns
    }

    /// The trace of the step's matrix: 2 cos φ for a step that turns by φ, larger than 2 in size where it is unstable.
    pub fn trace(&self, h_omega: f64) -> f64 {
        let [[a, _], [_, d]] = self.columns(h_omega);
        a + d
    }

    /// ρ(hω) = (B + C)²/(−2BC) of a symmetric step with matrix [[A, B], [C, A]], see [`crate::sampling`]: infinite
    /// where it is unstable, 0 where it turns by a multiple of π, which has BC = A² − 1 = 0, up to rounding.
    pub(crate) fn rho(&self, h_omega: f64) -> f64 {
        const ROUNDING: f64 = 1e-12;
        let [[_, c], [b, _]] = self.columns(h_omega);
        match b * c {
            product if product < 0.0 => (b + c) * (b + c) / (-2.0 * product),
            product if product < ROUNDING => 0.0,
            _ => f64::INFINITY,
        }
    }

    /// The expected error of the energy after a number of symmetric steps, ρ sin²(nφ), in units of the temperature: see
    /// [`crate::sampling`].
    pub(crate) fn energy_error(&self, h_omega: f64, steps: u64) -> f64 {
        let [[a, c], [b, d]] = self.columns(h_omega);
        let turned = (-b * c).max(0.0).sqrt().atan2((a + d) / 2.0);
        self.rho(h_omega) * (steps as f64 * turned).sin().powi(2)
    }

    /// The relative error of the phase (φ − hω)/hω, with the φ of 2 cos φ = tr for which it is nearest to `expected`;
    /// `None` where the step is unstable. Rounding adds about 1e-16/(hω)² for each map.
    ///
    /// For a small step 0 is expected; beyond hω = π the error at a slightly smaller step continues to the right φ.
    pub fn phase_error(&self, h_omega: f64, expected: f64) -> Option<f64> {
        let trace = self.trace(h_omega);
        if trace.abs() > 2.0 {
            return None;
        }
        let near = h_omega * (1.0 + expected);
        let angle = (trace / 2.0).acos();
        let turned = |angle: f64| angle + TAU * ((near - angle) / TAU).round();
        let [one, other] = [turned(angle), turned(-angle)];
        let phase = if (one - near).abs() <= (other - near).abs() { one } else { other };
        Some((phase - h_omega) / h_omega)
    }

    /// How many maps the step has.
    pub fn maps(&self) -> usize {
        self.maps.len()
    }
}

/// Where a function with one maximum between two points is largest, by golden sections.
pub(crate) fn largest_between(function: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    // to the square root of the rounding, below which values near a maximum do not differ
    while to - from > 1e-9 * to {
        let (left, right) = (to - golden * (to - from), from + golden * (to - from));
        if function(left) < function(right) { from = left } else { to = right }
    }
    (from + to) / 2.0
}

/// Where a stable range ends that begins at `stable`, before `unstable`.
fn bisected(is_unstable: impl Fn(f64) -> bool, mut stable: f64, mut unstable: f64) -> f64 {
    while unstable - stable > 1e-13 * unstable {
        let middle = (stable + unstable) / 2.0;
        *(if is_unstable(middle) { &mut unstable } else { &mut stable }) = middle;
    }
    stable
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::shipped_proved;

    use super::*;
    use crate::Analysis;

    fn oscillator(name: &str) -> Oscillator {
        Oscillator::of_scheme(shipped_proved(name).unwrap())
    }

    #[test]
    fn the_trace_of_the_leapfrog_is_known() {
        let verlet = oscillator("stormer-verlet");
        for h_omega in [0.1_f64, 1.0, 1.9, 2.5] {
            assert!((verlet.trace(h_omega) - (2.0 - h_omega * h_omega)).abs() < 1e-14);
            let phase = (h_omega < 2.0).then(|| 2.0 * (h_omega / 2.0).asin() / h_omega - 1.0);
            match (verlet.phase_error(h_omega, 0.0), phase) {
                (Some(found), Some(known)) => assert!((found - known).abs() < 1e-13, "{found} {known}"),
                (found, known) => assert_eq!(found, known),
            }
        }
    }

    /// At small hω the error is its leading term, which the exact polynomial gives.
    #[test]
    fn phase_errors_approach_their_leading_terms() {
        for (name, h_omega) in
            [("stormer-verlet", 0.01), ("yoshida4", 0.05), ("blanes-moan-srkn6b", 0.2), ("kahan-li8", 0.3)]
        {
            let leading = Analysis::of(shipped_proved(name).unwrap()).phase;
            let found = oscillator(name).phase_error(h_omega, 0.0).unwrap();
            let ratio = found / (leading.coefficient * h_omega.powi(leading.power as i32));
            assert!((ratio - 1.0).abs() < 0.05, "{name}: {ratio}");
        }
    }

    /// Held against the exact polynomials, for all shipped schemes: gaps may be as narrow as 4e-4.
    #[test]
    fn limits_are_those_of_the_exact_trace() {
        for name in shadowstep_schemes::shipped_names() {
            let proved = shipped_proved(name).unwrap();
            let Some(exact) = crate::stability::Stability::of_scheme(proved) else { continue };
            let exact: f64 = exact.limit.parse().unwrap();
            let found = oscillator(name).limit(2.0 * proved.plan.degree() as f64);
            // a limit at a triple root moves by the cube root of the room for rounding
            assert!((found / exact - 1.0).abs() < 1e-4, "{name}: {found} {exact}");
        }
    }

    /// Its trace nearly touches 2 at hω = 2π, where the phase continues to be too slow.
    #[test]
    fn the_phase_continues_beyond_half_a_turn() {
        let (srkn11, mut error) = (oscillator("blanes-moan-srkn11b"), 0.0);
        for n in 1..=900 {
            let h_omega = f64::from(n) / 100.0;
            if let Some(found) = srkn11.phase_error(h_omega, error) {
                assert!(n < 30 || found < 0.0, "{found} at {h_omega}");
                error = found;
            }
        }
        // between the minimum of the trace and 2, to which it returns at hω = 9.0736: φ is a little more than 2π
        assert!(error > TAU / 9.0 - 1.0 && error < 1.25 * TAU / 9.0 - 1.0, "{error}");
    }
}
