//! Seven argon atoms in the plane.

use shadowstep_macros::potential;

use super::definition::{Definition, Description, Parameter};
use super::initial::{Body, Initial};
use crate::number::Number;
use crate::systems::pairs::Pairs;
use crate::systems::potential::Potential;

potential! {
    /// The Lennard-Jones potential of depth epsilon with its zero at the distance sigma.
    pub struct LennardJones { epsilon, sigma }
    pair U(r2) = 4*epsilon * (sigma^12/r2^6 - sigma^6/r2^3)
}

const ATOMS: usize = 7;

const fn atom(name: &'static str, position: [&'static str; 2], velocity: [&'static str; 2]) -> Body<2> {
    Body { name, mass: "m", position, velocity }
}

/// One atom in the middle, six around it.
const BODIES: [Body<2>; ATOMS] = [
    atom("1", ["0", "0"], ["-30", "-20"]),
    atom("2", ["0.02", "0.39"], ["50", "-90"]),
    atom("3", ["0.34", "0.17"], ["-70", "-60"]),
    atom("4", ["0.36", "-0.21"], ["90", "40"]),
    atom("5", ["-0.02", "-0.40"], ["80", "90"]),
    atom("6", ["-0.35", "-0.16"], ["-40", "100"]),
    atom("7", ["-0.31", "0.21"], ["-80", "-60"]),
];

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "argon-crystal",
        title: "Seven argon atoms in the plane (nanometres, nanoseconds, kilograms; energies in joules)",
        hamiltonian: "sum_i |p_i|^2/(2 m) + sum_(i<j) 4 epsilon ((sigma/r_ij)^12 - (sigma/r_ij)^6)",
        parameters: &[
            Parameter::positive("k_b", "1.380658e-23", "Boltzmann's constant in joules per kelvin"),
            Parameter::positive("m", "66.34e-27", "mass of an atom in kilograms"),
            Parameter::positive("epsilon", "119.8 * k_b", "depth of the potential in joules"),
            Parameter::positive("sigma", "0.341", "distance of its zero in nanometres"),
        ],
        initial: || Initial::of_bodies(&BODIES),
        step: "4e-5",
        until: "0.2",
        source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, table I.4.1: H(0) = -1260.2 k_b, 0.2 ns",
    };

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        let pair = LennardJones { epsilon: number("epsilon"), sigma: number("sigma") };
        Box::new(Pairs::<_, 2>::all(ATOMS, pair).expect("the pairs fit"))
    }
}
