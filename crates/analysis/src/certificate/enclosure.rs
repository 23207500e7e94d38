//! Boxes around decimals in which there is one solution of the order conditions, by Newton's method with bounds.
//!
//! The conditions F are as many as weights are solved for; the other weights are held. Of palindromes they are those of
//! odd degree: even degrees hold by symmetry. With Y near the inverse of F′ and the box X of radius r about the
//! decimals u, a solution is in X, and one only, if `|Y F(u)| + |1 − Y F′(X)| r < r` in every row (Krawczyk 1969). Here
//! Y and r are proposed; whoever checks the certificate computes the bounds.

use std::fmt;

use num_traits::{One, Signed, ToPrimitive, Zero};
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::order::{self, Condition, Words};
use shadowstep_schemes::{ExactScheme, Map, MapKind, Rational, digits_of};

use super::whole_numbers::WholeNumbers;
use crate::polish::{conditions, lyndon_words};

/// The proposal for a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    /// What the weights are.
    pub of: Form,
    /// The weights, without those that follow from them.
    pub weights: Vec<Rational>,
    /// The places in `weights` that are solved for; the others are what they are.
    pub solved: Vec<usize>,
    /// Y: a row for each place.
    pub inverse: Vec<Vec<f64>>,
    /// r, a power of ten.
    pub radius: Rational,
}

/// The weights of an enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// γ₁, … of a palindromic composition of Störmer–Verlet, its first half without the middle one, which the sum
    /// gives. The conditions are those of the words in the errors of a step.
    Composition,
    /// Kicks and drifts of a palindrome, its first half with the middle one.
    Palindrome,
    /// All kicks and drifts.
    Maps,
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Form::Composition => "composition",
            Form::Palindrome => "palindrome",
            Form::Maps => "maps",
        })
    }
}

impl Enclosure {
    /// The box of a scheme of this order; `None` where its decimals are not determined by the conditions.
    pub(super) fn of(scheme: &ExactScheme, order: u32) -> Option<Enclosure> {
        let maps = scheme.maps();
        let is_palindrome = scheme.is_symmetric() && order.is_multiple_of(2);
        let (of, weights) = match steps(&maps).filter(|_| is_palindrome && order >= 4) {
            Some(gamma) => (Form::Composition, gamma[..gamma.len() / 2].to_vec()),
            None => {
                let (of, count) =
                    if is_palindrome { (Form::Palindrome, maps.len().div_ceil(2)) } else { (Form::Maps, maps.len()) };
                (of, maps[..count].iter().map(|map| map.weight.clone()).collect())
            }
        };
        let system = System { of, kinds: maps.iter().map(|map| map.kind).collect(), order };
        let rows: Vec<Vec<f64>> = system
            .conditions(&system.all(&duals(&weights), middle_dual(&weights)), &Duals { count: weights.len() })
            .into_iter()
            .map(|(_, value)| value.slopes)
            .collect();
        let solved = columns(&rows, weights.len())?;
        let inverse = inverse(rows.iter().map(|row| solved.iter().map(|place| row[*place]).collect()).collect())?;
        let off = system.off(&weights);
        let size = |row: &Vec<f64>| {
            let product = |(y, off): (&f64, &Rational)| Rational::from_float(*y).unwrap_or_else(Rational::zero) * off;
            row.iter().zip(&off).map(product).map(|product| product.abs()).sum::<Rational>()
        };
        let farthest = inverse.iter().map(size).max()?;
        // a few times what is needed
        let digits = digits_of(&farthest).map_or(300, |digits| digits.saturating_sub(1));
        let radius = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(digits));
        // F′ moves by some r over the box: beside 1/Y that has to be little
        let largest = inverse.iter().map(|row| row.iter().map(|y| y.abs()).sum::<f64>()).fold(0.0, f64::max);
        (largest * float(&radius) < 1e-6).then_some(Enclosure { of, weights, solved, inverse, radius })
    }

    /// How many of the weights are held.
    pub fn held(&self) -> usize {
        self.weights.len() - self.solved.len()
    }
}

/// γ₁, γ₂, … where the maps are their steps of Störmer–Verlet: an odd number, with the sum 1.
fn steps(maps: &[Map]) -> Option<Vec<Rational>> {
    let begins = maps.first()?.kind == MapKind::Kick && maps.len() % 4 == 3;
    let gamma: Vec<_> = maps.iter().skip(1).step_by(2).map(|map| map.weight.clone()).collect();
    let half = Rational::new(1.into(), 2.into());
    let at = |place: usize| gamma.get(place).cloned().unwrap_or_else(Rational::zero);
    let before = |place: usize| if place == 0 { Rational::zero() } else { at(place - 1) };
    let are_means = || (0..=gamma.len()).all(|place| maps[2 * place].weight == (before(place) + at(place)) * &half);
    (begins && are_means() && gamma.iter().sum::<Rational>().is_one()).then_some(gamma)
}

/// The conditions of an enclosure.
struct System {
    of: Form,
    kinds: Vec<MapKind>,
    order: u32,
}

