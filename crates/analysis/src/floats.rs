//! Order conditions in f64, alone and with their slopes: to recognise schemes and to search for them.

use num_traits::ToPrimitive;
use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::symbolic::Rational;

use crate::polish::OfUnknowns;

/// Values in f64.
pub(crate) struct Floats;

impl Arithmetic for Floats {
    type Value = f64;
    fn zero(&self) -> f64 {
        0.0
    }
    fn one(&self) -> f64 {
        1.0
    }
    fn weight(&self, weight: &Rational) -> f64 {
        weight.to_f64().unwrap_or(f64::NAN)
    }
    fn integer(&self, n: i32) -> f64 {
        f64::from(n)
    }
    fn add_product(&self, target: &mut f64, a: &f64, b: &f64) {
        *target += a * b;
    }
    fn divide(&self, a: &f64, n: u32) -> f64 {
        a / f64::from(n)
    }
}

impl OfUnknowns for Floats {
    fn is_zero(&self, weight: &f64) -> bool {
        *weight == 0.0
    }
}

/// Values in f64 with their slopes along all unknowns.
pub(crate) struct FloatDuals;

/// A value with its slopes; a constant has none.
#[derive(Clone, Debug)]
pub(crate) struct FloatDual {
    pub(crate) value: f64,
    pub(crate) slopes: Vec<f64>,
}

impl FloatDual {
    /// The unknown of this number among `unknowns`.
    pub(crate) fn unknown(value: f64, number: usize, unknowns: usize) -> FloatDual {
        FloatDual { value, slopes: (0..unknowns).map(|n| if n == number { 1.0 } else { 0.0 }).collect() }
    }
}

impl Arithmetic for FloatDuals {
    type Value = FloatDual;
    fn zero(&self) -> FloatDual {
        FloatDual { value: 0.0, slopes: Vec::new() }
    }
    fn one(&self) -> FloatDual {
        FloatDual { value: 1.0, slopes: Vec::new() }
    }
    fn weight(&self, weight: &Rational) -> FloatDual {
        FloatDual { value: Floats.weight(weight), slopes: Vec::new() }
    }
    fn integer(&self, n: i32) -> FloatDual {
        FloatDual { value: f64::from(n), slopes: Vec::new() }
    }
    fn add_product(&self, target: &mut FloatDual, a: &FloatDual, b: &FloatDual) {
        target.value += a.value * b.value;
        for (factor, other) in [(a, b), (b, a)] {
            if target.slopes.is_empty() && !factor.slopes.is_empty() {
                target.slopes = vec![0.0; factor.slopes.len()];
            }
            target.slopes.iter_mut().zip(&factor.slopes).for_each(|(sum, slope)| *sum += slope * other.value);
        }
    }
    fn divide(&self, a: &FloatDual, n: u32) -> FloatDual {
        let n = f64::from(n);
        FloatDual { value: a.value / n, slopes: a.slopes.iter().map(|slope| slope / n).collect() }
    }
}

impl OfUnknowns for FloatDuals {
    fn is_zero(&self, weight: &FloatDual) -> bool {
        weight.value == 0.0 && weight.slopes.is_empty()
    }
}
