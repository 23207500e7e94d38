//! A basis of the brackets of kick and drift, and the coordinates of a Lie polynomial in it.
//!
//! The brackets are right-nested, [x_1,[x_2,[…,[x_{n−1},x_n]…]]], as the literature writes error terms (Omelyan, Mryglod
//! & Folk, Comput. Phys. Commun. 146 (2002) 188; Blanes & Moan, J. Comput. Appl. Math. 142 (2002) 313). Among those with
//! k letters K and d letters D the basis takes, in the order of a dictionary, each that does not depend on those before
//! it. In the dictionary the letter of which there are more comes first, K where there are as many of both; brackets end
//! in that letter and the other one. So K and D are treated alike: for every odd n the basis is its own image when K and
//! D are exchanged, and a scheme has the same error coefficients whether it begins with a kick or with a drift. Up to
//! n = 5 the brackets are the papers' brackets, up to the order and the sign.
//!
//! For quadratic T a bracket of k kicks and d drifts is a polynomial of degree d − k + 1 in p, so that all with k ≥ d + 2
//! vanish, and with them the ideal that they generate. It is spanned by the right-nested brackets in which some inner
//! bracket vanishes. They come first in the dictionary and their coordinates are dropped.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};
use shadowstep_symbolic::Rational;

use crate::prime::{PRIME, add_multiple, power};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::order::{Word, letter};

/// The bracket [x_1,[x_2,[…,[x_{n−1},x_n]…]]] of the Lie derivatives K of the kick and D of the drift.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bracket(Vec<MapKind>);

impl Bracket {
    /// x_1, …, x_n
    pub fn letters(&self) -> &[MapKind] {
        &self.0
    }

    /// The coefficient of a word of as many letters.
    fn coefficient(&self, word: &[MapKind]) -> i64 {
        // of the innermost letters: what each piece of the word has
        let (last, outer) = self.0.split_last().expect("a bracket has letters");
        let mut pieces: Vec<i64> = word.iter().map(|letter| i64::from(letter == last)).collect();
        for (length, x) in outer.iter().rev().enumerate() {
            let from_left = |s: usize| if word[s] == *x { pieces[s + 1] } else { 0 };
            let from_right = |s: usize| if word[s + length + 1] == *x { pieces[s] } else { 0 };
            pieces = (0..pieces.len() - 1).map(|s| from_left(s) - from_right(s)).collect();
        }
        pieces[0]
    }

    /// Whether some inner bracket, or the whole one, has at least two kicks more than drifts.
    fn vanishes_for_quadratic(&self) -> bool {
        let mut excess = 0;
        self.0.iter().rev().any(|kind| {
            excess += if *kind == MapKind::Kick { 1 } else { -1 };
            excess >= 2
        })
    }
}

impl fmt::Display for Bracket {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (last, outer) = self.0.split_last().expect("a bracket has letters");
        outer.iter().try_for_each(|kind| write!(f, "[{},", letter(*kind)))?;
        write!(f, "{}{}", letter(*last), "]".repeat(outer.len()))
    }
}

/// The coordinates of a Lie polynomial in the basis for a class of kinetic energies. The polynomial is given by its
/// coefficients at all Lyndon words of one length, which determine it.
pub(crate) fn coordinates(lyndon: &[(Word, BigInt)], kinetic: Kinetic) -> Vec<(Bracket, Rational)> {
    let length = lyndon.first().map_or(0, |(word, _)| word.len());
    let kicks = |word: &[MapKind]| word.iter().filter(|kind| **kind == MapKind::Kick).count();
    let mut all = Vec::new();
    for k in (1..length).rev() {
        let (words, values): (Vec<_>, Vec<_>) = lyndon.iter().filter(|(word, _)| kicks(word) == k).cloned().unzip();
        if kinetic == Kinetic::Quadratic && k >= length - k + 2 {
            continue;
        }
        let basis = Basis::known(&words, k, kinetic);
        let stays = |(bracket, _): &(Bracket, _)| kinetic == Kinetic::Any || !bracket.vanishes_for_quadratic();
        all.extend(basis.brackets.iter().cloned().zip(basis.coordinates(&values)).filter(stays));
    }
    all
}

