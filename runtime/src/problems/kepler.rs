//! Kepler's problem in the plane.

use num_traits::{One, Signed};
use shadowstep_macros::potential;

use crate::Rational;
use crate::problems::{Initial, Parameter, Problem};

potential! {
    /// Kepler's problem in the plane.
    pub struct Kepler;
    U(x, y) = -1/sqrt(x^2 + y^2)
}

pub(super) const PROBLEM: Problem = Problem {
    name: "kepler",
    title: "Kepler's problem in the plane",
    hamiltonian: "(px^2 + py^2)/2 - 1/sqrt(x^2 + y^2)",
    parameters: &[Parameter {
        name: "eccentricity",
        default: "0.6",
        meaning: "eccentricity of the orbit, which begins at its pericentre",
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
