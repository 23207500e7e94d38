//! The mathematical pendulum.

use crate::number::Number;
use crate::potential::Potential;
use crate::problems::Problem;

/// U = −cos q.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pendulum;

impl<N: Number> Potential<N> for Pendulum {
    fn dimension(&self) -> usize {
        1
    }

    fn energy(&self, q: &[N], energy: &mut N, _: &mut [N]) {
        energy.assign_cos(&q[0]);
        energy.negate();
    }

    #[inline]
    fn gradient(&self, q: &[N], gradient: &mut [N], _: &mut [N]) {
        gradient[0].assign_sin(&q[0]);
    }

    /// q sin q + 2 cos q
    #[inline]
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, _: &mut [N]) {
        N::assign_sin_cos(&mut gradient[0], rate, &q[0]);
        rate.multiply_integer(2);
        rate.add_product(&q[0], &gradient[0]);
    }
}

pub(super) const PROBLEM: Problem = Problem {
    name: "pendulum",
    title: "Pendulum",
    hamiltonian: "p^2/2 - cos(q)",
    parameters: &[],
    positions: &[("q", "0")],
    momenta: &[("p", "1")],
    source: "Moan & Niesen, section 5.1: p(0) = 1, t in [0, 100]; p = 2 is the separatrix",
};
