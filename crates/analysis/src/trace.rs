//! The trace of a step of the harmonic oscillator: an exact polynomial in x = (hω)².
//!
//! For H = (p² + ω²q²)/2 a kick is hp −= a x q, a drift q += b (hp), a gradient kick hp += 2c x² q, and a step a matrix
//! of determinant 1. Its trace, 2 cos φ for a step that turns by φ, is Σ_k t_k x^k, where t_k has the sign (−1)^k and
//! is a sum of products of k of the a's, or of a c in place of two, and the b's.

use std::ops::Range;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{FromPrimitive, One, Signed, ToPrimitive, Zero};
use shadowstep_schemes::symbolic::{Fraction, Rational};

use crate::prime::{PRIME, Residues, residue};
use shadowstep_schemes::MapKind;
use shadowstep_schemes::arithmetic::{Arithmetic, Fixed, FixedPoint, Sensitivity};
use shadowstep_schemes::map::Map;
use shadowstep_schemes::scheme::Held;

/// Terms of the trace beyond the order that are computed first for the error of the phase.
const FEW_TERMS: usize = 8;

/// The trace polynomial, with integers over powers of one denominator: reducing each fraction would cost far more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// T_0, T_1, … in tr = Σ T_k (x/N)^k
    pub(crate) integers: Vec<BigInt>,
    /// N
    pub(crate) denominator: BigInt,
}

/// The leading error of the phase: (φ − hω)/hω = coefficient·(hω)^power + ….
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseError {
    /// c
    pub coefficient: f64,
    /// The power of hω.
    pub power: u32,
}

impl Trace {
    /// The trace of the step that these maps make.
    pub fn of(maps: &[Map]) -> Trace {
        Trace::up_to(maps, usize::MAX)
    }

    /// Its terms up to x^degree.
    fn up_to(maps: &[Map], degree: usize) -> Trace {
        let scale = maps.iter().fold(BigInt::one(), |lcm, map| lcm.lcm(map.weight.denom()));
        // in units of 1/scale for each power of h
        let rest = |kind: MapKind| scale.pow(kind.power() - 1);
        let integer = |map: &Map| (map.kind, map.weight.numer() * (&scale / map.weight.denom()) * rest(map.kind));
        let maps: Vec<_> = maps.iter().map(integer).collect();
        let mut integers = trace(&maps, degree, &BigInt::zero(), &BigInt::one(), |sum, a, b| *sum += a * b);
        integers.iter_mut().skip(1).step_by(2).for_each(|value| *value = -&*value);
        while integers.len() > 1 && integers.last().is_some_and(Zero::is_zero) {
            integers.pop();
        }
        Trace { integers, denominator: &scale * &scale }
    }

    /// The degree in x.
    pub fn degree(&self) -> usize {
        self.integers.len() - 1
    }

    /// t_k, the coefficient of x^k, exactly.
    pub fn coefficient(&self, k: usize) -> Rational {
        let Some(integer) = self.integers.get(k) else { return Rational::zero() };
        Rational::new(integer.clone(), self.denominator.pow(k as u32))
    }

    /// t_k without reducing the fraction, which takes long where the weights have hundreds of digits.
    pub fn unreduced_coefficient(&self, k: usize) -> Fraction {
        let Some(integer) = self.integers.get(k) else { return Rational::zero().into() };
        Fraction::new(integer.clone(), self.denominator.pow(k as u32))
    }
}

impl PhaseError {
    /// The leading error of the phase of a scheme that has the order `order` for quadratic T.
    ///
    /// Where tr = 2 cos(hω) + δ x^m + …, the phase is off by −δ/2·(hω)^{2m−2}, relatively. A δ that the digits of the
    /// weights can account for counts as none.
    pub fn of(maps: &[Map], held: Held, order: u32) -> PhaseError {
        let first = order.div_ceil(2) as usize + 1;
        let found = PhaseError::among(first..first + FEW_TERMS, maps, held);
        // beyond the degree there is nothing that the cosine's coefficient could be equal to
        found
            .or_else(|| PhaseError::among(first + FEW_TERMS..2 * maps.len() + 2, maps, held))
            .expect("a step is not a cosine")
    }

    /// The first of the terms of the trace that differs from the same term of the cosine.
    fn among(terms: Range<usize>, maps: &[Map], held: Held) -> Option<PhaseError> {
        let trace = Trace::up_to(maps, terms.end);
        let slopes = slopes(maps, terms.end);
        let tolerance = |m: usize| match held {
            Held::Exactly => Rational::zero(),
            Held::Digits(digits) => {
                let slope = slopes.get(m).copied().and_then(Rational::from_f64).unwrap_or_else(Rational::zero);
                slope / BigInt::from(10).pow(digits - 1)
            }
        };
        terms
            .map(|m| (m, trace.coefficient(m) - cosine(m)))
            .find(|(m, difference)| difference.abs() > tolerance(*m))
            .map(|(m, difference)| {
                let coefficient = -difference.to_f64().unwrap_or(f64::NAN) / 2.0;
                PhaseError { coefficient, power: 2 * m as u32 - 2 }
            })
    }
}

/// The leading error of the phase of a step with weights in f64 and of the order `order` for quadratic T: the
/// coefficient c and the power of hω, where higher terms count as none.
pub(crate) fn leading_phase(maps: &[(MapKind, f64)], order: u32) -> (f64, u32) {
    let m = order.div_ceil(2) as usize + 1;
    let terms = trace(maps, m, &0.0, &1.0, |sum, a, b| *sum += a * b);
    let sign = if m % 2 == 1 { -1.0 } else { 1.0 };
    let difference = sign * terms.get(m).copied().unwrap_or(0.0) - cosine(m).to_f64().unwrap_or(f64::NAN);
    (-difference / 2.0, 2 * m as u32 - 2)
}

