//! The harmonic oscillator: q = q₀ cos ωt + (p₀/ω) sin ωt, p = p₀ cos ωt − ω q₀ sin ωt. U is homogeneous of degree 2: β
//! is 0.

use crate::Rational;
use crate::number::HighPrecision;
use crate::number::value::Value;
use crate::systems::problems::exact_flow::solution::{Method, Point, Request, Solution, SolutionError, log2};

/// A rotation of (ωq, p).
#[derive(Debug)]
pub(super) struct Rotation<R: HighPrecision> {
    h: Rational,
    context: R::Context,
    omega: Value<R>,
    q: Value<R>,
    p: Value<R>,
}

/// The rotation in closed form.
#[derive(Debug)]
pub(super) struct ClosedForm;

impl Method for ClosedForm {
    type Solution<R: HighPrecision> = Rotation<R>;

    fn bits<R: HighPrecision>(request: &Request<'_>, rough: &R::Context) -> Result<u32, SolutionError> {
        let omega = R::from_rational(request.values.value("omega"), rough);
        // the bits of the largest angle before its point
        request.bits(log2(&omega) + request.longest.log2(), u32::MAX)
    }

    fn solve<R: HighPrecision>(request: &Request<'_>, context: R::Context) -> Rotation<R> {
        Rotation {
            h: request.h.clone(),
            omega: Value(R::from_rational(request.values.value("omega"), &context)),
            q: Value(request.values.q(&context).remove(0)),
            p: Value(request.values.p(&context).remove(0)),
            context,
        }
    }
}

impl<R: HighPrecision> Solution<R> for Rotation<R> {
    fn at(&mut self, n: i64) -> Point<R> {
        let t = Value(R::from_rational(&(&self.h * Rational::from_integer(n.into())), &self.context));
        let (sin, cos) = (t * &self.omega).sin_cos();
        let q = self.q.clone() * &cos + self.p.clone() / &self.omega * &sin;
        let p = self.p.clone() * &cos - self.q.clone() * &self.omega * &sin;
        Point { q: vec![q], p: vec![p], beta: Value::zero(&self.context) }
    }
}
