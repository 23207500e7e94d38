//! A basis of the brackets of kick and drift, and the coordinates of a Lie polynomial in it.
//!
//! The brackets are right-nested, [x_1,[x_2,[…,[x_{n−1},x_n]…]]], as the literature writes error terms (Omelyan,
//! Mryglod & Folk, Comput. Phys. Commun. 146 (2002) 188; Blanes & Moan, J. Comput. Appl. Math. 142 (2002) 313). Among
//! those with k letters K and d letters D the basis takes, in the order of a dictionary, each that does not depend on
//! those before it. In the dictionary the letter of which there are more comes first, K where there are as many of
//! both; brackets end in that letter and the other one. So K and D are treated alike: for every odd n the basis is its
//! own image when K and D are exchanged, and a scheme has the same error coefficients whether it begins with a kick or
//! with a drift. Up to n = 5 the brackets are the papers' brackets, up to the order and the sign.
//!
//! For quadratic T a bracket of k kicks and d drifts is a polynomial of degree d − k + 1 in p, so that all with k ≥ d +
//! 2 vanish, and with them the ideal that they generate. It is spanned by the right-nested brackets in which some inner
//! bracket vanishes. They come first in the dictionary and their coordinates are dropped.

use std::collections::BTreeMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};
use shadowstep_schemes::symbolic::Rational;

use crate::prime::{PRIME, add_multiple, power};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::order::letter;
use shadowstep_schemes::part_words;

/// A letter of brackets: the Lie derivative of the kick or the drift, or that of one of many parts, by its number.
pub trait Letter: Copy + Ord + Hash {
    /// How it is written.
    fn symbol(self) -> char;

    /// 1 for a kick, −1 for a drift, 0 for one of many parts.
    fn excess(self) -> i64;

    /// Its place among the letters.
    fn number(self) -> usize;

    /// The letter with this place.
    fn numbered(number: usize) -> Self;
}

impl Letter for MapKind {
    fn symbol(self) -> char {
        letter(self)
    }

    fn excess(self) -> i64 {
        if self == MapKind::Kick { 1 } else { -1 }
    }

    fn number(self) -> usize {
        usize::from(self != MapKind::Kick)
    }

    fn numbered(number: usize) -> Self {
        if number == 0 { MapKind::Kick } else { MapKind::Drift }
    }
}

impl Letter for usize {
    fn symbol(self) -> char {
        part_words::letter(self)
    }

    fn excess(self) -> i64 {
        0
    }

    fn number(self) -> usize {
        self
    }

    fn numbered(number: usize) -> Self {
        number
    }
}

/// The bracket [x_1,[x_2,[…,[x_{n−1},x_n]…]]] of Lie derivatives: K of the kick and D of the drift, or A, B, C, … of
/// many parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bracket<L = MapKind>(Vec<L>);

impl<L: Letter> Bracket<L> {
    /// x_1, …, x_n
    pub fn letters(&self) -> &[L] {
        &self.0
    }

    /// The coefficient of a word of as many letters.
    fn coefficient(&self, word: &[L]) -> i64 {
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
        self.0.iter().rev().any(|letter| {
            excess += letter.excess();
            excess >= 2
        })
    }
}

impl<L: Letter> fmt::Display for Bracket<L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (last, outer) = self.0.split_last().expect("a bracket has letters");
        outer.iter().try_for_each(|letter| write!(f, "[{},", letter.symbol()))?;
        write!(f, "{}{}", last.symbol(), "]".repeat(outer.len()))
    }
}

/// Words with their coefficients.
type Values<L> = (Vec<Vec<L>>, Vec<BigInt>);

/// The coordinates of a Lie polynomial in the basis for a class of kinetic energies. The polynomial is given by its
/// coefficients at all Lyndon words of one length, which determine it.
pub(crate) fn coordinates<L: Letter>(lyndon: &[(Vec<L>, BigInt)], kinetic: Kinetic) -> Vec<(Bracket<L>, Rational)> {
    // by the letters that words have, those with more of the first letter first
    let mut by_letters: BTreeMap<Vec<L>, Values<L>> = BTreeMap::new();
    for (word, value) in lyndon {
        let mut letters = word.clone();
        letters.sort();
        let (words, values) = by_letters.entry(letters).or_default();
        words.push(word.clone());
        values.push(value.clone());
    }
    let mut all = Vec::new();
    for (letters, (words, values)) in by_letters {
        if kinetic == Kinetic::Quadratic && letters.iter().map(|letter| letter.excess()).sum::<i64>() >= 2 {
            continue;
        }
        let basis = Basis::known(&words, &letters, kinetic);
        let brackets = basis.brackets.iter().map(|bracket| Bracket(bracket.iter().map(|&n| L::numbered(n)).collect()));
        let stays = |(bracket, _): &(Bracket<L>, _)| kinetic == Kinetic::Any || !bracket.vanishes_for_quadratic();
        all.extend(brackets.zip(basis.coordinates(&values)).filter(stays));
    }
    all
}