/// The terms of the trace modulo the prime, if no denominator is divisible by it.
pub(crate) fn residues(maps: &[Map]) -> Option<Vec<u64>> {
    if maps.iter().any(|map| residue(map.weight.denom()) == 0) {
        return None;
    }
    let weighed: Vec<_> = maps.iter().map(|map| (map.kind, Residues.weight(&map.weight))).collect();
    let mut residues = trace(&weighed, usize::MAX, &0, &1, |sum, a, b| Residues.add_product(sum, a, b));
    residues.iter_mut().skip(1).step_by(2).for_each(|value| *value = (PRIME - *value) % PRIME);
    Some(residues)
}

/// The coefficients of the trace as a polynomial in u = x/range, in units of 2^−bits, each off by less than two units.
pub(crate) fn scaled(maps: &[Map], range: u64, bits: u64) -> Vec<BigInt> {
    let range = Rational::from_integer(range.into());
    let one = Rational::one();
    let square = &range * &range;
    let factor = |kind| match kind {
        MapKind::Kick => &range,
        MapKind::Drift => &one,
        MapKind::GradientKick => &square,
    };
    let mut more = 64;
    loop {
        let arithmetic = FixedPoint::with_bits((bits + more) as u32);
        let weighed: Vec<_> =
            maps.iter().map(|map| (map.kind, arithmetic.weight(&(&map.weight * factor(map.kind))))).collect();
        let (zero, unit) = (arithmetic.zero(), arithmetic.one());
        let values = trace(&weighed, usize::MAX, &zero, &unit, |sum, a, b| arithmetic.add_product(sum, a, b));
        let error = values.iter().map(Fixed::error).fold(0.0, f64::max);
        // the values are large beyond the limit of stability, and so are their errors
        let lost = error.log2().ceil().max(0.0) as u64;
        if lost <= more {
            let sign = |k: usize| if k % 2 == 1 { -1 } else { 1 };
            let beyond = u64::from(arithmetic.bits()) - bits;
            return values.iter().enumerate().map(|(k, value)| (value.units() * sign(k)) >> beyond).collect();
        }
        more = lost + 16;
    }
}

/// The coefficient of x^m in 2 cos √x.
fn cosine(m: usize) -> Rational {
    let factorial: BigInt = (1..=2 * m).map(BigInt::from).product();
    Rational::new(if m.is_multiple_of(2) { 2.into() } else { (-2).into() }, factorial)
}

/// How far each coefficient moves when each weight moves by one unit of its last digit, in that unit.
fn slopes(maps: &[Map], degree: usize) -> Vec<f64> {
    let weights: Vec<_> = maps.iter().map(|map| (map.kind, Sensitivity.weight(&map.weight))).collect();
    let traces = trace(&weights, degree, &Sensitivity.zero(), &Sensitivity.one(), |sum, a, b| {
        Sensitivity.add_product(sum, a, b);
    });
    traces.iter().map(|sensitive| sensitive.slope).collect()
}

/// The degree in x that a matrix has after some maps.
#[derive(Default)]
pub(crate) struct Degree {
    now: usize,
    /// After the last drift: what follows it adds to q's.
    of_position: usize,
}

impl Degree {
    /// After all maps.
    pub(crate) fn of(kinds: impl Iterator<Item = MapKind>) -> usize {
        let mut degree = Degree::default();
        kinds.for_each(|kind| degree.pass(kind));
        degree.now
    }

    fn pass(&mut self, kind: MapKind) {
        match kind {
            MapKind::Drift => self.of_position = self.now,
            MapKind::Kick => self.now = self.now.max(self.of_position + 1),
            MapKind::GradientKick => self.now = self.now.max(self.of_position + 2),
        }
    }
}

/// The coefficients of the trace in −x up to a degree, which are sums of products without a sign.
fn trace<V: Clone>(
    maps: &[(MapKind, V)],
    most: usize,
    zero: &V,
    one: &V,
    add_product: impl Fn(&mut V, &V, &V),
) -> Vec<V> {
    let most = most.min(Degree::of(maps.iter().map(|(kind, _)| *kind)));
    let size = most + 1;
    let polynomial = |constant: &V| {
        let mut coefficients = vec![zero.clone(); size];
        coefficients[0] = constant.clone();
        coefficients
    };
    // the columns of the matrix: where the step takes (q, hp) = (1, 0) and (0, 1)
    let mut columns = [[polynomial(one), polynomial(zero)], [polynomial(zero), polynomial(one)]];
    let mut reached = Degree::default();
    for (kind, weight) in maps {
        reached.pass(*kind);
        let degree = most.min(reached.now);
        let mut twice = zero.clone();
        (0..2).for_each(|_| add_product(&mut twice, one, weight));
        for [q, p] in &mut columns {
            match kind {
                MapKind::Kick => (0..degree).for_each(|k| add_product(&mut p[k + 1], weight, &q[k])),
                MapKind::Drift => (0..=degree).for_each(|k| add_product(&mut q[k], weight, &p[k])),
                MapKind::GradientKick => {
                    (0..degree.saturating_sub(1)).for_each(|k| add_product(&mut p[k + 2], &twice, &q[k]));
                }
            }
        }
    }
    let [[q, _], [_, p]] = columns;
    q.into_iter()
        .zip(&p)
        .map(|(mut sum, p)| {
            add_product(&mut sum, one, p);
            sum
        })
        .collect()
}
