//! Kepler's equation in any number type: t = r₀s + ηG₂(s) + ζG₃(s), with G_k = sᵏ c_k(αs²).
//!
//! Functions are inlined, so that lanes use the widest instructions; not without optimisation, as the frame of one
//! function with every intermediate result of double-doubles in lanes overflows the stack.

use std::cmp::Ordering;

use super::anomaly::Orbit;
use super::stumpff::{Stumpff, Terms};
use crate::Rational;
use crate::number::{Number, epsilon, scaled};

/// The equation of an orbit and a time, its root s as far as it is known, and all that is computed at s. No call
/// allocates.
#[derive(Clone, Debug)]
pub(super) struct Equation<N> {
    /// Whether the numbers have the 53 bits of `f64` or fewer.
    is_double: bool,
    /// The largest step, in units of the orbit's scales, after which nothing is left to refine.
    last_step: f64,
    pub(super) mu: N,
    time: N,
    pub(super) r0: N,
    /// μ/r₀
    pub(super) pull: N,
    /// q·v
    pub(super) eta: N,
    /// 2μ/r₀ − v²
    pub(super) alpha: N,
    /// μ − αr₀
    pub(super) zeta: N,
    pub(super) s: N,
    /// s before the last step, where Stumpff's functions are known.
    pub(super) before: N,
    pub(super) stumpff: Stumpff<N>,
    z: N,
    pub(super) g: [N; 3],
    f: N,
    pub(super) r: N,
    slope: N,
    /// Newton's step −f/r.
    newton: N,
    /// That with the next term.
    pub(super) step: N,
    /// Whole revolutions that the time is without.
    pub(super) revolutions: N,
    pub(super) has_revolutions: bool,
    /// s with whole revolutions included.
    anomaly: N,
    /// Whether the step is long in some lane.
    is_long: bool,
    pub(super) pi: N,
    pub(super) one: N,
    scratch: [N; 3],
}

/// More passes than any orbit has needed: each one triples the digits.
const MOST_PASSES: usize = 60;

impl<N: Number> Equation<N> {
    /// Whether the numbers have the 53 bits of `f64` or fewer.
    pub(super) fn is_double(&self) -> bool {
        self.is_double
    }

    pub(super) fn new(context: &N::Context) -> Self {
        let bits = bits_of::<N>(context);
        let zero = || N::zero(context);
        let zeros = || [zero(), zero(), zero()];
        let one = N::from_rational(&Rational::from_integer(1.into()), context);
        let mut minus_one = one.clone();
        minus_one.negate();
        let mut pi = zero();
        pi.assign_acos(&minus_one);
        pi.assign_derivatives(&one); // of a constant, where the function has none
        Equation {
            is_double: bits <= f64::MANTISSA_DIGITS,
            last_step: (-f64::from(bits) / 3.0 - 2.0).exp2(),
            mu: zero(),
            time: zero(),
            r0: zero(),
            pull: zero(),
            eta: zero(),
            alpha: zero(),
            zeta: zero(),
            s: zero(),
            before: zero(),
            stumpff: Stumpff::new(bits, context),
            z: zero(),
            g: zeros(),
            f: zero(),
            r: zero(),
            slope: zero(),
            newton: zero(),
            step: zero(),
            revolutions: zero(),
            has_revolutions: false,
            anomaly: zero(),
            is_long: false,
            pi,
            one,
            scratch: zeros(),
        }
    }

    /// Solves the equation of the orbit through q with the velocity v: s, G₁, G₂ and r at the time t.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn solve<'a>(&mut self, mu: &N, time: &N, coordinates: impl Iterator<Item = [&'a N; 2]>)
    where
        N: 'a,
    {
        self.assign_orbit(mu, coordinates);
        self.time.assign(time);
        self.has_revolutions = false;
        self.is_long = false;
        if self.is_double {
            self.begin_short_step();
            for lane in 0..N::LANES {
                if !self.is_close(lane) {
                    self.begin(lane);
                }
            }
            self.evaluate(Terms::All);
            self.assign_step();
        } else {
            (0..N::LANES).for_each(|lane| self.begin(lane));
            self.refine();
        }
        self.take_last_step();
        // of numbers that are dual twice: the last step from an error d leaves d³ in s and d² in its derivatives; of an
        // f64, d is small enough for these too
        if N::HAS_DERIVATIVES && !self.is_double {
            self.settle_derivatives();
        }
    }

