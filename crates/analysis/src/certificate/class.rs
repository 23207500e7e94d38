//! Classes of Hamiltonians that an order is for, and their conditions.

use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::near_integrable::{self, Power};
use shadowstep_schemes::nystrom::tree_conditions;
use shadowstep_schemes::order::{Condition, Word, lyndon_words, word_conditions};
use shadowstep_schemes::{MapKind, Proved};

/// Orders for a class of Hamiltonians.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Class {
    /// The order for every T(p): Lyndon words.
    EveryKinetic(u32),
    /// The order for T = ½pᵀM⁻¹p: Nyström trees.
    Quadratic(u32),
    /// The orders of the terms of ε, ε², … of H = A + εB, the last one of all higher powers too: Lyndon words by their
    /// letters of B.
    NearIntegrable {
        /// The maps of B.
        perturbation: MapKind,
        /// The orders.
        orders: Vec<u32>,
    },
}

impl Class {
    /// What is proved beside this order for every T(p) and does not follow from it.
    pub(super) fn beside(order: u32, proved: &Proved) -> Vec<Class> {
        let (proof, claim) = (&proved.proof, proved.scheme.table.near_integrable.as_ref());
        let quadratic = proof.quadratic.order;
        let near_integrable = claim.map(|claim| Class::NearIntegrable {
            perturbation: claim.dominant.other(),
            orders: proof.near_integrable.iter().map(|order| order.order).collect(),
        });
        (quadratic > order).then_some(Class::Quadratic(quadratic)).into_iter().chain(near_integrable).collect()
    }

    /// The highest of the orders.
    pub(super) fn highest(&self) -> u32 {
        match self {
            Class::EveryKinetic(order) | Class::Quadratic(order) => *order,
            Class::NearIntegrable { orders, .. } => orders.iter().copied().max().unwrap_or(0),
        }
    }

    /// The conditions and their values at the weights of maps.
    pub(super) fn conditions<A: Arithmetic>(
        &self,
        maps: &[(MapKind, A::Value)],
        arithmetic: &A,
    ) -> Vec<(Condition, A::Value)> {
        match self {
            Class::EveryKinetic(order) => word_conditions(&lyndon_words(*order as usize), maps, arithmetic),
            Class::Quadratic(order) => tree_conditions(maps, *order, arithmetic),
            Class::NearIntegrable { perturbation, orders } => {
                word_conditions(&words(*perturbation, orders), maps, arithmetic)
            }
        }
    }
}

/// The words of all powers of ε.
fn words(perturbation: MapKind, orders: &[u32]) -> Vec<Word> {
    let of_power = |(count, order): (usize, &u32)| {
        near_integrable::words(Power { perturbation, count, or_more: count == orders.len() }, *order)
    };
    let mut words: Vec<_> = (1..).zip(orders).flat_map(of_power).collect();
    words.sort();
    words.dedup();
    words
}
