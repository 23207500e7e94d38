//! The exact flow of Kepler's problem, in every number type: the part A of Wisdom–Holman splittings.

mod along;
mod anomaly;
mod equation;
mod input;
mod passage;
mod stumpff;

use crate::number::Number;
use along::Slopes;
use equation::{Equation, value};
pub use input::KeplerDriftError;
use passage::Passage;

/// The exact flow of A = |p|²/(2m) − κ/|q|, in terms of the velocity v = p/m and the gravity parameter μ = κ/m: q̈ =
/// −μq/|q|³.
///
/// **Formulas.** With r₀ = |q|, η = q·v, α = 2μ/r₀ − v² (which is μ/a), ζ = μ − αr₀ and G_k(s) = sᵏ c_k(αs²), where
/// c_k(z) = Σ (−z)ⁿ/(2n + k)! are Stumpff's functions, the universal anomaly s = ∫dt/r is the root of Kepler's equation
///
/// t = r₀s + ηG₂ + ζG₃, whose derivative r = r₀ + ηG₁ + ζG₂ is the distance at the time t; then
///
/// Δq = (f − 1)q + gv, Δv = ḟq + (ġ − 1)v with f − 1 = −μG₂/r₀, g = r₀G₁ + ηG₂, ḟ = −μG₁/(r₀r), ġ − 1 = −μG₂/r.
///
/// Ellipses, parabolas and hyperbolas are one case, and increments have no cancellation of f and ġ with 1. Whole
/// revolutions are taken off t first, of which s keeps its part. Along the flow β grows by ∫(qᵀA_q + pᵀA_p − 2A) dt =
/// 3κs.
///
/// **Solution.** In `f64`, a step of a fraction of a revolution begins with the series of s in t and is refined by two
/// steps of third order. Elsewhere, and always with more digits, s is found in `f64` by Laguerre's steps between two
/// bounds, at most 400; then steps in the number type triple the digits. Where the terms of r or t cancel, as on
/// hyperbolic passages of the centre, an `f64` drift is computed in double-double. A lane has the bits that it has
/// alone.
///
/// **Errors** of q and v, relative to |q| and |v|, in units of u (1 + K): u = 2⁻⁵³ for `f64`, 2⁻¹⁰⁶ for double-doubles,
/// and K is the condition of the problem, the root of the sum of squares of relative changes of the result by relative
/// changes of μ, q, v and t. Of 10⁵ random orbits from any point, over 10⁻⁶ to 30 periods of both signs:
///
/// | orbits | `f64`: median | 99 % | largest | double-double: median | 99 % | largest |
/// | --- | --- | --- | --- | --- | --- | --- |
/// | e < 0.3 | 0.33 | 1.34 | 2.3 | 0.14 | 1.30 | 3.1 |
/// | 0.3 < e ≤ 0.9999 | 0.35 | 1.73 | 5.5 | 0.19 | 1.71 | 23 |
/// | \|1 − e\| ≤ 10⁻⁸ | 0.32 | 1.60 | 7.7 | 0.14 | 1.61 | 8.6 |
/// | 1 + 10⁻⁶ ≤ e ≤ 10 | 0.32 | 1.62 | 5.0 | 0.14 | 8.31 | 341 |
///
/// In number types of more digits than `f64`, a hyperbolic passage loses as many digits as |ηG₁|/(r₀ + r) has, which
/// grows like r₀/|a|. Numbers of five limbs (96 digits) agreed with mpmath's of 60 digits on 10⁵ cases, to 1.3e-61 (1 +
/// K).
///
/// **Long runs.** Errors wander like √n: means over the orbits are below 2 standard errors at each n. Root mean squares
/// over 32 orbits (0.01 < e < 0.3, 15 to 100 steps a period, `f64`) of the relative error of energy and angular
/// momentum and of the angle of the pericentre:
///
/// | drifts | energy | angular momentum | angle |
/// | --- | --- | --- | --- |
/// | 10⁴ | 1.2e-14 | 5.5e-15 | 6.1e-14 |
/// | 10⁵ | 3.2e-14 | 1.5e-14 | 2.1e-13 |
/// | 10⁶ | 1.1e-13 | 5.5e-14 | 6.9e-13 |
/// | 10⁷ | 3.9e-13 | 1.9e-13 | 1.6e-12 |
///
/// Both tables are from `cargo test --release -p shadowstep kepler_drift -- --ignored --nocapture`. What a drift costs:
/// `cargo bench -p shadowstep --bench kepler_drift`; for planets about 105 ns in `f64` and 24 ns an orbit in
/// `Lanes<16>` with AVX-512.
///
/// **Radial orbits** (of no angular momentum) pass through the centre as ellipses and hyperbolas do whose pericentre
/// goes to 0: the body comes back where it came from. At the centre itself v is infinite or NaN.
///
/// **Range.** In `f64`, products such as r₀² and μs³ must not overflow or underflow. What is too large becomes infinite
/// or NaN; nothing panics.
///
/// ```
/// use shadowstep::systems::kepler_drift::KeplerDrift;
///
/// let mut drift = KeplerDrift::<f64>::new(&());
/// let (mut q, mut v) = ([1.0, 0.0], [0.0, 1.0]); // a circle of period 2π
/// let s = *drift.advance(&1.0, &1.0, &mut q, &mut v);
/// assert!((q[0] - 1_f64.cos()).abs() < 1e-15 && (v[0] + 1_f64.sin()).abs() < 1e-15);
/// assert!((s - 1.0).abs() < 1e-15); // ∫dt/r
/// ```
///
/// Sources: K. Stumpff, Himmelsmechanik I (1959); E. Everhart, E. T. Pitkin, Am. J. Phys. 51 (1983) 712; J. M. A.
/// Danby, Fundamentals of Celestial Mechanics, 2nd ed. (1988), ch. 6; J. Wisdom, D. M. Hernandez, MNRAS 453 (2015)
/// 3015; H. Rein, D. Tamayo, MNRAS 452 (2015) 376.
#[derive(Clone, Debug)]
pub struct KeplerDrift<N: Number> {
    /// Of dual numbers that of their values: derivatives follow from its solution.
    equation: Equation<N::Plain>,
    gauss: [N; 4],
    /// s = ∫dt/r
    anomaly: N,
    increment: [N; 2],
    /// The increments of all coordinates, where a lane passes the centre.
    increments: Vec<[N; 2]>,
    passage: Option<Passage>,
}

