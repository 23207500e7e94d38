//! Which conditions a table's weights must meet, and their values and derivatives.

use std::collections::BTreeSet;

use num_bigint::BigInt;
use num_traits::Zero;
use shadowstep_schemes::symbolic::Rational;

use crate::polish::composition::{self, Word};
use crate::polish::dual::{Dual, Duals};
use crate::polish::unknowns::Model;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::claims::{Kinetic, NearIntegrable};
use shadowstep_schemes::order::{self, Condition, Functional, Words};
use shadowstep_schemes::proof::prove;
use shadowstep_schemes::table::Table;
use shadowstep_schemes::{ExactScheme, near_integrable, nystrom};

/// The conditions, as functions of the weights.
pub(crate) struct Equations {
    step: Conditions,
    /// Those of the processed step, if there is a processor.
    processed: Option<Conditions>,
    /// Whether the cubes of the kicks must sum to 0.
    split_kicks: bool,
}

/// The conditions of the orders that are claimed of a step.
struct Conditions {
    family: Family,
    /// The words of near-integrable orders that are not conditions of the family.
    near_integrable: Option<Words>,
    /// A palindrome meets the conditions of even order if it meets the conditions of odd order.
    odd_only: bool,
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

impl Conditions {
    /// Those of an order and of near-integrable orders, of a step that is a composition of a base with this order, or
    /// no composition.
    fn of(
        (order, kinetic): (u32, Kinetic),
        near_integrable: Option<&NearIntegrable>,
        base_order: Option<u32>,
        odd_only: bool,
    ) -> Conditions {
        let family = match (kinetic, base_order) {
            (Kinetic::Any, Some(base_order)) => {
                let mut words = composition::lyndon_words(base_order, order);
                words.retain(|word| !odd_only || word.iter().sum::<u32>() % 2 == 1);
                Family::Composition(words)
            }
            (Kinetic::Quadratic, _) => Family::Trees(if odd_only { order - (order + 1) % 2 } else { order }),
            (Kinetic::Any, None) => Family::Words(Words::of(&order::lyndon_words(order as usize))),
        };
        let claims = near_integrable.into_iter().flat_map(|claim| claim.powers());
        let words = claims.flat_map(|(order, power)| near_integrable::words(power, order.value));
        // those up to the order are conditions of every T(p) already
        let words = words.filter(|word| kinetic == Kinetic::Quadratic || word.len() > order as usize);
        let words: Vec<_> = words.collect::<BTreeSet<_>>().into_iter().collect();
        let near_integrable = (!words.is_empty()).then(|| Words::of(&words));
        Conditions { family, near_integrable, odd_only }
    }

    /// The conditions and their values, for a composition's γ's, and for maps.
    fn values<A: OfUnknowns>(
        &self,
        gamma: &[A::Value],
        maps: &dyn Fn() -> Vec<(MapKind, A::Value)>,
        arithmetic: &A,
    ) -> Vec<(Condition, A::Value)> {
        let mut found = match &self.family {
            Family::Composition(words) => composition::conditions(words, gamma, arithmetic),
            Family::Words(words) => words.conditions(&maps(), arithmetic),
            Family::Trees(order) => nystrom::tree_conditions(&maps(), *order, arithmetic),
        };
        if let Some(words) = &self.near_integrable {
            found.extend(words.conditions(&maps(), arithmetic));
        }
        found.retain(|(condition, _)| !self.odd_only || condition.order % 2 == 1);
        found
    }
}

impl Equations {
    /// The conditions of the orders that the table claims, and the requested additional one.
    pub(crate) fn of(model: &Model, table: &Table, split_kicks: bool) -> Equations {
        let base_order = model.base.as_ref().and_then(symmetric_order);
        let step = Conditions::of(
            (table.order.value, table.kinetic),
            table.near_integrable.as_ref(),
            base_order,
            model.symmetric,
        );
        let processed = table.processor.as_ref().map(|claim| {
            Conditions::of((claim.order.value, table.kinetic), claim.near_integrable.as_ref(), base_order, false)
        });
        Equations { step, processed, split_kicks }
    }

