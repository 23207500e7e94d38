//! The Hénon–Heiles problem.

use shadowstep_macros::potential;

use super::definition::{Definition, Description};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};

potential! {
    /// The Hénon–Heiles potential.
    pub struct HenonHeiles;
    U(x, y) = (x^2 + y^2)/2 + x^2*y - y^3/3
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "henon-heiles",
        title: "Hénon–Heiles",
        hamiltonian: "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3",
        parameters: &[],
        initial: || Initial::new([("x", "0"), ("y", "0")], [("px", "0.1"), ("py", "0")]),
        step: "1/10",
        until: "100",
        source: "Moan & Niesen, section 5.3: p_1(0) = 0.1; chaotic from H = 1/12, escape from H = 1/6",
    };

    fn potential<N: Number + 'static>(_: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(HenonHeiles))
    }
}
