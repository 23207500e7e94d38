//! Order conditions for every T(p): Lyndon words of the product of exponentials.
//!
//! A step is the product exp(h a_1 K) exp(h b_1 D) exp(h a_2 K) … of the Lie derivatives K of the kick and D of the
//! drift; the exact flow is exp(h (K + D)). Both are group-like elements of the algebra of words in K and D, so they
//! agree up to order n if and only if the coefficients of the Lyndon words of at most n letters agree (the Lyndon
//! words generate the shuffle algebra: Radford 1979; for splitting schemes Murua & Sanz-Serna, Phil. Trans. R. Soc.
//! A 357 (1999) 1079). The coefficient of a word of n letters in the exact flow is 1/n!.
//!
//! A gradient kick is exp(h³ c C) with `C = [K,[D,K]]` = 2KDK − DKK − KKD: a sum of words of three letters in place of
//! a letter.

use std::collections::HashMap;
use std::fmt;

use crate::symbolic::Rational;

use crate::arithmetic::Arithmetic;
use crate::map::Map;
use crate::map_kind::MapKind;

/// An order condition: what a scheme's value must be equal to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The power of h that it concerns.
    pub order: u32,
    /// What has the value.
    pub functional: Functional,
    /// The value needed.
    pub needed: Rational,
}

/// The functional of a scheme that a condition is about, such as a coefficient of the product of its exponentials.
///
/// Displayed as `the word KKD` or `the tree K[D D[K]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Functional {
    /// The coefficient of a Lyndon word in kicks and drifts.
    Word(Word),
    /// Another one, by its name: `the tree K[D D[K]]`.
    Named(String),
}

impl fmt::Display for Functional {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Functional::Word(word) => write!(f, "the word {}", word.iter().copied().map(letter).collect::<String>()),
            Functional::Named(name) => f.write_str(name),
        }
    }
}

/// A word and its place in the tree of prefixes.
struct Prefix {
    last: MapKind,
    /// Index of the word without its last letter; `None` is the empty word.
    parent: Option<usize>,
}

/// A sequence of kicks and drifts, in the order in which they act.
pub type Word = Vec<MapKind>;

/// The conditions of orders 1..=`order` for every T(p) and their values for a sequence of maps.
#[cfg(test)]
pub(crate) fn conditions<A: Arithmetic>(maps: &[Map], order: u32, arithmetic: &A) -> Vec<(Condition, A::Value)> {
    word_conditions(&lyndon_words(order as usize), &weighed(maps, arithmetic), arithmetic)
}

/// The conditions of some words, of low orders first, and their values for maps whose weights are values already.
pub fn word_conditions<A: Arithmetic>(
    words: &[Word],
    maps: &[(MapKind, A::Value)],
    arithmetic: &A,
) -> Vec<(Condition, A::Value)> {
    Words::of(words).conditions(maps, arithmetic)
}

/// Words that were prepared once, for many sequences of maps.
pub struct Words {
    prefixes: Vec<Prefix>,
    /// Of each word, itself among the prefixes; words of few letters first.
    ends: Vec<usize>,
    conditions: Vec<Condition>,
}

impl Words {
    /// Prepares some words.
    pub fn of(words: &[Word]) -> Words {
        let mut sorted: Vec<&Word> = words.iter().collect();
        sorted.sort_by_key(|word| word.len());
        let mut prefixes = Vec::new();
        let ends = sorted.iter().map(|word| insert(&mut prefixes, word)).collect();
        Words { prefixes, ends, conditions: sorted.into_iter().map(|word| condition(word)).collect() }
    }

    /// The conditions of the words, of low orders first, and their values.
    pub fn conditions<A: Arithmetic>(
        &self,
        maps: &[(MapKind, A::Value)],
        arithmetic: &A,
    ) -> Vec<(Condition, A::Value)> {
        let coefficients = self.coefficients(maps, arithmetic);
        self.conditions.iter().cloned().zip(self.ends.iter().map(|&end| coefficients[end].clone())).collect()
    }

    /// The words and all their prefixes; a prefix stands before what it begins.
    pub fn prefixes(&self) -> Vec<Word> {
        let mut written: Vec<Word> = Vec::new();
        for prefix in &self.prefixes {
            let before = prefix.parent.map_or(&[][..], |parent| &written[parent]);
            written.push([before, &[prefix.last]].concat());
        }
        written
    }

    /// The coefficients of the prefixes in the product of the exponentials of the maps.
    pub fn coefficients<A: Arithmetic>(&self, maps: &[(MapKind, A::Value)], arithmetic: &A) -> Vec<A::Value> {
        coefficients(maps, &self.prefixes, arithmetic)
    }
}

fn condition(word: &[MapKind]) -> Condition {
    let factorial = (1..=word.len() as u64).product::<u64>();
    Condition {
        order: word.len() as u32,
        functional: Functional::Word(word.to_vec()),
        needed: Rational::new(1.into(), factorial.into()),
    }
}

