//! Formulas as a directed acyclic graph without repetitions: equal parts are one node.
//!
//! A node is made of existing nodes, so the nodes below a node have smaller numbers. An algorithm that needs the parts
//! before the whole goes through the numbers in order, without recursion.

mod bracket;
pub(crate) mod build;
mod degree;
mod derivative;
mod expand;
pub(crate) mod flow;
pub(crate) mod notation;
pub(crate) mod pair;
mod quadratic;
mod rate;
pub(crate) mod simplify;
mod substitute;

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use num_traits::Zero;

use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;

/// A formula in a [`Graph`]: an index, valid in this graph only.
///
/// Two nodes of one graph are equal if, and only if, their simplified formulas are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node(u32);

/// The formula of a node in terms of other nodes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Form {
    /// An exact number.
    Number(Rational),
    /// The coordinate with this index.
    Coordinate(usize),
    /// The parameter with this index.
    Parameter(usize),
    /// The property of the bodies with this index, such as a mass. Like a coordinate it has a new value in every
    /// evaluation; like a parameter it is not differentiated.
    Property(usize),
    /// constant + Σ coefficient · node, sorted by node. No node is a sum or a number, none occurs twice, no
    /// coefficient is 0. A multiple c·node is a sum of one term.
    Sum {
        /// The number in the sum, often 0.
        constant: Rational,
        /// Nodes and their coefficients.
        terms: Vec<(Node, Rational)>,
    },
    /// Π node^exponent, sorted by node. None occurs twice, no exponent is 0.
    ///
    /// A power with an exponent p/q in lowest terms is the real q-th root to the power p: for an odd q it is defined
    /// for negative bases, too, for an even one only for positive ones.
    Product(Vec<(Node, Rational)>),
    /// function(node)
    Call(Function, Node),
}

/// A linear map D of formulas with D(f g) = f D(g) + g D(f).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Derivation {
    /// ∂/∂q_i
    Along(usize),
    /// Σ q_i ∂/∂q_i over all coordinates: k times a function that is homogeneous of degree k
    Radial,
    /// Σ v_i ∂/∂q_i over all coordinates, where v_i is the property with the index of q_i
    Directional,
}

/// Formulas without repetitions, simplified as they are made.
///
/// ```
/// use shadowstep_schemes::symbolic::{Graph, Rational, parse};
///
/// let coordinates = ["x".to_string(), "y".to_string()];
/// let mut graph = Graph::new();
/// let potential = graph.build(&parse("-1/sqrt(x^2 + y^2)")?, &coordinates, &[])?;
/// assert_eq!(graph.degree(potential), Some(Rational::from_integer((-1).into())));
///
/// let rate = graph.rate(potential);
/// assert_eq!(rate, graph.build(&parse("3*(y*y + x*x)^-0.5")?, &coordinates, &[])?);
///
/// let force = graph.derivative(potential, 0);
/// assert_eq!(force, graph.build(&parse("x/sqrt(x^2 + y^2)^3")?, &coordinates, &[])?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Graph {
    forms: Vec<Arc<Form>>,
    nodes: HashMap<Arc<Form>, Node>,
    /// Derivatives found so far.
    pub(crate) derivatives: HashMap<(Node, Derivation), Node>,
}

impl Graph {
    /// A graph without nodes.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of nodes.
    pub fn size(&self) -> usize {
        self.forms.len()
    }

    /// The form of a node of this graph.
    ///
    /// # Panics
    /// If the node is from a larger graph.
    pub fn form(&self, node: Node) -> &Form {
        &self.forms[node.0 as usize]
    }

    /// The form, kept alive while the graph grows.
    pub(crate) fn shared_form(&self, node: Node) -> Arc<Form> {
        Arc::clone(&self.forms[node.0 as usize])
    }

    /// The node with this form, which must be simplified.
    pub(crate) fn intern(&mut self, form: Form) -> Node {
        if let Some(node) = self.nodes.get(&form) {
            return *node;
        }
        let number = u32::try_from(self.forms.len()).expect("fewer nodes than 2^32: memory ends before");
        let form = Arc::new(form);
        self.forms.push(Arc::clone(&form));
        self.nodes.insert(form, Node(number));
        Node(number)
    }

    /// The exact numbers in the simplified formula of a node: constants and coefficients.
    pub fn numbers(&self, node: Node) -> Vec<&Rational> {
        self.below(&[node]).into_iter().flat_map(|part| self.own_numbers(part)).collect()
    }

    /// The constant and the coefficients of a node itself.
    pub(crate) fn own_numbers(&self, node: Node) -> impl Iterator<Item = &Rational> {
        let (constant, terms) = match self.form(node) {
            Form::Number(value) => (Some(value), &[][..]),
            Form::Sum { constant, terms } => (Some(constant), &terms[..]),
            _ => (None, &[][..]),
        };
        constant.into_iter().chain(terms.iter().map(|(_, coefficient)| coefficient))
    }

    /// The nodes that a node is directly made of.
    pub(crate) fn children(&self, node: Node) -> impl Iterator<Item = Node> {
        let (parts, argument) = match self.form(node) {
            Form::Number(_) | Form::Coordinate(_) | Form::Parameter(_) | Form::Property(_) => (&[][..], None),
            Form::Sum { terms: parts, .. } | Form::Product(parts) => (&parts[..], None),
            Form::Call(_, argument) => (&[][..], Some(*argument)),
        };
        parts.iter().map(|(part, _)| *part).chain(argument)
    }

    /// The nodes themselves and all below them, parts before wholes.
    pub(crate) fn below(&self, nodes: &[Node]) -> BTreeSet<Node> {
        self.below_unless(nodes, |_| false)
    }

    /// As [`Graph::below`], without `known` nodes and the nodes that are only below these.
    pub(crate) fn below_unless(&self, nodes: &[Node], known: impl Fn(Node) -> bool) -> BTreeSet<Node> {
        let mut found = BTreeSet::new();
        let mut waiting = nodes.to_vec();
        while let Some(node) = waiting.pop() {
            if !known(node) && found.insert(node) {
                waiting.extend(self.children(node));
            }
        }
        found
    }

    /// The value of a node that is a number.
    pub fn as_number(&self, node: Node) -> Option<&Rational> {
        match self.form(node) {
            Form::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether the node is the number 0.
    pub(crate) fn is_zero(&self, node: Node) -> bool {
        self.as_number(node).is_some_and(Zero::is_zero)
    }

    /// A number.
    pub fn number(&mut self, value: Rational) -> Node {
        self.intern(Form::Number(value))
    }

    /// The coordinate with this index.
    pub fn coordinate(&mut self, index: usize) -> Node {
        self.intern(Form::Coordinate(index))
    }

    /// The parameter with this index.
    pub fn parameter(&mut self, index: usize) -> Node {
        self.intern(Form::Parameter(index))
    }

    /// A property of bodies.
    pub fn property(&mut self, index: usize) -> Node {
        self.intern(Form::Property(index))
    }
}
