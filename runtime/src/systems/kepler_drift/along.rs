//! The derivative of a Kepler drift along a direction, by formulas: the equation is solved for the numbers alone.

use super::equation::Equation;
use crate::Rational;
use crate::number::Number;

/// What the derivatives of a drift along all directions have in common.
///
/// With z = αs², ∂G_k/∂s = G_(k−1) and ∂G_k/∂α = (k G_(k+2) − s G_(k+1))/2, so that Kepler's equation t = r₀s + ηG₂ +
/// ζG₃ gives
///
/// r ṡ = ṫ − s ṙ₀ − G₂ η̇ − G₃ ζ̇ − (η ∂G₂/∂α + ζ ∂G₃/∂α) α̇.
///
/// S. Mikkola, K. Innanen, Celest. Mech. Dyn. Astron. 74 (1999) 59; H. Rein, D. Tamayo, MNRAS 459 (2016) 2275.
pub(super) struct Slopes<P> {
    inverse_r0: P,
    inverse_r: P,
    g0: P,
    g3: P,
    /// ∂G₁/∂α, ∂G₂/∂α
    of_g: [P; 2],
    /// η ∂G₂/∂α + ζ ∂G₃/∂α
    of_time: P,
}

/// Derivatives of s, and of f − 1, g, ḟ and ġ − 1.
pub(super) struct Along<P> {
    pub(super) anomaly: P,
    pub(super) gauss: [P; 4],
}

impl<P: Number> Slopes<P> {
    #[inline(always)]
    pub(super) fn new(equation: &Equation<P>) -> Self {
        let Equation { s, alpha, eta, zeta, r0, r, one, .. } = equation;
        let [_, g2, _] = &equation.g;
        let [g3, g4, g5] = equation.longer_functions();
        // (k G_(k+2) − s G_(k+1))/2
        let half_difference = |k: i32, more: &P, less: &P| {
            let mut slope = more.clone();
            slope.multiply_integer(k);
            slope.subtract_product(s, less);
            slope.divide_integer(2);
            slope
        };
        let of_g = [half_difference(1, &g3, g2), half_difference(2, &g4, &g3)];
        let mut of_time = product(eta, &of_g[1]);
        of_time.add_product(zeta, &half_difference(3, &g5, &g4));
        let quotient = |r: &P| {
            let mut inverse = one.clone();
            inverse.divide(r);
            inverse
        };
        let mut g0 = one.clone();
        g0.subtract_product(alpha, g2);
        Slopes { inverse_r0: quotient(r0), inverse_r: quotient(r), g0, g3, of_g, of_time }
    }

    /// Along a direction in which μ, t and each q and v have these derivatives; f, g, ḟ, ġ are those of the drift.
    #[inline(always)]
    pub(super) fn along<'a>(
        &self,
        equation: &Equation<P>,
        [_, _, f_dot, g_dot]: [&P; 4],
        (of_mu, of_t): (&P, &P),
        coordinates: impl Iterator<Item = [&'a P; 4]>,
    ) -> Along<P>
    where
        P: 'a,
    {
        let Equation { mu, r0, pull, eta, alpha, zeta, s, .. } = equation;
        let [g1, g2, _] = &equation.g;
        let Slopes { inverse_r0, inverse_r, g0, g3, of_g: [a1, a2], of_time } = self;
        let [mut of_r0, of_eta, mut of_alpha] = of_products(coordinates, &s.context());
        of_r0.multiply(inverse_r0);
        let mut of_pull = of_mu.clone();
        of_pull.subtract_product(pull, &of_r0);
        of_pull.multiply(inverse_r0);
        of_alpha.add(&of_pull);
        of_alpha.multiply_integer(2);
        let mut of_zeta = of_mu.clone();
        of_zeta.subtract_product(alpha, &of_r0);
        of_zeta.subtract_product(r0, &of_alpha);
        let mut of_s = of_t.clone();
        if let Some(of_turns) = equation.derivative_of_turns(of_mu, &of_alpha) {
            of_s.subtract(&of_turns);
        }
        of_s.subtract_product(s, &of_r0);
        of_s.subtract_product(g2, &of_eta);
        of_s.subtract_product(g3, &of_zeta);
        of_s.subtract_product(of_time, &of_alpha);
        of_s.multiply(inverse_r);
        let mut of_g1 = product(g0, &of_s);
        of_g1.add_product(a1, &of_alpha);
        let mut of_g2 = product(g1, &of_s);
        of_g2.add_product(a2, &of_alpha);
        let mut of_r = of_r0.clone();
        for (a, b) in [(g1, &of_eta), (eta, &of_g1), (g2, &of_zeta), (zeta, &of_g2)] {
            of_r.add_product(a, b);
        }
        // f − 1 = −μG₂/r₀, g = r₀G₁ + ηG₂, ḟ = −μG₁/(r₀r), ġ − 1 = −μG₂/r
        let of_f = minus_sum([(&of_pull, g2), (pull, &of_g2)]);
        let mut of_g = minus_sum([(&of_r0, g1), (r0, &of_g1)]);
        of_g.negate();
        of_g.add_product(&of_eta, g2);
        of_g.add_product(eta, &of_g2);
        let mut of_f_dot = minus_sum([(&of_pull, g1), (pull, &of_g1)]);
        of_f_dot.subtract_product(f_dot, &of_r);
        of_f_dot.multiply(inverse_r);
        let mut of_g_dot = minus_sum([(of_mu, g2), (mu, &of_g2)]);
        of_g_dot.subtract_product(g_dot, &of_r);
        of_g_dot.multiply(inverse_r);
        if let Some(of_anomaly) = equation.derivative_of_whole_anomaly(&of_alpha) {
            of_s.add(&of_anomaly);
        }
        Along { anomaly: of_s, gauss: [of_f, of_g, of_f_dot, of_g_dot] }
    }
}

