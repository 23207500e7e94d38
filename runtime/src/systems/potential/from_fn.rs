//! A potential from a closure.

use crate::systems::potential::Potential;

/// A potential of `dimension` coordinates from a function that writes the gradient U_q(q) into its second argument and
/// returns U(q).
///
/// It computes in `f64`. The rate qᵀU_q − 2U is computed from both. A potential that evaluates the gradient alone
/// faster, or in other number types, implements [`Potential`] or is a formula of [`crate::potential!`].
///
/// ```
/// use shadowstep::{Motion, Stepper, UnitMasses, systems::potential::from_fn, splitting_scheme};
///
/// #[splitting_scheme("yoshida4.toml")]
/// pub struct Yoshida4;
///
/// let spring_constant = 4.0; // U = 2 |q|²
/// let springs = from_fn(2, |q, gradient| {
///     gradient[0] = spring_constant * q[0];
///     gradient[1] = spring_constant * q[1];
///     spring_constant / 2.0 * (q[0] * q[0] + q[1] * q[1])
/// });
/// let mut motion = Motion::new(springs, UnitMasses, [1.0, 0.0], [0.0, 1.0])?;
/// let stepper = Stepper::new(Yoshida4, 0.05)?;
/// for _ in 0..1000 {
///     stepper.step(&mut motion);
/// }
/// assert!((motion.energy() - 2.5).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn from_fn<F: Fn(&[f64], &mut [f64]) -> f64>(dimension: usize, function: F) -> FromFn<F> {
    FromFn { dimension, function }
}

/// The potential that [`from_fn`] makes.
#[derive(Clone, Copy, Debug)]
pub struct FromFn<F> {
    dimension: usize,
    function: F,
}

impl<F: Fn(&[f64], &mut [f64]) -> f64> Potential<f64> for FromFn<F> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    /// A gradient that is computed beside the energy.
    fn scratch(&self) -> usize {
        self.dimension
    }

    fn energy(&self, q: &[f64], energy: &mut f64, scratch: &mut [f64]) {
        *energy = (self.function)(q, scratch);
    }

    #[inline]
    fn gradient(&self, q: &[f64], gradient: &mut [f64], _: &mut [f64]) {
        (self.function)(q, gradient);
    }

    #[inline]
    fn gradient_and_rate(&self, q: &[f64], gradient: &mut [f64], rate: &mut f64, _: &mut [f64]) {
        *rate = -2.0 * (self.function)(q, gradient);
        for (q, gradient) in q.iter().zip(gradient) {
            *rate += q * *gradient;
        }
    }
}
