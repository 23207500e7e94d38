//! What is computed for some nodes: sums, products of atoms, functions, each once.
//!
//! A product is a multiset of atoms. The powers of one base are expressed by few atoms: if the base is under a root and
//! in a denominator, by 1/√base alone, so that neither a second root nor a division is needed.

use std::collections::{BTreeMap, HashMap, HashSet};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive};

use crate::symbolic::graph::simplify::common_size;
use crate::symbolic::graph::{Form, Graph, Node};
use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::program::instruction::Place;

/// When a program runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    /// Once: everything is computed, from parameters and exact numbers.
    Prepare,
    /// For every q: what does not depend on coordinates is a constant.
    Main,
}

/// The index of a quantity.
pub(super) type Id = usize;

/// Something to be computed.
#[derive(Debug, Clone)]
pub(super) enum Quantity {
    Leaf(Place),
    Number(Rational),
    /// Parts, each to be added or, if true, subtracted.
    Sum(Vec<(bool, Id)>),
    Product(Product),
    Negate(Id),
    Call(Function, Id),
}

/// ± Π atom^multiplicity; atoms with a negative multiplicity are in the denominator.
#[derive(Debug, Clone, Default)]
pub(super) struct Product {
    pub(super) negative: bool,
    pub(super) factors: BTreeMap<usize, i64>,
}

/// What products are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Atom {
    Value(Id),
    Sqrt(Id),
    ReciprocalSqrt(Id),
    Root(Id, u32),
    /// exp(exponent · log base), for exponents that no root of reasonable order expresses
    Power(Id, Id),
    /// Multiply by an integer.
    Scale(i32),
    /// Divide by an integer.
    Shrink(i32),
    /// 1 over another atom
    Inverse(usize),
    /// The product of two atoms.
    Pair(usize, usize),
}

/// All that is computed.
#[derive(Debug)]
pub(super) struct LoweringPlan {
    pub(super) quantities: Vec<Quantity>,
    pub(super) atoms: Vec<Atom>,
    /// The requested quantities; `None` for 0.
    pub(super) outputs: Vec<Option<Id>>,
    /// The constants.
    pub(super) hoisted: Vec<Node>,
    /// The quantity 1, if a reciprocal may need it.
    pub(super) one: Option<Id>,
}

/// What the nodes need. Constants are added to the plan's list.
pub(super) fn plan(graph: &mut Graph, nodes: &[Node], stage: Stage) -> LoweringPlan {
    let mut collector = Collector {
        graph,
        stage,
        varying: HashMap::new(),
        quantities: Vec::new(),
        known: HashMap::new(),
        negated: HashMap::new(),
        waiting: Vec::new(),
        products: Vec::new(),
        atoms: Vec::new(),
        atom_indices: HashMap::new(),
        hoisted: Vec::new(),
        hoisted_indices: HashMap::new(),
    };
    let outputs: Vec<_> = nodes.iter().map(|node| collector.output(*node)).collect();
    collector.work();
    let one = collector.resolve_products();
    let quantities = collector.quantities.into_iter().map(|quantity| quantity.expect("defined by `work`")).collect();
    LoweringPlan { quantities, atoms: collector.atoms, outputs, hoisted: collector.hoisted, one }
}

/// A product whose atoms are chosen when all exponents of its bases are known.
struct Raw {
    id: Id,
    negative: bool,
    /// The rational factor, positive.
    number: Rational,
    /// Atoms that are known already.
    atoms: Vec<usize>,
    /// Bases with exponents.
    powers: Vec<(Id, Exponent)>,
}

/// numerator/order in lowest terms
#[derive(Clone, Copy)]
struct Exponent {
    numerator: i32,
    order: u32,
}

struct Collector<'a> {
    graph: &'a mut Graph,
    stage: Stage,
    /// Whether a node is computed in this stage, for the nodes met so far.
    varying: HashMap<Node, bool>,
    /// `None` for one that is waiting.
    quantities: Vec<Option<Quantity>>,
    /// The quantity c·node by the nodes of c and node.
    known: HashMap<(Node, Node), Id>,
    /// The quantity −x by the quantity x.
    negated: HashMap<Id, Id>,
    /// Quantities to be defined as c·node.
    waiting: Vec<(Id, Rational, Node)>,
    products: Vec<Raw>,
    atoms: Vec<Atom>,
    atom_indices: HashMap<Atom, usize>,
    hoisted: Vec<Node>,
    hoisted_indices: HashMap<Node, usize>,
}