/// The derivatives of ½qᵀq, qᵀv and −½vᵀv.
#[inline(always)]
fn of_products<'a, P: Number + 'a>(coordinates: impl Iterator<Item = [&'a P; 4]>, context: &P::Context) -> [P; 3] {
    let [mut of_qq, mut of_qv, mut of_vv] = std::array::from_fn(|_| P::zero(context));
    for [q, v, of_q, of_v] in coordinates {
        of_qq.add_product(q, of_q);
        of_qv.add_product(q, of_v);
        of_qv.add_product(v, of_q);
        of_vv.subtract_product(v, of_v);
    }
    [of_qq, of_qv, of_vv]
}

/// −(ab + cd)
#[inline(always)]
fn minus_sum<P: Number>([(a, b), (c, d)]: [(&P, &P); 2]) -> P {
    let mut sum = product(a, b);
    sum.add_product(c, d);
    sum.negate();
    sum
}

impl<P: Number> Equation<P> {
    /// G₃, G₄ and G₅ at the solution.
    #[inline(always)]
    fn longer_functions(&self) -> [P; 3] {
        let Equation { step, stumpff, before: s, .. } = self;
        let [c4, c5] = &stumpff.longer;
        let square = product(s, s);
        let g2 = product(&square, &stumpff.c[2]);
        let mut g3 = product(&square, s);
        let mut g5 = product(&square, &g3);
        let mut g4 = product(&square, &square);
        g3.multiply(&stumpff.c[3]);
        g4.multiply(c4);
        g4.divide_integer(24);
        g5.multiply(c5);
        g5.divide_integer(120);
        let g1 = product(s, &stumpff.c[1]);
        // G_k += d (G_(k−1) + d/2 G_(k−2)): from the highest on
        let mut half = step.clone();
        half.divide_integer(2);
        let advance = |more: &mut P, less: &P, least: &P| {
            let mut change = product(&half, least);
            change.add(less);
            more.add_product(step, &change);
        };
        advance(&mut g5, &g4, &g3);
        advance(&mut g4, &g3, &g2);
        advance(&mut g3, &g2, &g1);
        [g3, g4, g5]
    }

    /// The derivative of the whole revolutions that the time is without, count·2πμ/α^(3/2).
    #[inline(always)]
    fn derivative_of_turns(&self, of_mu: &P, of_alpha: &P) -> Option<P> {
        self.has_revolutions.then(|| {
            self.in_turning_lanes(|turns, root| {
                // (count 2π/√α)(μ̇ − 3/2 μ α̇/α)/α
                let mut change = product(&self.mu, of_alpha);
                change.multiply(&P::from_rational(&Rational::new((-3).into(), 2.into()), &root.context()));
                change.divide(&self.alpha);
                change.add(of_mu);
                change.divide(&self.alpha);
                turns.multiply(&change);
            })
        })
    }

    /// The derivative of what whole revolutions add to s, count·2π/√α.
    #[inline(always)]
    fn derivative_of_whole_anomaly(&self, of_alpha: &P) -> Option<P> {
        self.has_revolutions.then(|| {
            self.in_turning_lanes(|turns, _| {
                turns.multiply(of_alpha);
                turns.divide(&self.alpha);
                turns.divide_integer(-2);
            })
        })
    }

    /// What is done to count·2π/√α, in lanes with whole revolutions; 0 in the others.
    #[cold]
    fn in_turning_lanes(&self, change: impl FnOnce(&mut P, &P)) -> P {
        let mut root = self.alpha.clone();
        root.assign_sqrt(&self.alpha);
        let mut turns = product(&self.revolutions, &self.pi);
        turns.multiply_integer(2);
        turns.divide(&root);
        change(&mut turns, &root);
        let mut found = P::zero(&root.context());
        for lane in (0..P::LANES).filter(|lane| self.revolutions.lane(*lane).0 != 0.0) {
            found.assign_lane(lane, &turns);
        }
        found
    }
}

/// a b
#[inline(always)]
fn product<P: Number>(a: &P, b: &P) -> P {
    let mut product = a.clone();
    product.assign_product(a, b);
    product
}
