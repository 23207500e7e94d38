//! Passages of the centre in double-double, rounded: on long steps to the pericentre and past it the terms of t or r
//! are larger than their sum, and `f64` would lose digits that the orbit does not.

use super::equation::Equation;
use crate::number::{DoubleDouble, Number};

/// A drift of one lane.
#[derive(Clone, Debug)]
pub(super) struct Passage {
    equation: Equation<DoubleDouble>,
    gauss: [DoubleDouble; 4],
    q: Vec<DoubleDouble>,
    v: Vec<DoubleDouble>,
}

impl Passage {
    pub(super) fn new() -> Self {
        Passage {
            equation: Equation::new(&()),
            gauss: [DoubleDouble::default(); 4],
            q: Vec::with_capacity(3),
            v: Vec::with_capacity(3),
        }
    }

    /// Solves Kepler's equation from a state; s is returned.
    pub(super) fn solve(&mut self, mu: f64, t: f64, state: impl Iterator<Item = [f64; 2]>) -> f64 {
        self.q.clear();
        self.v.clear();
        for [q, v] in state {
            self.q.push(q.into());
            self.v.push(v.into());
        }
        self.solve_from_state(mu, t)
    }

    /// Compiled once, not for each number type whose lanes are states.
    #[inline(never)]
    fn solve_from_state(&mut self, mu: f64, t: f64) -> f64 {
        let coordinates = self.q.iter().zip(&self.v).map(|(q, v)| [q, v]);
        self.equation.solve(&mu.into(), &t.into(), coordinates);
        self.equation.assign_gauss(self.gauss.each_mut());
        self.equation.anomaly().parts().0
    }

    /// The increments of a coordinate of q and of v.
    pub(super) fn increments(&self, index: usize) -> [f64; 2] {
        let [f, g, f_dot, g_dot] = &self.gauss;
        [[f, g], [f_dot, g_dot]].map(|[of_q, of_v]| {
            let mut sum = DoubleDouble::default();
            sum.assign_product(of_q, &self.q[index]);
            sum.add_product(of_v, &self.v[index]);
            sum.parts().0
        })
    }
}
