//! The leading error of a scheme: the terms of lowest order in the logarithm of its step.
//!
//! A step of order p is exp(h a_1 K) exp(h b_1 D) exp(h a_2 K) … = exp(h (K + D) + h^{p+1} E + …), where E is a Lie
//! polynomial of degree p + 1 in K and D. Its coordinates in the basis of [`super::bracket`] are the error coefficients.
//! For quadratic T, E is what is left modulo the ideal of the brackets that vanish; the terms of the logarithm between
//! the order for every T(p) and the order for quadratic T lie in that ideal.

use std::collections::HashMap;

use num_bigint::BigInt;
use shadowstep_symbolic::{Fraction, Rational};

use crate::bracket::{Bracket, coordinates};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::Proved;
use shadowstep_schemes::arithmetic::FixedPoint;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::map::Map;
use shadowstep_schemes::order::{Word, lyndon_words, prefix_coefficients};

/// Digits behind the point of the words' coefficients. They are about 1e-8 or larger before the coefficients of the exact flow
/// are subtracted, and the difference is needed to the 16 digits of f64.
const DIGITS: u32 = 60;

/// Coefficients below this are not distinguished from 0: some digits above the words' coefficients' last.
const RESOLVED: f64 = 1e-50;

/// The leading error for one class of kinetic energies.
#[derive(Clone, Debug, PartialEq)]
pub struct LeadingError {
    /// The power of h in the logarithm of the step: the order + 1.
    pub power: u32,
    /// The brackets of the basis with their coefficients, those with more kicks first.
    pub terms: Vec<(Bracket, f64)>,
}

impl LeadingError {
    /// The leading errors of a scheme for every T(p) and for quadratic T; of a processed scheme those of its kernel.
    pub fn of(proved: &Proved) -> [LeadingError; 2] {
        LeadingError::of_maps(
            &proved.scheme.maps(),
            [Kinetic::Any, Kinetic::Quadratic].map(|of| proved.proof.for_kinetic(of).order),
        )
    }

    /// The same of the processed step χ⁻¹ ∘ kernel ∘ χ; `None` for a scheme that is not processed.
    pub fn processed(proved: &Proved) -> Option<[LeadingError; 2]> {
        let (maps, effective) = (proved.scheme.processed_maps()?, proved.proof.effective.as_ref()?);
        Some(LeadingError::of_maps(&maps, [Kinetic::Any, Kinetic::Quadratic].map(|of| effective.for_kinetic(of).order)))
    }

    /// Of a step of these orders for every T(p) and for quadratic T.
    fn of_maps(maps: &[Map], orders: [u32; 2]) -> [LeadingError; 2] {
        let arithmetic = FixedPoint::new(DIGITS);
        let unit = arithmetic.unit();
        // not reduced, which would take as long as all the rest
        let value = |units: Rational| resolved(Fraction::new(units.numer().clone(), units.denom() * &unit).to_f64());
        let mut lyndon = (0, Vec::new());
        [(Kinetic::Any, orders[0]), (Kinetic::Quadratic, orders[1])].map(|(kinetic, order)| {
            let power = order + 1;
            if lyndon.0 != power {
                lyndon = (power, logarithm(maps, power as usize, orders[0] as usize, &arithmetic));
            }
            let terms = coordinates(&lyndon.1, kinetic).into_iter().map(|(bracket, units)| (bracket, value(units)));
            LeadingError { power, terms: terms.collect() }
        })
    }

    /// The Euclidean norm of the coefficients.
    pub fn norm(&self) -> f64 {
        self.terms.iter().map(|(_, c)| c * c).sum::<f64>().sqrt()
    }

    /// The effective error s·‖E‖^{1/p} of a scheme of order p with s evaluations of the gradient a step.
    ///
    /// At a given cost a scheme with half of another's effective error and the same order makes 2^p times smaller
    /// errors, as far as the leading term goes (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151).
    pub fn effective(&self, evaluations: usize) -> f64 {
        evaluations as f64 * self.norm().powf(1.0 / f64::from(self.power - 1))
    }
}

/// A coefficient that the digits do not distinguish from 0 is 0.
fn resolved(coefficient: f64) -> f64 {
    if coefficient.abs() < RESOLVED { 0.0 } else { coefficient }
}

