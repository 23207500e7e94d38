//! The modified Hamiltonian of a step as a series in brackets, by the Baker–Campbell–Hausdorff formula.
//!
//! A step is exp(h a_1 K) exp(h b_1 D) exp(h a_2 K) … of the Lie derivatives K = {·, U} and D = {·, T}, the map that
//! acts first standing first. Its logarithm h (K + D + h E_2 + h² E_3 + …) is the Lie derivative of h H̄, and since
//! [{·, F}, {·, G}] is the Lie derivative of
//!
//! [F, G] = F_pᵀG_q − F_qᵀG_p,
//!
//! H̄ = T + U + h H_2 + h² H_3 + … is the same polynomial in the functions U and T: `K` stands for U, `D` for T,
//! `[K,D]` for −U_qᵀT_p. For parts H = H_1 + H_2 + … the letters A, B, C, … stand for these. Of a symmetric scheme H_2,
//! H_4, … are 0. The series is asymptotic: its terms fall up to a grade that h sets, and grow beyond it.
//!
//! The coefficients are those of the basis of [`bracket`](crate::bracket). Source: E. Hairer, C. Lubich & G. Wanner,
//! Geometric Numerical Integration, III.4, III.5 and IX.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use shadowstep_schemes::arithmetic::FixedPoint;
use shadowstep_schemes::claims::Kinetic;
use shadowstep_schemes::order::{lyndon_words, prefix_coefficients};
use shadowstep_schemes::scheme::Held;
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::{MapKind, NotForManyParts, Proved, part_words};

use crate::bracket::{Bracket, Letter, coordinates};

/// The highest grade that is computed for two parts.
pub const HIGHEST_GRADE: u32 = 10;

/// Exact coefficients are computed with at most this number of bits; where weights are longer, the coefficients are
/// rounded.
const MOST_BITS: u64 = 20_000;

/// Digits beyond those of the weights, and of weights that are exact but too long.
const MORE_DIGITS: u32 = 20;
const DIGITS_OF_LONG: u32 = 300;

/// Digits of the weights that coefficients may lose.
const DIGITS_LOST: u32 = 10;

/// H̄ = H + Σ hⁿ H_(n+1) of a step, up to a power of h.
#[derive(Clone, Debug, PartialEq)]
pub struct ModifiedHamiltonian<L = MapKind> {
    /// H_2, H_3, …: the brackets of the basis with their coefficients, those that are 0 left out.
    pub terms: Vec<Vec<(Bracket<L>, Rational)>>,
    /// Decimals behind the point to which coefficients are known; `None` where they are exact.
    pub digits: Option<u32>,
}

impl ModifiedHamiltonian {
    /// That of a scheme's step of two parts, up to h^grade; of a processed scheme that of the processed step.
    ///
    /// For quadratic T brackets that vanish are left out.
    ///
    /// ```
    /// use shadowstep_analysis::modified::ModifiedHamiltonian;
    /// use shadowstep_schemes::{Kinetic, shipped_proved};
    ///
    /// let verlet = shipped_proved("stormer-verlet").unwrap();
    /// let modified = ModifiedHamiltonian::of(&verlet, Kinetic::Quadratic, 2);
    /// let terms: Vec<_> = modified.terms[1].iter().map(|(bracket, c)| format!("{c} {bracket}")).collect();
    /// assert_eq!(terms, ["-1/24 [K,[K,D]]", "1/12 [D,[D,K]]"]);
    /// ```
    ///
    /// # Panics
    /// A grade beyond [`HIGHEST_GRADE`].
    pub fn of(proved: &Proved, kinetic: Kinetic, grade: u32) -> Self {
        assert!(grade <= HIGHEST_GRADE, "a grade of at most {HIGHEST_GRADE}");
        let scheme = &proved.scheme;
        let (maps, held) = match (scheme.processed_maps(), &scheme.processor) {
            (Some(maps), Some(processor)) => (maps, processor.held),
            _ => (scheme.maps(), scheme.held),
        };
        let weights: Vec<_> = maps.iter().map(|map| &map.weight).collect();
        let words = lyndon_words(grade as usize + 1);
        let product = |pieces: &[Vec<MapKind>], arithmetic: &FixedPoint| {
            let values = prefix_coefficients(&maps, pieces, arithmetic);
            values.into_iter().map(|(word, value)| (word, value.units())).collect()
        };
        series(&words, (&weights, held), grade, product, kinetic)
    }
}

