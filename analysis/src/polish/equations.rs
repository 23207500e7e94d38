//! Which conditions a table's weights must meet, and their values and derivatives.

use std::collections::BTreeSet;

use num_bigint::BigInt;
use num_traits::Zero;
use shadowstep_symbolic::Rational;

use crate::polish::composition::{self, Word};
use crate::polish::dual::{Dual, Duals};
use crate::polish::unknowns::Model;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::order::{self, Condition, Functional, Words};
use shadowstep_schemes::proof::prove;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{ExactScheme, near_integrable, nystrom};

/// The conditions, as functions of the weights.
pub(crate) struct Equations {
    family: Family,
    /// The words of near-integrable orders that are not conditions of the family.
    near_integrable: Option<Words>,
    /// A palindrome meets the conditions of even order if it meets the conditions of odd order.
    odd_only: bool,
    /// Whether the cubes of the kicks must sum to 0.
    split_kicks: bool,
}

enum Family {
    /// Words in kicks and drifts, for every T(p).
    Words(Words),
    /// Trees of at most this number of nodes, for quadratic T.
    Trees(u32),
    /// Words in the base's errors, for compositions of a symmetric base.
    Composition(Vec<Word>),
}

/// Arithmetic with weights that are functions of unknowns.
pub(crate) trait OfUnknowns: Arithmetic {
    /// Whether a weight is 0 whatever the unknowns are.
    fn is_zero(&self, weight: &Self::Value) -> bool;
}

impl OfUnknowns for Duals {
    fn is_zero(&self, weight: &Dual) -> bool {
        weight.value.is_zero() && weight.slopes.iter().all(BigInt::is_zero)
    }
}

/// A condition, how far it is from what is needed, and its derivatives along the unknowns.
pub(super) struct Row {
    pub(super) condition: Condition,
    pub(super) off: BigInt,
    pub(super) slopes: Vec<BigInt>,
}

impl Equations {
    /// The conditions of the orders that the table claims, and the requested additional one.
    pub(crate) fn of(model: &Model, table: &Table, split_kicks: bool) -> Equations {
        let (kinetic, order, odd_only) = (table.kinetic, table.order.value, model.symmetric);
        let base_order = model.base.as_ref().and_then(symmetric_order);
        let family = match (kinetic, base_order) {
            (Kinetic::Any, Some(base_order)) => {
                let mut words = composition::lyndon_words(base_order, order);
                words.retain(|word| !odd_only || word.iter().sum::<u32>() % 2 == 1);
                Family::Composition(words)
            }
            (Kinetic::Quadratic, _) => Family::Trees(if odd_only { order - (order + 1) % 2 } else { order }),
            (Kinetic::Any, None) => Family::Words(Words::of(&order::lyndon_words(order as usize))),
        };
        let claims = table.near_integrable.iter().flat_map(|claim| claim.powers());
        let words = claims.flat_map(|(order, power)| near_integrable::words(power, order.value));
        // those up to the order are conditions of every T(p) already
        let words = words.filter(|word| kinetic == Kinetic::Quadratic || word.len() > order as usize);
        let words: Vec<_> = words.collect::<BTreeSet<_>>().into_iter().collect();
        let near_integrable = (!words.is_empty()).then(|| Words::of(&words));
        Equations { family, near_integrable, odd_only, split_kicks }
    }

    /// Whether the conditions are polynomials in the γ's.
    pub(super) fn are_in_gamma(&self) -> bool {
        matches!(self.family, Family::Composition(_)) && self.near_integrable.is_none()
    }

    /// All conditions at weights that are functions of `unknowns` unknowns.
    pub(super) fn rows(&self, model: &Model, weights: &[Vec<Dual>], unknowns: usize, arithmetic: Duals) -> Vec<Row> {
        let row = |(condition, mut dual): (Condition, Dual)| {
            dual.slopes.resize(unknowns, BigInt::zero());
            Row { off: dual.value - arithmetic.units(&condition.needed), condition, slopes: dual.slopes }
        };
        self.values(model, weights, &arithmetic).into_iter().map(row).collect()
    }

    /// All conditions, and their values at some weights.
    pub(crate) fn values<A: OfUnknowns>(
        &self,
        model: &Model,
        weights: &[Vec<A::Value>],
        arithmetic: &A,
    ) -> Vec<(Condition, A::Value)> {
        let maps = || maps(model, weights, arithmetic);
        let mut found = match &self.family {
            Family::Composition(words) => composition::conditions(words, &weights[0], arithmetic),
            Family::Words(words) => words.conditions(&maps(), arithmetic),
            Family::Trees(order) => nystrom::tree_conditions(&maps(), *order, arithmetic),
        };
        if let Some(words) = &self.near_integrable {
            found.extend(words.conditions(&maps(), arithmetic));
        }
        if self.split_kicks {
            found.push(cubes_of_kicks(&maps(), arithmetic));
        }
        found.retain(|(condition, _)| !self.odd_only || condition.order % 2 == 1);
        found
    }
}

/// The order of a base whose errors are of odd degree only.
fn symmetric_order(base: &ExactScheme) -> Option<u32> {
    base.is_symmetric().then(|| prove(base).general.order).filter(|order| *order >= 2)
}

/// Σ a_s³ = 0
fn cubes_of_kicks<A: Arithmetic>(maps: &[(MapKind, A::Value)], arithmetic: &A) -> (Condition, A::Value) {
    let mut sum = arithmetic.zero();
    for (_, weight) in maps.iter().filter(|(kind, _)| *kind == MapKind::Kick) {
        arithmetic.add_product(&mut sum, &arithmetic.product(weight, weight), weight);
    }
    (
        Condition {
            order: 3,
            functional: Functional::Named("the cubes of the kicks".to_owned()),
            needed: Rational::zero(),
        },
        sum,
    )
}

/// The maps of a step, a composition's written out, neighbours of one kind merged.
pub(crate) fn maps<A: OfUnknowns>(
    model: &Model,
    weights: &[Vec<A::Value>],
    arithmetic: &A,
) -> Vec<(MapKind, A::Value)> {
    let mut maps: Vec<(MapKind, A::Value)> = Vec::new();
    let mut append = |kind, weight: A::Value| match maps.last_mut() {
        _ if arithmetic.is_zero(&weight) => {}
        Some((last, sum)) if *last == kind => arithmetic.add_product(sum, &arithmetic.one(), &weight),
        _ => maps.push((kind, weight)),
    };
    match &model.base {
        None => {
            for (s, (kick, drift)) in weights[0].iter().zip(&weights[1]).enumerate() {
                append(MapKind::Kick, kick.clone());
                if let Some(gradient_kicks) = weights.get(2) {
                    append(MapKind::GradientKick, gradient_kicks[s].clone());
                }
                append(MapKind::Drift, drift.clone());
            }
        }
        Some(base) => {
            let base = order::weighed(&base.maps(), arithmetic);
            for step in &weights[0] {
                for (kind, weight) in &base {
                    let scaled = (0..kind.power()).fold(weight.clone(), |weight, _| arithmetic.product(step, &weight));
                    append(*kind, scaled);
                }
            }
        }
    }
    maps
}
