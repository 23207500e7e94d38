//! Products of sums multiplied out, and whether a formula is 0 then.

use num_traits::{One, ToPrimitive};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::rational::Rational;

/// The highest power of a sum that is multiplied out.
const HIGHEST: u32 = 16;

/// The most terms of a product of sums.
const MOST_TERMS: usize = 4000;

impl Graph {
    /// Whether the formula is 0, for all values for which it is defined. A formula that is 0 by other rules than the
    /// rules of polynomials in its parts is not found to be so.
    pub(crate) fn vanishes(&mut self, node: Node) -> bool {
        let expanded = self.multiplied_out(node);
        self.is_zero(expanded)
    }

    /// The formula with products of sums multiplied out, but those that have too many terms, and the arguments of
    /// functions.
    pub fn multiplied_out(&mut self, node: Node) -> Node {
        self.multiplied_out_within(node, usize::MAX)
    }

    /// The same, as long as the graph has at most this number of parts: then products stay as they are.
    pub fn multiplied_out_within(&mut self, node: Node, most: usize) -> Node {
        match &*self.shared_form(node) {
            Form::Sum { constant, terms } => {
                let mut expanded: Vec<_> = terms
                    .iter()
                    .map(|(part, factor)| (self.multiplied_out_within(*part, most), factor.clone()))
                    .collect();
                expanded.push((self.number(constant.clone()), Rational::one()));
                self.sum(&expanded)
            }
            Form::Product(factors) => self.product_of_sums(factors, most).unwrap_or(node),
            _ => node,
        }
    }

    /// The product of powers of sums, unless it has too many terms.
    fn product_of_sums(&mut self, factors: &[(Node, Rational)], most: usize) -> Option<Node> {
        let mut terms = vec![self.number(Rational::one())];
        for (base, exponent) in factors {
            let power = exponent.to_integer().to_u32().filter(|n| exponent.is_integer() && *n <= HIGHEST);
            let expanded = self.multiplied_out_within(*base, most);
            let (parts, count) = match (&*self.shared_form(expanded), power) {
                (Form::Sum { constant, terms }, Some(power)) => {
                    let mut parts: Vec<Node> = terms.iter().map(|(part, c)| self.scaled(*part, c)).collect();
                    parts.push(self.number(constant.clone()));
                    (parts, power)
                }
                _ => (vec![self.power(expanded, exponent)], 1),
            };
            for _ in 0..count {
                let mut product = Vec::new();
                for left in &terms {
                    if self.size() > most {
                        return None;
                    }
                    for right in &parts {
                        product.push((self.times(*left, *right), Rational::one()));
                    }
                }
                let sum = self.sum(&product);
                terms = match &*self.shared_form(sum) {
                    Form::Sum { constant, terms } => {
                        let mut parts: Vec<Node> = terms.iter().map(|(part, c)| self.scaled(*part, c)).collect();
                        parts.push(self.number(constant.clone()));
                        parts
                    }
                    _ => vec![sum],
                };
                if terms.len() > MOST_TERMS {
                    return None;
                }
            }
        }
        let terms: Vec<_> = terms.into_iter().map(|term| (term, Rational::one())).collect();
        Some(self.sum(&terms))
    }
}

#[cfg(test)]
mod tests {
    use crate::symbolic::{Graph, parse};

    #[test]
    fn polynomial_identities() {
        let names = ["x", "y"].map(String::from);
        let vanishes = |text: &str| {
            let mut graph = Graph::new();
            let node = graph.build(&parse(text).unwrap(), &names, &[]).unwrap();
            graph.vanishes(node)
        };
        for text in [
            "(x + y)^2 - x^2 - 2*x*y - y^2",
            "(x + y)*(x - y) - x^2 + y^2",
            "((x + 1)^3 - x^3 - 3*x^2 - 3*x - 1)*sin(x)",
            "x*(1 + y)*exp(x + y) - x*exp(x + y) - x*y*exp(x + y)",
        ] {
            assert!(vanishes(text), "{text}");
        }
        for text in ["x", "(x + y)^2 - x^2 - y^2", "sin(x)^2 + cos(x)^2 - 1"] {
            assert!(!vanishes(text), "{text}");
        }
    }
}
