//! The logarithm of a step, but for the exact flow: the terms of one length, by the coefficients of Lyndon words.
//!
//! A step of order p is exp(h a_1 K) exp(h b_1 D) exp(h a_2 K) … = exp(h (K + D) + h^{p+1} E + …). The product 1 + X of
//! the step and exp(−h (K + D)) begins with p + 1 letters, so of log(1 + X) = X − X²/2 + X³/3 − … few powers have words
//! of a given length.

use std::collections::HashMap;

use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::{Word, Words, lyndon_words};

/// The logarithm of exp(h a_1 K) exp(h b_1 D) … exp(−h (K + D)) at words of one length, prepared for many steps of the
/// same order.
pub(crate) struct Logarithm {
    lyndon: Vec<Word>,
    words: Words,
    /// Of each word with its prefixes, the places of the prefixes, the shortest first, and of the word itself.
    prefixes: Vec<Vec<usize>>,
    /// The places of words.
    places: HashMap<Word, usize>,
    /// X has no words with fewer letters.
    least: usize,
}

impl Logarithm {
    /// That at the Lyndon words of a length, of steps of at least the order `order` for every T(p).
    pub(crate) fn of_length(length: usize, order: usize) -> Logarithm {
        let lyndon: Vec<_> = lyndon_words(length).into_iter().filter(|word| word.len() == length).collect();
        let least = order + 1;
        let words = if length < 2 * least { Words::of(&lyndon) } else { Words::of(&all_words(length)) };
        let places: HashMap<Word, usize> = words.prefixes().into_iter().zip(0..).collect();
        let places_in = |word: &Word| (1..=word.len()).map(|cut| places[&word[..cut]]).collect();
        let prefixes = words.prefixes().iter().map(places_in).collect();
        Logarithm { prefixes, lyndon, words, places, least }
    }

    /// The Lyndon words.
    pub(crate) fn words(&self) -> &[Word] {
        &self.lyndon
    }

    /// The coefficient of each Lyndon word.
    pub(crate) fn of<A: Arithmetic>(&self, maps: &[(MapKind, A::Value)], arithmetic: &A) -> Vec<A::Value> {
        let excess = self.excess(maps, arithmetic);
        self.lyndon.iter().map(|word| self.coefficient(word, &excess, arithmetic)).collect()
    }

    /// The coefficients in X, by Horner's rule: the sum over the cuts of a word of the maps' coefficient of the first
    /// part times the coefficient of the second, of n letters, in exp(−h (K + D)), which is (−1)ⁿ/n!.
    fn excess<A: Arithmetic>(&self, maps: &[(MapKind, A::Value)], arithmetic: &A) -> Vec<A::Value> {
        let (coefficients, minus_one) = (self.words.coefficients(maps, arithmetic), arithmetic.integer(-1));
        let horner = |prefixes: &Vec<usize>| {
            prefixes.iter().zip((1..=prefixes.len() as u32).rev()).fold(arithmetic.one(), |sum, (&prefix, n)| {
                let mut value = coefficients[prefix].clone();
                arithmetic.add_product(&mut value, &minus_one, &arithmetic.divide(&sum, n));
                value
            })
        };
        self.prefixes.iter().map(horner).collect()
    }

    /// The coefficient of a word in log(1 + X).
    fn coefficient<A: Arithmetic>(&self, word: &[MapKind], excess: &[A::Value], arithmetic: &A) -> A::Value {
        let mut sum = excess[self.places[word]].clone();
        for r in 2..=word.len() / self.least {
            let sign = arithmetic.integer(if r % 2 == 1 { 1 } else { -1 });
            let power = self.power(word, r, excess, arithmetic);
            arithmetic.add_product(&mut sum, &sign, &arithmetic.divide(&power, r as u32));
        }
        sum
    }

    /// The coefficient of a word in X^r.
    fn power<A: Arithmetic>(&self, word: &[MapKind], r: usize, excess: &[A::Value], arithmetic: &A) -> A::Value {
        if r == 1 {
            return excess[self.places[word]].clone();
        }
        let mut sum = arithmetic.zero();
        for cut in self.least..(word.len() + 1).saturating_sub(self.least * (r - 1)) {
            let rest = self.power(&word[cut..], r - 1, excess, arithmetic);
            arithmetic.add_product(&mut sum, &excess[self.places[&word[..cut]]], &rest);
        }
        sum
    }
}

/// All words of a length.
fn all_words(length: usize) -> Vec<Word> {
    let letter = |bits: usize, i: usize| if bits >> i & 1 == 0 { MapKind::Kick } else { MapKind::Drift };
    (0..1 << length).map(|bits| (0..length).map(|i| letter(bits, i)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;
    use num_traits::Signed;
    use shadowstep_schemes::arithmetic::FixedPoint;
    use shadowstep_schemes::map::Stages;
    use shadowstep_schemes::order::weighed;
    use shadowstep_schemes::symbolic::Rational;

    use super::*;

    #[test]
    fn logarithms_are_lie_polynomials() {
        let rationals = |values: [(i64, i64); 3]| values.map(|(n, d)| Rational::new(n.into(), d.into())).to_vec();
        // consistent, and of order 1 only, so that squares and cubes of X are needed
        let maps = Stages {
            kick: rationals([(1, 3), (-1, 2), (7, 6)]),
            gradient_kick: rationals([(1, 7), (0, 1), (-2, 9)]),
            drift: rationals([(2, 5), (1, 10), (1, 2)]),
        };
        let arithmetic = FixedPoint::new(60);
        let maps = weighed(&maps.maps(), &arithmetic);
        // the rounding errors of seven letters, far below the coefficients
        let tolerance = BigInt::from(10_000);
        // shorter ones have no powers, and so not all words
        for length in 4..=7 {
            let logarithm = Logarithm::of_length(length, 1);
            let excess = logarithm.excess(&maps, &arithmetic);
            for word in &all_words(length) {
                // reversing the words of a Lie polynomial of an even degree changes its sign
                let backwards: Vec<_> = word.iter().rev().copied().collect();
                let value = |word: &Word| logarithm.coefficient(word, &excess, &arithmetic).units();
                let (value, other) = (value(word), value(&backwards));
                let sum = if length.is_multiple_of(2) { value + other } else { value - other };
                assert!(sum.abs() < tolerance, "{word:?}: {sum}");
            }
        }
    }
}
