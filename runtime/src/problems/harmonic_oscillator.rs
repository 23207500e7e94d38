//! The harmonic oscillator, whose modified Hamiltonian is known in closed form.

use num_traits::Signed;
use shadowstep_macros::potential;

use crate::problems::{Initial, Parameter, Problem};

potential! {
    /// The harmonic oscillator. U is homogeneous of degree 2: β stays 0.
    pub struct HarmonicOscillator { omega }
    U(q) = omega^2 * q^2/2
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
    initial: || Initial::new([("q", "1")], [("p", "0")]),
    step: "1/20",
    until: "100",
    source: "closed form of the modified Hamiltonian of kick-drift-kick Störmer–Verlet: ½(p² + (1−x²)ω²q²)·arcsin(x)/(x√(1−x²)), x = hω/2",
};
