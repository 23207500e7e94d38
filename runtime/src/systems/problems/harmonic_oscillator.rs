//! The harmonic oscillator, whose modified Hamiltonian is known in closed form.

mod exact_flow;

use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::potential::{Potential, Vectorised};
use crate::systems::problems::exact_flow::solver::Solver;

potential! {
    /// The harmonic oscillator. U is homogeneous of degree 2: β stays 0.
    pub struct HarmonicOscillator { omega }
    U(q) = omega^2 * q^2/2
}

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "harmonic-oscillator",
        title: "Harmonic oscillator",
        hamiltonian: "p^2/2 + omega^2*q^2/2",
        parameters: &[Parameter::positive("omega", "1", "angular frequency")],
        initial: || Initial::new([("q", "1")], [("p", "0")]),
        step: "1/20",
        until: "100",
        source: "closed form of the modified Hamiltonian of kick-drift-kick Störmer–Verlet: ½(p² + \
            (1−x²)ω²q²)·arcsin(x)/(x√(1−x²)), x = hω/2",
    };

    const EXACT_FLOW: Option<Solver> = Some(Solver::of::<exact_flow::ClosedForm>());

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        Box::new(Vectorised(HarmonicOscillator { omega: number("omega") }))
    }
}