impl System {
    /// All weights of a step.
    fn all<T: Clone>(&self, weights: &[T], middle: T) -> Vec<T> {
        let mirrored = |count: usize| weights[..count].iter().rev().cloned();
        match self.of {
            Form::Composition => weights.iter().cloned().chain([middle]).chain(mirrored(weights.len())).collect(),
            Form::Palindrome => weights.iter().cloned().chain(mirrored(weights.len() - 1)).collect(),
            Form::Maps => weights.to_vec(),
        }
    }

    /// The conditions and their values at all weights.
    fn conditions<A: Arithmetic>(&self, all: &[A::Value], arithmetic: &A) -> Vec<(Condition, A::Value)> {
        if self.of == Form::Composition {
            let mut words = lyndon_words(2, self.order - 1);
            words.retain(|word| word.iter().sum::<u32>() % 2 == 1 && word != &[1]);
            return conditions(&words, all, arithmetic);
        }
        let mut words = order::lyndon_words(self.order as usize);
        words.retain(|word| self.of == Form::Maps || word.len() % 2 == 1);
        let maps: Vec<_> = self.kinds.iter().copied().zip(all.iter().cloned()).collect();
        Words::of(&words).conditions(&maps, arithmetic)
    }

    /// How far the conditions are from what is needed.
    fn off(&self, weights: &[Rational]) -> Vec<Rational> {
        let all = self.all(weights, middle(weights));
        let whole = WholeNumbers::new(all.iter(), self.order);
        let scaled: Vec<_> = all.iter().map(|weight| whole.weight(weight)).collect();
        let values = self.conditions(&scaled, &whole).into_iter();
        values.map(|(condition, value)| whole.value(value, condition.order) - condition.needed).collect()
    }
}

/// The middle one of a palindrome with the sum 1.
fn middle(half: &[Rational]) -> Rational {
    Rational::one() - Rational::from_integer(2.into()) * half.iter().sum::<Rational>()
}

/// A number and its derivatives by the weights.
#[derive(Clone)]
struct Dual {
    value: f64,
    slopes: Vec<f64>,
}

struct Duals {
    count: usize,
}

/// The weights with their derivatives.
fn duals(weights: &[Rational]) -> Vec<Dual> {
    let unit = |place: usize| (0..weights.len()).map(|i| f64::from(u8::from(i == place))).collect();
    let dual = |(place, weight): (usize, &Rational)| Dual { value: float(weight), slopes: unit(place) };
    weights.iter().enumerate().map(dual).collect()
}

fn middle_dual(half: &[Rational]) -> Dual {
    Dual { value: float(&middle(half)), slopes: vec![-2.0; half.len()] }
}

fn float(value: &Rational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

impl Arithmetic for Duals {
    type Value = Dual;
    fn zero(&self) -> Dual {
        Dual { value: 0.0, slopes: vec![0.0; self.count] }
    }
    fn one(&self) -> Dual {
        Dual { value: 1.0, ..self.zero() }
    }
    fn weight(&self, weight: &Rational) -> Dual {
        Dual { value: float(weight), ..self.zero() }
    }
    fn add_product(&self, target: &mut Dual, a: &Dual, b: &Dual) {
        target.value += a.value * b.value;
        for (target, (x, y)) in target.slopes.iter_mut().zip(a.slopes.iter().zip(&b.slopes)) {
            *target += x * b.value + a.value * y;
        }
    }
    fn divide(&self, a: &Dual, n: u32) -> Dual {
        let n = f64::from(n);
        Dual { value: a.value / n, slopes: a.slopes.iter().map(|slope| slope / n).collect() }
    }
}

/// As many columns as rows that are far from dependent, by elimination with the largest pivots.
fn columns(rows: &[Vec<f64>], count: usize) -> Option<Vec<usize>> {
    let mut left = rows.to_vec();
    let mut chosen = Vec::new();
    for _ in 0..rows.len() {
        let places = (0..left.len()).flat_map(|row| (0..count).map(move |column| (row, column)));
        let (row, column) = places.max_by(|a, b| left[a.0][a.1].abs().total_cmp(&left[b.0][b.1].abs()))?;
        let pivot = left.swap_remove(row);
        if pivot[column].abs() < 1e-9 {
            return None;
        }
        for other in &mut left {
            let factor = other[column] / pivot[column];
            other.iter_mut().zip(&pivot).for_each(|(value, pivot)| *value -= factor * pivot);
            other[column] = 0.0;
        }
        chosen.push(column);
    }
    chosen.sort_unstable();
    Some(chosen)
}

/// The inverse of a square matrix.
fn inverse(mut rows: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let n = rows.len();
    rows.iter_mut().enumerate().for_each(|(i, row)| row.extend((0..n).map(|j| f64::from(u8::from(i == j)))));
    for i in 0..n {
        let pivot = (i..n).max_by(|a, b| rows[*a][i].abs().total_cmp(&rows[*b][i].abs()))?;
        rows.swap(i, pivot);
        let scale = rows[i][i];
        if scale == 0.0 {
            return None;
        }
        rows[i].iter_mut().for_each(|value| *value /= scale);
        let pivot = rows[i].clone();
        for row in rows.iter_mut().enumerate().filter(|(j, _)| *j != i).map(|(_, row)| row) {
            let factor = row[i];
            row.iter_mut().zip(&pivot).for_each(|(value, pivot)| *value -= factor * pivot);
        }
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}