impl<N: Number> KeplerDrift<N> {
    /// A place for intermediate results, so that no drift allocates.
    pub fn new(context: &N::Context) -> Self {
        let zero = || N::zero(context);
        let equation = Equation::new(context);
        let passage = equation.is_double().then(Passage::new);
        KeplerDrift {
            equation,
            gauss: [zero(), zero(), zero(), zero()],
            anomaly: zero(),
            increment: [zero(), zero()],
            increments: Vec::with_capacity(3),
            passage,
        }
    }

    /// q, v ← the state after the time t, positive or negative, around a centre of gravity parameter μ; s = ∫dt/r is
    /// returned.
    ///
    /// Positions and velocities have the same dimension. [Wrong input](KeplerDrift::check) makes NaNs, in its own lane.
    #[inline(always)]
    pub fn advance(&mut self, mu: &N, t: &N, q: &mut [N], v: &mut [N]) -> &N {
        self.with_increments(mu, t, q, v, |_, _, _| {})
    }

    /// The same, with the same bits; what is added to q and v is added to dq and dv as well.
    #[inline(always)]
    pub fn advance_augmented(&mut self, mu: &N, t: &N, q: &mut [N], v: &mut [N], dq: &mut [N], dv: &mut [N]) -> &N {
        self.with_increments(mu, t, q, v, |i, of_q, of_v| {
            dq[i].add(of_q);
            dv[i].add(of_v);
        })
    }

    /// The same after a [check](KeplerDrift::check).
    ///
    /// # Errors
    /// Wrong input; then q and v are unchanged.
    pub fn try_advance(&mut self, mu: &N, t: &N, q: &mut [N], v: &mut [N]) -> Result<&N, KeplerDriftError> {
        Self::check(mu, t, q, v)?;
        Ok(self.advance(mu, t, q, v))
    }

    /// Checks the input of a drift.
    ///
    /// # Errors
    /// μ is not positive and finite; the time, a position or a velocity is not finite; q is 0; q and v differ in their
    /// dimensions. With lanes, in any of them.
    ///
    /// ```
    /// use shadowstep::systems::kepler_drift::KeplerDrift;
    ///
    /// let error = KeplerDrift::check(&-1.0, &0.1, &[1.0, 0.0], &[0.0, 1.0]).unwrap_err();
    /// assert_eq!(error.to_string(), "the gravity parameter μ of a Kepler drift must be positive and finite, but it is -1");
    /// ```
    pub fn check(mu: &N, t: &N, q: &[N], v: &[N]) -> Result<(), KeplerDriftError> {
        input::check(mu, t, q, v)
    }