impl ModifiedHamiltonian<usize> {
    /// That of a scheme's step of `parts` parts, up to h^grade.
    ///
    /// # Errors
    /// A scheme that is not for many parts.
    pub fn of_parts(proved: &Proved, parts: usize, grade: u32) -> Result<Self, NotForManyParts> {
        let proved = proved.for_many_parts()?;
        let (maps, middle) = proved.scheme.step_of_parts();
        let weights: Vec<_> = maps.iter().map(|map| &map.weight).chain(&middle).collect();
        let words = part_words::lyndon_words(parts, grade as usize + 1);
        let product = |pieces: &[Vec<usize>], arithmetic: &FixedPoint| {
            let values = part_words::prefix_coefficients((&maps, &middle), parts, pieces, arithmetic);
            values.into_iter().map(|(word, value)| (word, value.units())).collect()
        };
        Ok(series(&words, (&weights, proved.scheme.held), grade, product, Kinetic::Any))
    }
}

impl<L: Letter> ModifiedHamiltonian<L> {
    /// The terms that are not 0, with the power of h of each.
    pub fn all(&self) -> impl Iterator<Item = (u32, &Bracket<L>, &Rational)> {
        (1..).zip(&self.terms).flat_map(|(power, terms)| terms.iter().map(move |(bracket, c)| (power, bracket, c)))
    }
}

/// The logarithm of a product of exponentials, from the coefficients of all pieces of Lyndon words in it.
fn series<L: Letter>(
    words: &[Vec<L>],
    (weights, held): (&[&Rational], Held),
    grade: u32,
    product: impl Fn(&[Vec<L>], &FixedPoint) -> HashMap<Vec<L>, BigInt>,
    kinetic: Kinetic,
) -> ModifiedHamiltonian<L> {
    let longest = grade + 1;
    let denominator = weights.iter().fold(BigInt::one(), |lcm, weight| lcm.lcm(weight.denom()));
    let bits = grid(&denominator, longest).bits();
    let exact = held == Held::Exactly && bits <= MOST_BITS;
    let (arithmetic, digits) = match held {
        _ if exact => (FixedPoint::with_bits(bits as u32 + 128), None),
        Held::Exactly => (FixedPoint::new(DIGITS_OF_LONG + MORE_DIGITS), Some(DIGITS_OF_LONG)),
        Held::Digits(digits) => {
            (FixedPoint::new(digits + MORE_DIGITS), Some(digits.saturating_sub(DIGITS_LOST).max(1)))
        }
    };
    // a letter alone is no piece of a bracket, and all weights of a letter sum to 1
    let words: Vec<_> = words.iter().filter(|word| word.len() > 1).collect();
    let pieces: Vec<Vec<L>> = words.iter().flat_map(|word| (0..word.len()).map(|i| word[i..].to_vec())).collect();
    let product = Product { coefficients: product(&pieces, &arithmetic), unit: arithmetic.unit() };
    let terms = (2..=longest).map(|length| {
        let of_length = words.iter().filter(|word| word.len() == length as usize);
        let logarithms = of_length.map(|word| (word.to_vec(), product.logarithm(word)));
        // exact values are multiples of 1/grid
        let (lyndon, unit): (Vec<_>, _) = match exact {
            true => {
                let grid = grid(&denominator, length);
                let multiple = |units: BigInt| nearest(units * &grid, &product.unit);
                (logarithms.map(|(word, units)| (word, multiple(units))).collect(), grid)
            }
            false => (logarithms.collect(), product.unit.clone()),
        };
        let value = |(bracket, units): (Bracket<L>, Rational)| (bracket, units / unit.clone());
        let is_known = |(_, c): &(Bracket<L>, Rational)| match digits {
            None => !c.is_zero(),
            Some(digits) => c.abs() * BigInt::from(10).pow(digits) >= Rational::one(),
        };
        coordinates(&lyndon, kinetic).into_iter().map(value).filter(is_known).collect()
    });
    ModifiedHamiltonian { terms: terms.collect(), digits }
}

/// What the coefficient of a word of n letters in a power X^r/r, r ≤ n, is a multiple of 1 over, where weights are
/// exact with the common denominator D: Dⁿ n! lcm(1, …, n). A gradient kick's weight stands for three letters.
fn grid(denominator: &BigInt, n: u32) -> BigInt {
    let factorial: BigInt = (1..=n).map(BigInt::from).product();
    let multiple = (1..=n).map(BigInt::from).fold(BigInt::one(), |lcm, k| lcm.lcm(&k));
    denominator.pow(n) * factorial * multiple
}

/// numerator/denominator, rounded; the denominator is positive.
fn nearest(numerator: BigInt, denominator: &BigInt) -> BigInt {
    let twice: BigInt = denominator * 2;
    let sum: BigInt = numerator * 2 + denominator;
    sum.div_floor(&twice)
}

/// 1 + X, by the coefficients of words in units.
struct Product<L> {
    coefficients: HashMap<Vec<L>, BigInt>,
    unit: BigInt,
}

