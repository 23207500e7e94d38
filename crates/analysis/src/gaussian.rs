//! Gaussian targets of Hamiltonian Monte Carlo, and how often a proposal is accepted.
//!
//! A Gaussian density and unit masses make H a sum of independent oscillators of frequencies ω_i, the roots of the
//! eigenvalues of the inverse covariance: of a direction with standard deviation σ, ω = 1/σ. Masses other than 1 change
//! the ω_i only.
//!
//! **Acceptance.** Let E_i be the expected error of the energy of oscillator i ([`crate::sampling`]). A map of
//! determinant 1 with singular values s and 1/s takes a state (x, y) of two normal variables to one with ΔH = ((s² −
//! 1)x² + (s⁻² − 1)y²)/2, and 2E = (s − 1/s)². So E[exp(iuΔH)] = (1 + 2E(u² − iu))^(−1/2): all that ΔH depends on is E.
//! With u = v + i/2 this is real, and as min(1, e^−x) = e^(−x/2) e^(−|x|/2), Parseval's formula with v = sinh(s)/2
//! gives
//!
//! E[min(1, e^−ΔH)] = (1/π) ∫ Π_i (1 + E_i cosh²(s)/2)^(−1/2) ds / cosh s,
//!
//! which holds for any number of oscillators. For many with small E_i it approaches 2Φ(−√(μ/2)), μ = Σ E_i, which
//! Beskos, Pillai, Roberts, Sanz-Serna and Stuart (Bernoulli 19 (2013) 1501) prove for targets of independent, equal
//! components, Gaussian or not.

use thiserror::Error;

/// A Gaussian density by the frequencies of its oscillators.
#[derive(Clone, Debug, PartialEq)]
pub struct Gaussian {
    frequencies: Vec<f64>,
}

/// Frequencies that are not those of a Gaussian.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum NotGaussian {
    /// There is none.
    #[error("there are no frequencies")]
    Empty,
    /// This one, numbered from 1, is not positive or not finite.
    #[error("frequency {number} is {value}, and must be positive and finite")]
    OutOfRange {
        /// Its number.
        number: usize,
        /// Its value.
        value: f64,
    },
}

/// The distance of points in s: the integrand is analytic for |Im s| < π/2, and of many oscillators bounded for |Im
/// s| < π/4, so that the error of the sum is about exp(−π²/(2·distance)), 7e-18.
const DISTANCE: f64 = 0.125;

/// −log of an integrand that adds nothing more.
const NOTHING: f64 = 45.0;

impl Gaussian {
    /// The Gaussian with these frequencies.
    ///
    /// # Errors
    /// No frequencies, or one that is not positive and finite.
    pub fn new(frequencies: Vec<f64>) -> Result<Gaussian, NotGaussian> {
        if frequencies.is_empty() {
            return Err(NotGaussian::Empty);
        }
        match frequencies.iter().position(|omega| !(*omega > 0.0 && omega.is_finite())) {
            Some(at) => Err(NotGaussian::OutOfRange { number: at + 1, value: frequencies[at] }),
            None => Ok(Gaussian { frequencies }),
        }
    }

    /// The Gaussian of this dimension, at least 1, with frequencies spread evenly up to 1: j/d for j = 1 … d.
    pub fn spread(dimension: u32) -> Gaussian {
        let dimension = dimension.max(1);
        Gaussian { frequencies: (1..=dimension).map(|j| f64::from(j) / f64::from(dimension)).collect() }
    }

    /// The frequencies.
    pub fn frequencies(&self) -> &[f64] {
        &self.frequencies
    }

    /// The highest frequency.
    pub fn fastest(&self) -> f64 {
        self.frequencies.iter().copied().fold(0.0, f64::max)
    }

    /// A quarter of the period of the slowest oscillator, after which its position is independent of where it was.
    pub fn quarter_period(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 / self.frequencies.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// The mean of min(1, e^−ΔH) for oscillators with these expected errors: see [the module](self). Exact up to about
/// 1e-16.
pub(crate) fn acceptance(errors: &[f64]) -> f64 {
    mean(|cosh_squared| log_product(errors, cosh_squared / 2.0) / 2.0)
}

/// What it approaches for many oscillators with this sum of expected errors: 2Φ(−√(μ/2)).
pub fn acceptance_of_many(error: f64) -> f64 {
    mean(|cosh_squared| error * cosh_squared / 4.0)
}

/// (1/π) ∫ exp(−exponent(cosh²s)) ds/cosh s; the exponent increases.
fn mean(exponent: impl Fn(f64) -> f64) -> f64 {
    let integrand = |n: u32| {
        let cosh = (f64::from(n) * DISTANCE).cosh();
        let exponent = exponent(cosh * cosh) + cosh.ln();
        if exponent.is_finite() { (-exponent).exp() } else { 0.0 }
    };
    let last = (-NOTHING).exp();
    let right: f64 = (1..).map(integrand).take_while(|value| *value > last).sum();
    (integrand(0) + 2.0 * right) * DISTANCE / std::f64::consts::PI
}

/// log Π (1 + E_i x)
fn log_product(errors: &[f64], x: f64) -> f64 {
    const LARGE: f64 = 1e100;
    let (mut log, mut product) = (0.0, 1.0);
    for error in errors {
        product *= 1.0 + error * x;
        if product > LARGE {
            log += f64::ln(product);
            product = 1.0;
        }
    }
    log + f64::ln(product)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Of one oscillator ΔH < 0 in a sector of the plane, and reversibility makes the acceptance twice its share: (4/π)
    /// arctan(1/s).
    #[test]
    fn that_of_one_oscillator_is_an_angle() {
        for s in [1.0_f64, 1.000_001, 1.01, 1.5, 7.0, 1e4, 1e9] {
            let error = (s - 1.0 / s).powi(2) / 2.0;
            let known = 4.0 / PI * (1.0 / s).atan();
            assert!((acceptance(&[error]) / known - 1.0).abs() < 1e-9, "{s}: {} and {known}", acceptance(&[error]));
        }
    }

    #[test]
    fn many_oscillators_approach_the_normal_distribution() {
        // 2Φ(−x), from tables
        for (x, known) in
            [(0.0, 1.0), (0.453_762_190_169_879, 0.65), (1.0, 0.317_310_507_862_914), (3.0, 0.002_699_796_063_260)]
        {
            assert!((acceptance_of_many(2.0 * x * x) - known).abs() < 1e-14, "{x}");
        }
        let distance = |many: usize| {
            let error = 0.5;
            (acceptance(&vec![error / many as f64; many]) - acceptance_of_many(error)).abs()
        };
        assert!(distance(10) > 1e-4 && distance(100_000) < 2e-6, "{} {}", distance(10), distance(100_000));
        // by a tenth for ten times as many
        assert!((distance(1000) / distance(10_000) - 10.0).abs() < 0.1);
    }

    #[test]
    fn unstable_oscillators_are_never_accepted() {
        assert_eq!(acceptance(&[0.1, f64::INFINITY]), 0.0);
        assert!(acceptance(&vec![1.0; 1_000_000]) < 1e-30);
    }

    #[test]
    fn frequencies_are_positive() {
        assert_eq!(Gaussian::new(vec![]), Err(NotGaussian::Empty));
        let message = Gaussian::new(vec![1.0, -2.0]).unwrap_err().to_string();
        assert_eq!(message, "frequency 2 is -2, and must be positive and finite");
        let four = Gaussian::spread(4);
        assert_eq!(
            (four.frequencies(), four.fastest(), four.quarter_period()),
            (&[0.25, 0.5, 0.75, 1.0][..], 1.0, 2.0 * PI)
        );
    }
}
