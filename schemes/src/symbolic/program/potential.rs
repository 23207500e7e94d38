//! The programs of a potential, from its formula.

use num_traits::One;

use crate::symbolic::graph::{Derivation, Graph, Node};
use crate::symbolic::number::rational::Rational;
use crate::symbolic::program::Program;
use crate::symbolic::separation::{Separation, Summand};

/// The programs of a potential U(q).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PotentialPrograms {
    /// One output: U.
    pub energy: Program,
    /// An output per coordinate: U_q. The operations are the same as in `gradient_and_rate`, so that a trajectory has
    /// the same bits whether qᵀU_q − 2U is computed or not; the constants are the same.
    pub gradient: Program,
    /// U_q, and as the last output qᵀU_q − 2U; of a pair its summand.
    pub gradient_and_rate: Program,
    /// What the last output of a pair is.
    pub summand: Summand,
}

impl Graph {
    /// The programs of the potential `energy` of this many coordinates.
    pub fn potential(&mut self, energy: Node, coordinates: usize) -> PotentialPrograms {
        let mut outputs: Vec<Node> = (0..coordinates).map(|i| self.derivative(energy, i)).collect();
        outputs.push(self.rate(energy));
        let gradient_and_rate = self.program(&outputs);
        PotentialPrograms::new(self.program(&[energy]), gradient_and_rate, Summand::Rate)
    }

    /// The program of a value, without derivatives.
    pub fn value(&self, value: Node) -> PotentialPrograms {
        PotentialPrograms::new(self.program(&[value]), Program::default(), Summand::Rate)
    }
}

/// A pair's energy is computed in place of its rate if that saves at least this number of operations a pair. qᵀU_q
/// takes two operations a pair for seven bodies in space, less for more bodies, and more for fewer.
const WORTH_AN_ENERGY: u64 = 2;

impl Graph {
    /// The programs of a pair's energy u, a formula of [`Graph::build_pair`], with in place of the gradient its slope
    /// s, by which ∂u/∂q_j = s (q_j − q_i) for u(r²), ∂u/∂q_j = s for u(d); the rate is Σ qᵀu_q − 2u over both bodies.
    ///
    /// So s = 2u'(r²) with the rate 2r²u'(r²) − 2u, or s = u'(d) with the rate d u'(d) − 2u. The last output is u in
    /// place of the rate, where that saves operations and s is computed by the same ones.
    pub fn pair(&mut self, energy: Node, separation: Separation) -> PotentialPrograms {
        let degree = Rational::from_integer(separation.degree().into());
        let derivative = self.derivative(energy, 0);
        let slope = self.scaled(derivative, &degree);
        let radial = self.derived(energy, Derivation::Radial);
        let rate = self.sum(&[(radial, degree), (energy, -(Rational::one() + Rational::one()))]);
        let with_rate = self.program(&[slope, rate]);
        let with_energy = self.program(&[slope, energy]);
        let energy = self.program(&[energy]);
        let saves = with_energy.cost().weight() + WORTH_AN_ENERGY <= with_rate.cost().weight();
        if saves && with_energy.without_last_output() == with_rate.without_last_output() {
            PotentialPrograms::new(energy, with_energy, Summand::Energy)
        } else {
            PotentialPrograms::new(energy, with_rate, Summand::Rate)
        }
    }
}

impl Graph {
    /// The programs of the potential's derivative vᵀU_q in the direction of v, whose components are the properties 0,
    /// 1, …, for a graph without others.
    ///
    /// - `energy` computes nothing;
    /// - `gradient` has the Hessian–vector product U_qq v: one derivative of U_q, so that its cost grows like the cost
    ///   of U_q;
    /// - `gradient_and_rate` has after it vᵀ∂(qᵀU_q − 2U)/∂q = qᵀU_qq v − vᵀU_q, derived from the simplified rate.
    pub fn hessian_product(&mut self, energy: Node, coordinates: usize) -> PotentialPrograms {
        let directional = |graph: &mut Graph, node| graph.derived(node, Derivation::Directional);
        let gradient: Vec<Node> = (0..coordinates).map(|i| self.derivative(energy, i)).collect();
        let mut outputs: Vec<Node> = gradient.into_iter().map(|of_axis| directional(self, of_axis)).collect();
        let rate = self.rate(energy);
        outputs.push(directional(self, rate));
        self.second_derivatives(&outputs)
    }

    /// The programs of a pair's second derivatives, in place of the programs of [`Graph::hessian_product`].
    ///
    /// `gradient` has the slope s of [`Graph::pair`] and a curvature t, `gradient_and_rate` after them a slope r of the
    /// rate. For u(r²), with the differences d of the positions and w = v_j − v_i of a vector v, the pair adds s w + t
    /// (dᵀw) d to the product U_qq v of the body j, and r dᵀw to vᵀ∂(qᵀU_q − 2U)/∂q: t = 4u″(r²), r = 2∂(2r²u′ −
    /// 2u)/∂(r²). For u(d) it adds t w and r w: t = u″(d), r = ∂(d u′ − 2u)/∂d.
    pub fn pair_curvature(&mut self, energy: Node, separation: Separation) -> PotentialPrograms {
        let degree = Rational::from_integer(separation.degree().into());
        let derivative = self.derivative(energy, 0);
        let slope = self.scaled(derivative, &degree);
        let second = self.derivative(slope, 0);
        let curvature = self.scaled(second, &degree);
        let radial = self.derived(energy, Derivation::Radial);
        let rate = self.sum(&[(radial, degree.clone()), (energy, -(Rational::one() + Rational::one()))]);
        let of_rate = self.derivative(rate, 0);
        let of_rate = self.scaled(of_rate, &degree);
        self.second_derivatives(&[slope, curvature, of_rate])
    }

    /// Programs whose last output belongs to the rate.
    fn second_derivatives(&mut self, outputs: &[Node]) -> PotentialPrograms {
        PotentialPrograms::new(Program::default(), self.program(outputs), Summand::Rate)
    }
}

impl PotentialPrograms {
    fn new(energy: Program, gradient_and_rate: Program, summand: Summand) -> Self {
        let gradient = gradient_and_rate.without_last_output();
        PotentialPrograms { energy, gradient, gradient_and_rate, summand }
    }

    /// The number of kept constants: first the constants of the energy, then the gradient's.
    pub fn kept(&self) -> usize {
        self.energy.kept + self.gradient_and_rate.kept
    }

    /// The largest number of scratch places of the programs.
    pub fn scratch(&self) -> usize {
        [&self.energy, &self.gradient, &self.gradient_and_rate]
            .map(|program| program.scratch)
            .into_iter()
            .max()
            .unwrap_or(0)
    }
}
