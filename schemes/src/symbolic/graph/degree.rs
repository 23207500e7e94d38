//! Homogeneity: the degree k with f(λq) = λᵏ f(q).

use std::collections::HashMap;

use num_traits::{One, Zero};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::rational::Rational;

impl Graph {
    /// The k with f(λq) = λᵏ f(q) for all λ > 0, if the form of the node shows it; 0 for the number 0.
    pub fn degree(&self, node: Node) -> Option<Rational> {
        self.degrees(node).remove(&node).flatten()
    }

    /// The degrees of the node and all below it.
    pub(crate) fn degrees(&self, node: Node) -> HashMap<Node, Option<Rational>> {
        let mut degrees = HashMap::new();
        for part in self.below(&[node]) {
            let degree = self.degree_by_rule(part, &degrees);
            degrees.insert(part, degree);
        }
        degrees
    }

    /// The degree of a node from the degrees of its parts.
    fn degree_by_rule(&self, node: Node, known: &HashMap<Node, Option<Rational>>) -> Option<Rational> {
        match self.form(node) {
            Form::Number(_) | Form::Parameter(_) | Form::Property(_) => Some(Rational::zero()),
            Form::Coordinate(_) => Some(Rational::one()),
            Form::Sum { constant, terms } => {
                let degree = known[&terms[0].0].clone()?;
                let all = terms.iter().all(|(part, _)| known[part].as_ref() == Some(&degree));
                (all && (constant.is_zero() || degree.is_zero())).then_some(degree)
            }
            Form::Product(factors) => factors
                .iter()
                .try_fold(Rational::zero(), |total, (base, exponent)| Some(total + known[base].as_ref()? * exponent)),
            Form::Call(_, argument) => known[argument].clone().filter(Zero::is_zero),
        }
    }
}
