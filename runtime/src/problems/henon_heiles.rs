//! The Hénon–Heiles problem.

use crate::number::Number;
use crate::potential::Potential;
use crate::problems::Problem;

/// U = ½(x² + y²) + x²y − y³/3. The cubic terms alone make qᵀU_q − 2U = x²y − y³/3.
#[derive(Clone, Copy, Debug, Default)]
pub struct HenonHeiles;

impl HenonHeiles {
    /// cubic ← x²y − y³/3, with x² and y² at hand
    #[inline]
    fn cubic<N: Number>(y: &N, x_squared: &N, y_squared: &N, cubic: &mut N) {
        cubic.assign(y_squared);
        cubic.divide_integer(-3);
        cubic.add(x_squared);
        cubic.multiply(y);
    }

    /// gradient ← (x + 2xy, y + x² − y²), with x² and y² at hand
    #[inline]
    fn pull<N: Number>(q: &[N], gradient: &mut [N], x_squared: &N, y_squared: &N) {
        gradient[0].assign_product(&q[0], &q[1]);
        gradient[0].multiply_integer(2);
        gradient[0].add(&q[0]);
        gradient[1].assign_difference(x_squared, y_squared);
        gradient[1].add(&q[1]);
    }
}

impl<N: Number> Potential<N> for HenonHeiles {
    fn dimension(&self) -> usize {
        2
    }

    fn scratch(&self) -> usize {
        2
    }

    fn energy(&self, q: &[N], energy: &mut N, scratch: &mut [N]) {
        let [x_squared, y_squared, ..] = scratch else { unreachable!("two numbers of scratch space") };
        x_squared.assign_square(&q[0]);
        y_squared.assign_square(&q[1]);
        Self::cubic(&q[1], x_squared, y_squared, energy);
        x_squared.add(y_squared);
        x_squared.divide_integer(2);
        energy.add(x_squared);
    }

    #[inline]
    fn gradient(&self, q: &[N], gradient: &mut [N], scratch: &mut [N]) {
        let [x_squared, y_squared, ..] = scratch else { unreachable!("two numbers of scratch space") };
        x_squared.assign_square(&q[0]);
        y_squared.assign_square(&q[1]);
        Self::pull(q, gradient, x_squared, y_squared);
    }

    #[inline]
    fn gradient_and_rate(&self, q: &[N], gradient: &mut [N], rate: &mut N, scratch: &mut [N]) {
        self.gradient(q, gradient, scratch);
        Self::cubic(&q[1], &scratch[0], &scratch[1], rate);
    }
}

pub(super) const PROBLEM: Problem = Problem {
    name: "henon-heiles",
    title: "Hénon–Heiles",
    hamiltonian: "(px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3",
    parameters: &[],
    positions: &[("x", "0"), ("y", "0")],
    momenta: &[("px", "0.1"), ("py", "0")],
    source: "Moan & Niesen, section 5.3: p_1(0) = 0.1; chaotic from H = 1/12, escape from H = 1/6",
};
