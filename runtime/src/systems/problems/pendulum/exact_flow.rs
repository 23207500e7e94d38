//! The pendulum H = p²/2 − cos q from any initial state, by the addition theorems of Jacobi's elliptic functions.
//!
//! With S = sin(q/2), C = cos(q/2), P = p/2 and k² = S² + P² = (H + 1)/2, a state at the time t after the bottom is
//! S = k sn(t, k), C = dn(t, k), P = k cn(t, k): oscillations for k < 1, the separatrix for k = 1, rotations for k > 1.
//! For a step of τ, whose values from the bottom have the index τ, the theorems are
//!
//! S' = k(S P_τ C_τ + S_τ P C)/D, C' = (k² C C_τ − S S_τ P P_τ)/D, P' = k(P P_τ − S S_τ C C_τ)/D, D = k² − S² S_τ²,
//!
//! and with ∫p² dt = 4(E(t) − (1 − k²)t), E(u + v) = E(u) + E(v) − k² sn u sn v sn(u + v), a step adds
//! ∫p² dt = I_τ − 4 S S_τ S'/k. As p' = −sin q, β' = q sin q + 2 cos q has the integral β = 2∫p² dt − qp − 2Ht + const.
//!
//! So a step costs some products, a quotient and an arc tangent. S_τ, C_τ, P_τ and I_τ come from one Taylor series. Off
//! the curve S² + C² = 1, S² + P² = k² errors would grow exponentially: each step returns to it.

use std::f64::consts::{LOG2_E, TAU};

use super::taylor::flow;
use crate::number::value::Value;
use crate::number::{HighPrecision, Number};
use crate::systems::problems::exact_flow::solution::{Method, Point, Request, Solution, SolutionError, log2};

/// The largest number of bits for the growth of errors: with more a run takes too long. On the separatrix they suffice
/// to
/// |t| = 2772.
const MOST_GROWTH: u32 = 4000;

/// The largest change of q in a step: below π, so that the turns can be counted, and D is far from 0.
const LONGEST: f64 = 2.5;

/// The pendulum at the times n h.
#[derive(Debug)]
pub(super) struct Addition<R> {
    start: State<R>,
    present: State<R>,
    n: i64,
    /// A step of which `parts` make up h; `None` at rest, where only β grows.
    step: Option<Step<R>>,
    parts: u32,
    /// 2h, which β grows by in a step at rest.
    at_rest: Value<R>,
}

/// A state, and the same as S, C and P.
#[derive(Clone, Debug)]
struct State<R> {
    point: Point<R>,
    s: Value<R>,
    c: Value<R>,
    p: Value<R>,
}

/// A step of τ from the bottom, and the constants of the orbit.
#[derive(Debug)]
struct Step<R> {
    s: Value<R>,
    c: Value<R>,
    p: Value<R>,
    /// 2I_τ − 2Hτ
    beta: Value<R>,
    k: Value<R>,
    squared: Value<R>,
    turn: Value<R>,
}

impl<R: HighPrecision> State<R> {
    fn of(point: Point<R>) -> Self {
        let (s, c) = (point.q[0].clone() / 2).sin_cos();
        State { s, c, p: point.p[0].clone() / 2, point }
    }
}

impl<R: HighPrecision> Step<R> {
    /// A step of t on the orbit with this k².
    fn new(squared: &Value<R>, t: &Value<R>) -> Self {
        let k = squared.clone().sqrt();
        let zero: Value<R> = Value::zero(&squared.context());
        let bottom = Point { q: vec![zero.clone()], p: vec![k.clone() * 2], beta: zero };
        let state = State::of(flow(&bottom, t));
        // from the bottom, β = 2I − qp − 2Ht
        let beta = state.point.beta.clone() + state.point.q[0].clone() * &state.point.p[0];
        let turn = k.integer(1).atan() * 8;
        Step { s: state.s, c: state.c, p: state.p, beta, k, squared: squared.clone(), turn }
    }

