//! Formulas with some of their parts replaced.

use std::collections::HashMap;

use num_traits::One;

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::rational::Rational;

impl Graph {
    /// Formulas in which nodes below them, such as coordinates, are replaced by others.
    pub fn replaced(&mut self, nodes: &[Node], by: HashMap<Node, Node>) -> Vec<Node> {
        let mut changed = by;
        for node in self.below(nodes) {
            if !changed.contains_key(&node) && self.children(node).any(|child| changed.contains_key(&child)) {
                let replaced = self.with_children(node, &changed);
                changed.insert(node, replaced);
            }
        }
        nodes.iter().map(|node| *changed.get(node).unwrap_or(node)).collect()
    }

    /// The form of a node with other children.
    fn with_children(&mut self, node: Node, changed: &HashMap<Node, Node>) -> Node {
        let replace = |part: Node| *changed.get(&part).unwrap_or(&part);
        let parts =
            |parts: &[(Node, Rational)]| parts.iter().map(|(part, x)| (replace(*part), x.clone())).collect::<Vec<_>>();
        match &*self.shared_form(node) {
            Form::Number(_) | Form::Coordinate(_) | Form::Parameter(_) | Form::Property(_) => node,
            Form::Sum { constant, terms } => {
                let mut terms = parts(terms);
                terms.push((self.number(constant.clone()), Rational::one()));
                self.sum(&terms)
            }
            Form::Product(factors) => self.product(&parts(factors)),
            Form::Call(function, argument) => self.call(*function, replace(*argument)),
        }
    }
}
