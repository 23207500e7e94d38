//! The harmonic oscillator: q = q₀ cos ωt + (p₀/ω) sin ωt, p = p₀ cos ωt − ω q₀ sin ωt. U is homogeneous of degree 2: β is 0.

use rug::Float;

use crate::Rational;
use crate::exact_flow::solution::{ExactFlowError, Point, Request, Solution, log2};
use crate::number::{Number, Precision};

/// A rotation of (ωq, p).
#[derive(Debug)]
pub(super) struct Rotation {
    h: Rational,
    precision: Precision,
    omega: Float,
    q: Float,
    p: Float,
}

impl Solution for Rotation {
    fn new(request: &Request<'_>) -> Result<Self, ExactFlowError> {
        let omega = Float::from_rational(request.values.value("omega"), &request.rough()?);
        // the bits of the largest angle before its point
        let precision = request.precision(log2(&omega) + request.longest.log2(), u32::MAX)?;
        Ok(Rotation {
            h: request.h.clone(),
            precision,
            omega: Float::from_rational(request.values.value("omega"), &precision),
            q: request.values.q(&precision).remove(0),
            p: request.values.p(&precision).remove(0),
        })
    }

    fn at(&mut self, n: i64) -> Point {
        let t = Float::from_rational(&(&self.h * Rational::from_integer(n.into())), &self.precision);
        let zero = Float::zero(&self.precision);
        let (sin, cos) = (t * &self.omega).sin_cos(zero.clone());
        let q = self.q.clone() * &cos + self.p.clone() / &self.omega * &sin;
        let p = self.p.clone() * &cos - self.q.clone() * &self.omega * &sin;
        Point { q: vec![q], p: vec![p], beta: zero }
    }
}
