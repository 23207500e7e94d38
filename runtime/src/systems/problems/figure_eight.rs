//! Three bodies on a figure eight.

use super::definition::{Definition, Description};
use super::gravity::{THREE_MASSES, gravity, three_bodies};
use super::initial::{Body, Initial};
use crate::number::Number;
use crate::systems::potential::Potential;

/// The third body starts in the middle, with −2 times the velocity of the other two. Copies of these values with
/// 0.46620368 lack a digit: their total momentum is not 0.
const BODIES: [Body<2>; 3] = [
    Body { name: "1", mass: "m_1", position: ["0.97000436", "-0.24308753"], velocity: ["0.466203685", "0.43236573"] },
    Body { name: "2", mass: "m_2", position: ["-0.97000436", "0.24308753"], velocity: ["0.466203685", "0.43236573"] },
    Body { name: "3", mass: "m_3", position: ["0", "0"], velocity: ["-0.93240737", "-0.86473146"] },
];

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "figure-eight",
        title: "Three equal bodies on a figure eight",
        hamiltonian: "sum_i |p_i|^2/(2 m_i) - g sum_(i<j) m_i m_j/|q_i - q_j|",
        parameters: &three_bodies(["1", "1", "1"]),
        initial: || Initial::of_bodies(&BODIES),
        step: "1/100",
        until: "6.32591398",
        source: "Chenciner & Montgomery, Annals of Mathematics 152 (2000) 881; initial values by C. Simó; period \
            6.32591398",
    };

    const GRAVITY: Option<usize> = Some(2);

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        gravity::<N, 2>(number, &THREE_MASSES)
    }
}
