//! The chain of Fermi, Pasta, Ulam and Tsingou with quadratic forces.

use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::Initial;
use crate::number::Number;
use crate::systems::pairs::{Ends, Pairs};
use crate::systems::potential::Potential;

potential! {
    /// A spring whose force has a quadratic term.
    pub struct CubicSpring { alpha }
    pair U(d) = d^2/2 + alpha * d^3/3
}

const BODIES: usize = 32;

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "fput-alpha",
        title: "Fermi–Pasta–Ulam–Tsingou chain of 32 bodies between walls, in its first mode",
        hamiltonian: "sum_i p_i^2/2 + sum_i (d_i^2/2 + alpha d_i^3/3), d_i = q_(i+1) - q_i, walls at rest",
        parameters: &[Parameter::any("alpha", "0.25", "strength of the quadratic force")],
        // the two bodies in the middle are displaced most, by 1
        initial: || Initial::of_chain(BODIES, |i| format!("sin({i}*pi/33)/sin(16*pi/33)"), |_| "0".to_owned()),
        step: "0.025",
        until: "1000",
        source: "Fermi, Pasta, Ulam & Tsingou, Los Alamos report LA-1940 (1955): first mode, at rest. Common today: \
            steps of 0.025 until 48000",
    };

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        let pair = CubicSpring { alpha: number("alpha") };
        Box::new(Pairs::<_, 1>::neighbours(BODIES, pair, Ends::Fixed).expect("the pairs fit"))
    }
}