    /// One more step, of which the derivatives are taken: those of the solution, as the step itself is 0 up to
    /// round-off.
    fn settle_derivatives(&mut self) {
        let solution = |own: &mut Self| {
            let [g1, g2, _] = &own.g;
            [&own.s, g1, g2, &own.r, &own.anomaly].map(N::clone)
        };
        let before = solution(self);
        self.evaluate(Terms::All);
        self.assign_step();
        self.take_last_step();
        let settled = solution(self);
        let [g1, g2, _] = &mut self.g;
        let numbers = [&mut self.s, g1, g2, &mut self.r, &mut self.anomaly];
        for ((number, value), derivatives) in numbers.into_iter().zip(before).zip(&settled) {
            number.assign(&value);
            number.assign_derivatives(derivatives);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn assign_orbit<'a>(&mut self, mu: &N, coordinates: impl Iterator<Item = [&'a N; 2]>)
    where
        N: 'a,
    {
        let [square, ..] = &mut self.scratch;
        square.assign_zero();
        self.eta.assign_zero();
        self.alpha.assign_zero();
        for [q, v] in coordinates {
            square.add_product(q, q);
            self.eta.add_product(q, v);
            self.alpha.subtract_product(v, v);
        }
        self.mu.assign(mu);
        self.r0.assign_sqrt(square);
        self.pull.assign_quotient(mu, &self.r0);
        square.assign(&self.pull);
        square.multiply_integer(2);
        self.alpha.add(square);
        self.zeta.assign(mu);
        self.zeta.subtract_product(&self.alpha, &self.r0);
    }

