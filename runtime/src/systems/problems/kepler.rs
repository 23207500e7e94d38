//! Kepler's problem in the plane.

mod exact_flow;

use num_traits::{One, Signed};
use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::Initial;
use crate::Rational;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};
use crate::systems::problems::exact_flow::solver::Solver;

potential! {
    /// Kepler's problem in the plane.
    pub struct Kepler;
    U(x, y) = -1/sqrt(x^2 + y^2)
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "kepler",
        title: "Kepler's problem in the plane",
        hamiltonian: "(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)",
        parameters: &[Parameter {
            name: "eccentricity",
            default: "0.6",
            meaning: "eccentricity of the orbit, which starts at its pericentre",
            range: "it must be at least 0 and less than 1",
            allowed: |e| !e.is_negative() && *e < Rational::one(),
        }],
        initial: || {
            Initial::new(
                [("x", "1 - eccentricity"), ("y", "0")],
                [("px", "0"), ("py", "sqrt((1 + eccentricity)/(1 - eccentricity))")],
            )
        },
        step: "1/20",
        until: "100",
        source: "Moan & Niesen, section 5.2: e = 0.6, t in [0, 100]; H = -1/2, period 2 pi",
    };

    const EXACT_FLOW: Option<Solver> = Some(Solver::of::<exact_flow::KeplersEquation>());

    fn potential<N: Number + 'static>(_: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(Kepler))
    }
}
