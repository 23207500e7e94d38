//! From a syntax tree to the graph, with every fault at its place in the text.

use std::ops::Range;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use crate::exact::MOST_BITS;
use crate::fault::{HIGHEST_ROOT, NO_NAMES};
use crate::function::{Function, NOT_SMOOTH, PI, ROOTS, hint_at_functions};
use crate::graph::{Form, Graph, Node};
use crate::nearest::hint;
use crate::potential::Separation;
use crate::simplify::exact_power;
use crate::{Expression, Kind, Operation, Rational};

/// The largest numerator of an exponent.
const LARGEST_POWER: u32 = 10_000;

/// The most factors of a product: its gradient has as many terms, each as long as the product.
const MOST_FACTORS: usize = 64;

/// Why a syntax tree is no formula of a smooth function, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct GraphError {
    /// What is wrong.
    pub fault: GraphFault,
    /// The bytes of the text it is about.
    pub range: Range<usize>,
}

/// Why a syntax tree is no formula of a smooth function.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GraphFault {
    /// A name that is neither a coordinate nor a parameter.
    #[error("unknown name `{name}`; {hint}")]
    UnknownName {
        /// The name.
        name: String,
        /// The names there are, and the one that was probably meant.
        hint: String,
    },
    /// A function that does not exist.
    #[error("unknown function `{name}`; {hint}")]
    UnknownFunction {
        /// The name.
        name: String,
        /// The functions there are, and the one that was probably meant.
        hint: String,
    },
    /// A function with a kink or a jump.
    #[error(
        "`{0}` is not smooth, but the formula must be: it is differentiated, and its modified energy exists only then"
    )]
    NotSmooth(String),
    /// A function of one argument with another number of them.
    #[error("`{function}` takes one argument, not {found}")]
    ArgumentCount {
        /// The function.
        function: String,
        /// How many arguments were found.
        found: usize,
    },
    /// An exponent that is not a rational number.
    #[error("an exponent must be a rational number; write exp(y*log(x)) for x^y")]
    VariableExponent,
    /// An exponent with a large numerator or denominator.
    #[error("an exponent is at most {LARGEST_POWER}, and a root at most of order {HIGHEST_ROOT}; here it is {0}")]
    LargeExponent(Box<Rational>),
    /// A divisor that is 0.
    #[error("division by zero")]
    DivisionByZero,
    /// The power 0^0.
    #[error("0^0 has no value")]
    ZeroToTheZero,
    /// An even root of the negative number given.
    #[error("even root of the negative number {0}: it has no real value")]
    EvenRoot(Box<Rational>),
    /// A function at a number where it has no real value.
    #[error("{function}({argument}) has no real value")]
    OutsideDomain {
        /// The function.
        function: Function,
        /// Its argument.
        argument: Box<Rational>,
    },
    /// A number with too many digits.
    #[error("numbers of absurd size: more than about 30000 digits")]
    AbsurdSize,
    /// A long product.
    #[error("a product of {0} different factors is too long; at most {MOST_FACTORS} are differentiated")]
    LongProduct(usize),
}

impl Graph {
    /// The formula of an expression whose names are coordinates and parameters, known by their index.
    ///
    /// The functions are sqrt, cbrt, exp, log, sin, cos, tan, sinh, cosh, tanh, atan, asin and acos; `pi` is π, unless a
    /// coordinate or parameter has that name; exponents are rational numbers. The tree is walked by recursion, which the heights that [`parse`](crate::parse) allows suit.
    ///
    /// # Errors
    /// A [`GraphError`] at the first unknown name, unknown or not smooth function, wrong number of arguments, exponent
    /// that is not rational or too large, and constant part that has no real value or absurdly many digits.
    pub fn build(
        &mut self,
        expression: &Expression,
        coordinates: &[String],
        parameters: &[String],
    ) -> Result<Node, GraphError> {
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
    ) -> Result<Node, GraphError> {
        Builder { graph: self, coordinates: &[separation.to_owned()], parameters, properties }.node(expression)
    }
}