/// A basis of brackets, and its matrix inverted.
struct Basis {
    brackets: Vec<Bracket>,
    /// Integers: for each bracket, what each word's coefficient contributes, times the denominator.
    numerators: Vec<Vec<BigInt>>,
    denominator: BigInt,
}

impl Basis {
    /// The basis of the brackets with k kicks, whose Lyndon words are given; computed once for each k, number of letters and kinetic energy.
    fn known(words: &[Word], k: usize, kinetic: Kinetic) -> Arc<Basis> {
        type Known = BTreeMap<(usize, usize, bool), Arc<Basis>>;
        static KNOWN: Mutex<Known> = Mutex::new(BTreeMap::new());
        let key = (words[0].len(), k, kinetic == Kinetic::Quadratic);
        // not computed under the lock: threads that need others do not wait
        let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(&key).cloned();
        found.unwrap_or_else(|| known().entry(key).or_insert(Arc::new(Basis::of(words, k, kinetic))).clone())
    }

    fn of(words: &[Word], k: usize, kinetic: Kinetic) -> Basis {
        let brackets = basis(words, k, words[0].len() - k, kinetic);
        let inverse = inverse(matrix(&brackets, words));
        let denominator = inverse.iter().flatten().fold(BigInt::one(), |lcm, value| lcm.lcm(value.denom()));
        let integer = |value: &Rational| value.numer() * (&denominator / value.denom());
        let numerators = inverse.iter().map(|row| row.iter().map(integer).collect()).collect();
        Basis { brackets, numerators, denominator }
    }

    /// The coordinates of the polynomial with these coefficients at the words.
    fn coordinates(&self, values: &[BigInt]) -> impl Iterator<Item = Rational> {
        self.numerators.iter().map(move |row| {
            let products = row.iter().zip(values).filter(|(factor, _)| !factor.is_zero());
            Rational::new(products.map(|(factor, value)| factor * value).sum(), self.denominator.clone())
        })
    }
}

/// The basis of the brackets with k kicks and d drifts; for quadratic T the basis of the ideal comes first.
fn basis(words: &[Word], k: usize, d: usize, kinetic: Kinetic) -> Vec<Bracket> {
    let mut candidates = candidates(k, d);
    if kinetic == Kinetic::Quadratic {
        candidates.sort_by_key(|bracket| !bracket.vanishes_for_quadratic());
    }
    let mut echelon = Echelon::default();
    candidates.retain(|bracket| {
        let row = words.iter().map(|word| bracket.coefficient(word).rem_euclid(PRIME as i64) as u64).collect();
        echelon.rows.len() < words.len() && echelon.extend(row)
    });
    // rows that are independent modulo a prime are independent; the count shows that none was lost
    assert_eq!(candidates.len(), words.len(), "right-nested brackets span");
    candidates
}

/// The right-nested brackets with k kicks and d drifts that end in the more frequent letter and the other one, in the
/// order of the dictionary.
fn candidates(k: usize, d: usize) -> Vec<Bracket> {
    let more = if k >= d { MapKind::Kick } else { MapKind::Drift };
    let (mores, others) = (k.max(d) - 1, k.min(d) - 1);
    let mut found = Vec::new();
    grow(more, mores, others, &mut Vec::new(), &mut found);
    found
}

fn grow(more: MapKind, mores: usize, others: usize, letters: &mut Vec<MapKind>, found: &mut Vec<Bracket>) {
    if mores == 0 && others == 0 {
        found.push(Bracket([&letters[..], &[more, more.other()]].concat()));
    }
    for (kind, left) in [(more, mores), (more.other(), others)] {
        if left > 0 {
            letters.push(kind);
            grow(more, mores - usize::from(kind == more), others - usize::from(kind != more), letters, found);
            letters.pop();
        }
    }
}

/// Rows modulo a prime, each with 1 at its pivot.
#[derive(Default)]
struct Echelon {
    rows: Vec<(usize, Vec<u64>)>,
}

