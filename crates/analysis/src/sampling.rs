//! The measure of integrators for Hamiltonian Monte Carlo: the largest expected error of the energy of a harmonic
//! oscillator.
//!
//! Let H = (p² + q²)/2 with q and p from the equilibrium at temperature 1, and the matrix of a symmetric step of size h
//! be [[A, B], [C, A]]. After L steps that turn by φ each, the mean of the error of the energy is ρ(h) sin²(Lφ)
//! (Blanes, Casas and Sanz-Serna, SIAM J. Sci. Comput. 36 (2014) A1556), with
//!
//! ρ(h) = (B + C)²/(2(1 − A²)) = (B + C)²/(−2BC).
//!
//! Their schemes minimise its maximum over 0 < h < h̄, where h̄ is the number of evaluations of the forces: a step of
//! Störmer–Verlet per unit of time costs as much. For independent oscillators with frequencies ω, hω stands for h.

use shadowstep_schemes::Proved;

use crate::oscillator::{Oscillator, largest_between};
use crate::stability::Stability;

/// The largest ρ(h) over 0 < h < h̄.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplingError {
    /// h̄, the number of evaluations a step.
    pub range: f64,
    /// The maximum of ρ; `None` where a step in the range is unstable.
    pub largest: Option<f64>,
}

/// Points at which ρ is computed, before the largest is refined.
const POINTS: u32 = 4000;

impl SamplingError {
    /// The error of a symmetric scheme; `None` for other ones, which are not reversible in time. For a processed scheme
    /// it is the kernel's.
    pub fn of(proved: &Proved, stability: Option<&Stability>) -> Option<SamplingError> {
        if !proved.proof.symmetric {
            return None;
        }
        let range = proved.plan.evaluations as f64;
        let limit: f64 = stability?.limit.parse().ok()?;
        let step = Oscillator::of_scheme(proved);
        Some(SamplingError { range, largest: (limit >= range).then(|| largest(&step, range)) })
    }
}

/// The largest ρ over 0 < h < `range`, where the step must be stable: that of many points, and a golden-section search
/// around it.
pub(crate) fn largest(step: &Oscillator, range: f64) -> f64 {
    let width = range / f64::from(POINTS);
    let at = |n: u32| f64::from(n) * width;
    let best = (1..=POINTS).max_by(|a, b| step.rho(at(*a)).total_cmp(&step.rho(at(*b)))).expect("there are points");
    let peak = largest_between(|h| step.rho(h), at(best - 1), at(best + 1).min(range));
    step.rho(peak).max(step.rho(at(best)))
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::{Source, read, shipped, shipped_proved};

    use super::*;

    fn found(proved: &Proved) -> f64 {
        SamplingError::of(proved, Stability::of_scheme(proved).as_ref()).unwrap().largest.unwrap()
    }

    /// A = 1 − h²/2, B = h, C = −h + h³/4: ρ(h) = h⁴/(32 − 8h²).
    #[test]
    fn that_of_the_leapfrog_is_known() {
        let verlet = shipped_proved("stormer-verlet").unwrap();
        assert!((found(verlet) - 1.0 / 24.0).abs() < 1e-12, "{}", found(verlet));
        for h in [0.1_f64, 0.7, 1.5] {
            let known = h.powi(4) / (32.0 - 8.0 * h * h);
            assert!((Oscillator::of_scheme(verlet).rho(h) / known - 1.0).abs() < 1e-9);
        }
    }

    /// Its trace touches −2 at hω = 3.043, where rounding decides on which side it is.
    #[test]
    fn a_turn_by_pi_is_no_instability() {
        let bcss4 = shipped_proved("bcss4").unwrap();
        assert!((found(bcss4) / 6.876e-7 - 1.0).abs() < 1e-3, "{}", found(bcss4));
        assert!(Oscillator::of_scheme(bcss4).rho(3.043) < 1e-6);
        assert_eq!(Oscillator::of_scheme(bcss4).rho(5.4), f64::INFINITY);
    }

    /// The values were computed from the matrices of the steps in another program.
    #[test]
    fn the_free_parameter_of_the_schemes_for_sampling_is_where_it_is_least() {
        for (name, known, parameter) in [("bcss2", 3.98951e-4, "0.211781"), ("bcss3", 7.41913e-5, "0.11888010966548")] {
            let least = found(shipped_proved(name).unwrap());
            assert!((least / known - 1.0).abs() < 1e-5, "{name}: {least}");
            for by in [-3e-4, 3e-4] {
                let Source { path, text } = shipped(name).unwrap();
                let moved = parameter.parse::<f64>().unwrap() + by;
                let source =
                    Source { path, text: text.replace(&format!("\"{parameter}\""), &format!("\"{moved:.12}\"")) };
                let other = read(&source, &|base, _| shipped(base)).unwrap();
                assert!(found(&other) > 1.001 * least, "{name}, {moved}: {} and {least}", found(&other));
            }
        }
    }
}
