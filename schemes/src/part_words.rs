//! Order conditions of H = H_1 + … + H_n: words on n letters.
//!
//! A step is a product of the exponentials of the Lie derivatives A, B, C, … of the parts' flows, the exact flow is
//! exp(h (A + B + C + …)). Both are group-like, so the coefficients of Lyndon words decide, as for
//! [two letters](crate::order); the coefficient of a word of m letters in the exact flow is 1/m!.

use std::collections::HashMap;

use crate::symbolic::Rational;

use crate::arithmetic::Arithmetic;
use crate::map::Map;
use crate::map_kind::MapKind;
use crate::order::{Condition, Functional, divided_powers, weighed};

/// A map of a step of n parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PartMap {
    /// The flow of H_1, which the kicks stand for.
    First,
    /// The flow of H_n, which the drifts stand for.
    Last,
    /// The flows of H_2, …, H_(n−1) in this order.
    Ascending,
    /// The same from H_(n−1) to H_2.
    Descending,
}

impl PartMap {
    /// The parts in the order in which they flow, from 0.
    fn parts(self, count: usize) -> Vec<usize> {
        match self {
            PartMap::First => vec![0],
            PartMap::Last => vec![count - 1],
            PartMap::Ascending => (1..count - 1).collect(),
            PartMap::Descending => (1..count - 1).rev().collect(),
        }
    }
}

/// The maps of a step: kicks, drifts, and between them the middle parts.
///
/// # Panics
/// If there are as many middle maps as maps, or a gradient kick.
pub(crate) fn part_maps<V>(maps: impl IntoIterator<Item = (MapKind, V)>, middle: Vec<V>) -> Vec<(PartMap, V)> {
    let mut between = middle.into_iter();
    let mut found = Vec::new();
    for (kind, weight) in maps {
        let (own, next) = match kind {
            MapKind::Kick => (PartMap::First, PartMap::Ascending),
            MapKind::Drift => (PartMap::Last, PartMap::Descending),
            MapKind::GradientKick => unreachable!("steps of many parts have no gradient kicks"),
        };
        found.push((own, weight));
        found.extend(between.next().map(|weight| (next, weight)));
    }
    found
}

/// A word's last letter and the place of the word without it; `None` is the empty word.
struct Prefix {
    last: usize,
    parent: Option<usize>,
}

/// The conditions of orders 1..=`highest` for this number of parts, of low orders first, and their values for a step.
pub(crate) fn conditions<A: Arithmetic>(
    maps: &[(PartMap, A::Value)],
    parts: usize,
    highest: u32,
    arithmetic: &A,
) -> Vec<(Condition, A::Value)> {
    let words = lyndon_words(parts, highest as usize);
    let (prefixes, ends) = prefixes(&words);
    let values = coefficients(maps, (parts, highest as usize), &prefixes, arithmetic);
    let mut conditions: Vec<_> =
        words.iter().zip(ends).map(|(word, end)| (condition(word), values[end].clone())).collect();
    conditions.sort_by_key(|(condition, _)| condition.order);
    conditions
}

/// The coefficients of words on the letters of this number of parts, and of all their prefixes, in the product of the
/// exponentials of a step's maps and of its [middle maps](crate::many_parts).
pub fn prefix_coefficients<A: Arithmetic>(
    (maps, middle): (&[Map], &[Rational]),
    parts: usize,
    words: &[Vec<usize>],
    arithmetic: &A,
) -> HashMap<Vec<usize>, A::Value> {
    let longest = words.iter().map(Vec::len).max().unwrap_or(0);
    let (prefixes, _) = prefixes(words);
    let middle = middle.iter().map(|weight| arithmetic.weight(weight)).collect();
    let values = coefficients(&part_maps(weighed(maps, arithmetic), middle), (parts, longest), &prefixes, arithmetic);
    let mut written: Vec<Vec<usize>> = Vec::new();
    for prefix in &prefixes {
        let before = prefix.parent.map_or(&[][..], |parent| &written[parent]);
        written.push([before, &[prefix.last]].concat());
    }
    written.into_iter().zip(values).collect()
}

/// The coefficients of the prefixes, none longer than `longest`, in the product of the exponentials of the maps.
fn coefficients<A: Arithmetic>(
    maps: &[(PartMap, A::Value)],
    (parts, longest): (usize, usize),
    prefixes: &[Prefix],
    arithmetic: &A,
) -> Vec<A::Value> {
    let mut values = vec![arithmetic.zero(); prefixes.len()];
    for (map, weight) in maps {
        let powers = divided_powers(weight, longest, arithmetic);
        map.parts(parts).into_iter().for_each(|part| multiply(&mut values, prefixes, (part, &powers), arithmetic));
    }
    values
}

