//! Scattering at a Gaussian hill.

use num_traits::Signed;
use shadowstep_macros::potential;

use crate::problems::{Initial, Parameter, Problem};

potential! {
    /// A Gaussian hill.
    pub struct Scattering;
    U(x, y) = exp(-(x^2 + y^2))
}

pub(super) const PROBLEM: Problem = Problem {
    name: "scattering",
    title: "Scattering at a Gaussian hill",
    hamiltonian: "(px^2 + py^2)/2 + exp(-x^2 - y^2)",
    parameters: &[
        Parameter {
            name: "start",
            default: "17",
            meaning: "distance of the start before the hill: there U is below 1e-125",
            range: "it must be positive",
            allowed: |start| start.is_positive(),
        },
        Parameter {
            name: "impact",
            default: "0.3",
            meaning: "impact parameter",
            range: "any number is allowed",
            allowed: |_| true,
        },
        Parameter {
            name: "speed",
            default: "2",
            meaning: "speed far from the hill",
            range: "it must be positive",
            allowed: |speed| speed.is_positive(),
        },
    ],
    initial: || Initial::new([("x", "-start"), ("y", "impact")], [("px", "speed"), ("py", "0")]),
    step: "1/20",
    until: "17",
    source: "after Benettin & Giorgilli, J. Stat. Phys. 74 (1994) 569, quoted in Moan & Niesen, section 5",
};
