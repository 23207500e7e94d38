//! The pendulum H = p²/2 − cos q from any initial state, by its Taylor series.
//!
//! Jacobi's elliptic functions give q and p, but need a case each for libration, separatrix and rotation, and leave
//! β' = q sin q + 2 cos q, which is not a function of theirs because of its q, to a quadrature. The Taylor series of the flow is one method for
//! all, at every precision: with s = sin q, c = cos q and upper indices for its coefficients,
//!
//! (k+1) q^{k+1} = p^k, (k+1) p^{k+1} = −s^k, k s^k = Σ_{j=1}^k j q^j c^{k−j}, k c^k = −Σ_{j=1}^k j q^j s^{k−j},
//! (k+1) β^{k+1} = 2c^k + Σ_{j=0}^k q^j s^{k−j}.
//!
//! The order is as high as the digits require; if the step is too long for that, it is cut to ρ/e², with ρ the radius of
//! convergence, as À. Jorba and M. Zou do (Experiment. Math. 14 (2005) 99): for B bits K = ½B log 2 terms then suffice.

use std::f64::consts::{LN_2, LOG2_E};

use rug::Float;

use crate::Rational;
use crate::exact_flow::solution::{ExactFlowError, Point, Request, Solution, log2};
use crate::number::{Number, Precision};

/// The largest number of bits for the growth of errors: with more a run takes too long. On the separatrix they suffice to
/// |t| = 2772.
const MOST_GROWTH: u32 = 4000;

/// The number of consecutive terms that are examined, because every second one may be 0.
const LAST_TERMS: usize = 4;

/// The present state of the pendulum, and the initial one.
#[derive(Debug)]
pub(super) struct TaylorSeries {
    h: Rational,
    precision: Precision,
    start: Point,
    present: Point,
    n: i64,
}

impl TaylorSeries {
    /// Advances by `rest`, or by the part of it that one series allows; returns the remainder.
    fn advance(&mut self, rest: Float) -> Float {
        let bits = f64::from(self.precision.in_bits());
        let most = (bits * LN_2 / 2.0).ceil() as usize + LAST_TERMS;
        let mut terms = Terms::new(&self.present);
        let step = loop {
            terms.extend();
            if terms.are_small(log2(&rest), -bits) {
                break rest.clone();
            }
            if terms.q.len() > most {
                let fraction = terms.log2_radius() - 2.0 * LOG2_E - log2(&rest);
                break rest.clone() * fraction.min(0.0).exp2();
            }
        };
        self.present = terms.sum(&step);
        rest - step
    }
}

fn start(request: &Request<'_>, precision: &Precision) -> Point {
    Point { q: request.values.q(precision), p: request.values.p(precision), beta: Float::zero(precision) }
}

impl Solution for TaylorSeries {
    fn new(request: &Request<'_>) -> Result<Self, ExactFlowError> {
        let rough = start(request, &request.rough()?);
        let (q, p) = (&rough.q[0], &rough.p[0]);
        let energy = p.clone().square() / 2u32 - q.clone().cos();
        // errors grow by e^t at most, as |U''| ≤ 1; and away from the separatrix H = 1 linearly, by a factor of some
        // 1/|H − 1| a period and of another one for the shape of the orbit
        let exponential = request.longest * LOG2_E;
        let periods = (request.longest + 1.0).log2() + log2(p).max(0.0);
        let linear = 2.0 * (periods + (-log2(&(energy - 1u32))).max(0.0));
        // the size of q, which grows with rotation
        let size = log2(q).max(periods).max(0.0);
        let precision = request.precision(size + exponential.min(linear), MOST_GROWTH)?;
        let start = start(request, &precision);
        Ok(TaylorSeries { h: request.h.clone(), precision, present: start.clone(), start, n: 0 })
    }

    fn at(&mut self, n: i64) -> Point {
        // from the present state, or from the initial one if that is nearer
        if n.abs() <= (n - self.n).abs() {
            self.present = self.start.clone();
            self.n = 0;
        }
        let mut rest = Float::from_rational(&(&self.h * Rational::from_integer((n - self.n).into())), &self.precision);
        while !rest.is_zero() {
            rest = self.advance(rest);
        }
        self.n = n;
        self.present.clone()
    }
}

/// The Taylor coefficients of the flow about a state.
struct Terms {
    q: Vec<Float>,
    p: Vec<Float>,
    beta: Vec<Float>,
    sin: Vec<Float>,
    cos: Vec<Float>,
    /// j q^j
    weighted: Vec<Float>,
}

impl Terms {
    fn new(Point { q, p, beta }: &Point) -> Self {
        let zero = Float::new(beta.prec());
        let (sin, cos) = q[0].clone().sin_cos(zero.clone());
        Terms {
            q: q.clone(),
            p: p.clone(),
            beta: vec![beta.clone()],
            sin: vec![sin],
            cos: vec![cos],
            weighted: vec![zero],
        }
    }

    /// From the coefficients to k those of k + 1.
    fn extend(&mut self) {
        let k = self.q.len();
        let last = |list: &[Float]| list[k - 1].clone();
        let rate = last(&self.cos) * 2u32 + product(&self.q, &self.sin);
        self.beta.push(rate / k as u32);
        self.weighted.push(last(&self.p));
        self.q.push(last(&self.p) / k as u32);
        self.p.push(-last(&self.sin) / k as u32);
        // the 0 in front of `weighted` multiplies the coefficient that is not known yet
        let sin = product(&self.weighted[1..], &self.cos) / k as u32;
        let cos = -product(&self.weighted[1..], &self.sin) / k as u32;
        self.sin.push(sin);
        self.cos.push(cos);
    }

    /// log₂ of the largest coefficient of each of the last degrees, with the degree.
    fn last(&self) -> impl Iterator<Item = (f64, f64)> {
        let degrees = self.q.len().saturating_sub(LAST_TERMS).max(1)..self.q.len();
        degrees.map(|k| {
            let sizes = [&self.q[k], &self.p[k], &self.beta[k]].map(log2);
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
    fn sum(&self, step: &Float) -> Point {
        let horner = |list: &[Float]| {
            let (highest, others) = list.split_last().expect("the state is the first term");
            others.iter().rev().fold(highest.clone(), |sum, term| sum * step + term)
        };
        Point { q: vec![horner(&self.q)], p: vec![horner(&self.p)], beta: horner(&self.beta) }
    }
}

/// Σ_j a_j b_{k−j}
fn product(a: &[Float], b: &[Float]) -> Float {
    let mut sum = Float::new(a[0].prec());
    a.iter().zip(b.iter().rev()).for_each(|(a, b)| sum += a * b);
    sum
}
