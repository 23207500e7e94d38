//! Derivatives by rule.

use num_bigint::BigInt;
use num_traits::{One, Zero};

use crate::symbolic::graph::{Derivation, Form, Graph, Node};
use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;

impl Graph {
    /// ∂(node)/∂q_i for the coordinate q_i with index i.
    ///
    /// A derivative that is not defined anywhere, such as the derivative of asin(√(x²)/x), becomes a formula without a
    /// value, such as 0^(−1/2).
    pub fn derivative(&mut self, node: Node, coordinate: usize) -> Node {
        self.derived(node, Derivation::Along(coordinate))
    }

    /// D(node), and D of all nodes below it, each once.
    pub(crate) fn derived(&mut self, node: Node, derivation: Derivation) -> Node {
        let unknown = self.below_unless(&[node], |part| self.derivatives.contains_key(&(part, derivation)));
        let degrees = match derivation {
            Derivation::Along(_) | Derivation::Directional => Default::default(),
            Derivation::Radial => self.degrees(node),
        };
        for part in unknown {
            let derivative = match degrees.get(&part) {
                Some(Some(degree)) => self.scaled(part, degree),
                _ => self.by_rule(part, derivation),
            };
            self.derivatives.insert((part, derivation), derivative);
        }
        self.derivatives[&(node, derivation)]
    }

    /// D(node), from D of its parts.
    fn by_rule(&mut self, node: Node, derivation: Derivation) -> Node {
        match &*self.shared_form(node) {
            Form::Number(_) | Form::Parameter(_) | Form::Property(_) => self.number(Rational::zero()),
            Form::Coordinate(index) => match derivation {
                Derivation::Along(other) if *index == other => self.number(Rational::one()),
                Derivation::Along(_) => self.number(Rational::zero()),
                Derivation::Radial => node,
                Derivation::Directional => self.property(*index),
            },
            Form::Sum { terms, .. } => {
                let known = &self.derivatives;
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(part, coefficient)| (known[&(*part, derivation)], coefficient.clone()))
                    .collect();
                self.sum(&terms)
            }
            Form::Product(factors) => self.product_rule(factors, derivation),
            Form::Call(function, argument) => {
                let inner = self.derivatives[&(*argument, derivation)];
                if self.is_zero(inner) {
                    return inner;
                }
                let (outer, sign) = self.outer_derivative(*function, node, *argument);
                let product = self.times(outer, inner);
                self.scaled(product, &Rational::from_integer(sign.into()))
            }
        }
    }

    /// D(Π b^n) = Σ n b^(n−1) D(b) · (the other factors). There is no division by b, which may be zero.
    fn product_rule(&mut self, factors: &[(Node, Rational)], derivation: Derivation) -> Node {
        let mut terms = Vec::new();
        for (index, (base, exponent)) in factors.iter().enumerate() {
            let inner = self.derivatives[&(*base, derivation)];
            if self.is_zero(inner) {
                continue;
            }
            let mut term = factors.to_vec();
            term[index].1 -= BigInt::one();
            term.push((inner, Rational::one()));
            terms.push((self.product(&term), exponent.clone()));
        }
        self.sum(&terms)
    }

    /// f'(x) up to a sign, and the sign; `call` is f(x).
    fn outer_derivative(&mut self, function: Function, call: Node, x: Node) -> (Node, i32) {
        match function {
            Function::Exp => (call, 1),
            Function::Log => (self.power(x, &ratio(-1, 1)), 1),
            Function::Sin => (self.call(Function::Cos, x), 1),
            Function::Cos => (self.call(Function::Sin, x), -1),
            Function::Tan => (self.one_plus_square(call, 1), 1),
            Function::Sinh => (self.call(Function::Cosh, x), 1),
            Function::Cosh => (self.call(Function::Sinh, x), 1),
            Function::Tanh => (self.one_plus_square(call, -1), 1),
            Function::Atan => (self.power_of_one_plus_square(x, 1, &ratio(-1, 1)), 1),
            Function::Asin => (self.power_of_one_plus_square(x, -1, &ratio(-1, 2)), 1),
            Function::Acos => (self.power_of_one_plus_square(x, -1, &ratio(-1, 2)), -1),
        }
    }

    /// 1 ± x²
    fn one_plus_square(&mut self, x: Node, sign: i32) -> Node {
        let one = self.number(Rational::one());
        let square = self.power(x, &ratio(2, 1));
        self.sum(&[(one, ratio(1, 1)), (square, ratio(sign, 1))])
    }

    /// (1 ± x²)^exponent
    fn power_of_one_plus_square(&mut self, x: Node, sign: i32, exponent: &Rational) -> Node {
        let base = self.one_plus_square(x, sign);
        self.power(base, exponent)
    }
}

fn ratio(numerator: i32, denominator: i32) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}