    /// The flow, where `each` is given the index of a coordinate and the increments of q and v.
    #[inline(always)]
    fn with_increments(&mut self, mu: &N, t: &N, q: &mut [N], v: &mut [N], mut each: impl FnMut(usize, &N, &N)) -> &N {
        N::in_widest_instructions(
            #[inline(always)]
            || {
                self.solve(mu, t, q, v);
                if self.equation.cancels() {
                    self.pass_centre(mu, t, q, v);
                    for (i, [of_q, of_v]) in self.increments.iter().enumerate() {
                        q[i].add(of_q);
                        v[i].add(of_v);
                        each(i, of_q, of_v);
                    }
                    return;
                }
                for (i, (q, v)) in q.iter_mut().zip(v).enumerate() {
                    assign_increment(&mut self.increment, &self.gauss, q, v);
                    let [of_q, of_v] = &self.increment;
                    q.add(of_q);
                    v.add(of_v);
                    each(i, of_q, of_v);
                }
            },
        );
        &self.anomaly
    }

    /// Gauss's functions and s.
    #[inline(always)]
    fn solve(&mut self, mu: &N, t: &N, q: &[N], v: &[N]) {
        let KeplerDrift { equation, gauss, anomaly, .. } = self;
        let ((mu, of_mu), (t, of_t)) = (mu.dual_parts(), t.dual_parts());
        equation.solve(mu, t, q.iter().zip(v).map(|(q, v)| [q.dual_parts().0, v.dual_parts().0]));
        equation.assign_gauss(gauss.each_mut().map(|number| number.dual_parts_mut().0));
        anomaly.dual_parts_mut().0.assign(equation.anomaly());
        if !N::HAS_DERIVATIVES {
            return;
        }
        let slopes = Slopes::new(equation);
        for k in 0..of_mu.len() {
            let coordinates = q.iter().zip(v).map(|(q, v)| {
                let ((q, of_q), (v, of_v)) = (q.dual_parts(), v.dual_parts());
                [q, v, &of_q[k], &of_v[k]]
            });
            let values = gauss.each_ref().map(|number| number.dual_parts().0);
            let along = slopes.along(equation, values, (&of_mu[k], &of_t[k]), coordinates);
            gauss.iter_mut().zip(&along.gauss).for_each(|(own, of)| own.dual_parts_mut().1[k].assign(of));
            anomaly.dual_parts_mut().1[k].assign(&along.anomaly);
        }
    }

    /// Increments of all coordinates ← the ones by Gauss's functions, and in lanes where these have lost digits, the
    /// ones of more digits.
    #[cold]
    fn pass_centre(&mut self, mu: &N, t: &N, q: &[N], v: &[N]) {
        self.increments.clear();
        for (q, v) in q.iter().zip(v) {
            assign_increment(&mut self.increment, &self.gauss, q, v);
            self.increments.push(self.increment.clone());
        }
        let Some(passage) = &mut self.passage else { return };
        for lane in 0..N::LANES {
            if !self.equation.cancels_in(lane) {
                continue;
            }
            let state = q.iter().zip(v).map(|(q, v)| [value(q, lane), value(v, lane)]);
            let s = passage.solve(value(mu, lane), value(t, lane), state);
            let generic = self.anomaly.clone();
            self.anomaly.set_lane(lane, s, 0);
            self.anomaly.assign_derivatives(&generic);
            for (i, of_both) in self.increments.iter_mut().enumerate() {
                for (number, increment) in of_both.iter_mut().zip(passage.increments(i)) {
                    let generic = number.clone();
                    number.set_lane(lane, increment, 0);
                    number.assign_derivatives(&generic);
                }
            }
        }
    }
}

/// The increments of a coordinate: (f − 1)q + gv and ḟq + (ġ − 1)v.
#[inline(always)]
fn assign_increment<N: Number>([of_q, of_v]: &mut [N; 2], [f, g, f_dot, g_dot]: &[N; 4], q: &N, v: &N) {
    of_q.assign_product(f, q);
    of_q.add_product(g, v);
    of_v.assign_product(f_dot, q);
    of_v.add_product(g_dot, v);
}