impl<L: Letter> Product<L> {
    /// The coefficient of a word in log(1 + X) = X − X²/2 + X³/3 − …
    fn logarithm(&self, word: &[L]) -> BigInt {
        let n = word.len();
        // of each end of the word in X^r
        let mut ends: Vec<BigInt> = (0..n).map(|i| self.coefficients[&word[i..]].clone()).collect();
        let mut sum = ends[0].clone();
        for r in 2..=n {
            ends = (0..=n - r)
                .map(|i| {
                    let cuts = i + 1..=n - (r - 1);
                    let products = cuts.map(|cut| &self.coefficients[&word[i..cut]] * &ends[cut]);
                    nearest(products.sum(), &self.unit)
                })
                .collect();
            let term = nearest(ends[0].clone(), &BigInt::from(r));
            sum += if r % 2 == 1 { term } else { -term };
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::LeadingError;
    use num_traits::ToPrimitive;
    use shadowstep_schemes::shipped_proved;

    fn texts<L: Letter>(modified: &ModifiedHamiltonian<L>) -> Vec<String> {
        modified.all().map(|(power, bracket, c)| format!("{power}: {c} {bracket}")).collect()
    }

    /// Symplectic Euler is exp(hK) exp(hD): the series of the textbook, whose brackets are these up to Jacobi's
    /// identity (Hairer, Lubich & Wanner, III.4).
    #[test]
    fn the_series_of_baker_campbell_and_hausdorff() {
        let euler = shipped_proved("symplectic-euler").unwrap();
        let modified = ModifiedHamiltonian::of(euler, Kinetic::Any, 4);
        assert_eq!(modified.digits, None);
        assert_eq!(
            texts(&modified),
            [
                "1: 1/2 [K,D]",
                "2: 1/12 [K,[K,D]]",
                "2: 1/12 [D,[D,K]]",
                "3: -1/24 [K,[D,[K,D]]]",
                "4: -1/720 [K,[K,[K,[K,D]]]]",
                "4: -1/120 [K,[K,[D,[K,D]]]]",
                "4: 1/360 [D,[K,[K,[K,D]]]]",
                "4: -1/120 [D,[D,[K,[D,K]]]]",
                "4: 1/360 [K,[D,[D,[D,K]]]]",
                "4: -1/720 [D,[D,[D,[D,K]]]]",
            ]
        );
    }

    /// The first terms that are not 0 are the leading error, which is computed in another way.
    #[test]
    fn the_first_terms_are_the_leading_error() {
        for name in [
            "symplectic-euler",
            "ruth3",
            "yoshida4",
            "chin-4a",
            "blanes-moan-srkn6b",
            "wisdom-corrector-3",
            "takahashi-imada",
        ] {
            let proved = shipped_proved(name).unwrap();
            let errors = LeadingError::processed(proved).unwrap_or_else(|| LeadingError::of(proved));
            for (kinetic, error) in [Kinetic::Any, Kinetic::Quadratic].into_iter().zip(errors) {
                if kinetic == Kinetic::Any && proved.scheme.has_gradient_kicks() {
                    continue;
                }
                let modified = ModifiedHamiltonian::of(proved, kinetic, error.power - 1);
                let found: Vec<_> =
                    modified.all().map(|(power, bracket, c)| (power, bracket.clone(), c.to_f64().unwrap())).collect();
                let expected: Vec<_> = error
                    .terms
                    .into_iter()
                    .filter(|(_, c)| *c != 0.0)
                    .map(|(bracket, c)| (error.power - 1, bracket, c))
                    .collect();
                assert_eq!(found, expected, "{name}, {kinetic:?}");
            }
        }
    }

    /// Two parts are a kick and a drift.
    #[test]
    fn two_parts_of_many_are_kick_and_drift() {
        for name in ["symplectic-euler", "yoshida4", "mclachlan-s5"] {
            let proved = shipped_proved(name).unwrap();
            let [two, many] = [
                texts(&ModifiedHamiltonian::of(proved, Kinetic::Any, 5)),
                texts(&ModifiedHamiltonian::of_parts(proved, 2, 5).unwrap()),
            ];
            let renamed: Vec<_> = two.iter().map(|text| text.replace('K', "A").replace('D', "B")).collect();
            assert_eq!(renamed, many, "{name}");
        }
    }

    /// Of symmetric schemes even powers of h remain, also where weights are rounded.
    #[test]
    fn symmetric_schemes_have_even_powers() {
        let modified = ModifiedHamiltonian::of(shipped_proved("blanes-moan-s6").unwrap(), Kinetic::Any, 7);
        let sizes: Vec<_> = modified.terms.iter().map(Vec::len).collect();
        assert_eq!(sizes, [0, 0, 0, 6, 0, 18, 0]);
        assert!(modified.digits.is_some_and(|digits| digits > 200));
    }
}