    /// From a state to the next one, or to the one before.
    fn advance(&self, state: &State<R>, forward: bool) -> State<R> {
        let step_s = if forward { self.s.clone() } else { -self.s.clone() };
        let product = state.s.clone() * &step_s;
        let scale = (self.squared.clone() - product.clone().square()).recip();
        let s = state.s.clone() * &self.p * &self.c + step_s * &state.p * &state.c;
        let c = state.c.clone() * &self.c * &self.squared - product.clone() * &state.p * &self.p;
        let p = state.p.clone() * &self.p - product.clone() * &state.c * &self.c;
        let (mut s, mut c, mut p) = (s * &self.k * &scale, c * &scale, p * &self.k * &scale);
        // back to S² + C² = 1 and S² + P² = k², to first order in the errors
        let off = (s.clone().square() + c.clone().square() - 1) / 2;
        s -= s.clone() * &off;
        c -= c.clone() * &off;
        let off = (s.clone().square() + p.clone().square() - &self.squared) / (self.squared.clone() * 2);
        s -= s.clone() * &off;
        p -= p.clone() * &off;
        let (old, q) = (&state.point, self.angle(&s, &c, &state.point.q[0]));
        let momentum = p.clone() * 2;
        let mut beta = old.beta.clone() + old.q[0].clone() * &old.p[0] - q.clone() * &momentum;
        if forward {
            beta += &self.beta
        } else {
            beta -= self.beta.clone()
        }
        beta -= product * &s * 8 / &self.k;
        State { s, c, p, point: Point { q: vec![q], p: vec![momentum], beta } }
    }

    /// The q of S and C that is nearest to another one.
    fn angle(&self, s: &Value<R>, c: &Value<R>, near: &Value<R>) -> Value<R> {
        // the nearer axis, from which an arc tangent does not lose digits: S = sin φ and C = cos φ
        let (angle, quarters) = match s.to_f64().abs() <= c.to_f64().abs() {
            true => ((s.clone() / c).atan(), if c.is_below_zero() { 2 } else { 0 }),
            false => (-(c.clone() / s).atan(), if s.is_below_zero() { 3 } else { 1 }),
        };
        let angle = angle * 2 + self.turn.clone() / 2 * quarters;
        // q/2 is known up to a turn
        let turns = ((near.clone() - &angle).to_f64() / (2.0 * TAU)).round();
        angle + self.turn.clone() * 2 * near.integer(turns as i64)
    }
}

fn start<R: HighPrecision>(request: &Request<'_>, context: &R::Context) -> Point<R> {
    let values = |numbers: Vec<R>| numbers.into_iter().map(Value).collect();
    Point { q: values(request.values.q(context)), p: values(request.values.p(context)), beta: Value::zero(context) }
}

/// The addition theorems.
#[derive(Debug)]
pub(super) struct AdditionTheorems;

/// p²/2 − cos q
fn energy<R: HighPrecision>(Point { q, p, .. }: &Point<R>) -> Value<R> {
    p[0].clone().square() / 2 - q[0].clone().cos()
}

/// How many steps make one of the step size.
fn parts<R: HighPrecision>(request: &Request<'_>, energy: &Value<R>) -> f64 {
    let h = f64::from_rational(request.h, &()).abs();
    (h * (2.0 * (energy.to_f64() + 1.0)).max(0.0).sqrt() / LONGEST).ceil().max(1.0)
}

impl Method for AdditionTheorems {
    type Solution<R: HighPrecision> = Addition<R>;

