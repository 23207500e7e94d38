//! Three bodies on a figure eight.

use num_traits::Signed;

use crate::problems::initial::Body;
use crate::problems::{Initial, Parameter, Problem};

/// Parameters g, m_1, m_2, m_3 of a problem of three bodies.
pub(super) const fn three_bodies(masses: [&'static str; 3]) -> [Parameter; 4] {
    [
        positive("g", "1", "gravitational constant"),
        positive("m_1", masses[0], "mass of the first body"),
        positive("m_2", masses[1], "mass of the second body"),
        positive("m_3", masses[2], "mass of the third body"),
    ]
}

const fn positive(name: &'static str, default: &'static str, meaning: &'static str) -> Parameter {
    Parameter { name, default, meaning, range: "it must be positive", allowed: |value| value.is_positive() }
}

/// The third body begins in the middle, between the other two, whose velocities are −1/2 of its own: copies with
/// 0.46620368 have lost a digit, and the momentum is not 0.
const BODIES: [Body<2>; 3] = [
    Body { name: "1", mass: "m_1", position: ["0.97000436", "-0.24308753"], velocity: ["0.466203685", "0.43236573"] },
    Body { name: "2", mass: "m_2", position: ["-0.97000436", "0.24308753"], velocity: ["0.466203685", "0.43236573"] },
    Body { name: "3", mass: "m_3", position: ["0", "0"], velocity: ["-0.93240737", "-0.86473146"] },
];

pub(super) const PROBLEM: Problem = Problem {
    name: "figure-eight",
    title: "Three equal bodies on a figure eight",
    hamiltonian: "sum_i |p_i|^2/(2 m_i) - g sum_(i<j) m_i m_j/|q_i - q_j|",
    parameters: &three_bodies(["1", "1", "1"]),
    initial: || Initial::of_bodies(&BODIES),
    step: "1/100",
    until: "6.32591398",
    source: "Chenciner & Montgomery, Annals of Mathematics 152 (2000) 881; initial values by C. Simó; period 6.32591398",
};
