//! The mathematical pendulum.

use shadowstep_macros::potential;

use crate::problems::{Initial, Problem};

potential! {
    /// The mathematical pendulum.
    pub struct Pendulum;
    U(q) = -cos(q)
}

pub(super) const PROBLEM: Problem = Problem {
    name: "pendulum",
    title: "Pendulum",
    hamiltonian: "p^2/2 - cos(q)",
    parameters: &[],
    initial: || Initial::new([("q", "0")], [("p", "1")]),
    step: "1/10",
    until: "100",
    source: "Moan & Niesen, section 5.1: p(0) = 1, t in [0, 100]; p = 2 is the separatrix",
};
