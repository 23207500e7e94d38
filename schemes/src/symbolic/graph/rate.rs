//! The rate qᵀU_q − 2U, which a kick adds to β, in its simplest form.

use num_bigint::BigInt;
use num_traits::One;

use crate::symbolic::graph::{Derivation, Graph, Node};
use crate::symbolic::number::rational::Rational;

impl Graph {
    /// qᵀU_q − 2U over all coordinates q.
    ///
    /// A homogeneous term of degree k contributes (k − 2) times itself, a quadratic term nothing. The same rule is used
    /// inside other terms: qᵀ∂/∂q of exp(−x² − y²) is exp(−x² − y²) times 2(−x² − y²).
    pub fn rate(&mut self, potential: Node) -> Node {
        let minus_two = Rational::from_integer(BigInt::from(-2));
        let radial = self.derived(potential, Derivation::Radial);
        self.sum(&[(radial, Rational::one()), (potential, minus_two)])
    }
}
