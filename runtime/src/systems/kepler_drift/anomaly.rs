//! The universal anomaly s(t) in `f64`, for any orbit and time: Laguerre's steps between two bounds.

use std::f64::consts::{PI, TAU};

/// An orbit by what is known of its first point: μ and the numbers of Kepler's equation t = r₀s + ηG₂(s) + ζG₃(s), all
/// scaled by powers of 2 such that the squared velocities μ/r₀ and |α| are below 4.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit {
    pub(super) mu: f64,
    pub(super) r0: f64,
    /// q·v
    pub(super) eta: f64,
    /// 2μ/r₀ − v² = μ/a
    pub(super) alpha: f64,
    /// μ − αr₀
    pub(super) zeta: f64,
}

/// More steps than any orbit has needed; each fourth is at least a bisection.
const MOST_STEPS: usize = 400;

/// What a step leaves of an error, in units of the orbit's own scales, is about the cube of the step in these.
const SMALL: f64 = 1e-4;

impl Orbit {
    /// The number of whole revolutions that is nearest to the time t.
    pub(super) fn revolutions(&self, t: f64) -> f64 {
        let count = (t * self.alpha * self.alpha.sqrt() / (TAU * self.mu)).round();
        if self.alpha > 0.0 && count.is_finite() { count } else { 0.0 }
    }

    /// s of the time t, at most half a revolution, to some 10 digits: further steps in another number type refine it.
    /// NaN if a number is not finite.
    pub(super) fn anomaly(&self, t: f64) -> f64 {
        let finite = [t, self.mu, self.r0, self.eta, self.alpha, self.zeta].into_iter().all(f64::is_finite);
        if t == 0.0 || !finite {
            return if finite { 0.0 } else { f64::NAN };
        }
        // backwards as forwards with the opposite velocity
        Orbit { eta: self.eta * t.signum(), ..*self }.search(t.abs()).0 * t.signum()
    }

    /// s of a time t > 0, and the number of steps.
    fn search(&self, t: f64) -> (f64, usize) {
        // the eccentric anomaly of half a revolution is at most 4.62, where x = π + 2 sin(x/2)
        let (mut low, mut high) = (0.0, if self.alpha > 0.0 { 1.5 * PI / self.alpha.sqrt() } else { f64::INFINITY });
        let within = |s: f64, low: f64, high: f64| s > low && s < high;
        let mut s = self.guess(t);
        if !within(s, low, high) {
            s = (t / self.r0).min(0.5 * high);
        }
        for count in 0..MOST_STEPS {
            let at = self.equation(s, t);
            if at.is_solved() {
                return (s, count);
            }
            if at.f < 0.0 {
                low = s
            } else {
                high = s
            }
            let step = at.laguerre();
            let next = s + step;
            if at.is_small(step, s) {
                return (next.clamp(low, high), count);
            }
            if within(next, low, high) && count % 4 != 3 {
                s = next;
                continue;
            }
            s = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * s };
            if !within(s, low, high) {
                return (s, count); // the bounds are neighbours
            }
        }
        (s, MOST_STEPS)
    }

    /// A first s: of short steps by the series in t, of bound orbits by Danby's (Fundamentals of Celestial Mechanics,
    /// eq. 6.8.20), of long hyperbolic flights by the leading exponential, else of the parabola.
    fn guess(&self, t: f64) -> f64 {
        let (tau, w, z) = (t / self.r0, self.eta / self.r0, self.zeta / self.r0);
        if (tau * w).abs() < 0.3 && (tau * tau * z).abs() < 0.3 {
            return tau * (1.0 - tau * (0.5 * w - tau * (0.5 * w * w - z / 6.0)));
        }
        let parabolic = self.parabolic(t);
        if self.alpha.abs() * parabolic * parabolic < 1.0 {
            return parabolic;
        }
        let k = self.alpha.abs().sqrt();
        if self.alpha > 0.0 {
            let (sine, cosine) = (self.eta * k / self.mu, self.zeta / self.mu); // e sin E₀, e cos E₀
            let y = k * k * k / self.mu * t - sine;
            let sign = (sine * y.cos() + cosine * y.sin()).signum();
            return (y + 0.85 * sine.hypot(cosine) * sign) / k;
        }
        let exponential = (2.0 * k * k * t / (self.eta + self.zeta / k)).ln() / k;
        if exponential * k > 1.0 { exponential.min(parabolic) } else { parabolic }
    }

    /// The root of r₀s + ηs²/2 + ζs³/6 = t if the left side grows everywhere, else NaN.
    fn parabolic(&self, t: f64) -> f64 {
        let shift = self.eta / self.zeta;
        let p = 2.0 * self.r0 / self.zeta - shift * shift;
        let q = 3.0 * t / self.zeta + shift * (3.0 * self.r0 / self.zeta - shift * shift);
        let root = p.sqrt();
        2.0 * root * ((q / (p * root)).asinh() / 3.0).sinh() - shift
    }

    /// Kepler's equation at s.
    fn equation(&self, s: f64, t: f64) -> Equation {
        let [c0, c1, c2, c3] = stumpff(self.alpha * s * s);
        let (g1, g2, g3) = (s * c1, s * s * c2, s * s * s * c3);
        let terms = [self.r0 * s, self.eta * g2, self.zeta * g3];
        let r = self.r0 + self.eta * g1 + self.zeta * g2;
        Equation {
            f: terms[0] - t + terms[1] + terms[2],
            round_off: f64::EPSILON * (terms.into_iter().map(f64::abs).sum::<f64>() + t),
            r,
            slope: self.eta * c0 + self.zeta * g1,
            curvature: self.mu - self.alpha * r,
            alpha: self.alpha,
        }
    }
}

