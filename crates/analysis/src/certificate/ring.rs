//! Numbers that formulas with roots are made of: polynomials over the rationals in x₁, x₂, …, each a root of a number
//! before it.
//!
//! An identity of such polynomials modulo x_i^k_i = r_i holds for whichever roots the x_i are, so that it needs no
//! decimals.

use std::cell::RefCell;
use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};
use shadowstep_schemes::Rational;
use shadowstep_schemes::arithmetic::Arithmetic;

/// A polynomial: the coefficients of the products of powers of the roots, without those that are 0. Exponents end with
/// one that is not 0.
pub type Polynomial = BTreeMap<Vec<u32>, Rational>;

/// x^power = of
#[derive(Clone, Debug, PartialEq)]
pub struct Root {
    /// k
    pub power: u32,
    /// r, in the roots before it.
    pub of: Polynomial,
}

impl Root {
    /// The rational number that this root is another one times, such as 5 of √30 over √(6/5): without it, identities
    /// between them would not hold.
    fn over(&self, other: &Root) -> Option<Rational> {
        let ((_, numerator), (_, denominator)) = (self.of.first_key_value()?, other.of.first_key_value()?);
        let ratio = numerator / denominator;
        let scaled = other.of.iter().map(|(exponents, value)| (exponents.clone(), value * &ratio)).collect();
        let root = Rational::new(ratio.numer().nth_root(self.power), ratio.denom().nth_root(self.power));
        let is_root = |exponent: i32| root.pow(exponent) == ratio;
        (ratio.is_positive() && self.power == other.power && self.of == scaled && is_root(self.power as i32))
            .then_some(root)
    }
}

/// The most products of powers of roots: the inverse of a polynomial solves as many linear equations.
const LARGEST: usize = 36;

/// All roots of a scheme.
#[derive(Default)]
pub(super) struct Ring {
    pub(super) roots: RefCell<Vec<Root>>,
}

/// A rational number.
pub(super) fn constant(value: Rational) -> Polynomial {
    if value.is_zero() { Polynomial::new() } else { Polynomial::from([(Vec::new(), value)]) }
}

impl Ring {
    /// The root of a polynomial: a rational multiple of an earlier one, or a new one; `None` where there are too many.
    pub(super) fn root(&self, power: u32, of: Polynomial) -> Option<Polynomial> {
        let mut roots = self.roots.borrow_mut();
        let root = Root { power, of };
        let known = roots.iter().enumerate().find_map(|(place, known)| Some((place, root.over(known)?)));
        let (place, multiple) = known.unwrap_or((roots.len(), Rational::one()));
        if place == roots.len() {
            roots.push(root);
        }
        let size: usize = roots.iter().map(|root| root.power as usize).product();
        let mut exponents = vec![0; place];
        exponents.push(1);
        (size <= LARGEST).then(|| Polynomial::from([(exponents, multiple)]))
    }

    /// The polynomial in which no power of a root reaches that of its equation.
    fn reduced(&self, polynomial: Polynomial) -> Polynomial {
        let roots = self.roots.borrow();
        let mut found = Polynomial::new();
        let mut left: Vec<(Vec<u32>, Rational)> = polynomial.into_iter().collect();
        while let Some((mut exponents, coefficient)) = left.pop() {
            let is_high = |i: &usize| roots.get(*i).is_some_and(|root| exponents[*i] >= root.power);
            match (0..exponents.len()).rev().find(is_high) {
                Some(place) => {
                    exponents[place] -= roots[place].power;
                    left.extend(
                        roots[place].of.iter().map(|(other, factor)| (sum(&exponents, other), &coefficient * factor)),
                    );
                }
                None => add(&mut found, exponents, coefficient),
            }
        }
        found
    }