    /// Whether the conditions are polynomials in the γ's.
    pub(super) fn are_in_gamma(&self) -> bool {
        matches!(self.step.family, Family::Composition(_)) && self.step.near_integrable.is_none()
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
        let mut found = self.step.values(&weights[0], &maps, arithmetic);
        if let Some(processed) = &self.processed {
            let gamma = processed_gamma(model, weights, arithmetic);
            found.extend(processed.values(&gamma, &|| processed_maps(model, weights, arithmetic), arithmetic));
        }
        if self.split_kicks {
            found.push(cubes_of_kicks(&maps(), arithmetic));
        }
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

/// The maps of a step, or of the kernel; a composition's written out, neighbours of one kind merged.
pub(crate) fn maps<A: OfUnknowns>(
    model: &Model,
    weights: &[Vec<A::Value>],
    arithmetic: &A,
) -> Vec<(MapKind, A::Value)> {
    joined(written_out(model, &weights[..model.kernel_lists], arithmetic), arithmetic)
}

/// The maps of the processed step: the inverse of the post-map, the kernel, the post-map.
pub(crate) fn processed_maps<A: OfUnknowns>(
    model: &Model,
    weights: &[Vec<A::Value>],
    arithmetic: &A,
) -> Vec<(MapKind, A::Value)> {
    let (kernel, processor) = weights.split_at(model.kernel_lists);
    let post = written_out(model, processor, arithmetic);
    let pre = post.iter().rev().map(|(kind, weight)| (*kind, negative(weight, arithmetic))).collect::<Vec<_>>();
    joined([pre, written_out(model, kernel, arithmetic), post].concat(), arithmetic)
}

/// The γ's of the processed step of a composition; empty for others, whose conditions are in their maps.
fn processed_gamma<A: Arithmetic>(model: &Model, weights: &[Vec<A::Value>], arithmetic: &A) -> Vec<A::Value> {
    match (&model.base, weights) {
        (Some(_), [kernel, post]) => {
            let pre = post.iter().rev().map(|gamma| negative(gamma, arithmetic));
            pre.chain(kernel.iter().chain(post).cloned()).collect()
        }
        _ => Vec::new(),
    }
}

fn negative<A: Arithmetic>(value: &A::Value, arithmetic: &A) -> A::Value {
    arithmetic.product(value, &arithmetic.integer(-1))
}

/// The maps of lists of weights, one by one.
fn written_out<A: Arithmetic>(model: &Model, lists: &[Vec<A::Value>], arithmetic: &A) -> Vec<(MapKind, A::Value)> {
    let Some(base) = &model.base else {
        let of_stage = |s: usize| {
            let gradient_kick = lists.get(2).map(|list| (MapKind::GradientKick, list[s].clone()));
            [Some((MapKind::Kick, lists[0][s].clone())), gradient_kick, Some((MapKind::Drift, lists[1][s].clone()))]
        };
        return (0..lists[0].len()).flat_map(of_stage).flatten().collect();
    };
    let base = order::weighed(&base.maps(), arithmetic);
    let scaled = |step: &A::Value, (kind, weight): &(MapKind, A::Value)| {
        (*kind, (0..kind.power()).fold(weight.clone(), |weight, _| arithmetic.product(step, &weight)))
    };
    lists[0].iter().flat_map(|step| base.iter().map(|map| scaled(step, map)).collect::<Vec<_>>()).collect()
}

/// Without weights that are 0, neighbours of one kind merged.
fn joined<A: OfUnknowns>(maps: Vec<(MapKind, A::Value)>, arithmetic: &A) -> Vec<(MapKind, A::Value)> {
    let mut joined: Vec<(MapKind, A::Value)> = Vec::new();
    for (kind, weight) in maps {
        match joined.last_mut() {
            _ if arithmetic.is_zero(&weight) => {}
            Some((last, sum)) if *last == kind => arithmetic.add_product(sum, &arithmetic.one(), &weight),
            _ => joined.push((kind, weight)),
        }
    }
    joined
}
