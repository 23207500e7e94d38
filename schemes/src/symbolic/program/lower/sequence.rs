//! Operations with two operands, in their order.

use std::collections::HashMap;

use super::collect::{Atom, Id, LoweringPlan, Product, Quantity};
use super::{products, sums};
use crate::symbolic::number::function::Function;
use crate::symbolic::number::rational::Rational;
use crate::symbolic::program::instruction::Place;

/// The index of an operation, which stands for its result.
pub(super) type Value = usize;

/// An operation on values.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    Leaf(Place),
    /// An exact number by its index.
    Number(usize),
    /// Parts, each added or, if true, subtracted.
    Sum(Vec<(bool, Value)>),
    Product(Value, Value),
    Quotient(Value, Value),
    Scale(Value, i32),
    Shrink(Value, i32),
    Negate(Value),
    Sqrt(Value),
    ReciprocalSqrt(Value),
    Root(Value, u32),
    Call(Function, Value),
}

impl Operation {
    pub(super) fn operands(&self) -> Vec<Value> {
        match self {
            Operation::Leaf(_) | Operation::Number(_) => Vec::new(),
            Operation::Sum(parts) => parts.iter().map(|(_, part)| *part).collect(),
            Operation::Product(a, b) | Operation::Quotient(a, b) => vec![*a, *b],
            Operation::Scale(a, _) | Operation::Shrink(a, _) | Operation::Negate(a) | Operation::Sqrt(a) => vec![*a],
            Operation::ReciprocalSqrt(a) | Operation::Root(a, _) | Operation::Call(_, a) => vec![*a],
        }
    }
}

/// Operations, each after its operands.
#[derive(Debug, Default)]
pub(super) struct Sequence {
    pub(super) operations: Vec<Operation>,
    pub(super) numbers: Vec<Rational>,
    /// The requested values; `None` for 0.
    pub(super) outputs: Vec<Option<Value>>,
}

/// Orders a plan: what an output needs is computed just before it, unless an earlier output needed it.
pub(super) fn sequence(mut plan: LoweringPlan) -> Sequence {
    sums::share(&mut plan);
    products::share(&mut plan);
    let mut sequencer =
        Sequencer { plan, known: HashMap::new(), values: HashMap::new(), sequence: Sequence::default() };
    for output in sequencer.plan.outputs.clone() {
        let value = output.map(|id| sequencer.demand(Unit::Quantity(id)));
        sequencer.sequence.outputs.push(value);
    }
    sequencer.sequence
}

/// A quantity or an atom.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Unit {
    Quantity(Id),
    Atom(usize),
}

struct Sequencer {
    plan: LoweringPlan,
    known: HashMap<Unit, Value>,
    values: HashMap<Operation, Value>,
    sequence: Sequence,
}

impl Sequencer {
    /// Computes a unit after all it needs, as a recursion would, but with an explicit stack.
    fn demand(&mut self, unit: Unit) -> Value {
        let mut waiting = vec![unit];
        while let Some(next) = waiting.last().copied() {
            let missing: Vec<Unit> =
                self.needs(next).into_iter().filter(|need| !self.known.contains_key(need)).collect();
            if missing.is_empty() || self.known.contains_key(&next) {
                waiting.pop();
                if !self.known.contains_key(&next) {
                    let value = self.unit(next);
                    self.known.insert(next, value);
                }
            } else {
                waiting.extend(missing.into_iter().rev());
            }
        }
        self.known[&unit]
    }

