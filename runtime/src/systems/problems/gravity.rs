//! Newton's gravity.

use super::definition::Parameter;
use crate::number::Number;
use crate::systems::pairs::{Gravity, Pairs};
use crate::systems::potential::Potential;

/// The names of the masses of three bodies.
pub(super) const THREE_MASSES: [&str; 3] = ["m_1", "m_2", "m_3"];

/// The parameters of three bodies: the gravitational constant, and [`THREE_MASSES`] with these defaults.
pub(super) const fn three_bodies(masses: [&'static str; 3]) -> [Parameter; 4] {
    [
        Parameter::positive("g", "1", "gravitational constant"),
        Parameter::positive(THREE_MASSES[0], masses[0], "mass of the first body"),
        Parameter::positive(THREE_MASSES[1], masses[1], "mass of the second body"),
        Parameter::positive(THREE_MASSES[2], masses[2], "mass of the third body"),
    ]
}

/// Gravity among bodies in D dimensions, with the parameter `g` and these names of the masses.
pub(super) fn gravity<N: Number + 'static, const D: usize>(
    number: &dyn Fn(&str) -> N,
    masses: &[&str],
) -> Box<dyn Potential<N>> {
    let m: Vec<N> = masses.iter().map(|name| number(name)).collect();
    Box::new(Pairs::<_, D>::all(m.len(), Gravity { g: number("g"), m }).expect("the pairs fit"))
}
