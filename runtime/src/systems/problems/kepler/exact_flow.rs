//! Kepler's problem H = |p|²/2 − 1/|q|: the ellipse through any bound initial state, by the difference x = E − E₀ of
//! eccentric anomalies.
//!
//! With r = |q|, 1/a = 2/r₀ − |p₀|², ω = a^{−3/2}, σ = e cos E₀ = 1 − r₀/a and τ = e sin E₀ = q₀·p₀/√a, Kepler's
//! equation is
//!
//! ωt = x − σ sin x + τ(1 − cos x),
//!
//! and the state is q = f q₀ + g p₀, p = f' q₀ + g' p₀ with Lagrange's coefficients
//!
//! f = 1 − (a/r₀)(1 − cos x), g = ((1 − σ) sin x + τ(1 − cos x))/ω, f' = −√a sin x/(r r₀), g' = 1 − (a/r)(1 − cos x),
//! r = a(1 − σ cos x + τ sin x)
//!
//! (J. M. A. Danby, *Fundamentals of Celestial Mechanics*, 2nd ed., sections 6.3 and 6.7). Neither the pericentre nor
//! E₀ is needed; a circle has neither. U is homogeneous of degree −1: β' = qᵀU_q − 2U = 3/r, and as dt = √a r dx, β =
//! 3√a x.

use num_traits::Zero;

use crate::Rational;
use crate::number::HighPrecision;
use crate::number::value::Value;
use crate::systems::problems::exact_flow::solution::{Method, Point, Request, Solution, SolutionError, log2};
use crate::systems::problems::values::Values;

const UNBOUND: SolutionError = SolutionError::InitialState(
    "the exact flow of kepler is computed for bound orbits only: this initial state has H = |p|^2/2 - 1/|q| >= 0",
);
const RADIAL: SolutionError = SolutionError::InitialState(
    "the exact flow of kepler is computed for ellipses only: this initial state has no angular momentum, x py - y px = 0",
);

/// An ellipse and the time on it.
#[derive(Debug)]
pub(super) struct Ellipse<R: HighPrecision> {
    h: Rational,
    context: R::Context,
    q: Vec<Value<R>>,
    p: Vec<Value<R>>,
    /// |q₀|
    r: Value<R>,
    a: Value<R>,
    root_a: Value<R>,
    omega: Value<R>,
    sigma: Value<R>,
    tau: Value<R>,
}

impl<R: HighPrecision> Ellipse<R> {
    fn with(request: &Request<'_>, context: R::Context) -> Self {
        let values = |numbers: Vec<R>| numbers.into_iter().map(Value).collect::<Vec<_>>();
        let (q, p) = (values(request.values.q(&context)), values(request.values.p(&context)));
        let product = |a: &[Value<R>], b: &[Value<R>]| a[0].clone() * &b[0] + a[1].clone() * &b[1];
        let r = product(&q, &q).sqrt();
        let a = (2 / r.clone() - product(&p, &p)).recip();
        let root_a = a.clone().sqrt();
        let omega = (a.clone() * &root_a).recip();
        let sigma = 1 - r.clone() / &a;
        let tau = product(&q, &p) / &root_a;
        Ellipse { h: request.h.clone(), context, q, p, r, a, root_a, omega, sigma, tau }
    }

    /// x, sin x and 1 − cos x for ωt = `mean`.
    ///
    /// Newton's method doubles the digits, so that only its last step needs a sine and a cosine of all digits; the sine
    /// and cosine of the final x differ from them by the terms of a series in the last change.
    fn anomaly(&self, mean: &Value<R>) -> (Value<R>, Value<R>, Value<R>) {
        let all = self.sigma.bits();
        // the bits of the angle before its point
        let whole = log2(&mean.0).max(0.0) as u32;
        let mut bits = ROUGH_BITS + whole;
        let mut x = Equation::rounded(self, mean, bits).roughly();
        loop {
            bits = (2 * bits - whole - LOST_BITS).min(all);
            // the last step but one has half of the digits and some more
            if bits < all && 2 * bits > all {
                bits = (all / 2 + whole + 2 * LOST_BITS).min(all);
            }
            let equation = Equation::rounded(self, mean, bits);
            x = Value(x.at_bits(bits));
            let (sin, versine) = sine_and_versine(&x);
            let change = equation.off(&x, &sin, &versine) / equation.slope(&sin, &versine);
            x -= change.clone();
            // convergence is quadratic: the error is now the square of the change, and some bits for the curvature
            if bits == all && log2(&change.0) < -f64::from(all / 2 + LOST_BITS / 2) {
                let half = change.clone().square() / 2;
                let cos = 1 - versine.clone();
                return (
                    x,
                    sin.clone() - change.clone() * &cos - half.clone() * &sin,
                    versine - change * sin + half * cos,
                );
            }
        }
    }
}

/// Kepler's equation ωt = x − σ sin x + τ(1 − cos x) with numbers of some bits.
struct Equation<R> {
    sigma: Value<R>,
    tau: Value<R>,
    mean: Value<R>,
}

/// The bits of a first approximation, in addition to the bits of the angle before its point.
const ROUGH_BITS: u32 = 128;

/// Bits that a step of Newton's method may lose where the equation is flat and curved.
const LOST_BITS: u32 = 40;

