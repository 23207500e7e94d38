//! The search for a form of the formulas with fewer operations: common factors of the terms of a sum are factored out,
//! and constant factors of a sum are multiplied into its terms.
//!
//! The effect of a change depends on what else needs the products, so each change is tried.

use std::collections::{BTreeMap, HashMap, HashSet};

use num_traits::{One, Signed, Zero};

use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::rational::Rational;
use crate::symbolic::program::Program;
use crate::symbolic::program::lower;

/// The largest total size of the nodes of all programs that are tried: only very long formulas, or long numbers, exceed
/// it.
const MOST_WORK: usize = 20_000;

impl Graph {
    /// A program that computes all outputs together, such as the components of a gradient and the rate.
    ///
    /// Common parts of the outputs are computed once. Sums and products of parameters and numbers are constants, which
    /// are prepared once, and so are rationals that are neither integers nor 1 over an integer. Common factors are
    /// factored out of sums where that saves time. The graph is not changed.
    ///
    /// ```
    /// use shadowstep_schemes::symbolic::{Graph, parse};
    ///
    /// let mut graph = Graph::new();
    /// let potential = graph.build(&parse("-1/sqrt(x^2 + y^2)")?, &["x".into(), "y".into()], &[])?;
    /// let gradient = [graph.derivative(potential, 0), graph.derivative(potential, 1)];
    /// let program = graph.program(&gradient);
    /// assert_eq!(program.cost().to_string(), "1 addition, 6 multiplications, 1 root");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn program(&self, outputs: &[Node]) -> Program {
        let mut graph = self.clone();
        let mut outputs = outputs.to_vec();
        let mut best = lower::program(&mut graph, &outputs);
        let mut work = 0;
        while let Some((better, program)) = improvement(&mut graph, &outputs, &best, &mut work) {
            (outputs, best) = (better, program);
        }
        best
    }
}

/// The cost of a program: time, then length, then scratch places.
fn cost(program: &Program) -> (u64, usize, usize) {
    (program.cost().weight(), program.instructions.len(), program.scratch)
}

/// The first change that makes the program cheaper.
fn improvement(
    graph: &mut Graph,
    outputs: &[Node],
    program: &Program,
    work: &mut usize,
) -> Option<(Vec<Node>, Program)> {
    let size: usize = graph.below(outputs).into_iter().map(|node| size(graph, node)).sum();
    for change in changes(graph, outputs) {
        *work += size;
        if *work > MOST_WORK {
            return None;
        }
        let (old, new) = match change {
            Change::TakeOut { sum, base, exponent } => (sum, factored(graph, sum, base, &exponent)),
            Change::MultiplyIn { product, sum } => (product, distributed(graph, product, sum)),
        };
        let changed = graph.replaced(outputs, HashMap::from([(old, new)]));
        let candidate = lower::program(graph, &changed);
        if cost(&candidate) < cost(program) {
            return Some((changed, candidate));
        }
    }
    None
}

/// The number of parts of a node, and more where its numbers are long: their common divisors take a time that grows
/// with the square of their bits.
fn size(graph: &Graph, node: Node) -> usize {
    let thousands =
        graph.own_numbers(node).map(|number| number.numer().bits().max(number.denom().bits()) as usize / 1000);
    1 + graph.children(node).count() + thousands.map(|thousands| thousands * thousands).sum::<usize>()
}

/// An equal form of a node.
enum Change {
    /// Factor a power out of the terms of a sum that have it.
    TakeOut { sum: Node, base: Node, exponent: Rational },
    /// Multiply the constant factors of a product into a sum that is another factor.
    MultiplyIn { product: Node, sum: Node },
}

/// The possible changes below the outputs.
fn changes(graph: &Graph, outputs: &[Node]) -> Vec<Change> {
    let mut changes = Vec::new();
    let varying = varying(graph, outputs);
    for node in graph.below(outputs) {
        if let Form::Sum { terms, .. } = graph.form(node) {
            let powers = common_factors(graph, terms).into_iter();
            changes.extend(powers.map(|(base, exponent)| Change::TakeOut { sum: node, base, exponent }));
        }
        let Some((coefficient, factors)) = multiple(graph, node) else { continue };
        if !coefficient.is_one() || factors.iter().any(|(base, _)| !varying.contains(base)) {
            let is_sum = |base| matches!(graph.form(base), Form::Sum { .. }) && multiple(graph, base).is_none();
            let sums = factors.iter().filter(|(base, exponent)| exponent.is_one() && is_sum(*base));
            changes.extend(sums.map(|(sum, _)| Change::MultiplyIn { product: node, sum: *sum }));
        }
    }
    changes
}

