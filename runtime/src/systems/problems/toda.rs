//! The Toda lattice.

use shadowstep_macros::potential;

use super::definition::{Definition, Description};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::pairs::{Ends, Pairs};
use crate::systems::potential::Potential;

potential! {
    /// Toda's spring, at rest at d = 0.
    pub struct TodaSpring;
    pair U(d) = exp(-d) + d - 1
}

const BODIES: usize = 200;

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "toda",
        title: "Toda lattice: a ring of 200 bodies that starts with a long wave of velocities",
        hamiltonian: "sum_i p_i^2/2 + sum_i (exp(-d_i) + d_i - 1), d_i = q_(i+1) - q_i, around the ring",
        parameters: &[],
        initial: || Initial::of_chain(BODIES, |_| "0".to_owned(), |i| format!("sin({i}*pi/100)")),
        step: "1/20",
        until: "100",
        source: "Toda, Journal of the Physical Society of Japan 22 (1967) 431: integrable, with solitons; the wave is \
            our choice",
    };

    const HAS_FUNCTIONS: bool = true;

    fn potential<N: Number + 'static>(_: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Pairs::<_, 1>::neighbours(BODIES, TodaSpring, Ends::Periodic).expect("the pairs fit"))
    }
}