    fn needs(&self, unit: Unit) -> Vec<Unit> {
        let quantities = |ids: &[Id]| ids.iter().map(|id| Unit::Quantity(*id)).collect();
        match unit {
            Unit::Quantity(id) => match &self.plan.quantities[id] {
                Quantity::Leaf(_) | Quantity::Number(_) => Vec::new(),
                Quantity::Sum(parts) => parts.iter().map(|(_, part)| Unit::Quantity(*part)).collect(),
                Quantity::Product(product) => {
                    let mut needs: Vec<Unit> = self.computed(product.factors.keys().copied());
                    if product.factors.values().any(|count| *count < 0) {
                        needs.extend(self.plan.one.map(Unit::Quantity));
                    }
                    needs
                }
                Quantity::Negate(inner) | Quantity::Call(_, inner) => quantities(&[*inner]),
            },
            Unit::Atom(atom) => match self.plan.atoms[atom] {
                Atom::Value(id) | Atom::Sqrt(id) | Atom::ReciprocalSqrt(id) | Atom::Root(id, _) => quantities(&[id]),
                Atom::Power(base, exponent) => quantities(&[base, exponent]),
                Atom::Scale(_) | Atom::Shrink(_) => Vec::new(),
                Atom::Inverse(inner) => {
                    self.plan.one.map(Unit::Quantity).into_iter().chain([Unit::Atom(inner)]).collect()
                }
                Atom::Pair(a, b) => self.computed([a, b].into_iter()),
            },
        }
    }

    /// The atoms that are values, not integers to multiply or divide by.
    fn computed(&self, atoms: impl Iterator<Item = usize>) -> Vec<Unit> {
        let integer = |atom: &usize| matches!(self.plan.atoms[*atom], Atom::Scale(_) | Atom::Shrink(_));
        atoms.filter(|atom| !integer(atom)).map(Unit::Atom).collect()
    }

    /// Computes a unit, all of whose needs are known.
    fn unit(&mut self, unit: Unit) -> Value {
        match unit {
            Unit::Quantity(id) => match self.plan.quantities[id].clone() {
                Quantity::Leaf(place) => self.push(Operation::Leaf(place)),
                Quantity::Number(value) => {
                    self.sequence.numbers.push(value);
                    self.push(Operation::Number(self.sequence.numbers.len() - 1))
                }
                Quantity::Sum(parts) => {
                    let parts = parts.into_iter().map(|(negative, part)| (negative, self.known[&Unit::Quantity(part)]));
                    self.sum(parts.collect())
                }
                Quantity::Product(product) => self.product(&product),
                Quantity::Negate(inner) => self.push(Operation::Negate(self.known[&Unit::Quantity(inner)])),
                Quantity::Call(function, inner) => {
                    self.push(Operation::Call(function, self.known[&Unit::Quantity(inner)]))
                }
            },
            Unit::Atom(atom) => self.atom(self.plan.atoms[atom]),
        }
    }

    fn atom(&mut self, atom: Atom) -> Value {
        let quantity = |sequencer: &Self, id| sequencer.known[&Unit::Quantity(id)];
        match atom {
            Atom::Value(id) => quantity(self, id),
            Atom::Sqrt(id) => self.push(Operation::Sqrt(quantity(self, id))),
            Atom::ReciprocalSqrt(id) => self.push(Operation::ReciprocalSqrt(quantity(self, id))),
            Atom::Root(id, order) => self.push(Operation::Root(quantity(self, id), order)),
            Atom::Power(base, exponent) => {
                let log = self.push(Operation::Call(Function::Log, quantity(self, base)));
                let product = self.push(Operation::Product(log, quantity(self, exponent)));
                self.push(Operation::Call(Function::Exp, product))
            }
            Atom::Inverse(inner) => {
                let one = self.one();
                self.push(Operation::Quotient(one, self.known[&Unit::Atom(inner)]))
            }
            Atom::Pair(a, b) => {
                let mut factors = std::collections::BTreeMap::from([(a, 1)]);
                *factors.entry(b).or_insert(0) += 1;
                self.product(&Product { negative: false, factors })
            }
            Atom::Scale(_) | Atom::Shrink(_) => unreachable!("no unit needs an integer as a value"),
        }
    }

    /// A sum whose parts are replaced by common ones may have a single part.
    fn sum(&mut self, parts: Vec<(bool, Value)>) -> Value {
        match parts[..] {
            [(false, part)] => part,
            [(true, part)] => self.push(Operation::Negate(part)),
            _ => self.push(Operation::Sum(parts)),
        }
    }