/// K for a kick, D for a drift.
pub fn letter(kind: MapKind) -> char {
    match kind {
        MapKind::Kick => 'K',
        MapKind::Drift => 'D',
        MapKind::GradientKick => unreachable!("it is no letter"),
    }
}

/// The coefficients of words and of all their prefixes in the product of the exponentials of the maps.
pub fn prefix_coefficients<A: Arithmetic>(maps: &[Map], words: &[Word], arithmetic: &A) -> HashMap<Word, A::Value> {
    let words = Words::of(words);
    words.prefixes().into_iter().zip(words.coefficients(&weighed(maps, arithmetic), arithmetic)).collect()
}

/// The Lyndon words over K < D of at most `longest` letters (Duval's algorithm), in lexicographic order.
pub fn lyndon_words(longest: usize) -> Vec<Word> {
    let mut words = Vec::new();
    let mut word = vec![MapKind::Kick];
    loop {
        words.push(word.clone());
        let period = word.len();
        word = (0..longest).map(|i| word[i % period]).collect();
        while word.last() == Some(&MapKind::Drift) {
            word.pop();
        }
        match word.last_mut() {
            Some(last) => *last = MapKind::Drift,
            None => return words,
        }
    }
}

/// Adds a word with all its prefixes; parents come before children.
fn insert(prefixes: &mut Vec<Prefix>, word: &[MapKind]) -> usize {
    let mut parent = None;
    for &last in word {
        let known = prefixes.iter().position(|p| p.parent == parent && p.last == last);
        parent = Some(known.unwrap_or_else(|| {
            prefixes.push(Prefix { last, parent });
            prefixes.len() - 1
        }));
    }
    parent.expect("a word has letters")
}

/// The maps with their weights as values.
pub fn weighed<A: Arithmetic>(maps: &[Map], arithmetic: &A) -> Vec<(MapKind, A::Value)> {
    maps.iter().map(|map| (map.kind, arithmetic.weight(&map.weight))).collect()
}

/// The coefficients of the prefixes in the product of the exponentials of the maps.
fn coefficients<A: Arithmetic>(maps: &[(MapKind, A::Value)], prefixes: &[Prefix], arithmetic: &A) -> Vec<A::Value> {
    let longest_run = longest_run(prefixes);
    let (mut values, one) = (vec![arithmetic.zero(); prefixes.len()], arithmetic.one());
    for (kind, weight) in maps {
        if *kind == MapKind::GradientKick {
            multiply_by_gradient_kick(&mut values, prefixes, weight, arithmetic);
            continue;
        }
        let powers = divided_powers(weight, longest_run, arithmetic);
        // children before parents: what is still to be read is not yet changed
        for index in (0..prefixes.len()).rev().filter(|&i| prefixes[i].last == *kind) {
            let (shorter, own) = values.split_at_mut(index);
            let mut ancestor = Some(index);
            for power in &powers {
                let Some(i) = ancestor.filter(|&i| prefixes[i].last == *kind) else { break };
                ancestor = prefixes[i].parent;
                arithmetic.add_product(&mut own[0], power, ancestor.map_or(&one, |i| &shorter[i]));
            }
        }
    }
    values
}

/// The coefficients of a product with exp(c C) at its end: a word ends in k words of C, to which c^k/k! belongs.
fn multiply_by_gradient_kick<A: Arithmetic>(
    values: &mut [A::Value],
    prefixes: &[Prefix],
    weight: &A::Value,
    arithmetic: &A,
) {
    // children before parents: what is still to be read is not yet changed
    for index in (0..prefixes.len()).rev() {
        let (mut value, mut end) = (values[index].clone(), Some(index));
        let (mut factor, mut k) = (arithmetic.one(), 0);
        while let Some((coefficient, before)) = end.and_then(|end| last_word_of_gradient(prefixes, end)) {
            k += 1;
            factor = arithmetic.divide(&arithmetic.product(&factor, weight), k);
            factor = arithmetic.product(&factor, &arithmetic.integer(coefficient));
            match before {
                Some(i) => arithmetic.add_product(&mut value, &factor, &values[i]),
                None => arithmetic.add_product(&mut value, &factor, &arithmetic.one()),
            }
            end = before;
        }
        values[index] = value;
    }
}

/// The coefficient in C = 2KDK − DKK − KKD of the last three letters of a word, and the word before them; `None` where
/// C has no such word.
fn last_word_of_gradient(prefixes: &[Prefix], end: usize) -> Option<(i32, Option<usize>)> {
    let last = &prefixes[end];
    let middle = &prefixes[last.parent?];
    let first = &prefixes[middle.parent?];
    let coefficient = match [first.last, middle.last, last.last] {
        [MapKind::Kick, MapKind::Drift, MapKind::Kick] => 2,
        [MapKind::Drift, MapKind::Kick, MapKind::Kick] | [MapKind::Kick, MapKind::Kick, MapKind::Drift] => -1,
        _ => return None,
    };
    Some((coefficient, first.parent))
}

