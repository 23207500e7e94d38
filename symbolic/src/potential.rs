//! A potential's formula → the programs that compute it.

use num_traits::One;

use crate::Rational;
use crate::derivative::Derivation;
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

/// What the formula of a pair of bodies i < j is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Separation {
    /// d = q_j − q_i, on a line
    Difference,
    /// r² = |q_j − q_i|², in any dimension
    SquaredDistance,
}

impl Separation {
    /// What formulas call it: `d`, `r2`.
    pub fn name(self) -> &'static str {
        match self {
            Separation::Difference => "d",
            Separation::SquaredDistance => "r2",
        }
    }

    /// The separation of this name.
    pub fn named(name: &str) -> Option<Self> {
        [Separation::Difference, Separation::SquaredDistance].into_iter().find(|separation| separation.name() == name)
    }

    /// Its degree in the coordinates of the bodies.
    fn degree(self) -> u32 {
        match self {
            Separation::Difference => 1,
            Separation::SquaredDistance => 2,
        }
    }
}

impl Graph {
    /// The programs of a pair's energy u, a formula of [`Graph::build_pair`], with in place of the gradient its slope s,
    /// by which ∂u/∂q_j = s (q_j − q_i) for u(r²), ∂u/∂q_j = s for u(d); the rate is Σ qᵀu_q − 2u over both bodies.
    ///
    /// So s = 2u'(r²) with the rate 2r²u'(r²) − 2u, or s = u'(d) with the rate d u'(d) − 2u.
    pub fn pair(&mut self, energy: Node, separation: Separation) -> PotentialPrograms {
        let degree = Rational::from_integer(separation.degree().into());
        let derivative = self.derivative(energy, 0);
        let slope = self.scaled(derivative, &degree);
        let radial = self.derived(energy, Derivation::Radial);
        let rate = self.sum(&[(radial, degree), (energy, -(Rational::one() + Rational::one()))]);
        let gradient_and_rate = self.program(&[slope, rate]);
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