/// The coefficients of the logarithm of exp(h a_1 K) exp(h b_1 D) … exp(−h (K + D)) at the Lyndon words of a length, in
/// units of the arithmetic. The step has the order `order` for every T(p), so the product is 1 + X where X begins with
/// `order` + 1 letters.
fn logarithm(maps: &[Map], length: usize, order: usize, arithmetic: &FixedPoint) -> Vec<(Word, BigInt)> {
    let lyndon: Vec<_> = lyndon_words(length).into_iter().filter(|word| word.len() == length).collect();
    let highest_power = length / (order + 1);
    let words = if highest_power == 1 { lyndon.clone() } else { words(length) };
    let excess = Excess::of(maps, &words, order + 1, arithmetic);
    lyndon.into_iter().map(|word| (word.clone(), excess.logarithm(&word, highest_power))).collect()
}

/// All words of a length.
fn words(length: usize) -> Vec<Word> {
    let letter = |bits: usize, i: usize| if bits >> i & 1 == 0 { MapKind::Kick } else { MapKind::Drift };
    (0..1 << length).map(|bits| (0..length).map(|i| letter(bits, i)).collect()).collect()
}

/// X = exp(h a_1 K) exp(h b_1 D) … exp(−h (K + D)) − 1
struct Excess {
    /// The coefficients of the product of the maps, in units.
    coefficients: HashMap<Word, BigInt>,
    unit: BigInt,
    /// X has no words with fewer letters.
    least: usize,
}

impl Excess {
    fn of(maps: &[Map], words: &[Word], least: usize, arithmetic: &FixedPoint) -> Excess {
        let coefficients = prefix_coefficients(maps, words, arithmetic).into_iter();
        let coefficients = coefficients.map(|(word, value)| (word, value.units())).collect();
        Excess { coefficients, unit: arithmetic.unit(), least }
    }

    /// The coefficient of a word in log(1 + X) = X − X²/2 + X³/3 − …
    fn logarithm(&self, word: &[MapKind], highest_power: usize) -> BigInt {
        let term = |r: usize| {
            let power = self.power(word, r) / r;
            if r % 2 == 1 { power } else { -power }
        };
        (1..=highest_power).map(term).sum()
    }

    /// The coefficient of a word in X^r.
    fn power(&self, word: &[MapKind], r: usize) -> BigInt {
        if r == 1 {
            return self.value(word);
        }
        let cuts = self.least..(word.len() + 1).saturating_sub(self.least * (r - 1));
        cuts.map(|cut| self.value(&word[..cut]) * self.power(&word[cut..], r - 1) / &self.unit).sum()
    }

    /// The coefficient of a word in X, by Horner's rule: the sum over its cuts of the maps' coefficient of the first part times the coefficient of
    /// the second, of n letters, in exp(−h (K + D)), which is (−1)ⁿ/n!.
    fn value(&self, word: &[MapKind]) -> BigInt {
        let mut sum = self.unit.clone();
        for cut in 1..=word.len() {
            sum = &self.coefficients[&word[..cut]] - sum / (word.len() + 1 - cut);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use num_traits::Signed;

    use super::*;
    use shadowstep_schemes::map::Stages;

    #[test]
    fn logarithms_are_lie_polynomials() {
        let rationals = |values: [(i64, i64); 3]| values.map(|(n, d)| Rational::new(n.into(), d.into())).to_vec();
        // consistent, and of order 1 only, so that squares and cubes of X are needed
        let maps = Stages {
            kick: rationals([(1, 3), (-1, 2), (7, 6)]),
            gradient_kick: rationals([(1, 7), (0, 1), (-2, 9)]),
            drift: rationals([(2, 5), (1, 10), (1, 2)]),
        };
        let maps = maps.maps();
        let arithmetic = FixedPoint::new(DIGITS);
        // the rounding errors of seven letters, far below the coefficients
        let tolerance = BigInt::from(10_000);
        for length in 2..=7 {
            let all = words(length);
            let excess = Excess::of(&maps, &all, 2, &arithmetic);
            for word in &all {
                // reversing the words of a Lie polynomial of an even degree changes its sign
                let backwards: Vec<_> = word.iter().rev().copied().collect();
                let (value, other) = (excess.logarithm(word, length / 2), excess.logarithm(&backwards, length / 2));
                let sum = if length.is_multiple_of(2) { value + other } else { value - other };
                assert!(sum.abs() < tolerance, "{word:?}: {sum}");
            }
        }
    }
}
