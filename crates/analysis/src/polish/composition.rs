//! Order conditions of compositions of a symmetric scheme, in the γ's alone.
//!
//! A symmetric scheme of order p, run with the step γh, is exp(γh Y₁ + (γh)^(p+1) Y_(p+1) + (γh)^(p+3) Y_(p+3) + …),
//! where Y₁ is the whole motion and the others are its errors. The composition agrees with exp(hY₁) up to order n if
//! and only if the coefficients of the Lyndon words in these letters agree whose degrees add up to at most n: 1 for the
//! word Y₁, 0 for the others. They are far fewer than the words in kicks and drifts: up to order 10, 16 of odd degree,
//! which a palindrome needs only (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151; Murua & Sanz-Serna 1999).

use num_traits::{One, Zero};
use shadowstep_schemes::symbolic::Rational;

use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::{Condition, Functional};

/// A word, each letter given by its degree.
pub(crate) type Word = Vec<u32>;

/// The Lyndon words of degree at most `order` in the letters of a symmetric base of order `base_order`.
pub(crate) fn lyndon_words(base_order: u32, order: u32) -> Vec<Word> {
    let letters: Vec<u32> = (1..=order).filter(|&d| d == 1 || (d > base_order && d % 2 == 1)).collect();
    let mut words = Vec::new();
    grow(&letters, order, &mut Word::new(), &mut words);
    words.retain(is_lyndon);
    words.sort_by_key(|word| word.iter().sum::<u32>());
    words
}

fn grow(letters: &[u32], room: u32, word: &mut Word, found: &mut Vec<Word>) {
    for &letter in letters.iter().filter(|&&letter| letter <= room) {
        word.push(letter);
        found.push(word.clone());
        grow(letters, room - letter, word, found);
        word.pop();
    }
}

fn is_lyndon(word: &Word) -> bool {
    (1..word.len()).all(|i| word.as_slice() < &word[i..])
}

/// The conditions of words and their values for a composition.
pub(crate) fn conditions<A: Arithmetic>(
    words: &[Word],
    gamma: &[A::Value],
    arithmetic: &A,
) -> Vec<(Condition, A::Value)> {
    let prefixes = prefixes(words);
    let mut values = vec![arithmetic.zero(); prefixes.len()];
    let highest = words.iter().map(|word| word.iter().sum::<u32>()).max().unwrap_or(0);
    for step in gamma {
        let powers = powers(step, highest, arithmetic);
        // longer words first: what is still to be read is not yet changed
        for (index, word) in prefixes.iter().enumerate().rev() {
            let mut sum = values[index].clone();
            let (mut degree, mut factorial) = (0, 1);
            for taken in 1..=word.len() {
                degree += word[word.len() - taken];
                factorial *= taken as u32;
                let power = arithmetic.divide(&powers[degree as usize - 1], factorial);
                match prefixes.binary_search_by(|p| by_length(p, &word[..word.len() - taken])) {
                    Ok(parent) => arithmetic.add_product(&mut sum, &power, &values[parent]),
                    Err(_) => arithmetic.add_product(&mut sum, &power, &arithmetic.one()),
                }
            }
            values[index] = sum;
        }
    }
    let found = |word: &Word| prefixes.binary_search_by(|p| by_length(p, word)).expect("a word is its own prefix");
    words.iter().map(|word| (condition(word), values[found(word)].clone())).collect()
}

/// All beginnings of words, shorter ones first.
fn prefixes(words: &[Word]) -> Vec<Word> {
    let mut prefixes: Vec<_> =
        words.iter().flat_map(|word| (1..=word.len()).map(|length| word[..length].to_vec())).collect();
    prefixes.sort_by(|a, b| by_length(a, b));
    prefixes.dedup();
    prefixes
}

fn by_length(a: &[u32], b: &[u32]) -> std::cmp::Ordering {
    a.len().cmp(&b.len()).then_with(|| a.cmp(b))
}

/// γ, γ², …, γ^highest
fn powers<A: Arithmetic>(step: &A::Value, highest: u32, arithmetic: &A) -> Vec<A::Value> {
    let mut powers = vec![step.clone()];
    for _ in 1..highest {
        powers.push(arithmetic.product(&powers[powers.len() - 1], step));
    }
    powers
}

fn condition(word: &Word) -> Condition {
    let letters: Vec<_> = word.iter().map(|degree| format!("Y{degree}")).collect();
    let needed = if *word == [1] { Rational::one() } else { Rational::zero() };
    Condition {
        order: word.iter().sum(),
        functional: Functional::Named(format!("the word {}", letters.join(" "))),
        needed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowstep_schemes::arithmetic::ExactArithmetic;

    fn value(gamma: &[Rational], word: &[u32]) -> Rational {
        conditions(&[word.to_vec()], gamma, &ExactArithmetic).remove(0).1
    }

    #[test]
    fn words_of_odd_degree_are_as_many_as_the_literature_counts() {
        let count = |n| lyndon_words(2, 9).iter().filter(|word| word.iter().sum::<u32>() == n).count();
        // conditions of symmetric compositions: Hairer, Lubich & Wanner, Geometric Numerical Integration, V.3
        assert_eq!([1, 3, 5, 7, 9].map(count), [1, 1, 2, 4, 8]);
        let higher = lyndon_words(4, 9);
        assert!(higher.iter().all(|word| !word.contains(&3)) && higher.contains(&vec![5]));
    }

    #[test]
    fn short_words_are_the_sums_that_they_stand_for() {
        let gamma: Vec<Rational> =
            [(1, 3), (-2, 5), (7, 11)].map(|(n, d): (i64, i64)| Rational::new(n.into(), d.into())).to_vec();
        let cubes = || gamma.iter().map(|g| g * g * g);
        assert_eq!(value(&gamma, &[1]), gamma.iter().sum());
        assert_eq!(value(&gamma, &[3]), cubes().sum());
        // the word Y1 Y3: a Y1 of a step before the Y3 of another, or both of one step with 1/2!
        let half = Rational::new(1.into(), 2.into());
        let before = |i: usize| gamma[..i].iter().sum::<Rational>() + &gamma[i] * &half;
        assert_eq!(value(&gamma, &[1, 3]), cubes().enumerate().map(|(i, cube)| before(i) * cube).sum());
    }
}
