//! The chain of Fermi, Pasta, Ulam and Tsingou with quadratic forces.

use shadowstep_macros::potential;

use crate::problems::{Initial, Parameter, Problem};

potential! {
    /// A spring whose force has a quadratic term.
    pub struct CubicSpring { alpha }
    pair U(d) = d^2/2 + alpha * d^3/3
}

pub(super) const BODIES: usize = 32;

pub(super) const PROBLEM: Problem = Problem {
    name: "fput-alpha",
    title: "Fermi–Pasta–Ulam–Tsingou chain of 32 bodies between walls, in its first mode",
    hamiltonian: "sum_i p_i^2/2 + sum_i (d_i^2/2 + alpha d_i^3/3), d_i = q_(i+1) - q_i, walls at rest",
    parameters: &[Parameter {
        name: "alpha",
        default: "0.25",
        meaning: "strength of the quadratic force",
        range: "any number is allowed",
        allowed: |_| true,
    }],
    // the two bodies in the middle are displaced most, by 1
    initial: || Initial::of_chain(BODIES, |i| format!("sin({i}*pi/33)/sin(16*pi/33)"), |_| "0".to_owned()),
    step: "0.025",
    until: "1000",
    source: "Fermi, Pasta, Ulam & Tsingou, Los Alamos report LA-1940 (1955): first mode, at rest. Common today: steps of 0.025 until 48000",
};
