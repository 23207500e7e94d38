//! The Pythagorean problem of three bodies.

use super::definition::{Definition, Description};
use super::gravity::{THREE_MASSES, gravity, three_bodies};
use super::initial::{Body, Initial};
use crate::number::Number;
use crate::systems::potential::Potential;

const BODIES: [Body<2>; 3] = [
    Body { name: "1", mass: "m_1", position: ["1", "3"], velocity: ["0", "0"] },
    Body { name: "2", mass: "m_2", position: ["-2", "-1"], velocity: ["0", "0"] },
    Body { name: "3", mass: "m_3", position: ["1", "-1"], velocity: ["0", "0"] },
];

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "pythagorean",
        title: "Three bodies of masses 3, 4, 5 at rest in the corners of a triangle: close encounters",
        hamiltonian: "sum_i |p_i|^2/(2 m_i) - g sum_(i<j) m_i m_j/|q_i - q_j|",
        parameters: &three_bodies(["3", "4", "5"]),
        initial: || Initial::of_bodies(&BODIES),
        step: "1/1000",
        until: "10",
        source: "Burrau, Astronomische Nachrichten 195 (1913) 113: no fixed step resolves its encounters",
    };

    const GRAVITY: Option<usize> = Some(2);

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        gravity::<N, 2>(number, &THREE_MASSES)
    }
}
