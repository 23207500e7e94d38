//! From a syntax tree to the graph; faults have their places in the text.

use std::ops::Range;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::function::Function;
use crate::symbolic::number::power::{MOST_BITS, exact_power};
use crate::symbolic::number::rational::Rational;
use crate::symbolic::text::error::{HIGHEST_ROOT, LARGEST_POWER, MOST_FACTORS, SemanticError, SemanticFault};
use crate::symbolic::text::names::{Callee, NOT_SMOOTH, PI, callee, unknown_name};
use crate::symbolic::text::syntax::{Expression, ExpressionKind, Operation};

impl Graph {
    /// The formula of an expression whose names are coordinates and parameters, known by their index.
    ///
    /// The functions are sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin and acos; `pi` is π, unless
    /// a coordinate or parameter has that name; exponents are rational numbers.
    ///
    /// # Errors
    /// A [`SemanticError`] at the first unknown name, unknown or not smooth function, wrong number of arguments,
    /// exponent that is not rational or too large, and constant part that has no real value or too many digits.
    pub fn build(
        &mut self,
        expression: &Expression,
        coordinates: &[String],
        parameters: &[String],
    ) -> Result<Node, SemanticError> {
        Builder { graph: self, coordinates, parameters, properties: &[] }.node(expression)
    }

    /// The formula of an expression about a pair of bodies at some separation, the only coordinate, with properties of
    /// the bodies, such as `m_i` and `m_j`.
    ///
    /// # Errors
    /// As [`Graph::build`].
    pub fn build_pair(
        &mut self,
        expression: &Expression,
        separation: &str,
        properties: &[String],
        parameters: &[String],
    ) -> Result<Node, SemanticError> {
        Builder { graph: self, coordinates: &[separation.to_owned()], parameters, properties }.node(expression)
    }
}

struct Builder<'a> {
    graph: &'a mut Graph,
    coordinates: &'a [String],
    parameters: &'a [String],
    properties: &'a [String],
}