/// The nodes below the outputs that contain a coordinate.
fn varying(graph: &Graph, outputs: &[Node]) -> HashSet<Node> {
    let mut varying = HashSet::new();
    for node in graph.below(outputs) {
        if matches!(graph.form(node), Form::Coordinate(_)) || graph.children(node).any(|child| varying.contains(&child))
        {
            varying.insert(node);
        }
    }
    varying
}

/// The coefficient and the factors of a product, or of a multiple of one.
fn multiple(graph: &Graph, node: Node) -> Option<(Rational, Vec<(Node, Rational)>)> {
    match graph.form(node) {
        Form::Product(factors) => Some((Rational::one(), factors.clone())),
        Form::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => {
            let Form::Product(factors) = graph.form(terms[0].0) else { return None };
            Some((terms[0].1.clone(), factors.clone()))
        }
        _ => None,
    }
}

/// K · (Σ term) · rest as (Σ K · term) · rest, where K are all constant factors
fn distributed(graph: &mut Graph, product: Node, sum: Node) -> Node {
    let Some((coefficient, factors)) = multiple(graph, product) else { return product };
    let Form::Sum { constant, terms } = &*graph.shared_form(sum) else { return product };
    let varying = varying(graph, &[product]);
    let others = factors.into_iter().filter(|(base, _)| *base != sum);
    let (mut rest, constants): (Vec<_>, Vec<_>) = others.partition(|(base, _)| varying.contains(base));
    let mut inside = Vec::new();
    for (term, factor) in [(graph.number(constant.clone()), Rational::one())].iter().chain(terms) {
        let mut factors = constants.clone();
        factors.push((*term, Rational::one()));
        inside.push((graph.product(&factors), factor * &coefficient));
    }
    rest.push((graph.sum(&inside), Rational::one()));
    graph.product(&rest)
}

/// Powers in at least two terms, each with its exponent that is nearest to 0.
fn common_factors(graph: &Graph, terms: &[(Node, Rational)]) -> Vec<(Node, Rational)> {
    let mut found: BTreeMap<(Node, bool), (usize, Rational)> = BTreeMap::new();
    for (term, _) in terms {
        for (base, exponent) in factors(graph, *term) {
            let key = (base, exponent.is_negative());
            let (count, least) = found.entry(key).or_insert_with(|| (0, exponent.clone()));
            *count += 1;
            if exponent.abs() < least.abs() {
                *least = exponent;
            }
        }
    }
    let common = found.into_iter().filter(|(_, (count, _))| *count > 1);
    common.map(|((base, _), (_, exponent))| (base, exponent)).collect()
}

fn factors(graph: &Graph, term: Node) -> Vec<(Node, Rational)> {
    match graph.form(term) {
        Form::Product(factors) => factors.clone(),
        _ => vec![(term, Rational::one())],
    }
}

/// base^exponent · Σ (terms with that factor) / base^exponent + the rest
fn factored(graph: &mut Graph, sum: Node, base: Node, exponent: &Rational) -> Node {
    let Form::Sum { constant, terms } = &*graph.shared_form(sum) else { return sum };
    let mut rest = vec![(graph.number(constant.clone()), Rational::one())];
    let mut inside = Vec::new();
    for (term, coefficient) in terms {
        let found = factors(graph, *term).into_iter().find(|(other, _)| *other == base);
        if found.is_some_and(|(_, other)| other.is_negative() == exponent.is_negative()) {
            let quotient = graph.product(&[(*term, Rational::one()), (base, -exponent)]);
            inside.push((quotient, coefficient.clone()));
        } else {
            rest.push((*term, coefficient.clone()));
        }
    }
    let inside = graph.sum(&inside);
    let product = graph.product(&[(inside, Rational::one()), (base, exponent.clone())]);
    rest.push((product, Rational::one()));
    graph.sum(&rest)
}
