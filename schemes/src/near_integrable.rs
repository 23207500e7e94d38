//! Order conditions for near-integrable systems H = A + εB, where the flow of A takes much the larger part.
//!
//! A letter of a word that stands for B brings a factor ε. A scheme has order (p, q, r, …) if its local error is
//! O(ε h^{p+1} + ε² h^{q+1} + ε³ h^{r+1} + …), the last order standing for all higher powers of ε too (McLachlan, BIT
//! 35 (1995) 258; Blanes et al., Appl. Numer. Math. 68 (2013) 58). That is the case if and only if the conditions of
//! the Lyndon words with one B hold up to order p, of those with two up to q, and so on: the shuffle products by which
//! the Lyndon words generate the others keep the number of B's, and their factors have fewer B's and fewer letters, for
//! which no lower orders are claimed. A may be any Hamiltonian, not just a kinetic energy; with gradient kicks, any for
//! which `[B,[A,B]]` has a flow of its own. These count as the words of `[B,[A,B]]`, of ε².

use std::fmt;

use crate::claims::{HIGHEST_LINEAR_ORDER, HIGHEST_NEAR_INTEGRABLE_ORDER, NearIntegrable};
use crate::document::Placed;
use crate::map_kind::MapKind;
use crate::order::{Word, lyndon_words};

/// The words that belong to a power of ε.
#[derive(Clone, Copy, Debug)]
pub struct Power {
    /// The letter of B.
    pub perturbation: MapKind,
    /// How many B's a word has.
    pub count: usize,
    /// Whether words with more B's belong to it too.
    pub or_more: bool,
}

impl Power {
    /// Whether it is ε alone, without higher powers.
    fn is_linear(self) -> bool {
        self.count == 1 && !self.or_more
    }

    /// The highest order that can be claimed and proved.
    pub(crate) fn highest_order(self) -> u32 {
        if self.is_linear() { HIGHEST_LINEAR_ORDER } else { HIGHEST_NEAR_INTEGRABLE_ORDER }
    }
}

/// Displayed as `ε`, `ε^2`, `ε^3 and higher powers`.
impl fmt::Display for Power {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let power = if self.count == 1 { "ε".to_owned() } else { format!("ε^{}", self.count) };
        write!(f, "{power}{}", if self.or_more { " and higher powers" } else { "" })
    }
}

impl NearIntegrable {
    /// The powers of ε, one for each order claimed.
    pub fn powers(&self) -> impl Iterator<Item = (&Placed<u32>, Power)> {
        let perturbation = self.dominant.other();
        let last = self.orders.len();
        (1..)
            .zip(&self.orders)
            .map(move |(count, order)| (order, Power { perturbation, count, or_more: count == last }))
    }
}

/// The words whose conditions belong to a power of ε, up to an order: the sum of the dominant maps, a word without any
/// B, belongs to every power.
pub fn words(power: Power, order: u32) -> Vec<Word> {
    if power.is_linear() {
        return words_with_one(power.perturbation, order as usize);
    }
    let mut words = lyndon_words(order as usize);
    words.retain(|word| {
        let count = word.iter().filter(|kind| **kind == power.perturbation).count();
        count == 0 || count == power.count || power.or_more && count > power.count
    });
    words
}

/// The Lyndon words with one B at most: A alone, and of each length the one whose B stands first or last, as the
/// letters are ordered.
fn words_with_one(perturbation: MapKind, longest: usize) -> Vec<Word> {
    let dominant = perturbation.other();
    let word = |length: usize| {
        let mut word = vec![dominant; length];
        let end = if perturbation < dominant { 0 } else { length - 1 };
        word[end] = perturbation;
        word
    };
    std::iter::once(vec![dominant]).chain((1..=longest).map(word)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_with_one_perturbation_are_those_of_all_words() {
        for perturbation in [MapKind::Kick, MapKind::Drift] {
            let mut all = lyndon_words(9);
            all.retain(|word| word.iter().filter(|kind| **kind == perturbation).count() <= 1);
            let mut found = words(Power { perturbation, count: 1, or_more: false }, 9);
            all.sort();
            found.sort();
            assert_eq!(found, all);
        }
    }
}