/// f = r₀s + ηG₂ + ζG₃ − t and its derivatives r, r′, r″.
#[derive(Clone, Copy, Debug)]
struct Equation {
    f: f64,
    round_off: f64,
    r: f64,
    slope: f64,
    curvature: f64,
    alpha: f64,
}

impl Equation {
    /// Whether f is 0 as far as its round-off shows.
    fn is_solved(&self) -> bool {
        self.f.abs() <= self.round_off
    }

    /// Laguerre's step of degree 5, which converges from nearly everywhere (B. A. Conway, Celest. Mech. 39 (1986) 199).
    fn laguerre(&self) -> f64 {
        let root = (16.0 * self.r * self.r - 20.0 * self.f * self.slope).abs().sqrt();
        -5.0 * self.f / (self.r + root)
    }

    /// Whether the step is small beside the scales on which r and the Stumpff functions change, and beside s.
    fn is_small(&self, step: f64, s: f64) -> bool {
        (step * self.slope).abs() <= SMALL * self.r
            && step * step * self.curvature.abs() <= SMALL * SMALL * self.r
            && step * step * self.alpha.abs() <= SMALL * SMALL
            && step.abs() <= SMALL * s.abs()
    }
}

/// c₀ … c₃ of z to some 12 digits.
fn stumpff(z: f64) -> [f64; 4] {
    if z.abs() > 5e5 {
        return [f64::INFINITY; 4]; // the hyperbolic functions overflow
    }
    let (mut y, mut count) = (z, 0);
    while y.abs() > 0.3 {
        y *= 0.25;
        count += 1;
    }
    let series = |n: f64| {
        (0..6).rev().fold(1.0, |sum, k| {
            let m = n + 2.0 * f64::from(k);
            1.0 - y / (m * (m + 1.0)) * sum
        })
    };
    let (mut c2, mut c3) = (series(3.0) / 2.0, series(4.0) / 6.0);
    let (mut c0, mut c1) = (1.0 - y * c2, 1.0 - y * c3);
    for _ in 0..count {
        c3 = (c2 + c0 * c3) * 0.25;
        c2 = c1 * c1 * 0.5;
        c1 *= c0;
        y *= 4.0;
        c0 = 1.0 - y * c2;
    }
    [c0, c1, c2, c3]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64Mcg;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    fn number(random: &mut Pcg64Mcg, low: f64, high: f64) -> f64 {
        low + (high - low) * (random.next_u64() >> 11) as f64 * 2_f64.powi(-53)
    }

    /// An orbit of any eccentricity, from any point, also a nearly or exactly radial one; r₀ = 1 and the larger of the
    /// squared velocities is 1.
    fn orbit(random: &mut Pcg64Mcg) -> Orbit {
        let mu = 10_f64.powf(number(random, -6.0, 0.0).max(-5.0));
        let square = if mu < 1.0 { number(random, 0.0, 2.0) } else { 0.0 } + 2.0 * number(random, 0.0, 1.0).powi(8);
        let tilt = [number(random, -1.0, 1.0), 1.0, -1.0, 0.0][(random.next_u64() % 4) as usize];
        let near = 1.0 - 10_f64.powf(number(random, -17.0, -1.0));
        let v2 = if random.next_u64() & 1 == 0 { square } else { 2.0 * mu * near };
        let alpha = 2.0 * mu - v2;
        Orbit { mu, r0: 1.0, eta: v2.sqrt() * tilt * near, alpha, zeta: mu - alpha }
    }

    #[test]
    fn few_steps_are_needed() {
        let mut random = Pcg64Mcg::seed_from_u64(3);
        let (mut most, mut sum) = (0, 0);
        let count = 100_000;
        for _ in 0..count {
            let orbit = orbit(&mut random);
            let mut t = 10_f64.powf(number(&mut random, -12.0, 12.0));
            if orbit.alpha > 0.0 {
                t = t.min(number(&mut random, 0.0, PI) * orbit.mu / orbit.alpha.powf(1.5));
            }
            let (s, steps) = orbit.search(t);
            let at = orbit.equation(s, t);
            // a wrong s would leave a part of t; a rounded one leaves at most what a change of s in the 9th digit does
            let close = at.f.abs() <= 100.0 * at.round_off + 1e-9 * s * at.r + 1e-9 * t;
            assert!(close, "{orbit:?}, t = {t:e}: s = {s:e} leaves {:e} after {steps} steps", at.f);
            assert!(steps <= 40, "{orbit:?}, t = {t:e}: {steps}");
            most = most.max(steps);
            sum += steps;
        }
        assert!(most <= 40 && sum < 5 * count, "{most} steps, {sum} in all");
    }

    #[test]
    fn any_numbers_end() {
        let sizes = [0.0, 1.0, -1.0, 1e-300, 1e300, -1e300, 1e-17, f64::MAX, f64::NAN, f64::INFINITY];
        for index in 0..sizes.len().pow(5) {
            let pick = |i: u32| sizes[index / sizes.len().pow(i) % sizes.len()];
            let orbit = Orbit { mu: 1.0, r0: pick(0), eta: pick(1), alpha: pick(2), zeta: pick(3) };
            orbit.anomaly(pick(4));
            orbit.revolutions(pick(4));
        }
    }
}
