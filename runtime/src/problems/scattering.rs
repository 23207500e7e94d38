//! Scattering at a Gaussian hill.

use num_traits::Signed;

use crate::number::Number;
use crate::potential::Potential;
use crate::problems::{Parameter, Problem};

/// U = exp(−|q|²) in the plane; qᵀU_q − 2U = −2 (|q|² + 1) U.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scattering;

impl Scattering {
    /// hill ← exp(−|q|²), square ← |q|²
    #[inline]
    fn hill<N: Number>(q: &[N], hill: &mut N, square: &mut N) {
        square.assign_square(&q[0]);
        square.add_product(&q[1], &q[1]);
        square.negate();
        hill.assign_exp(square);
        square.negate();
    }

    /// gradient ← −2 U q; twice ← −2 U
    #[inline]
    fn push<N: Number>(q: &[N], gradient: &mut [N], twice: &mut N) {
        twice.multiply_integer(-2);
        for (gradient, q) in gradient.iter_mut().zip(q) {
            gradient.assign_product(twice, q);
        }
    }
}

impl<N: Number> Potential<N> for Scattering {
    fn dimension(&self) -> usize {
        2
    }

    fn scratch(&self) -> usize {
        2
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        Self::hill(q, energy, &mut scratch[0]);
    }

    #[inline]
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let [hill, square, ..] = scratch else { unreachable!("two numbers of scratch space") };
        Self::hill(q, hill, square);
        Self::push(q, gradient, hill);
    }

    #[inline]
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        let [square, product, ..] = scratch else { unreachable!("two numbers of scratch space") };
        Self::hill(q, rate, square);
        Self::push(q, gradient, rate);
        product.assign_product(rate, square);
        rate.add(product);
    }
}

pub(super) const PROBLEM: Problem = Problem {
    name: "scattering",
    title: "Scattering at a Gaussian hill",
    hamiltonian: "(px^2 + py^2)/2 + exp(-x^2 - y^2)",
    parameters: &[
        Parameter {
            name: "start",
            default: "17",
            meaning: "distance of the start before the hill: there U is below 1e-125",
            range: "it must be positive",
            allowed: |start| start.is_positive(),
        },
        Parameter {
            name: "impact",
            default: "0.3",
            meaning: "impact parameter",
            range: "any number is allowed",
            allowed: |_| true,
        },
        Parameter {
            name: "speed",
            default: "2",
            meaning: "speed far from the hill",
            range: "it must be positive",
            allowed: |speed| speed.is_positive(),
        },
    ],
    positions: &[("x", "-start"), ("y", "impact")],
    momenta: &[("px", "speed"), ("py", "0")],
    source: "after Benettin & Giorgilli, J. Stat. Phys. 74 (1994) 569, quoted in Moan & Niesen, section 5",
};