impl<R: HighPrecision> Equation<R> {
    fn rounded(ellipse: &Ellipse<R>, mean: &Value<R>, bits: u32) -> Self {
        let [sigma, tau, mean] = [&ellipse.sigma, &ellipse.tau, mean].map(|value| Value(value.at_bits(bits)));
        Equation { sigma, tau, mean }
    }

    /// The residual of x.
    fn off(&self, x: &Value<R>, sin: &Value<R>, versine: &Value<R>) -> Value<R> {
        x.clone() - self.sigma.clone() * sin + self.tau.clone() * versine - &self.mean
    }

    /// Its derivative, r/a = 1 − σ cos x + τ sin x.
    fn slope(&self, sin: &Value<R>, versine: &Value<R>) -> Value<R> {
        1 - self.sigma.clone() * (1 - versine.clone()) + self.tau.clone() * sin
    }

    /// x to half of its bits at least, by Newton's method within bounds.
    fn roughly(&self) -> Value<R> {
        let mean = &self.mean;
        // |x − ωt| = |e sin E − e sin E₀| ≤ 2
        let (mut low, mut high) = (mean.clone() - 2, mean.clone() + 2);
        let half = -f64::from(ROUGH_BITS) / 2.0;
        let mut x = mean.clone();
        loop {
            let (sin, versine) = sine_and_versine(&x);
            let off = self.off(&x, &sin, &versine);
            *(if off.is_below_zero() { &mut low } else { &mut high }) = x.clone();
            let change = off / self.slope(&sin, &versine);
            let next = x.clone() - &change;
            if log2(&change.0) < half {
                return next;
            }
            x = if low < next && next < high { next } else { (low.clone() + &high) / 2 };
        }
    }
}

/// sin x and 1 − cos x.
fn sine_and_versine<R: HighPrecision>(x: &Value<R>) -> (Value<R>, Value<R>) {
    let (sin, cos) = x.sin_cos();
    (sin, 1 - cos)
}

/// Kepler's equation.
#[derive(Debug)]
pub(super) struct KeplersEquation;

impl Method for KeplersEquation {
    type Solution<R: HighPrecision> = Ellipse<R>;

    /// Refuses orbits with H ≥ 0 and those through the centre.
    fn check(values: &Values) -> Result<(), SolutionError> {
        let [x, y, px, py] = ["x", "y", "px", "py"].map(|name| values.value(name));
        if (x * py - y * px).is_zero() {
            return Err(RADIAL);
        }
        // |p|²|q| < 2, in squares, which are exact
        let (squared_r, squared_p) = (x * x + y * y, px * px + py * py);
        if &squared_p * &squared_p * squared_r >= Rational::from_integer(4.into()) {
            return Err(UNBOUND);
        }
        Ok(())
    }

    fn bits<R: HighPrecision>(request: &Request<'_>, rough: &R::Context) -> Result<u32, SolutionError> {
        let rough = Ellipse::<R>::with(request, rough.clone());
        // the orbit is so close to a parabola that no digits of 1/a are left
        if !rough.a.is_finite() || rough.a.is_below_zero() {
            return Err(UNBOUND);
        }
        // 1/a is a difference of numbers of size 2/r₀
        let parabolic = log2(&rough.a.0) - log2(&rough.r.0);
        let angle = log2(&rough.omega.0) + request.longest.log2();
        // 1 − e is at least this; r, the slope of Kepler's equation, gets as small, and errors grow as 1/r² in the
        // forces
        let [x, y] = &rough.q[..] else { unreachable!("two coordinates") };
        let [px, py] = &rough.p[..] else { unreachable!("two coordinates") };
        let momentum = x.clone() * py - y.clone() * px;
        let flatness = log2(&rough.a.0) + 1.0 - 2.0 * log2(&momentum.0);
        let growth = 2.0 * parabolic.max(0.0) + angle.max(0.0) + 4.0 * flatness.max(0.0);
        request.bits(growth, u32::MAX)
    }

    fn solve<R: HighPrecision>(request: &Request<'_>, context: R::Context) -> Ellipse<R> {
        Ellipse::with(request, context)
    }
}

impl<R: HighPrecision> Solution<R> for Ellipse<R> {
    fn at(&mut self, n: i64) -> Point<R> {
        let t = Value(R::from_rational(&(&self.h * Rational::from_integer(n.into())), &self.context));
        let (x, sin, versine) = self.anomaly(&(t * &self.omega));
        let r = (1 - self.sigma.clone() * (1 - versine.clone()) + self.tau.clone() * &sin) * &self.a;
        let f = 1 - self.a.clone() / &self.r * &versine;
        let g = ((1 - self.sigma.clone()) * &sin + self.tau.clone() * &versine) / &self.omega;
        let f_rate = -(self.root_a.clone() * &sin / &r / &self.r);
        let g_rate = 1 - self.a.clone() / &r * &versine;
        let combined = |f: &Value<R>, g: &Value<R>| {
            self.q.iter().zip(&self.p).map(|(q, p)| f.clone() * q + g.clone() * p).collect::<Vec<_>>()
        };
        Point { q: combined(&f, &g), p: combined(&f_rate, &g_rate), beta: x * &self.root_a * 3 }
    }
}
