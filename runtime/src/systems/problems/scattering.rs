//! Scattering at a Gaussian hill.

use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};

potential! {
    /// A Gaussian hill.
    pub struct Scattering;
    U(x, y) = exp(-(x^2 + y^2))
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "scattering",
        title: "Scattering at a Gaussian hill",
        hamiltonian: "(px^2 + py^2)/2 + exp(-x^2 - y^2)",
        parameters: &[
            Parameter::positive("start", "17", "distance of the start before the hill: there U is below 1e-125"),
            Parameter::any("impact", "0.3", "impact parameter"),
            Parameter::positive("speed", "2", "speed far from the hill"),
        ],
        initial: || Initial::new([("x", "-start"), ("y", "impact")], [("px", "speed"), ("py", "0")]),
        step: "1/20",
        until: "17",
        source: "after Benettin & Giorgilli, J. Stat. Phys. 74 (1994) 1117, quoted in Moan & Niesen, section 5",
    };

    const HAS_FUNCTIONS: bool = true;

    fn potential<N: Number + 'static>(_: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(Scattering))
    }
}
