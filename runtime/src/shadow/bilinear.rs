//! The bilinear estimator: products of the newest k + 1 states in pairs, of order 2k.
//!
//! With states counted back from the newest, i = 0..k,
//!
//! E_k = 1/(2h) Σ_{i>j} P_ij (q_i·p_j − p_i·q_j + β_j − β_i),   P_ij = 2 (−1)^{i−j} C(k,i) C(k,j) / ((i−j) C(2k,k)).
//!
//! This is the estimator of Skeel & Hardy (SIAM J. Sci. Comput. 23 (2001) 1172) and Engle, Skeel & Drees (J. Comput. Phys.
//! 206 (2005) 432), whose weights were printed as tables for k = 2, 4, …, 12, in closed formula.
//!
//! **Proof.** Let X = e^{−x} and Y = e^{−y} shift the first and the second factor of a product back by a step, x and y being h d/dt
//! on each. P is antisymmetric, so that the sum over i > j of P_ij (q_i·p_j − p_i·q_j) is that over all i ≠ j of P_ij q_i·p_j,
//! which is 2F/C(2k,k) on q·p with
//!
//! F(X,Y) = Σ_{i≠j} (−1)^{i−j} C(k,i) C(k,j) X^i Y^j / (i−j).
//!
//! Then (X∂_X − Y∂_Y) F = Σ_{i≠j} (−1)^{i−j} C(k,i) C(k,j) X^i Y^j = (1−X)^k (1−Y)^k − G(XY) with G(z) = Σ_i C(k,i)² z^i. In
//! s = x + y and d = x − y the operator is −2∂_d, and F is odd in d, so
//!
//! F = ½ d G(e^{−s}) − ½ ∫₀^d (1−X)^k (1−Y)^k dd'.
//!
//! The second term is of degree 2k + 1 in h. The first is the mean of ½(x − y), the derivative in ½h(q'·p − q·p'), at the
//! states i with the weights C(k,i)². So, as G(1) = C(2k,k), and likewise for β, whose weights are Σ_j P_ij,
//!
//! E_k = Σ_i C(k,i)²/C(2k,k) · ½(q'·p − q·p' − β')(state i) + O(h^{2k}):
//!
//! a mean of the modified energy over the window, about its middle, k/2 steps back. ∎ Nothing is assumed of the scheme but that
//! it has a modified Hamiltonian: it need not be a palindrome.

use crate::Rational;
use crate::motion::Increments;
use crate::number::Number;
use crate::shadow::form::{Form, Products};
use crate::shadow::spread::Point;
use crate::shadow::{Estimate, Estimator, Method};

/// The bilinear estimator E_k of order 2k from the newest k + 1 states, k ≥ 1.
///
/// Its value belongs to the middle of these: for an odd k to the time between two states. A state costs k products of
/// vectors and some k²/2 of numbers.
///
/// **Its error** is estimated by the larger of two: its spread, max − min over the 1 + ⌈√k⌉ windows on either side (the
/// modified energy is constant, so what changes from window to window is the estimator's error, or round-off), and the largest
/// of their last terms |E_k − E_{k−1}|, the mean of E_{k−1} over the two windows within. The spread alone does not see an error that
/// is the same everywhere, as on a circular orbit; the difference alone has zeros. That needs 1 + ⌈√k⌉ states more on each side;
/// see [Errors](crate::shadow#errors). For k = 1 there is no E_{k−1}, and no estimate.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, exact, problems::Kepler, run::energy_drift, shadow::Bilinear, tables::shipped};
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]); // eccentricity 0.6
/// let verlet = shipped("stormer-verlet").unwrap();
/// let drift = energy_drift(&verlet, start, &exact("1/40").unwrap(), 400, &Bilinear::new(16), |_| ()).unwrap();
/// assert!(drift.drift < 1e-12); // the energy itself varies by 0.01
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bilinear {
    /// Half the order; one less than the states.
    pub k: u32,
    /// Whether the error is wanted as well.
    pub with_error: bool,
}

impl Bilinear {
    /// E_k; no estimate of the error.
    pub fn new(k: u32) -> Self {
        Bilinear { k, with_error: false }
    }

    /// E_k with an estimate of its error for k ≥ 2.
    pub fn with_error(k: u32) -> Self {
        Bilinear { k, with_error: true }
    }
}

impl<N: Number> Method<N> for Bilinear {
    type Estimator = BilinearEstimator<N>;

    /// # Panics
    /// If k is 0.
    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> BilinearEstimator<N> {
        assert!(self.k >= 1, "a pair needs two states");
        let form = Form::new(self.k, self.with_error, h, context);
        let states = form.k().max(form.delay()) + 1;
        BilinearEstimator { products: Products::new(states, form.k(), dimension, context), form }
    }
}

/// The estimator that [`Bilinear`] describes.
#[derive(Clone, Debug)]
pub struct BilinearEstimator<N> {
    products: Products<N>,
    form: Form<N>,
}

impl<N: Number> Estimator<N> for BilinearEstimator<N> {
    fn states(&self) -> usize {
        self.form.k() + 1 + 2 * self.form.spread.around()
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        self.products.push(q, p, increments);
        if self.products.pushed() <= self.form.k() {
            return None;
        }
        self.form.add_value(&self.products, 0);
        if !self.form.spread.estimate() {
            return None;
        }
        Some(estimate(&self.form, self.products.state(self.form.delay())))
    }
}

/// What a form says of a state.
pub(super) fn estimate<'a, N: Number>(form: &'a Form<N>, (q, p): (&'a [N], &'a [N])) -> Estimate<'a, N> {
    let Point { value, last_term, order } = form.spread.middle();
    let (last_term, error) = if form.has_error() { (Some(last_term), Some(form.spread.error())) } else { (None, None) };
    Estimate { value, last_term, error, order: *order, q, p }
}
