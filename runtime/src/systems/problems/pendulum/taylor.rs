//! The flow of the pendulum H = p²/2 − cos q from a state, by its Taylor series.
//!
//! With s = sin q, c = cos q and upper indices for the coefficients,
//!
//! (k+1) q^{k+1} = p^k, (k+1) p^{k+1} = −s^k, k s^k = Σ_{j=1}^k j q^j c^{k−j}, k c^k = −Σ_{j=1}^k j q^j s^{k−j},
//! (k+1) β^{k+1} = 2c^k + Σ_{j=0}^k q^j s^{k−j}.
//!
//! The order is as high as the digits require; if the step is too long for that, it is cut to ρ/e², with ρ the radius
//! of convergence, as À. Jorba and M. Zou do (Experiment. Math. 14 (2005) 99): for B bits K = ½B log 2 terms then
//! suffice.

use std::f64::consts::{LN_2, LOG2_E};

use num_traits::FromPrimitive;

use crate::Rational;
use crate::number::HighPrecision;
use crate::number::value::Value;
use crate::systems::problems::exact_flow::solution::{Point, log2};

/// The number of consecutive terms that are examined, because every second one may be 0.
const LAST_TERMS: usize = 4;

/// The state after the time t.
pub(super) fn flow<R: HighPrecision>(state: &Point<R>, t: &Value<R>) -> Point<R> {
    let (mut state, mut rest) = (state.clone(), t.clone());
    while !rest.is_zero() {
        (state, rest) = advance(&state, rest);
    }
    state
}

/// Advances by `rest`, or by the part of it that one series allows; returns the remainder as well.
fn advance<R: HighPrecision>(state: &Point<R>, rest: Value<R>) -> (Point<R>, Value<R>) {
    let bits = f64::from(rest.bits());
    let most = (bits * LN_2 / 2.0).ceil() as usize + LAST_TERMS;
    let mut terms = Terms::new(state);
    let step = loop {
        terms.extend();
        if terms.are_small(log2(&rest.0), -bits) {
            break rest.clone();
        }
        if terms.q.len() > most {
            let fraction = terms.log2_radius() - 2.0 * LOG2_E - log2(&rest.0);
            let fraction = Rational::from_f64(fraction.min(0.0).exp2()).expect("a power of two");
            break rest.clone() * Value(R::from_rational(&fraction, &rest.context()));
        }
    };
    (terms.sum(&step), rest - step)
}

/// The Taylor coefficients of the flow about a state.
struct Terms<R> {
    q: Vec<Value<R>>,
    p: Vec<Value<R>>,
    beta: Vec<Value<R>>,
    sin: Vec<Value<R>>,
    cos: Vec<Value<R>>,
    /// j q^j
    weighted: Vec<Value<R>>,
}

impl<R: HighPrecision> Terms<R> {
    fn new(Point { q, p, beta }: &Point<R>) -> Self {
        let zero = Value::zero(&beta.context());
        let (sin, cos) = q[0].sin_cos();
        Terms {
            q: q.clone(),
            p: p.clone(),
            beta: vec![beta.clone()],
            sin: vec![sin],
            cos: vec![cos],
            weighted: vec![zero],
        }
    }

    /// Computes the next coefficients from the ones before.
    fn extend(&mut self) {
        let k = self.q.len();
        let last = |list: &[Value<R>]| list[k - 1].clone();
        let rate = last(&self.cos) * 2 + product(&self.q, &self.sin);
        self.beta.push(rate / k as i32);
        self.weighted.push(last(&self.p));
        self.q.push(last(&self.p) / k as i32);
        self.p.push(-last(&self.sin) / k as i32);
        // the 0 in front of `weighted` multiplies the coefficient that is not known yet
        let sin = product(&self.weighted[1..], &self.cos) / k as i32;
        let cos = -product(&self.weighted[1..], &self.sin) / k as i32;
        self.sin.push(sin);
        self.cos.push(cos);
    }

    /// log₂ of the largest coefficient of each of the last degrees, with the degree.
    fn last(&self) -> impl Iterator<Item = (f64, f64)> {
        let degrees = self.q.len().saturating_sub(LAST_TERMS).max(1)..self.q.len();
        degrees.map(|k| {
            let sizes = [&self.q[k], &self.p[k], &self.beta[k]].map(|term| log2(&term.0));
            (k as f64, sizes.into_iter().fold(f64::NEG_INFINITY, f64::max))
        })
    }

    /// Whether the last terms of a step of size 2^`step` are below 2^`tolerance`.
    fn are_small(&self, step: f64, tolerance: f64) -> bool {
        self.q.len() > LAST_TERMS && self.last().all(|(k, size)| size + k * step < tolerance)
    }

    /// log₂ of the radius of convergence.
    fn log2_radius(&self) -> f64 {
        self.last().map(|(k, size)| -size / k).fold(f64::INFINITY, f64::min)
    }

    /// The state after a step.
    fn sum(&self, step: &Value<R>) -> Point<R> {
        let horner = |list: &[Value<R>]| {
            let (highest, others) = list.split_last().expect("the state is the first term");
            others.iter().rev().fold(highest.clone(), |sum, term| sum * step + term)
        };
        Point { q: vec![horner(&self.q)], p: vec![horner(&self.p)], beta: horner(&self.beta) }
    }
}

/// Σ_j a_j b_{k−j}
fn product<R: HighPrecision>(a: &[Value<R>], b: &[Value<R>]) -> Value<R> {
    let mut sum = R::zero(&a[0].context());
    a.iter().zip(b.iter().rev()).for_each(|(a, b)| sum.add_product(&a.0, &b.0));
    Value(sum)
}
