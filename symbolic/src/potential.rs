//! A potential's formula → the programs that compute it.

use crate::graph::{Graph, Node};
use crate::program::Program;

/// The programs of a potential U(q).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PotentialPrograms {
    /// One output: U.
    pub energy: Program,
    /// An output per coordinate: U_q. The same operations as in `gradient_and_rate`, so that a trajectory has the same
    /// bits whether qᵀU_q − 2U is computed or not; it keeps the same constants.
    pub gradient: Program,
    /// U_q, and as the last output qᵀU_q − 2U.
    pub gradient_and_rate: Program,
}

impl Graph {
    /// The programs of the potential `energy` of so many coordinates.
    pub fn potential(&mut self, energy: Node, coordinates: usize) -> PotentialPrograms {
        let mut outputs: Vec<Node> = (0..coordinates).map(|i| self.derivative(energy, i)).collect();
        outputs.push(self.rate(energy));
        let gradient_and_rate = self.program(&outputs);
        let gradient = gradient_and_rate.without_last_output();
        PotentialPrograms { energy: self.program(&[energy]), gradient, gradient_and_rate }
    }
}

impl PotentialPrograms {
    /// How many constants there are to keep: those of the energy, then those of the gradient.
    pub fn kept(&self) -> usize {
        self.energy.kept + self.gradient_and_rate.kept
    }

    /// How many scratch places the programs use at most.
    pub fn scratch(&self) -> usize {
        [&self.energy, &self.gradient, &self.gradient_and_rate]
            .map(|program| program.scratch)
            .into_iter()
            .max()
            .unwrap_or(0)
    }
}
