//! The mathematical pendulum.

mod exact_flow;
mod taylor;

use shadowstep_macros::potential;

use super::definition::{Definition, Description};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};
use crate::systems::problems::exact_flow::solver::Solver;

potential! {
    /// The mathematical pendulum.
    pub struct Pendulum;
    U(q) = -cos(q)
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "pendulum",
        title: "Pendulum",
        hamiltonian: "p^2/2 - cos(q)",
        parameters: &[],
        initial: || Initial::new([("q", "0")], [("p", "1")]),
        step: "1/10",
        until: "100",
        source: "Moan & Niesen, section 5.1: p(0) = 1, t in [0, 100]; p = 2 is the separatrix",
    };

    const EXACT_FLOW: Option<Solver> = Some(Solver::of::<exact_flow::AdditionTheorems>());

    const HAS_FUNCTIONS: bool = true;

    fn potential<N: Number + 'static>(_: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(Pendulum))
    }
}
