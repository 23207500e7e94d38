//! The chain of Fermi, Pasta, Ulam and Tsingou with stiff and soft springs in turn.

use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};

potential! {
    /// Three stiff springs of frequency omega between soft, quartic ones: x01, x02, x03 are (scaled) positions of the
    /// stiff springs, x11, x12, x13 their expansions.
    pub struct StiffFput { omega }
    U(x01, x02, x03, x11, x12, x13) = omega^2 * (x11^2 + x12^2 + x13^2)/2
        + ((x01 - x11)^4 + (x02 - x12 - x01 - x11)^4 + (x03 - x13 - x02 - x12)^4 + (x03 + x13)^4)/4
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "fput-stiff",
        title: "Fermi–Pasta–Ulam–Tsingou chain of three stiff springs",
        hamiltonian: "sum (y0i^2 + y1i^2)/2 + omega^2/2 sum x1i^2 + ((x01 - x11)^4 + (x02 - x12 - x01 - x11)^4 + (x03 \
            - x13 - x02 - x12)^4 + (x03 + x13)^4)/4",
        parameters: &[Parameter::positive("omega", "50", "frequency of the stiff springs")],
        initial: || {
            let positions = [("x01", "1"), ("x02", "0"), ("x03", "0"), ("x11", "1/omega"), ("x12", "0"), ("x13", "0")];
            let momenta = [("y01", "1"), ("y02", "0"), ("y03", "0"), ("y11", "1"), ("y12", "0"), ("y13", "0")];
            Initial::new(positions, momenta)
        },
        step: "1/1000",
        until: "10",
        source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, section I.5.1: H(0) = 2.00120008, steps of \
            0.001 and 0.03",
    };

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(StiffFput { omega: number("omega") }))
    }
}