    /// s ← the first terms of its series in t, and a step from there with few terms of the Stumpff functions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn begin_short_step(&mut self) {
        let [tau, w, z] = &mut self.scratch;
        self.step.assign_quotient(&self.one, &self.r0);
        tau.assign_product(&self.time, &self.step);
        w.assign_product(&self.eta, &self.step);
        z.assign_product(&self.zeta, &self.step);
        // s = τ − τ²(w/2 − τ(w²/2 − z/6)), τ = t/r₀, w = η/r₀, z = ζ/r₀
        z.divide_integer(3);
        self.s.assign_square(w);
        self.s.subtract(z);
        self.s.multiply(tau);
        w.subtract(&self.s);
        w.multiply(tau);
        w.divide_integer(2);
        self.s.assign(tau);
        self.s.subtract_product(tau, w);
        self.evaluate(Terms::Few);
        self.assign_step();
        self.s.add(&self.step);
    }

    /// At s: the Stumpff functions, f = r₀s + ηG₂ + ζG₃ − t, r = f′ = r₀ + ηG₁ + ζG₂, and its slope r′ = ηG₀ + ζG₁.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(&mut self, terms: Terms) {
        let [square, ..] = &mut self.scratch;
        square.assign_square(&self.s);
        self.z.assign_product(&self.alpha, square);
        self.stumpff.assign(&self.z, terms);
        let [c0, c1, c2, c3] = &self.stumpff.c;
        let [g1, g2, g3] = &mut self.g;
        g1.assign_product(&self.s, c1);
        g2.assign_product(square, c2);
        g3.assign_product(square, &self.s);
        g3.multiply(c3);
        self.f.assign_product(&self.r0, &self.s);
        self.f.subtract(&self.time);
        self.f.add_product(&self.eta, g2);
        self.f.add_product(&self.zeta, g3);
        self.slope.assign_product(&self.eta, c0);
        self.slope.add_product(&self.zeta, g1);
        self.assign_radius();
    }

    #[inline(always)]
    fn assign_radius(&mut self) {
        let [g1, g2, _] = &self.g;
        self.r.assign(&self.r0);
        self.r.add_product(&self.eta, g1);
        self.r.add_product(&self.zeta, g2);
    }

    /// Newton's step and the next term, of which the error is cubic (Chebyshev): d − d² r′/(2r), d = −f/r.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn assign_step(&mut self) {
        let [inverse, ..] = &mut self.scratch;
        inverse.assign_quotient(&self.one, &self.r);
        self.newton.assign_product(&self.f, inverse);
        self.newton.negate();
        inverse.multiply(&self.slope);
        inverse.multiply(&self.newton);
        inverse.divide_integer(2);
        self.step.assign(&self.newton);
        self.step.subtract_product(&self.newton, inverse);
    }

    /// Whether Newton's step was short (the two terms of the step may cancel by chance), so that what is left of the
    /// error is below 10⁻⁶ of the orbit's own scales.
    #[inline(always)]
    fn is_close(&self, lane: usize) -> bool {
        let [mu, alpha, s, z, r, slope, step] =
            [&self.mu, &self.alpha, &self.s, &self.z, &self.r, &self.slope, &self.newton].map(|x| value(x, lane));
        self.stumpff.is_small(z)
            && (step * slope).abs() <= 1e-2 * r
            && step * step * (mu + alpha.abs() * r) <= 1e-4 * r
            && step.abs() <= 1e-2 * s.abs()
    }

    /// s of a lane ← s computed in `f64`, and the time without whole revolutions.
    #[cold]
    #[inline(never)]
    fn begin(&mut self, lane: usize) {
        self.is_long = true;
        if !self.has_revolutions {
            self.revolutions.assign_zero();
        }
        let (orbit, velocity) = self.orbit(lane);
        for _ in 0..4 {
            let count = orbit.revolutions(self.scaled_time(lane, velocity));
            if count == 0.0 {
                break;
            }
            self.subtract_revolutions(lane, count);
        }
        self.s.set_lane(lane, orbit.anomaly(self.scaled_time(lane, velocity)), -velocity.0);
    }

    /// The orbit of a lane in units of 2ⁿ, in which it has the size 1, and the exponents of the units of velocity and
    /// length.
    fn orbit(&self, lane: usize) -> (Orbit, (i64, i64)) {
        let numbers = [&self.mu, &self.r0, &self.eta, &self.alpha, &self.zeta];
        let [mu, r0, eta, alpha, zeta] = numbers.map(|x| x.lane(lane));
        let length = exponent(r0);
        let velocity = (exponent(mu) - length).max(exponent(alpha)).div_euclid(2);
        let of = |(m, n): (f64, i64), unit: i64| scaled(m, n - unit);
        let orbit = Orbit {
            mu: of(mu, length + 2 * velocity),
            r0: of(r0, length),
            eta: of(eta, length + velocity),
            alpha: of(alpha, 2 * velocity),
            zeta: of(zeta, length + 2 * velocity),
        };
        (orbit, (velocity, length))
    }

    fn scaled_time(&self, lane: usize, (velocity, length): (i64, i64)) -> f64 {
        let (m, n) = self.time.lane(lane);
        scaled(m, n + velocity - length)
    }

    /// t ← t − count·2πμ/α^(3/2) in a lane
    fn subtract_revolutions(&mut self, lane: usize, count: f64) {
        let [turns, root, time] = &mut self.scratch;
        turns.set_lane(lane, count, 0);
        time.assign(&self.revolutions);
        time.add(turns);
        self.revolutions.assign_lane(lane, time);
        self.has_revolutions = true;
        turns.multiply(&self.pi);
        turns.multiply_integer(2);
        turns.multiply(&self.mu);
        root.assign_sqrt(&self.alpha);
        turns.divide(root);
        turns.divide(&self.alpha);
        time.assign_difference(&self.time, turns);
        self.time.assign_lane(lane, time);
    }

    /// Steps until the last one is so short that nothing is left. Lanes that are done wait for the others.
    fn refine(&mut self) {
        for _ in 0..MOST_PASSES {
            self.evaluate(Terms::All);
            self.assign_step();
            if (0..N::LANES).all(|lane| self.is_last_step(lane)) {
                return;
            }
            self.take_laguerre_step();
        }
    }

    /// Whether the step, in units of the orbit's scales, leaves less than the last place.
    fn is_last_step(&mut self, lane: usize) -> bool {
        let [_, ratio, square] = &mut self.scratch;
        // a NaN has nothing to refine
        let at_most = |x: &N, bound: f64| value(x, lane).abs().partial_cmp(&bound) != Some(Ordering::Greater);
        if at_most(&self.newton, 0.0) {
            return true;
        }
        ratio.assign_quotient(&self.newton, &self.s);
        let mut small = at_most(ratio, self.last_step);
        ratio.assign_product(&self.newton, &self.slope);
        ratio.divide(&self.r);
        small &= at_most(ratio, self.last_step);
        // |r″| ≤ μ + |α|r
        square.assign_square(&self.newton);
        ratio.assign_quotient(&self.mu, &self.r);
        ratio.multiply(square);
        small &= at_most(ratio, self.last_step.powi(2));
        ratio.assign_product(&self.alpha, square);
        small && at_most(ratio, self.last_step.powi(2))
    }

    /// s ← s − 5f/(r + √|16r² − 20fr′|) in lanes whose steps are not short (B. A. Conway, Celest. Mech. 39 (1986) 199).
    fn take_laguerre_step(&mut self) {
        let done: u64 = (0..N::LANES).filter(|lane| self.is_last_step(*lane)).map(|lane| 1 << lane).sum();
        let [root, product, next] = &mut self.scratch;
        root.assign_square(&self.r);
        root.multiply_integer(16);
        product.assign_product(&self.f, &self.slope);
        product.multiply_integer(20);
        root.subtract(product);
        root.make_absolute();
        product.assign_sqrt(root);
        product.add(&self.r);
        next.assign_quotient(&self.f, product);
        next.multiply_integer(-5);
        next.add(&self.s);
        for lane in (0..N::LANES).filter(|lane| done >> lane & 1 == 0) {
            self.s.assign_lane(lane, next);
        }
    }

    /// s ← s + d, with G₁, G₂ and r by their Taylor series of second order in d, and the whole revolutions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn take_last_step(&mut self) {
        let [half, change, slope] = &mut self.scratch;
        let [g1, g2, _] = &mut self.g;
        self.before.assign(&self.s);
        self.s.add(&self.step);
        half.assign(&self.step);
        half.divide_integer(2);
        // G₂ += d(G₁ + d/2 G₀), G₁ += d(G₀ − d/2 αG₁)
        slope.assign_product(&self.alpha, g1);
        change.assign(g1);
        change.add_product(half, &self.stumpff.c[0]);
        g2.add_product(&self.step, change);
        change.assign(&self.stumpff.c[0]);
        change.subtract_product(half, slope);
        g1.add_product(&self.step, change);
        self.assign_radius();
        self.anomaly.assign(&self.s);
        if self.has_revolutions {
            self.add_revolutions();
        }
    }

    /// anomaly ← s + count·2π/√α
    #[cold]
    fn add_revolutions(&mut self) {
        let [root, turns, sum] = &mut self.scratch;
        root.assign_sqrt(&self.alpha);
        turns.assign_product(&self.revolutions, &self.pi);
        turns.multiply_integer(2);
        turns.divide(root);
        sum.assign_sum(&self.s, turns);
        for lane in (0..N::LANES).filter(|lane| value(&self.revolutions, *lane) != 0.0) {
            self.anomaly.assign_lane(lane, sum);
        }
    }

    /// Whether terms of r or of t cancel in some lane: on the way to the pericentre and past it, of hyperbolas above
    /// all.
    #[inline(always)]
    pub(super) fn cancels(&self) -> bool {
        self.is_double && self.is_long && (0..N::LANES).any(|lane| self.cancels_in(lane))
    }

    /// Whether they do in this lane, and the numbers have the size of those that `f64` multiplies.
    pub(super) fn cancels_in(&self, lane: usize) -> bool {
        let [eta, g1, r0, r, s, t] =
            [&self.eta, &self.g[0], &self.r0, &self.r, &self.s, &self.time].map(|x| value(x, lane));
        let in_range = |x: &N| exponent(x.lane(lane)).abs() < 250;
        ((eta * g1).abs() > 1.5 * (r0 + r) || r0 * s.abs() > 2.5 * t.abs())
            && [&self.r0, &self.time, &self.mu].into_iter().all(in_range)
            && exponent(self.alpha.lane(lane)) < 250
    }

    /// s = ∫dt/r
    #[inline(always)]
    pub(super) fn anomaly(&self) -> &N {
        &self.anomaly
    }

    /// f − 1 = −μG₂/r₀, g = r₀G₁ + ηG₂, ḟ = −μG₁/(r₀r), ġ − 1 = −μG₂/r
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn assign_gauss(&self, [f, g, f_dot, g_dot]: [&mut N; 4]) {
        let [g1, g2, _] = &self.g;
        f.assign_product(&self.pull, g2);
        f.negate();
        g.assign_product(&self.r0, g1);
        g.add_product(&self.eta, g2);
        f_dot.assign_product(&self.pull, g1);
        f_dot.divide(&self.r);
        f_dot.negate();
        g_dot.assign_product(&self.mu, g2);
        g_dot.divide(&self.r);
        g_dot.negate();
    }
}

/// The precision of the numbers of a context.
fn bits_of<N: Number>(context: &N::Context) -> u32 {
    let epsilon = epsilon::<N>(context);
    let (m, n) = epsilon.lane(0);
    1 + (-(m.log2() + n as f64)).round() as u32
}

/// The number in a lane as an `f64`.
#[inline(always)]
pub(super) fn value<N: Number>(x: &N, lane: usize) -> f64 {
    let (m, n) = x.lane(lane);
    scaled(m, n)
}

/// e of |x| in [2^e, 2^(e + 1)), of normal numbers.
fn exponent((m, n): (f64, i64)) -> i64 {
    (m.to_bits() >> 52 & 0x7ff) as i64 - 1023 + n
}