/// The most letters of one kind that stand together.
fn longest_run(prefixes: &[Prefix]) -> usize {
    let run = |mut index: usize| {
        let mut length = 1;
        while let Some(parent) = prefixes[index].parent.filter(|&p| prefixes[p].last == prefixes[index].last) {
            (index, length) = (parent, length + 1);
        }
        length
    };
    (0..prefixes.len()).map(run).max().unwrap_or(0)
}

/// w, w²/2!, w³/3!, …
pub(crate) fn divided_powers<A: Arithmetic>(weight: &A::Value, count: usize, arithmetic: &A) -> Vec<A::Value> {
    let mut powers = vec![weight.clone()];
    for r in 2..=count as u32 {
        let last = powers.last().expect("the first power is there");
        powers.push(arithmetic.divide(&arithmetic.product(last, weight), r));
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lyndon_words_are_as_many_as_the_free_lie_algebra_has_dimensions() {
        let words = lyndon_words(10);
        let count = |n| words.iter().filter(|w| w.len() == n).count();
        // Witt's formula for two generators
        assert_eq!((1..=10).map(count).collect::<Vec<_>>(), [2, 1, 2, 3, 6, 9, 18, 30, 56, 99]);
    }

    #[test]
    fn each_lyndon_word_is_smaller_than_its_rotations() {
        for word in lyndon_words(8) {
            let letters: Vec<char> = word.iter().map(|k| if *k == MapKind::Kick { 'a' } else { 'b' }).collect();
            for i in 1..letters.len() {
                assert!(letters < [&letters[i..], &letters[..i]].concat(), "{letters:?}");
            }
        }
    }

    use crate::arithmetic::{ExactArithmetic, FixedPoint};
    use crate::map::{Map, Stages};

    fn rationals(fractions: &[(i64, i64)]) -> Vec<Rational> {
        fractions.iter().map(|&(n, d)| Rational::new(n.into(), d.into())).collect()
    }

    /// Weights of no scheme in particular.
    fn any_weights() -> (Vec<Rational>, Vec<Rational>) {
        (rationals(&[(1, 3), (-2, 5), (7, 11), (3, 2)]), rationals(&[(5, 7), (1, 9), (-3, 4), (2, 13)]))
    }

    fn merged(kick: &[Rational], drift: &[Rational]) -> Vec<Map> {
        Stages { kick: kick.to_vec(), gradient_kick: Vec::new(), drift: drift.to_vec() }.maps()
    }

    #[test]
    fn short_words_are_the_sums_that_they_stand_for() {
        let (a, b) = any_weights();
        let values = conditions(&merged(&a, &b), 3, &ExactArithmetic);
        let value = |name: &str| &values.iter().find(|(c, _)| c.functional.to_string() == name).unwrap().1;
        let stages = || 0..a.len();
        let sum = |terms: Vec<Rational>| terms.into_iter().sum::<Rational>();
        let half = Rational::new(1.into(), 2.into());

        assert_eq!(*value("the word K"), sum(a.clone()));
        assert_eq!(*value("the word D"), sum(b.clone()));
        let kd = stages().flat_map(|i| stages().filter(move |j| i <= *j).map(move |j| (i, j)));
        assert_eq!(*value("the word KD"), sum(kd.map(|(i, j)| &a[i] * &b[j]).collect()));
        // KKD: two kicks i < j before a drift k, or one kick twice with 1/2!
        let kkd = stages().flat_map(|k| (0..=k).flat_map(move |j| (0..=j).map(move |i| (i, j, k))));
        let term = |(i, j, k): (usize, usize, usize)| {
            let product = &a[i] * &a[j] * &b[k];
            if i == j { product * &half } else { product }
        };
        assert_eq!(*value("the word KKD"), sum(kkd.map(term).collect()));
    }

    #[test]
    fn fixed_point_keeps_its_bound() {
        let (a, b) = any_weights();
        let maps = merged(&a, &b);
        let fixed = FixedPoint::new(30);
        let exact = conditions(&maps, 8, &ExactArithmetic);
        for ((condition, value), (_, approximate)) in exact.iter().zip(conditions(&maps, 8, &fixed)) {
            let (middle, error) = fixed.read(&approximate);
            let middle = middle.reduced();
            let distance = if middle > *value { &middle - value } else { value - &middle };
            assert!(error >= distance, "{}", condition.functional);
            assert!(
                error < Rational::new(1.into(), 10_i64.pow(18).into()),
                "{}: the bound is of use",
                condition.functional
            );
        }
    }
}
