//! Kepler's problem in the plane.

use num_traits::{One, Signed};

use crate::Rational;
use crate::number::Number;
use crate::potential::Potential;
use crate::problems::{Parameter, Problem};

/// U = −1/|q|, q in the plane. Homogeneous of degree −1: qᵀU_q − 2U = −3U = 3/|q|.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kepler;

impl Kepler {
    /// inverse ← 1/|q|
    #[inline]
    fn inverse_radius<N: Number>(q: &[N], inverse: &mut N, square: &mut N) {
        square.assign_square(&q[0]);
        square.add_product(&q[1], &q[1]);
        inverse.assign_reciprocal_sqrt(square);
    }

    /// gradient ← q/|q|³
    #[inline]
    fn pull<N: Number>(q: &[N], gradient: &mut [N], inverse: &N, cube: &mut N) {
        cube.assign_square(inverse);
        cube.multiply(inverse);
        for (gradient, q) in gradient.iter_mut().zip(q) {
            gradient.assign_product(cube, q);
        }
    }
}

impl<N: Number> Potential<N> for Kepler {
    fn dimension(&self) -> usize {
        2
    }

    fn scratch(&self) -> usize {
        2
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        Self::inverse_radius(q, energy, &mut scratch[0]);
        energy.negate();
    }

    #[inline]
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let [inverse, other, ..] = scratch else { unreachable!("two numbers of scratch space") };
        Self::inverse_radius(q, inverse, other);
        Self::pull(q, gradient, inverse, other);
    }

    #[inline]
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        Self::inverse_radius(q, rate, &mut scratch[0]);
        Self::pull(q, gradient, rate, &mut scratch[0]);
        rate.multiply_integer(3);
    }
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
    positions: &[("x", "1 - eccentricity"), ("y", "0")],
    momenta: &[("px", "0"), ("py", "sqrt((1 + eccentricity)/(1 - eccentricity))")],
    source: "Moan & Niesen, section 5.2: e = 0.6, t in [0, 100]; H = -1/2, period 2 pi",
};