/// Whether the formula of a pair in r² stays what it is when the bodies i and j are exchanged, as far as its simplified
/// form shows; `None` for a text that is no such formula, and for one in d, which has a direction.
pub fn is_symmetric(
    expression: &Expression,
    separation: Separation,
    properties: &[String],
    parameters: &[String],
) -> Option<bool> {
    let exchanged = |name: &String| match (name.strip_suffix("_i"), name.strip_suffix("_j")) {
        (Some(stem), _) => format!("{stem}_j"),
        (_, Some(stem)) => format!("{stem}_i"),
        _ => name.clone(),
    };
    // a property that the other body does not have in the list keeps an index of its own
    let mut all = properties.to_vec();
    for name in properties.iter().map(exchanged) {
        if !all.contains(&name) {
            all.push(name);
        }
    }
    let mut graph = Graph::new();
    let one = graph.build_pair(expression, separation.name(), &all, parameters).ok()?;
    let others: Vec<String> = all.iter().map(exchanged).collect();
    let other = graph.build_pair(expression, separation.name(), &others, parameters).ok()?;
    (separation == Separation::SquaredDistance).then_some(one == other)
}

struct Builder<'a> {
    graph: &'a mut Graph,
    coordinates: &'a [String],
    parameters: &'a [String],
    properties: &'a [String],
}

fn fault(fault: GraphFault, range: &Range<usize>) -> GraphError {
    GraphError { fault, range: range.clone() }
}