/// A basis of brackets, and its matrix inverted.
struct Basis {
    /// The numbers of their letters.
    brackets: Vec<Vec<usize>>,
    /// Integers: for each bracket, what each word's coefficient contributes, times the denominator.
    numerators: Vec<Vec<BigInt>>,
    denominator: BigInt,
}

impl Basis {
    /// The basis of the brackets with these letters, whose Lyndon words are given; computed once for the letters and
    /// the kinetic energy.
    fn known<L: Letter>(words: &[Vec<L>], letters: &[L], kinetic: Kinetic) -> Arc<Basis> {
        type Known = BTreeMap<(Vec<usize>, bool), Arc<Basis>>;
        static KNOWN: Mutex<Known> = Mutex::new(BTreeMap::new());
        let key = (letters.iter().map(|letter| letter.number()).collect(), kinetic == Kinetic::Quadratic);
        // not computed under the lock: threads that need others do not wait
        let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        let found = known().get(&key).cloned();
        found.unwrap_or_else(|| known().entry(key).or_insert(Arc::new(Basis::of(words, letters, kinetic))).clone())
    }

    fn of<L: Letter>(words: &[Vec<L>], letters: &[L], kinetic: Kinetic) -> Basis {
        let brackets = basis(words, letters, kinetic);
        let inverse = inverse(matrix(&brackets, words));
        let denominator = inverse.iter().flatten().fold(BigInt::one(), |lcm, value| lcm.lcm(value.denom()));
        let integer = |value: &Rational| value.numer() * (&denominator / value.denom());
        let numerators = inverse.iter().map(|row| row.iter().map(integer).collect()).collect();
        let numbers = |bracket: &Bracket<L>| bracket.0.iter().map(|letter| letter.number()).collect();
        Basis { brackets: brackets.iter().map(numbers).collect(), numerators, denominator }
    }

    /// The coordinates of the polynomial with these coefficients at the words.
    fn coordinates(&self, values: &[BigInt]) -> impl Iterator<Item = Rational> {
        self.numerators.iter().map(move |row| {
            let products = row.iter().zip(values).filter(|(factor, _)| !factor.is_zero());
            Rational::new(products.map(|(factor, value)| factor * value).sum(), self.denominator.clone())
        })
    }
}

/// The basis of the brackets with these letters; for quadratic T the basis of the ideal comes first.
fn basis<L: Letter>(words: &[Vec<L>], letters: &[L], kinetic: Kinetic) -> Vec<Bracket<L>> {
    let mut candidates = candidates(letters);
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

/// The right-nested brackets with these letters that end in the least frequent one, in the order of the dictionary in
/// which the most frequent letters come first: the ideal of a letter is spanned by the brackets that end in it.
fn candidates<L: Letter>(letters: &[L]) -> Vec<Bracket<L>> {
    let mut counts: Vec<(L, usize)> = Vec::new();
    for &letter in letters {
        match counts.iter_mut().find(|(known, _)| *known == letter) {
            Some((_, count)) => *count += 1,
            None => counts.push((letter, 1)),
        }
    }
    // of letters that are as frequent the first in the alphabet stays first
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let last = counts.last_mut().expect("a bracket has letters");
    last.1 -= 1;
    let last = last.0;
    let mut found = Vec::new();
    grow(&mut counts, last, &mut Vec::new(), &mut found);
    found
}

fn grow<L: Letter>(counts: &mut [(L, usize)], last: L, outer: &mut Vec<L>, found: &mut Vec<Bracket<L>>) {
    let mut is_whole = true;
    for place in 0..counts.len() {
        let (letter, count) = counts[place];
        if count > 0 {
            is_whole = false;
            counts[place].1 -= 1;
            outer.push(letter);
            grow(counts, last, outer, found);
            outer.pop();
            counts[place].1 += 1;
        }
    }
    // [x,x] is 0
    if is_whole && outer.last() != Some(&last) {
        found.push(Bracket([&outer[..], &[last]].concat()));
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
fn matrix<L: Letter>(brackets: &[Bracket<L>], words: &[Vec<L>]) -> Vec<Vec<Rational>> {
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
    use shadowstep_schemes::order::{Word, lyndon_words};

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
    fn the_basis_of_many_parts_is_as_large_as_the_space() {
        let size = |parts: usize, length: usize| {
            let words = part_words::lyndon_words(parts, length).into_iter().filter(|word| word.len() == length);
            coordinates(&words.map(|word| (word, BigInt::zero())).collect::<Vec<_>>(), Kinetic::Any).len()
        };
        // Witt's formula
        assert_eq!((2..=6).map(|n| size(3, n)).collect::<Vec<_>>(), [3, 8, 18, 48, 116]);
        assert_eq!((2..=5).map(|n| size(4, n)).collect::<Vec<_>>(), [6, 20, 60, 204]);
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
            let letters = [vec![MapKind::Kick; k], vec![MapKind::Drift; d]].concat();
            basis(&words, &letters, Kinetic::Any)
        };
        for k in 1..=6 {
            let other: Vec<_> = basis_of(7 - k, k).into_iter().map(exchanged).collect();
            assert_eq!(basis_of(k, 7 - k), other);
        }
    }
}