/// The coefficients of a product with the exponential of a letter at its end.
fn multiply<A: Arithmetic>(
    values: &mut [A::Value],
    prefixes: &[Prefix],
    (letter, powers): (usize, &[A::Value]),
    arithmetic: &A,
) {
    // children before parents: what is still to be read is not yet changed
    for index in (0..prefixes.len()).rev().filter(|&i| prefixes[i].last == letter) {
        let (mut value, mut end) = (values[index].clone(), Some(index));
        for power in powers {
            let Some(i) = end.filter(|&i| prefixes[i].last == letter) else { break };
            end = prefixes[i].parent;
            match end {
                Some(i) => arithmetic.add_product(&mut value, power, &values[i]),
                None => arithmetic.add_product(&mut value, power, &arithmetic.one()),
            }
        }
        values[index] = value;
    }
}

/// All prefixes of words, parents before children, and the places of the words.
fn prefixes(words: &[Vec<usize>]) -> (Vec<Prefix>, Vec<usize>) {
    let mut prefixes = Vec::new();
    let mut known = HashMap::new();
    let mut place = |word: &Vec<usize>| {
        let end = word.iter().fold(None, |parent, &last| {
            Some(*known.entry((parent, last)).or_insert_with(|| {
                prefixes.push(Prefix { last, parent });
                prefixes.len() - 1
            }))
        });
        end.expect("a word has letters")
    };
    let ends = words.iter().map(&mut place).collect();
    (prefixes, ends)
}

fn condition(word: &[usize]) -> Condition {
    let letters: String = word.iter().map(|&part| letter(part)).collect();
    let factorial = (1..=word.len() as u64).product::<u64>();
    Condition {
        order: word.len() as u32,
        functional: Functional::Named(format!("the word {letters}")),
        needed: Rational::new(1.into(), factorial.into()),
    }
}

/// A for the first part, B for the second, ….
pub fn letter(part: usize) -> char {
    u8::try_from(part).map_or('?', |part| char::from(b'A' + part))
}

/// The Lyndon words on this number of letters, of at most `longest` of them (Duval's algorithm), in lexicographic
/// order.
pub fn lyndon_words(letters: usize, longest: usize) -> Vec<Vec<usize>> {
    let mut words = Vec::new();
    let mut word = vec![0];
    loop {
        words.push(word.clone());
        let period = word.len();
        word = (0..longest).map(|i| word[i % period]).collect();
        while word.last() == Some(&(letters - 1)) {
            word.pop();
        }
        match word.last_mut() {
            Some(last) => *last += 1,
            None => return words,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values are from an independent program: the product of exponentials in the free algebra, in exact fractions
    /// (Python).
    #[test]
    fn coefficients_are_those_of_the_free_algebra() {
        use MapKind::{Drift, Kick};
        let rational = |(n, d): (i64, i64)| Rational::new(n.into(), d.into());
        let step = |maps: &[(MapKind, (i64, i64))], middle: &[(i64, i64)]| {
            let maps = maps.iter().map(|&(kind, weight)| (kind, rational(weight)));
            let maps = part_maps(maps, middle.iter().map(|&weight| rational(weight)).collect());
            conditions(&maps, 3, 4, &crate::arithmetic::ExactArithmetic)
        };
        let leapfrog = step(&[(Kick, (1, 2)), (Drift, (1, 1)), (Kick, (1, 2))], &[(1, 2), (1, 2)]);
        let others = [(Kick, (1, 3)), (Drift, (5, 7)), (Kick, (-2, 5)), (Drift, (1, 9))];
        let others = step(&others, &[(1, 3), (8, 21), (-82, 105)]);
        for (values, word, expected) in [
            (&leapfrog, "AAB", (1, 8)),
            (&leapfrog, "ABC", (1, 4)),
            (&leapfrog, "ACC", (1, 4)),
            (&leapfrog, "BBC", (1, 8)),
            (&others, "ABC", (226, 2025)),
            (&others, "ACB", (-2, 21)),
            (&others, "ABCB", (-2, 63)),
            (&others, "ABAC", (-2, 189)),
            (&others, "AACB", (-1, 63)),
        ] {
            let named =
                |(condition, _): &&(Condition, _)| condition.functional.to_string() == format!("the word {word}");
            assert_eq!(values.iter().find(named).unwrap().1, rational(expected), "{word}");
        }
    }

    #[test]
    fn lyndon_words_are_as_many_as_the_free_lie_algebra_has_dimensions() {
        // Witt's formula for three and four generators
        let counts = |letters, longest| {
            let words = lyndon_words(letters, longest);
            (1..=longest).map(|n| words.iter().filter(|word| word.len() == n).count()).collect::<Vec<_>>()
        };
        assert_eq!(counts(3, 8), [3, 3, 8, 18, 48, 116, 312, 810]);
        assert_eq!(counts(4, 6), [4, 6, 20, 60, 204, 670]);
    }
}
