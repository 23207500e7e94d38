//! The Sun and the outer planets.

use super::definition::{Definition, Description, Parameter};
use super::gravity::gravity;
use super::initial::{Body, Initial};
use crate::number::Number;
use crate::systems::potential::Potential;

/// The parameters that are masses, in the order of the bodies.
const MASSES: [&str; 6] = ["m_sun", "m_jupiter", "m_saturn", "m_uranus", "m_neptune", "m_pluto"];

const fn mass(name: &'static str, default: &'static str) -> Parameter {
    Parameter::positive(name, default, "mass in solar masses")
}

const fn body(
    name: &'static str,
    mass: &'static str,
    position: [&'static str; 3],
    velocity: [&'static str; 3],
) -> Body<3> {
    Body { name, mass, position, velocity }
}

const BODIES: [Body<3>; 6] = [
    body("sun", "m_sun", ["0", "0", "0"], ["0", "0", "0"]),
    body(
        "jupiter",
        "m_jupiter",
        ["-3.5023653", "-3.8169847", "-1.5507963"],
        ["0.00565429", "-0.00412490", "-0.00190589"],
    ),
    body("saturn", "m_saturn", ["9.0755314", "-3.0458353", "-1.6483708"], ["0.00168318", "0.00483525", "0.00192462"]),
    body("uranus", "m_uranus", ["8.3101420", "-16.2901086", "-7.2521278"], ["0.00354178", "0.00137102", "0.00055029"]),
    body(
        "neptune",
        "m_neptune",
        ["11.4707666", "-25.7294829", "-10.8169456"],
        ["0.00288930", "0.00114527", "0.00039677"],
    ),
    body(
        "pluto",
        "m_pluto",
        ["-15.5387357", "-25.2225594", "-3.1902382"],
        ["0.00276725", "-0.00170702", "-0.00136504"],
    ),
];

/// The entry of the registry.
pub(super) struct Entry;

impl Definition for Entry {
    const DESCRIPTION: Description = Description {
        name: "outer-solar-system",
        title: "The Sun and the outer planets (astronomical units, days, solar masses)",
        hamiltonian: "sum_i |p_i|^2/(2 m_i) - g sum_(i<j) m_i m_j/|q_i - q_j|",
        parameters: &[
            Parameter::positive("g", "2.95912208286e-4", "gravitational constant"),
            // the Sun's mass includes the inner planets
            mass("m_sun", "1.00000597682"),
            mass("m_jupiter", "0.000954786104043"),
            mass("m_saturn", "0.000285583733151"),
            mass("m_uranus", "0.0000437273164546"),
            mass("m_neptune", "0.0000517759138449"),
            mass("m_pluto", "1/1.3e8"),
        ],
        initial: || Initial::of_bodies(&BODIES),
        step: "100",
        until: "200000",
        source: "Hairer, Lubich & Wanner, Geometric Numerical Integration, table I.2.2: steps of 100 to 200 days over \
            200000 days",
    };

    const GRAVITY: Option<usize> = Some(3);

    fn potential<N: Number + 'static>(number: &dyn Fn(&str) -> N) -> Box<dyn Potential<N>> {
        gravity::<N, 3>(number, &MASSES)
    }
}
