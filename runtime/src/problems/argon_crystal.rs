//! Seven argon atoms in the plane.

use num_traits::Signed;
use shadowstep_macros::potential;

use crate::problems::initial::Body;
use crate::problems::{Initial, Parameter, Problem};

potential! {
    /// The Lennard-Jones potential of depth epsilon with its zero at the distance sigma.
    pub struct LennardJones { epsilon, sigma }
    pair U(r2) = 4*epsilon * (sigma^12/r2^6 - sigma^6/r2^3)
}

pub(super) const ATOMS: usize = 7;

const fn atom(name: &'static str, position: [&'static str; 2], velocity: [&'static str; 2]) -> Body<2> {
    Body { name, mass: "m", position, velocity }
}

/// One in the middle, six around it.
const BODIES: [Body<2>; ATOMS] = [
    atom("1", ["0", "0"], ["-30", "-20"]),
    atom("2", ["0.02", "0.39"], ["50", "-90"]),
    atom("3", ["0.34", "0.17"], ["-70", "-60"]),
    atom("4", ["0.36", "-0.21"], ["90", "40"]),
    atom("5", ["-0.02", "-0.40"], ["80", "90"]),
    atom("6", ["-0.35", "-0.16"], ["-40", "100"]),
    atom("7", ["-0.31", "0.21"], ["-80", "-60"]),
];

const fn positive(name: &'static str, default: &'static str, meaning: &'static str) -> Parameter {
    Parameter { name, default, meaning, range: "it must be positive", allowed: |value| value.is_positive() }
}

pub(super) const PROBLEM: Problem = Problem {
    name: "argon-crystal",
    title: "Seven argon atoms in the plane (nanometres, nanoseconds, kilograms; energies in joules)",
    hamiltonian: "sum_i |p_i|^2/(2 m) + sum_(i<j) 4 epsilon ((sigma/r_ij)^12 - (sigma/r_ij)^6)",
    parameters: &[
        positive("k_b", "1.380658e-23", "Boltzmann's constant in joules per kelvin"),
        positive("m", "66.34e-27", "mass of an atom in kilograms"),
        positive("epsilon", "119.8 * k_b", "depth of the potential in joules"),
        positive("sigma", "0.341", "distance of its zero in nanometres"),
    ],
    initial: || Initial::of_bodies(&BODIES),
    step: "4e-5",
    until: "0.2",
    source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, table I.4.1: H(0) = -1260.2 k_b, 0.2 ns",
};