impl Collector<'_> {
    fn output(&mut self, node: Node) -> Option<Id> {
        (!self.graph.is_zero(node)).then(|| self.exact(node))
    }

    /// Defines the waiting quantities, and then those that these need, without recursion.
    fn work(&mut self) {
        while let Some((id, coefficient, node)) = self.waiting.pop() {
            let quantity = self.definition(id, coefficient, node);
            self.quantities[id] = Some(quantity);
        }
    }

    fn new_quantity(&mut self, quantity: Option<Quantity>) -> Id {
        self.quantities.push(quantity);
        self.quantities.len() - 1
    }

    /// The quantity of a node with its sign.
    fn exact(&mut self, node: Node) -> Id {
        let (negative, id) = self.signed(&Rational::one(), node);
        if !negative {
            return id;
        }
        if let Some(known) = self.negated.get(&id) {
            return *known;
        }
        let negated = self.new_quantity(Some(Quantity::Negate(id)));
        self.negated.insert(id, negated);
        negated
    }

    /// The quantity coefficient·node without its leading sign, and whether the sign is a minus.
    fn signed(&mut self, coefficient: &Rational, node: Node) -> (bool, Id) {
        let (mut coefficient, mut node) = (coefficient.clone(), node);
        match &*self.graph.shared_form(node) {
            Form::Number(value) => {
                coefficient *= value;
                node = self.graph.number(Rational::one());
            }
            Form::Sum { constant, terms } => {
                let size = common_size(constant, terms).unwrap_or_else(Rational::one);
                let factor = if terms[0].1.is_negative() { -size } else { size };
                node = self.graph.scaled(node, &factor.recip());
                coefficient *= factor;
            }
            _ => {}
        }
        let negative = coefficient.is_negative();
        let coefficient = coefficient.abs();
        let key = (self.graph.number(coefficient.clone()), node);
        if let Some(id) = self.known.get(&key) {
            return (negative, *id);
        }
        let id = self.new_quantity(None);
        self.known.insert(key, id);
        self.waiting.push((id, coefficient, node));
        (negative, id)
    }

    /// Whether the node is computed in this stage; otherwise it is a constant, or a number.
    fn varies(&mut self, node: Node) -> bool {
        for part in self.graph.below_unless(&[node], |part| self.varying.contains_key(&part)) {
            let varies = match self.graph.form(part) {
                Form::Coordinate(_) | Form::Property(_) => true,
                Form::Parameter(_) => self.stage == Stage::Prepare,
                Form::Number(_) => false,
                _ if self.stage == Stage::Prepare => true,
                _ => self.graph.children(part).any(|child| self.varying[&child]),
            };
            self.varying.insert(part, varies);
        }
        self.varying[&node]
    }

    fn definition(&mut self, id: Id, coefficient: Rational, node: Node) -> Quantity {
        if !self.varies(node) {
            let node = self.graph.scaled(node, &coefficient);
            return self.constant(node);
        }
        match &*self.graph.shared_form(node) {
            Form::Coordinate(index) if coefficient.is_one() => Quantity::Leaf(Place::Coordinate(*index)),
            Form::Parameter(index) if coefficient.is_one() => Quantity::Leaf(Place::Parameter(*index)),
            Form::Property(index) if coefficient.is_one() => Quantity::Leaf(Place::Property(*index)),
            Form::Call(function, argument) if coefficient.is_one() => Quantity::Call(*function, self.exact(*argument)),
            Form::Sum { constant, terms } if coefficient.is_one() => Quantity::Sum(self.summands(constant, terms)),
            Form::Product(factors) => self.product(id, coefficient, factors),
            _ => self.product(id, coefficient, &[(node, Rational::one())]),
        }
    }

    fn constant(&mut self, node: Node) -> Quantity {
        match self.graph.form(node) {
            Form::Parameter(index) => return Quantity::Leaf(Place::Parameter(*index)),
            Form::Number(value) if self.stage == Stage::Prepare => return Quantity::Number(value.clone()),
            _ => {}
        }
        let index = *self.hoisted_indices.entry(node).or_insert_with(|| {
            self.hoisted.push(node);
            self.hoisted.len() - 1
        });
        Quantity::Leaf(Place::Constant(index))
    }

    /// The parts of a sum: one for all constants, and terms with coefficients of the same size, not 1, together.
    fn summands(&mut self, constant: &Rational, terms: &[(Node, Rational)]) -> Vec<(bool, Id)> {
        let number = self.graph.number(constant.clone());
        let mut constants = vec![(number, Rational::one())];
        let mut groups: BTreeMap<Node, Vec<(Node, Rational)>> = BTreeMap::new();
        for (node, coefficient) in terms {
            if self.varies(*node) {
                let size = self.graph.number(coefficient.abs());
                groups.entry(size).or_default().push((*node, coefficient.clone()));
            } else {
                constants.push((*node, coefficient.clone()));
            }
        }
        let mut parts = Vec::new();
        for group in groups.values() {
            if group.len() == 1 || group[0].1.abs().is_one() {
                parts.extend(group.iter().map(|(node, coefficient)| self.signed(coefficient, *node)));
            } else {
                let sum = self.graph.sum(group);
                parts.push(self.signed(&Rational::one(), sum));
            }
        }
        let constant = self.graph.sum(&constants);
        if !self.graph.is_zero(constant) {
            parts.push(self.signed(&Rational::one(), constant));
        }
        parts
    }

    /// Records a product; its atoms are chosen later.
    fn product(&mut self, id: Id, mut number: Rational, factors: &[(Node, Rational)]) -> Quantity {
        let mut raw = Raw { id, negative: false, number: Rational::one(), atoms: Vec::new(), powers: Vec::new() };
        let mut constants = Vec::new();
        for (base, exponent) in factors {
            // Prepared numbers are not powers, so only their roots are computed here.
            if self.stage == Stage::Main && !self.varies(*base) {
                constants.push((*base, exponent.clone()));
            } else {
                self.factor(*base, exponent, &mut raw);
            }
        }
        if !constants.is_empty() {
            let constant = self.graph.product(&constants);
            let constant = self.graph.scaled(constant, &number);
            let (negative, id) = self.signed(&Rational::one(), constant);
            raw.negative = negative;
            raw.atoms.push(self.atom(Atom::Value(id)));
            number = Rational::one();
        }
        raw.number = number;
        self.products.push(raw);
        Quantity::Product(Product::default())
    }

    fn factor(&mut self, base: Node, exponent: &Rational, raw: &mut Raw) {
        let base = self.exact(base);
        if let (Some(numerator), Some(order)) = (exponent.numer().to_i32(), exponent.denom().to_u32())
            && numerator.unsigned_abs() < 1 << 30
        {
            raw.powers.push((base, Exponent { numerator, order }));
        } else {
            let one = self.graph.number(Rational::one());
            let (negative, size) = self.signed(exponent, one);
            let size = if negative { self.new_quantity(Some(Quantity::Negate(size))) } else { size };
            raw.atoms.push(self.atom(Atom::Power(base, size)));
        }
    }

    fn atom(&mut self, atom: Atom) -> usize {
        *self.atom_indices.entry(atom).or_insert_with(|| {
            self.atoms.push(atom);
            self.atoms.len() - 1
        })
    }

    /// Chooses the atoms of all products; returns the quantity 1 if there is a denominator.
    fn resolve_products(&mut self) -> Option<Id> {
        let products = std::mem::take(&mut self.products);
        let powers = products.iter().flat_map(|raw| &raw.powers);
        let rooted = powers.filter(|(_, exponent)| exponent.order == 2 && exponent.numerator < 0);
        let rooted: HashSet<Id> = rooted.map(|(base, _)| *base).collect();
        let mut one = None;
        for raw in products {
            let mut factors = BTreeMap::new();
            raw.atoms.iter().for_each(|atom| *factors.entry(*atom).or_insert(0) += 1);
            for (base, exponent) in &raw.powers {
                for (atom, count) in powers_of(*base, *exponent, rooted.contains(base)) {
                    *factors.entry(self.atom(atom)).or_insert(0) += count;
                }
            }
            factors.retain(|_, count| *count != 0);
            if factors.values().any(|count| *count < 0) {
                one.get_or_insert_with(|| self.rational(&Rational::one()));
            }
            if let Some(atom) = self.number_atom(&raw.number, factors.values().all(|count| *count < 0)) {
                *factors.entry(atom).or_insert(0) += 1;
            }
            self.quantities[raw.id] = Some(Quantity::Product(Product { negative: raw.negative, factors }));
        }
        one
    }

    /// The quantity of a positive rational.
    fn rational(&mut self, value: &Rational) -> Id {
        let one = self.graph.number(Rational::one());
        let (_, id) = self.signed(value, one);
        self.work();
        id
    }

    /// A rational factor: an integer, 1 over an integer, or a constant. A numerator must be a quantity.
    fn number_atom(&mut self, number: &Rational, numerator: bool) -> Option<usize> {
        if number.is_one() {
            return None;
        }
        let small = |value: &BigInt| value.to_i32().filter(|_| !numerator);
        let atom = match (small(number.numer()), small(number.denom())) {
            (Some(n), _) if number.is_integer() => Atom::Scale(n),
            (Some(1), Some(n)) => Atom::Shrink(n),
            _ => Atom::Value(self.rational(number)),
        };
        Some(self.atom(atom))
    }
}

/// base^exponent in atoms with multiplicities; `rooted` if 1/√base is available.
fn powers_of(base: Id, exponent: Exponent, rooted: bool) -> Vec<(Atom, i64)> {
    let Exponent { numerator, order } = exponent;
    let n = i64::from(numerator);
    match order {
        1 if n < 0 && rooted => vec![(Atom::ReciprocalSqrt(base), -2 * n)],
        1 => vec![(Atom::Value(base), n)],
        2 if n < 0 => vec![(Atom::ReciprocalSqrt(base), -n)],
        // √b = b · 1/√b
        2 if rooted => vec![(Atom::Value(base), (n + 1) / 2), (Atom::ReciprocalSqrt(base), 1)],
        2 => vec![(Atom::Value(base), (n - 1) / 2), (Atom::Sqrt(base), 1)],
        _ if n < 0 => vec![(Atom::Root(base, order), n)],
        _ => {
            let (whole, rest) = n.div_rem(&i64::from(order));
            vec![(Atom::Value(base), whole), (Atom::Root(base, order), rest)]
        }
    }
}