    /// ± numerator / denominator; integers are multiplied in place as soon as there is an intermediate value.
    fn product(&mut self, product: &Product) -> Value {
        let mut factors = Vec::new();
        let mut integers = Vec::new();
        let mut denominators = Vec::new();
        for (atom, count) in &product.factors {
            match self.plan.atoms[*atom] {
                integer @ (Atom::Scale(_) | Atom::Shrink(_)) => integers.push(integer),
                _ => {
                    let power = self.power(self.known[&Unit::Atom(*atom)], count.unsigned_abs());
                    if *count > 0 { factors.push(power) } else { denominators.push(power) }
                }
            }
        }
        let mut factors = factors.into_iter();
        let mut value = match (factors.next(), factors.next()) {
            (Some(a), Some(b)) => self.first_product(a, b, &mut integers),
            (Some(a), None) => a,
            _ => self.one(),
        };
        let mut negative = product.negative;
        for integer in integers {
            value = match integer {
                Atom::Scale(n) => self.push(Operation::Scale(value, signed(n, &mut negative))),
                Atom::Shrink(n) => self.push(Operation::Shrink(value, signed(n, &mut negative))),
                _ => unreachable!("only integers are in this list"),
            };
        }
        for factor in factors {
            value = self.push(Operation::Product(value, factor));
        }
        if let Some(denominator) = denominators.into_iter().reduce(|a, b| self.push(Operation::Product(a, b))) {
            value = self.push(Operation::Quotient(value, denominator));
        }
        if negative { self.push(Operation::Negate(value)) } else { value }
    }

    /// a b; a factor 2 among the integers is used up where that saves an operation.
    fn first_product(&mut self, a: Value, b: Value, integers: &mut Vec<Atom>) -> Value {
        // 2ab is (a + a)b: a sum costs less than a product
        let twice = integers.iter().position(|integer| matches!(integer, Atom::Scale(2)));
        match twice.and_then(|twice| Some((twice, self.first_leaf(a, b)?))) {
            Some((twice, (a, b))) => {
                integers.remove(twice);
                let sum = self.push(Operation::Sum(vec![(false, a), (false, a)]));
                self.push(Operation::Product(sum, b))
            }
            None => self.push(Operation::Product(a, b)),
        }
    }

    /// The two values, first one at a place that is never written, so that it can be an operand twice. Among two such
    /// values the earlier coordinate is first: with vector registers it is in the lane of scalar operations.
    fn first_leaf(&self, a: Value, b: Value) -> Option<(Value, Value)> {
        match (&self.sequence.operations[a], &self.sequence.operations[b]) {
            (Operation::Leaf(one), Operation::Leaf(other)) if other < one => Some((b, a)),
            (Operation::Leaf(_), _) => Some((a, b)),
            (_, Operation::Leaf(_)) => Some((b, a)),
            _ => None,
        }
    }

    /// base^exponent by repeated squaring
    fn power(&mut self, base: Value, exponent: u64) -> Value {
        let mut result = base;
        for bit in (0..exponent.ilog2()).rev() {
            result = self.push(Operation::Product(result, result));
            if exponent >> bit & 1 == 1 {
                result = self.push(Operation::Product(result, base));
            }
        }
        result
    }

    fn one(&mut self) -> Value {
        let one = self.plan.one.expect("the plan has a 1 as soon as there is a denominator");
        self.known[&Unit::Quantity(one)]
    }

    /// The value of an operation; equal operations are one.
    fn push(&mut self, operation: Operation) -> Value {
        if let Some(value) = self.values.get(&operation) {
            return *value;
        }
        self.sequence.operations.push(operation.clone());
        let value = self.sequence.operations.len() - 1;
        self.values.insert(operation, value);
        value
    }
}

/// n, or −n if there is a minus, which is then used up.
fn signed(n: i32, negative: &mut bool) -> i32 {
    if std::mem::take(negative) { -n } else { n }
}
