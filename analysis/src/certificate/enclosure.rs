//! Boxes around decimals in which there is one solution of the order conditions, by Newton's method with bounds.
//!
//! For palindromic compositions of Störmer–Verlet: with the middle weight given by the sum, the conditions F are those of the words of odd degree in the
//! errors of a step; even degrees hold by symmetry. With Y near the inverse of F′ and the box X of radius r about the decimals u, a solution is in X, and one
//! only, if `|Y F(u)| + |1 − Y F′(X)| r < r` in every row (Krawczyk 1969). Here Y and r are proposed; whoever checks the certificate computes the bounds.

use num_traits::{One, Signed, ToPrimitive, Zero};
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::table::Weights;
use shadowstep_schemes::{ExactScheme, Rational, digits_of};

use super::whole_numbers::WholeNumbers;
use crate::polish::{conditions, lyndon_words};

/// The proposal for a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    /// γ₁, …, of the first half without the middle one.
    pub half: Vec<Rational>,
    /// The places in `half` that are solved for; the others are what they are.
    pub solved: Vec<usize>,
    /// Y: a row for each place.
    pub inverse: Vec<Vec<f64>>,
    /// r, a power of ten.
    pub radius: Rational,
}

impl Enclosure {
    /// The box of a scheme of this order; `None` where it is not such a composition, or its decimals are not determined.
    pub(super) fn of(scheme: &ExactScheme, order: u32) -> Option<Enclosure> {
        let is_composition =
            matches!(&scheme.table.weights, Some(Weights::Composition { base, .. }) if base.value == "stormer-verlet");
        let gamma: Vec<_> = scheme.maps().into_iter().skip(1).step_by(2).map(|map| map.weight).collect();
        let sum: Rational = gamma.iter().sum();
        if !is_composition || !scheme.is_symmetric() || gamma.len().is_multiple_of(2) || order < 4 || !sum.is_one() {
            return None;
        }
        let half = gamma[..gamma.len() / 2].to_vec();
        let words: Vec<_> = lyndon_words(2, order - 1)
            .into_iter()
            .filter(|word| word.iter().sum::<u32>() % 2 == 1 && word != &[1])
            .collect();
        let rows: Vec<Vec<f64>> = conditions(&words, &duals(&half), &Duals { count: half.len() })
            .into_iter()
            .map(|(_, value)| value.slopes)
            .collect();
        let solved = columns(&rows, half.len())?;
        let inverse = inverse(rows.iter().map(|row| solved.iter().map(|place| row[*place]).collect()).collect())?;
        let whole = WholeNumbers::new(gamma.iter(), order);
        let scaled: Vec<_> = gamma.iter().map(|weight| whole.weight(weight)).collect();
        let values = conditions(&words, &scaled, &whole).into_iter();
        let values: Vec<_> = values.map(|(condition, value)| whole.value(value, condition.order)).collect();
        let size = |row: &Vec<f64>| {
            row.iter()
                .zip(&values)
                .map(|(y, value)| (Rational::from_float(*y).unwrap_or_else(Rational::zero) * value).abs())
                .sum::<Rational>()
        };
        let farthest = inverse.iter().map(size).max()?;
        // a few times what is needed
        let digits = digits_of(&farthest).map_or(300, |digits| digits.saturating_sub(1));
        let radius = Rational::new(1.into(), num_bigint::BigInt::from(10).pow(digits));
        Some(Enclosure { half, solved, inverse, radius })
    }
}

/// A number and its derivatives by γ₁, ….
#[derive(Clone)]
struct Dual {
    value: f64,
    slopes: Vec<f64>,
}

struct Duals {
    count: usize,
}

/// All γ's of the palindrome, its middle by the sum.
fn duals(half: &[Rational]) -> Vec<Dual> {
    let count = half.len();
    let unit = |place: usize| (0..count).map(|i| f64::from(u8::from(i == place))).collect();
    let mut all: Vec<_> =
        half.iter().enumerate().map(|(i, g)| Dual { value: g.to_f64().unwrap_or(f64::NAN), slopes: unit(i) }).collect();
    let middle = 1.0 - 2.0 * all.iter().map(|dual| dual.value).sum::<f64>();
    let mirrored: Vec<_> = all.iter().rev().cloned().collect();
    all.push(Dual { value: middle, slopes: vec![-2.0; count] });
    all.extend(mirrored);
    all
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
        Dual { value: weight.to_f64().unwrap_or(f64::NAN), ..self.zero() }
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
