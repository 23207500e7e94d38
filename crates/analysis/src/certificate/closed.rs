//! The weights of a scheme whose cells are closed forms with roots, as polynomials in these.

use std::collections::BTreeMap;

use num_traits::{One, Signed, ToPrimitive, Zero};
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::symbolic::{Expression, ExpressionKind, Operation, evaluate, parse};
use shadowstep_schemes::table::{Cell, Table, Weights};
use shadowstep_schemes::{ExactScheme, MapKind, Rational};

use crate::certificate::ring::{Polynomial, Ring, constant};

/// The largest exponent of a root in a formula.
const LARGEST_POWER: u32 = 60;

/// Kicks and drifts in their order, neighbours of one kind merged; `None` where a cell is not made of roots, or there
/// are gradient kicks.
pub(super) fn maps(scheme: &ExactScheme, ring: &Ring) -> Option<Vec<(MapKind, Polynomial)>> {
    let mut maps: Vec<(MapKind, Polynomial)> = Vec::new();
    for (kick, drift) in stages(scheme, ring)? {
        for (kind, weight) in [(MapKind::Kick, kick), (MapKind::Drift, drift)] {
            match maps.last_mut() {
                _ if weight.is_empty() => {}
                Some((last, sum)) if *last == kind => *sum = Ring::sum(sum, &weight, &Rational::one()),
                _ => maps.push((kind, weight)),
            }
            if maps.last().is_some_and(|(_, weight)| weight.is_empty()) {
                maps.pop();
            }
        }
    }
    Some(maps)
}

/// Kicks and drifts of all stages.
fn stages(scheme: &ExactScheme, ring: &Ring) -> Option<Vec<(Polynomial, Polynomial)>> {
    let cells = Cells::of(&scheme.table, ring)?;
    match scheme.table.weights.as_ref()? {
        Weights::Stages { gradient_kick: Some(_), .. } => None,
        Weights::Stages { kick, drift, .. } => {
            let (kick, drift) = (cells.list(&kick.value)?, cells.list(&drift.value)?);
            Some(kick.into_iter().zip(drift).collect())
        }
        Weights::Composition { gamma, .. } => {
            let base = stages(scheme.base.as_deref()?, ring)?;
            let gamma = cells.list(&gamma.value)?;
            let scaled = |g: Polynomial| {
                base.iter().map(move |(a, b)| (ring.product(&g, a), ring.product(&g, b))).collect::<Vec<_>>()
            };
            Some(gamma.into_iter().flat_map(scaled).collect())
        }
    }
}

/// The cells of a table, with the values of its constants.
struct Cells<'a> {
    ring: &'a Ring,
    known: BTreeMap<String, Polynomial>,
}

impl Cells<'_> {
    fn of<'a>(table: &Table, ring: &'a Ring) -> Option<Cells<'a>> {
        let mut cells = Cells { ring, known: BTreeMap::new() };
        for (name, cell) in &table.constants {
            let value = cells.cell(cell)?;
            cells.known.insert(name.value.clone(), value);
        }
        Some(cells)
    }

    fn list(&self, cells: &[Cell]) -> Option<Vec<Polynomial>> {
        cells.iter().map(|cell| self.cell(cell)).collect()
    }

    fn cell(&self, cell: &Cell) -> Option<Polynomial> {
        self.value(&parse(&cell.value).ok()?)
    }

    fn value(&self, expression: &Expression) -> Option<Polynomial> {
        // what is rational needs no root
        if let Ok(exact) = evaluate(expression, &BTreeMap::new(), 30)
            && !exact.rounded
        {
            return Some(constant(exact.value));
        }
        let ring = self.ring;
        match &expression.kind {
            ExpressionKind::Number(value) => Some(constant(value.clone())),
            ExpressionKind::Name(name) => self.known.get(name).cloned(),
            ExpressionKind::Negate(inner) => {
                Some(Ring::sum(&Polynomial::new(), &self.value(inner)?, &-Rational::one()))
            }
            ExpressionKind::Binary(Operation::Power, base, exponent) => {
                let exponent = self.value(exponent)?;
                let exponent = if exponent.is_empty() {
                    Rational::zero()
                } else {
                    exponent.get(&Vec::new()).filter(|_| exponent.len() == 1)?.clone()
                };
                self.power(self.value(base)?, &exponent)
            }
            ExpressionKind::Binary(operation, left, right) => {
                let (left, right) = (self.value(left)?, self.value(right)?);
                match operation {
                    Operation::Add => Some(Ring::sum(&left, &right, &Rational::one())),
                    Operation::Subtract => Some(Ring::sum(&left, &right, &-Rational::one())),
                    Operation::Multiply => Some(ring.product(&left, &right)),
                    Operation::Divide => Some(ring.product(&left, &ring.inverse(&right)?)),
                    Operation::Power => None,
                }
            }
            ExpressionKind::Call { function, arguments } => {
                let root = match function.as_str() {
                    "sqrt" => 2,
                    "cbrt" => 3,
                    _ => return None,
                };
                let [argument] = arguments.as_slice() else { return None };
                self.power(self.value(argument)?, &Rational::new(1.into(), root.into()))
            }
        }
    }

    fn power(&self, base: Polynomial, exponent: &Rational) -> Option<Polynomial> {
        let small = |n: Option<u32>| n.filter(|n| *n <= LARGEST_POWER);
        let (numerator, denominator) = (small(exponent.numer().abs().to_u32())?, small(exponent.denom().to_u32())?);
        let root = if denominator == 1 { base } else { self.ring.root(denominator, base)? };
        let power = self.ring.power(&root, numerator);
        if exponent.is_negative() { self.ring.inverse(&power) } else { Some(power) }
    }
}