    /// 1/a, by the linear equations for its coefficients; `None` where there is none.
    pub(super) fn inverse(&self, a: &Polynomial) -> Option<Polynomial> {
        let basis = self.basis();
        let columns: Vec<_> =
            basis.iter().map(|e| self.product(a, &Polynomial::from([(e.clone(), Rational::one())]))).collect();
        let mut rows: Vec<Vec<Rational>> = basis
            .iter()
            .map(|e| {
                let one = if e.is_empty() { Rational::one() } else { Rational::zero() };
                columns
                    .iter()
                    .map(|column| column.get(e).cloned().unwrap_or_else(Rational::zero))
                    .chain([one])
                    .collect()
            })
            .collect();
        for i in 0..basis.len() {
            let pivot = (i..basis.len()).find(|row| !rows[*row][i].is_zero())?;
            rows.swap(i, pivot);
            let scale = rows[i][i].recip();
            rows[i].iter_mut().for_each(|value| *value *= &scale);
            let pivot = rows[i].clone();
            for row in (0..basis.len()).filter(|row| *row != i) {
                let factor = rows[row][i].clone();
                if !factor.is_zero() {
                    rows[row].iter_mut().zip(&pivot).for_each(|(value, pivot)| *value -= &factor * pivot);
                }
            }
        }
        let mut inverse = Polynomial::new();
        basis.into_iter().zip(rows).for_each(|(e, row)| add(&mut inverse, e, row[row.len() - 1].clone()));
        Some(inverse)
    }

    /// All products of powers of the roots below those of their equations.
    fn basis(&self) -> Vec<Vec<u32>> {
        let mut basis = vec![Vec::new()];
        for (place, root) in self.roots.borrow().iter().enumerate() {
            let lower = basis.clone();
            for exponent in 1..root.power {
                basis.extend(lower.iter().map(|e| {
                    let mut e = e.clone();
                    e.resize(place, 0);
                    e.push(exponent);
                    e
                }));
            }
        }
        basis
    }

    pub(super) fn sum(a: &Polynomial, b: &Polynomial, factor: &Rational) -> Polynomial {
        let mut found = a.clone();
        b.iter().for_each(|(e, value)| add(&mut found, e.clone(), value * factor));
        found
    }

    pub(super) fn power(&self, base: &Polynomial, exponent: u32) -> Polynomial {
        (0..exponent).fold(self.one(), |power, _| self.product(&power, base))
    }
}

/// The exponents of a product.
pub(super) fn sum(a: &[u32], b: &[u32]) -> Vec<u32> {
    let at = |e: &[u32], i: usize| e.get(i).copied().unwrap_or(0);
    (0..a.len().max(b.len())).map(|i| at(a, i) + at(b, i)).collect()
}

/// Adds a term.
pub(super) fn add(polynomial: &mut Polynomial, mut exponents: Vec<u32>, value: Rational) {
    while exponents.last() == Some(&0) {
        exponents.pop();
    }
    let sum = polynomial.remove(&exponents).map_or(value.clone(), |before| before + value);
    if !sum.is_zero() {
        polynomial.insert(exponents, sum);
    }
}

impl Arithmetic for Ring {
    type Value = Polynomial;
    fn zero(&self) -> Polynomial {
        Polynomial::new()
    }
    fn one(&self) -> Polynomial {
        constant(Rational::one())
    }
    fn weight(&self, weight: &Rational) -> Polynomial {
        constant(weight.clone())
    }
    fn add_product(&self, target: &mut Polynomial, a: &Polynomial, b: &Polynomial) {
        let mut product = Polynomial::new();
        for (e, x) in a {
            b.iter().for_each(|(f, y)| add(&mut product, sum(e, f), x * y));
        }
        for (exponents, value) in self.reduced(product) {
            add(target, exponents, value);
        }
    }
    fn divide(&self, a: &Polynomial, n: u32) -> Polynomial {
        a.iter().map(|(e, value)| (e.clone(), value / num_bigint::BigInt::from(n))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1/(2 − x) with x³ = 2, and 1/(y + x) with y² = 3.
    #[test]
    fn inverses_are_exact() {
        let ring = Ring::default();
        let number = |n: i64| constant(Rational::from_integer(n.into()));
        let x = ring.root(3, number(2)).unwrap();
        let a = Ring::sum(&number(2), &x, &-Rational::one());
        assert_eq!(ring.product(&a, &ring.inverse(&a).unwrap()), number(1));
        let b = Ring::sum(&ring.root(2, number(3)).unwrap(), &x, &Rational::one());
        assert_eq!(ring.product(&b, &ring.inverse(&b).unwrap()), number(1));
        assert_eq!(ring.power(&x, 7), ring.product(&number(4), &x));
        let twice = ring.root(3, number(16)).unwrap();
        assert_eq!(twice, Ring::sum(&x, &x, &Rational::one()), "16^(1/3) is no root of its own");
        assert!(ring.inverse(&Polynomial::new()).is_none() && ring.root(7, number(5)).is_none());
    }
}