impl Echelon {
    /// Takes a row if it does not depend on those that are here.
    fn extend(&mut self, mut row: Vec<u64>) -> bool {
        for (pivot, known) in &self.rows {
            let factor = PRIME - row[*pivot];
            add_multiple(&mut row, factor, known);
        }
        let Some(pivot) = row.iter().position(|value| *value != 0) else { return false };
        let mut scaled = vec![0; row.len()];
        add_multiple(&mut scaled, power(row[pivot], PRIME - 2), &row);
        self.rows.push((pivot, scaled));
        true
    }
}

/// A row for each word, a column for each bracket.
fn matrix(brackets: &[Bracket], words: &[Word]) -> Vec<Vec<Rational>> {
    let integer = |n: i64| Rational::from_integer(BigInt::from(n));
    words.iter().map(|word| brackets.iter().map(|bracket| integer(bracket.coefficient(word))).collect()).collect()
}

/// The inverse of a regular matrix, exactly.
fn inverse(mut matrix: Vec<Vec<Rational>>) -> Vec<Vec<Rational>> {
    let size = matrix.len();
    for (i, row) in matrix.iter_mut().enumerate() {
        row.extend((0..size).map(|j| if i == j { Rational::one() } else { Rational::zero() }));
    }
    for column in 0..size {
        let pivot = (column..size).find(|&row| !matrix[row][column].is_zero()).expect("a basis has a regular matrix");
        matrix.swap(column, pivot);
        let factor = matrix[column][column].recip();
        matrix[column].iter_mut().filter(|value| !value.is_zero()).for_each(|value| *value *= &factor);
        let pivot = matrix[column].clone();
        for (_, row) in matrix.iter_mut().enumerate().filter(|(row, _)| *row != column) {
            let factor = row[column].clone();
            if !factor.is_zero() {
                let places = row.iter_mut().zip(&pivot).filter(|(_, pivot)| !pivot.is_zero());
                places.for_each(|(value, pivot)| *value -= &factor * pivot);
            }
        }
    }
    matrix.into_iter().map(|mut row| row.split_off(size)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::order::lyndon_words;

    fn size_of_basis(length: usize, kinetic: Kinetic) -> usize {
        let words = lyndon_words(length).into_iter().filter(|word| word.len() == length);
        coordinates(&words.map(|word| (word, BigInt::zero())).collect::<Vec<_>>(), kinetic).len()
    }

    #[test]
    fn the_basis_is_as_large_as_the_space() {
        // Witt's formula for two generators
        assert_eq!((2..=9).map(|n| size_of_basis(n, Kinetic::Any)).collect::<Vec<_>>(), [1, 2, 3, 6, 9, 18, 30, 56]);
        // the Lie algebra of classical mechanics: McLachlan & Ryland, J. Math. Phys. 44 (2003) 3071
        let quadratic = (2..=9).map(|n| size_of_basis(n, Kinetic::Quadratic)).collect::<Vec<_>>();
        assert_eq!(quadratic, [1, 2, 2, 4, 5, 10, 14, 25]);
    }

    #[test]
    fn brackets_multiply_out_to_their_words() {
        use MapKind::{Drift as D, Kick as K};
        // [K,[D,K]] = KDK − KKD − DKK + KDK
        let bracket = Bracket(vec![K, D, K]);
        assert_eq!(bracket.to_string(), "[K,[D,K]]");
        let coefficients = [[K, D, K], [K, K, D], [D, K, K], [D, K, D]].map(|word| bracket.coefficient(&word));
        assert_eq!(coefficients, [2, -1, -1, 0]);
    }

    #[test]
    fn exchanged_letters_give_the_same_basis_of_odd_length() {
        let exchanged = |bracket: Bracket| Bracket(bracket.0.iter().map(|kind| kind.other()).collect());
        let basis_of = |k: usize, d: usize| {
            let count = |word: &Word| word.iter().filter(|kind| **kind == MapKind::Kick).count();
            let words: Vec<_> = lyndon_words(7).into_iter().filter(|w| w.len() == 7 && count(w) == k).collect();
            basis(&words, k, d, Kinetic::Any)
        };
        for k in 1..=6 {
            let other: Vec<_> = basis_of(7 - k, k).into_iter().map(exchanged).collect();
            assert_eq!(basis_of(k, 7 - k), other);
        }
    }
}
