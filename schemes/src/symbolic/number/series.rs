//! sin, cos, sinh, cosh, arctan and artanh by their power series, and with them π and log 2, as balls.
//!
//! A series is short for a small argument. So the argument is halved about √bits times, and the result doubled as
//! often; extra bits compensate for the errors that the doublings magnify.

use std::cell::RefCell;
use std::collections::HashMap;

use num_bigint::BigInt;
use num_traits::One;

use crate::symbolic::number::ball::Ball;

/// The curve of the points (cos t, sin t) or (cosh t, sinh t): the formulas differ in signs only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Curve {
    Circle,
    Hyperbola,
}

impl Curve {
    /// a − b on the circle, a + b on the hyperbola
    fn turn(self, a: &Ball, b: &Ball) -> Ball {
        match self {
            Curve::Circle => a.subtract(b),
            Curve::Hyperbola => a.add(b),
        }
    }
}

/// The number of halvings, if one takes as long as `products` products: the series takes about bits/halvings products.
fn halvings(argument: &Ball, products: u64) -> u64 {
    (argument.bits() / products).isqrt().saturating_sub(argument.leading_zeros())
}

/// sin x and 1 − cos x, or sinh x and cosh x − 1, for an x between −1 and 1.
///
/// 1 − cos x is small with x: doubling it keeps its bits, whereas doubling cos x would lose them.
pub(crate) fn sine_and_versine(curve: Curve, x: &Ball) -> (Ball, Ball) {
    let halvings = halvings(x, 2);
    let bits = x.bits() + 2 * halvings + 16;
    let small = x.with_bits(bits).shifted_down(halvings);
    // sin a = a − a³/3! + …, 1 − cos a = a²/2! − a⁴/4! + …
    let mut term = small.clone();
    let mut sums = [small.clone(), Ball::zero(bits)];
    let mut n = 1;
    while !term.is_negligible() {
        n += 1;
        term = term.multiply(&small).over(n);
        let sum = &mut sums[usize::from(n % 2 == 0)];
        *sum = if (n - 1) / 2 % 2 == 1 { curve.turn(sum, &term) } else { sum.add(&term) };
    }
    // Each term is at most half of the one before, so that the rest is at most the last.
    let [mut sine, mut versine] = sums.map(|sum| sum.widened(term.size()));
    let (one, two) = (Ball::one(bits), BigInt::from(2));
    for _ in 0..halvings {
        // sin 2a = 2 sin a cos a, 1 − cos 2a = 2 (1 − cos a) (1 + cos a)
        let cosine = curve.turn(&one, &versine);
        sine = sine.multiply(&cosine).times(&two);
        versine = versine.multiply(&cosine.add(&one)).times(&two);
    }
    (sine.with_bits(x.bits()), versine.with_bits(x.bits()))
}

/// arctan x for an x between −1 and 1, or artanh x for one between −1/2 and 1/2.
pub(crate) fn inverse_tangent(curve: Curve, x: &Ball) -> Ball {
    // A root and a quotient take as long as about ten products, and the series has odd powers only.
    let halvings = halvings(x, 20);
    let bits = x.bits() + halvings + 16;
    let one = Ball::one(bits);
    let mut small = x.with_bits(bits);
    for _ in 0..halvings {
        // tan(a/2) = tan a / (1 + √(1 + tan² a)); the hyperbola has the minus here.
        let square = small.multiply(&small);
        let under = if curve == Curve::Circle { one.add(&square) } else { one.subtract(&square) };
        small = small.over_larger(&one.add(&under.sqrt()));
    }
    // a² is at most 1/4
    let square = small.multiply(&small);
    let sum = odd_series(curve, small, |power| power.multiply(&square));
    sum.times(&(BigInt::one() << halvings)).with_bits(x.bits())
}

/// a − a³/3 + a⁵/5 − …, or the same without minus, of an a whose square is at most 1/4, so that the rest is at most the
/// last power; `next` multiplies by a².
fn odd_series(curve: Curve, a: Ball, next: impl Fn(&Ball) -> Ball) -> Ball {
    let (mut power, mut sum, mut n) = (a.clone(), a, 1);
    while !power.is_negligible() {
        n += 2;
        power = next(&power);
        let term = power.over(n);
        sum = if n % 4 == 3 { curve.turn(&sum, &term) } else { sum.add(&term) };
    }
    sum.widened(power.size())
}

/// Σ factor · arctan 1/n, or the same with artanh, for n > 1.
fn combination(curve: Curve, parts: &[(i32, u64)], bits: u64) -> Ball {
    let fine = bits + 32;
    let part = |(factor, n): &(i32, u64)| {
        odd_series(curve, Ball::one(fine).over(*n), |power| power.over(n * n)).times(&(*factor).into())
    };
    let sum = parts.iter().map(part).reduce(|sum, part| sum.add(&part)).expect("a formula has parts");
    sum.with_bits(bits)
}

/// π/2 by Machin's formula, to within few units.
pub(crate) fn half_pi(bits: u64) -> Ball {
    remembered(Curve::Circle, bits, || combination(Curve::Circle, &[(8, 5), (-2, 239)], bits))
}

/// log 2, to within few units.
pub(crate) fn log_two(bits: u64) -> Ball {
    remembered(Curve::Hyperbola, bits, || combination(Curve::Hyperbola, &[(18, 26), (-2, 4801), (8, 8749)], bits))
}

/// The most values of π/2 and log 2 that a thread keeps: the formulas of a document need them with few different
/// numbers of bits.
const MOST_REMEMBERED: usize = 32;

thread_local! {
    /// Values of π/2 (of the circle) and log 2 (of the hyperbola), by their bits. One with more bits does not stand for
    /// one with fewer: what is computed must not depend on what was computed before.
    static REMEMBERED: RefCell<HashMap<(Curve, u64), Ball>> = RefCell::default();
}

/// The constant of a curve, computed once for each number of bits.
fn remembered(curve: Curve, bits: u64, compute: impl FnOnce() -> Ball) -> Ball {
    REMEMBERED.with_borrow_mut(|remembered| {
        if remembered.len() == MOST_REMEMBERED && !remembered.contains_key(&(curve, bits)) {
            remembered.clear();
        }
        remembered.entry((curve, bits)).or_insert_with(compute).clone()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_constant_is_computed_once_for_its_bits() {
        let computed = Cell::new(0);
        let constant = |curve, bits| {
            remembered(curve, bits, || {
                computed.set(computed.get() + 1);
                Ball::one(bits)
            })
        };
        // bits that nothing else has in this thread
        for _ in 0..5 {
            constant(Curve::Circle, 12_345);
            constant(Curve::Circle, 12_346);
            constant(Curve::Hyperbola, 12_345);
        }
        assert_eq!(computed.get(), 3);
        (0..1000).for_each(|bits| drop(constant(Curve::Circle, 20_000 + bits)));
        assert!(REMEMBERED.with_borrow(HashMap::len) <= MOST_REMEMBERED);
        assert_eq!(half_pi(200).to_interval(1), combination(Curve::Circle, &[(8, 5), (-2, 239)], 200).to_interval(1));
    }
}