    fn bits<R: HighPrecision>(request: &Request<'_>, rough: &R::Context) -> Result<u32, SolutionError> {
        let rough: Point<R> = start(request, rough);
        let (q, p, energy) = (&rough.q[0], &rough.p[0], energy(&rough));
        // errors grow by e^t at most, as |U''| ≤ 1; and away from the separatrix H = 1 linearly, by a factor of some
        // 1/|H − 1| a period and of another one for the shape of the orbit
        let exponential = request.longest * LOG2_E;
        let periods = (request.longest + 1.0).log2() + log2(&p.0).max(0.0);
        let linear = 2.0 * (periods + (-log2(&(energy.clone() - 1).0)).max(0.0));
        // the size of q, which grows with rotation
        let size = log2(&q.0).max(periods).max(0.0);
        // each of the steps is rounded
        let h = f64::from_rational(request.h, &()).abs();
        let steps = (request.longest / h * parts(request, &energy) + 1.0).log2();
        request.bits(size + exponential.min(linear) + steps, MOST_GROWTH)
    }

    fn solve<R: HighPrecision>(request: &Request<'_>, context: R::Context) -> Addition<R> {
        let start: State<R> = State::of(start(request, &context));
        let parts = parts(request, &energy(&start.point));
        let squared = start.s.clone().square() + start.p.clone().square();
        let t = Value(R::from_rational(request.h, &context));
        let step = (!squared.is_zero()).then(|| Step::new(&squared, &(t.clone() / parts as i32)));
        Addition { present: start.clone(), start, n: 0, step, parts: parts as u32, at_rest: t * 2 }
    }
}

impl<R: HighPrecision> Solution<R> for Addition<R> {
    fn at(&mut self, n: i64) -> Point<R> {
        // from the present state, or from the initial one if that is nearer
        if n.abs() <= (n - self.n).abs() {
            self.present = self.start.clone();
            self.n = 0;
        }
        let (steps, forward) = ((n - self.n).unsigned_abs(), n > self.n);
        match &self.step {
            Some(step) => {
                for _ in 0..steps * u64::from(self.parts) {
                    self.present = step.advance(&self.present, forward);
                }
            }
            // cos q = 1
            None => self.present.point.beta = self.at_rest.clone() * self.at_rest.integer(n),
        }
        self.n = n;
        self.present.point.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::AnyLimbs;
    use crate::systems::problems::problem;

    /// The two methods have nothing in common but one step.
    #[test]
    fn many_steps_are_the_taylor_series() {
        let values = |q: &str, p: &str| {
            let set = [("q", q), ("p", p)].map(|(name, value)| (name.to_owned(), value.to_owned()));
            problem("pendulum").unwrap().setup(&set, 100).unwrap().values
        };
        for (q, p) in
            [("0", "1"), ("1/2", "-19/10"), ("3", "-1/10"), ("0", "2"), ("7", "5/2"), ("0", "-9"), ("1e-20", "0")]
        {
            let (values, h) = (values(q, p), "1/3".parse().unwrap());
            let request = Request { values: &values, h: &h, longest: 40.0, bits: 200 };
            let mut steps: Addition<AnyLimbs> = AdditionTheorems::solve(&request, AnyLimbs::context_of(320).unwrap());
            let start = steps.start.point.clone();
            for n in [1, 7, 100, -1, -60] {
                let (found, t) = (steps.at(n), start.beta.integer(n) / 3);
                let right = flow(&start, &t);
                for (found, right) in
                    [(&found.q[0], &right.q[0]), (&found.p[0], &right.p[0]), (&found.beta, &right.beta)]
                {
                    let off = log2(&(found.clone() - right).0) - log2(&right.0).max(0.0);
                    assert!(off < -220.0, "q = {q}, p = {p}, n = {n}: {found:?} {right:?}");
                }
            }
        }
        let at_rest = values("0", "0");
        let request = Request { values: &at_rest, h: &"1/3".parse().unwrap(), longest: 40.0, bits: 200 };
        let mut resting: Addition<AnyLimbs> = AdditionTheorems::solve(&request, AnyLimbs::context_of(320).unwrap());
        let point = resting.at(30);
        assert!(point.q[0].is_zero() && point.p[0].is_zero() && log2(&(point.beta - 20).0) < -200.0);
    }
}