impl Builder<'_> {
    fn node(&mut self, expression: &Expression) -> Result<Node, SemanticError> {
        let range = &expression.range;
        match &expression.kind {
            ExpressionKind::Number(value) => Ok(self.graph.number(value.clone())),
            ExpressionKind::Name(name) => self.named(name).map_err(|unknown| SemanticError::new(unknown, range)),
            ExpressionKind::Binary(Operation::Power, base, exponent) => self.power(base, exponent, range),
            ExpressionKind::Binary(Operation::Multiply | Operation::Divide, ..) => self.product(expression),
            ExpressionKind::Negate(_) | ExpressionKind::Binary(..) => self.sum(expression),
            ExpressionKind::Call { function, arguments } => self.call(function, arguments, range),
        }
    }

    fn named(&mut self, name: &str) -> Result<Node, SemanticFault> {
        let position = |names: &[String]| names.iter().position(|known| known == name);
        if let Some(index) = position(self.coordinates) {
            return Ok(self.graph.coordinate(index));
        }
        if let Some(index) = position(self.parameters) {
            return Ok(self.graph.parameter(index));
        }
        if let Some(index) = position(self.properties) {
            return Ok(self.graph.property(index));
        }
        if name == PI {
            return Ok(self.graph.pi());
        }
        let known: Vec<&str> =
            [self.coordinates, self.properties, self.parameters].into_iter().flatten().map(String::as_str).collect();
        let of_bodies = [format!("{name}_i"), format!("{name}_j")];
        if of_bodies.iter().any(|of_body| self.properties.contains(of_body)) {
            let hint = format!("of the bodies i and j it is `{}` and `{}`", of_bodies[0], of_bodies[1]);
            return Err(SemanticFault::UnknownName { name: name.to_string(), hint });
        }
        Err(unknown_name(name, &known))
    }

    /// All terms of a chain of additions at once: the time is proportional to their number.
    fn sum(&mut self, expression: &Expression) -> Result<Node, SemanticError> {
        let mut terms = Vec::new();
        self.terms(expression, &Rational::one(), &mut terms)?;
        self.check_size(&terms, &expression.range)?;
        Ok(self.graph.sum(&terms))
    }

    fn terms(
        &mut self,
        expression: &Expression,
        sign: &Rational,
        terms: &mut Vec<(Node, Rational)>,
    ) -> Result<(), SemanticError> {
        match &expression.kind {
            ExpressionKind::Negate(inner) => self.terms(inner, &-sign, terms),
            ExpressionKind::Binary(operation @ (Operation::Add | Operation::Subtract), left, right) => {
                self.terms(left, sign, terms)?;
                let sign = if *operation == Operation::Subtract { -sign } else { sign.clone() };
                self.terms(right, &sign, terms)
            }
            _ => {
                terms.push((self.node(expression)?, sign.clone()));
                Ok(())
            }
        }
    }

    /// All factors of a chain of multiplications and divisions at once.
    fn product(&mut self, expression: &Expression) -> Result<Node, SemanticError> {
        let mut factors = Vec::new();
        self.factors(expression, &Rational::one(), &mut factors)?;
        self.check_size(&factors, &expression.range)?;
        let node = self.graph.product(&factors);
        self.checked_product(node, &expression.range)
    }

    fn factors(
        &mut self,
        expression: &Expression,
        exponent: &Rational,
        factors: &mut Vec<(Node, Rational)>,
    ) -> Result<(), SemanticError> {
        if let ExpressionKind::Binary(operation @ (Operation::Multiply | Operation::Divide), left, right) =
            &expression.kind
        {
            self.factors(left, exponent, factors)?;
            let exponent = if *operation == Operation::Divide { -exponent } else { exponent.clone() };
            return self.factors(right, &exponent, factors);
        }
        let node = self.node(expression)?;
        if exponent.is_negative() && self.graph.as_number(node).is_some_and(Zero::is_zero) {
            return Err(SemanticError::new(SemanticFault::DivisionByZero, &expression.range));
        }
        factors.push((node, exponent.clone()));
        Ok(())
    }

    fn power(&mut self, base: &Expression, exponent: &Expression, range: &Range<usize>) -> Result<Node, SemanticError> {
        let node = self.node(exponent)?;
        let value = self.graph.as_number(node).cloned();
        let value = value.ok_or_else(|| SemanticError::new(SemanticFault::VariableExponent, &exponent.range))?;
        if too_large(&value) {
            return Err(SemanticError::new(SemanticFault::LargeExponent(value.to_string()), &exponent.range));
        }
        self.power_of(base, &value, range)
    }

    fn power_of(
        &mut self,
        base: &Expression,
        exponent: &Rational,
        range: &Range<usize>,
    ) -> Result<Node, SemanticError> {
        let node = self.node(base)?;
        if let Some(number) = self.graph.as_number(node) {
            let problem = match exponent {
                _ if number.is_zero() && exponent.is_negative() => Some(SemanticFault::DivisionByZero),
                _ if number.is_zero() && exponent.is_zero() => Some(SemanticFault::ZeroToTheZero),
                _ if number.is_negative() && exponent.denom().is_even() => {
                    Some(SemanticFault::EvenRoot(number.to_string()))
                }
                _ => None,
            };
            if let Some(problem) = problem {
                return Err(SemanticError::new(problem, &base.range));
            }
            // The power with the integer part of the exponent is computed, even if the rest is irrational.
            if exact_power(number, &exponent.floor()).is_none() {
                return Err(SemanticError::new(SemanticFault::TooLong, range));
            }
        }
        let node = self.graph.power(node, exponent);
        self.checked_product(node, range)
    }

    fn call(&mut self, name: &str, arguments: &[Expression], range: &Range<usize>) -> Result<Node, SemanticError> {
        if NOT_SMOOTH.contains(&name) {
            return Err(SemanticError::new(SemanticFault::NotSmooth(name.to_string()), range));
        }
        let (function, argument) = match callee(name, arguments).map_err(|fault| SemanticError::new(fault, range))? {
            (Callee::Root(order), argument) => {
                return self.power_of(argument, &Rational::new(BigInt::one(), order.into()), range);
            }
            (Callee::Function(function), argument) => (function, argument),
        };
        let node = self.node(argument)?;
        if let Some(value) = self.graph.as_number(node).filter(|value| outside(function, value)) {
            let argument = value.to_string();
            return Err(SemanticError::new(SemanticFault::OutsideDomain { function, argument }, range));
        }
        Ok(self.graph.call(function, node))
    }

    /// Rejects long numbers before they are multiplied or brought to a common denominator.
    fn check_size(&self, parts: &[(Node, Rational)], range: &Range<usize>) -> Result<(), SemanticError> {
        let bits = |value: &Rational| value.numer().bits() + value.denom().bits();
        let size = |node| match self.graph.form(node) {
            Form::Number(value) => bits(value),
            Form::Sum { constant, terms } => bits(constant) + terms.iter().map(|(_, value)| bits(value)).sum::<u64>(),
            _ => 0,
        };
        let total: u64 = parts.iter().map(|(node, _)| size(*node)).sum();
        if total <= MOST_BITS { Ok(()) } else { Err(SemanticError::new(SemanticFault::TooLong, range)) }
    }

    /// Rejects products that are too long, and exponents that became too large.
    fn checked_product(&self, node: Node, range: &Range<usize>) -> Result<Node, SemanticError> {
        let product = match self.graph.form(node) {
            Form::Sum { terms, .. } if terms.len() == 1 => terms[0].0,
            _ => node,
        };
        if let Form::Product(factors) = self.graph.form(product) {
            if factors.len() > MOST_FACTORS {
                return Err(SemanticError::new(SemanticFault::LongProduct(factors.len()), range));
            }
            if let Some((_, exponent)) = factors.iter().find(|(_, exponent)| too_large(exponent)) {
                return Err(SemanticError::new(SemanticFault::LargeExponent(exponent.to_string()), range));
            }
        }
        Ok(node)
    }
}

fn too_large(exponent: &Rational) -> bool {
    *exponent.numer().magnitude() > LARGEST_POWER.into() || *exponent.denom() > HIGHEST_ROOT.into()
}

/// Whether the function has no real value at the number.
fn outside(function: Function, value: &Rational) -> bool {
    match function {
        Function::Log => !value.is_positive(),
        Function::Asin | Function::Acos => value.numer().magnitude() > value.denom().magnitude(),
        _ => false,
    }
}