impl Builder<'_> {
    fn node(&mut self, expression: &Expression) -> Result<Node, GraphError> {
        let range = &expression.range;
        match &expression.kind {
            Kind::Number(value) => Ok(self.graph.number(value.clone())),
            Kind::Name(name) => self.named(name).map_err(|unknown| fault(unknown, range)),
            Kind::Binary(Operation::Power, base, exponent) => self.power(base, exponent, range),
            Kind::Binary(Operation::Multiply | Operation::Divide, ..) => self.product(expression),
            Kind::Negate(_) | Kind::Binary(..) => self.sum(expression),
            Kind::Call { function, arguments } => self.call(function, arguments, range),
        }
    }

    fn named(&mut self, name: &str) -> Result<Node, GraphFault> {
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
            return Err(GraphFault::UnknownName { name: name.to_string(), hint });
        }
        let hint = hint(name, &known, &[PI], "known names", NO_NAMES);
        Err(GraphFault::UnknownName { name: name.to_string(), hint })
    }

    /// All terms of a chain of additions at once, so that long sums cost no more than their length.
    fn sum(&mut self, expression: &Expression) -> Result<Node, GraphError> {
        let mut terms = Vec::new();
        self.terms(expression, &Rational::one(), &mut terms)?;
        self.sized(&terms, &expression.range)?;
        Ok(self.graph.sum(&terms))
    }

    fn terms(
        &mut self,
        expression: &Expression,
        sign: &Rational,
        terms: &mut Vec<(Node, Rational)>,
    ) -> Result<(), GraphError> {
        match &expression.kind {
            Kind::Negate(inner) => self.terms(inner, &-sign, terms),
            Kind::Binary(operation @ (Operation::Add | Operation::Subtract), left, right) => {
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
    fn product(&mut self, expression: &Expression) -> Result<Node, GraphError> {
        let mut factors = Vec::new();
        self.factors(expression, &Rational::one(), &mut factors)?;
        self.sized(&factors, &expression.range)?;
        let node = self.graph.product(&factors);
        self.moderate(node, &expression.range)
    }

    fn factors(
        &mut self,
        expression: &Expression,
        exponent: &Rational,
        factors: &mut Vec<(Node, Rational)>,
    ) -> Result<(), GraphError> {
        if let Kind::Binary(operation @ (Operation::Multiply | Operation::Divide), left, right) = &expression.kind {
            self.factors(left, exponent, factors)?;
            let exponent = if *operation == Operation::Divide { -exponent } else { exponent.clone() };
            return self.factors(right, &exponent, factors);
        }
        let node = self.node(expression)?;
        if exponent.is_negative() && self.graph.as_number(node).is_some_and(Zero::is_zero) {
            return Err(fault(GraphFault::DivisionByZero, &expression.range));
        }
        factors.push((node, exponent.clone()));
        Ok(())
    }

    fn power(&mut self, base: &Expression, exponent: &Expression, range: &Range<usize>) -> Result<Node, GraphError> {
        let node = self.node(exponent)?;
        let value = self.graph.as_number(node).cloned();
        let value = value.ok_or_else(|| fault(GraphFault::VariableExponent, &exponent.range))?;
        if too_large(&value) {
            return Err(fault(GraphFault::LargeExponent(Box::new(value)), &exponent.range));
        }
        self.raised(base, &value, range)
    }

    fn raised(&mut self, base: &Expression, exponent: &Rational, range: &Range<usize>) -> Result<Node, GraphError> {
        let node = self.node(base)?;
        if let Some(number) = self.graph.as_number(node) {
            let problem = match exponent {
                _ if number.is_zero() && exponent.is_negative() => Some(GraphFault::DivisionByZero),
                _ if number.is_zero() && exponent.is_zero() => Some(GraphFault::ZeroToTheZero),
                _ if number.is_negative() && exponent.denom().is_even() => {
                    Some(GraphFault::EvenRoot(Box::new(number.clone())))
                }
                _ => None,
            };
            if let Some(problem) = problem {
                return Err(fault(problem, &base.range));
            }
            // Its whole part must be computed, even if the rest is irrational.
            if exact_power(number, &exponent.floor()).is_none() {
                return Err(fault(GraphFault::AbsurdSize, range));
            }
        }
        let node = self.graph.power(node, exponent);
        self.moderate(node, range)
    }

    fn call(&mut self, name: &str, arguments: &[Expression], range: &Range<usize>) -> Result<Node, GraphError> {
        if NOT_SMOOTH.contains(&name) {
            return Err(fault(GraphFault::NotSmooth(name.to_string()), range));
        }
        let root = ROOTS.into_iter().find(|(root, _)| *root == name);
        let function = Function::named(name);
        if root.is_none() && function.is_none() {
            let unknown = GraphFault::UnknownFunction { name: name.to_string(), hint: hint_at_functions(name) };
            return Err(fault(unknown, range));
        }
        let [argument] = arguments else {
            let function = name.to_string();
            return Err(fault(GraphFault::ArgumentCount { function, found: arguments.len() }, range));
        };
        if let Some((_, order)) = root {
            return self.raised(argument, &Rational::new(BigInt::one(), order.into()), range);
        }
        let function = function.expect("every name that is not a root's is a function's, as seen above");
        let node = self.node(argument)?;
        if let Some(value) = self.graph.as_number(node).filter(|value| outside(function, value)) {
            let argument = Box::new(value.clone());
            return Err(fault(GraphFault::OutsideDomain { function, argument }, range));
        }
        Ok(self.graph.call(function, node))
    }

    /// Refuses long numbers before they are multiplied or brought to one denominator.
    fn sized(&self, parts: &[(Node, Rational)], range: &Range<usize>) -> Result<(), GraphError> {
        let bits = |value: &Rational| value.numer().bits() + value.denom().bits();
        let size = |node| match self.graph.form(node) {
            Form::Number(value) => bits(value),
            Form::Sum { constant, terms } => bits(constant) + terms.iter().map(|(_, value)| bits(value)).sum::<u64>(),
            _ => 0,
        };
        let total: u64 = parts.iter().map(|(node, _)| size(*node)).sum();
        if total <= MOST_BITS { Ok(()) } else { Err(fault(GraphFault::AbsurdSize, range)) }
    }

    /// Refuses products that are too long, and exponents that became too large.
    fn moderate(&self, node: Node, range: &Range<usize>) -> Result<Node, GraphError> {
        let product = match self.graph.form(node) {
            Form::Sum { terms, .. } if terms.len() == 1 => terms[0].0,
            _ => node,
        };
        if let Form::Product(factors) = self.graph.form(product) {
            if factors.len() > MOST_FACTORS {
                return Err(fault(GraphFault::LongProduct(factors.len()), range));
            }
            if let Some((_, exponent)) = factors.iter().find(|(_, exponent)| too_large(exponent)) {
                return Err(fault(GraphFault::LargeExponent(Box::new(exponent.clone())), range));
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
