//! The harmonic oscillator, whose modified Hamiltonian is known in closed form.

use num_traits::Signed;

use crate::Rational;
use crate::number::Number;
use crate::potential::Potential;
use crate::problems::{Parameter, Problem};

/// U = ½ω²|q|² in any dimension. Homogeneous of degree 2: β stays 0.
#[derive(Clone, Debug)]
pub struct HarmonicOscillator<N> {
    omega_squared: N,
    dimension: usize,
}

impl<N: Number> HarmonicOscillator<N> {
    /// With angular frequency ω; ω² is rounded once.
    pub fn new(omega: &Rational, dimension: usize, context: &N::Context) -> Self {
        HarmonicOscillator { omega_squared: N::from_rational(&(omega * omega), context), dimension }
    }
}

impl<N: Number> Potential<N> for HarmonicOscillator<N> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn energy(&self, q: &[N], energy: &mut N, _: &mut [N]) {
        energy.assign_zero();
        for q in q {
            energy.add_product(q, q);
        }
        energy.multiply(&self.omega_squared);
        energy.divide_integer(2);
    }

    #[inline]
    fn gradient(&self, q: &[N], gradient: &mut [N], _: &mut [N]) {
        for (gradient, q) in gradient.iter_mut().zip(q) {
            gradient.assign_product(&self.omega_squared, q);
        }
    }

    #[inline]
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.gradient(q, gradient, scratch);
        rate.assign_zero();
    }
}

pub(super) const PROBLEM: Problem = Problem {
    name: "harmonic-oscillator",
    title: "Harmonic oscillator",
    hamiltonian: "p^2/2 + omega^2 q^2/2",
    parameters: &[Parameter {
        name: "omega",
        default: "1",
        meaning: "angular frequency",
        range: "it must be positive",
        allowed: |omega| omega.is_positive(),
    }],
    positions: &[("q", "1")],
    momenta: &[("p", "0")],
    source: "closed form of the modified Hamiltonian of kick-drift-kick Störmer–Verlet: ½(p² + (1−x²)ω²q²)·arcsin(x)/(x√(1−x²)), x = hω/2",
};
