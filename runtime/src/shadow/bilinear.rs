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
use crate::number::Number;
use crate::shadow::window::Window;
use crate::shadow::{Estimate, Estimator, Method};
use crate::weights::bilinear;

/// The bilinear estimator E_k of order 2k from the newest k + 1 states, k ≥ 1.
///
/// Its value belongs to the middle of these: for an odd k to the time between two states. A state costs k products of
/// vectors and some k²/2 of numbers.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, exact, problems::Kepler, run::energy_drift, shadow::Bilinear, tables::shipped};
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]); // eccentricity 0.6
/// let verlet = shipped("stormer-verlet").unwrap();
/// let drift = energy_drift(&verlet, start, &exact("1/40").unwrap(), 400, &Bilinear { k: 16 }, |_| ()).unwrap();
/// assert!(drift.drift < 1e-12); // the energy itself varies by 0.01
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bilinear {
    /// Half the order; one less than the states.
    pub k: u32,
}

impl<N: Number> Method<N> for Bilinear {
    type Estimator = BilinearEstimator<N>;

    /// # Panics
    /// If k is 0.
    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> BilinearEstimator<N> {
        assert!(self.k >= 1, "a pair needs two states");
        let (k, zero) = (self.k as usize, N::zero(context));
        let twice_h = h * Rational::from_integer(2.into());
        let half = |row: &Vec<Rational>| row[..row.len().div_ceil(2)].iter().map(|p| p / &twice_h).collect::<Vec<_>>();
        let numbers = |row: Vec<Rational>| row.iter().map(|p| N::from_rational(p, context)).collect();
        BilinearEstimator {
            weights: bilinear(self.k).iter().map(|row| numbers(half(row))).collect(),
            window: Window::new(k + 1, dimension, context),
            pairs: vec![vec![zero.clone(); k]; k + 1],
            sum: zero.clone(),
            value: zero,
        }
    }
}

/// The estimator that [`Bilinear`] describes.
#[derive(Clone, Debug)]
pub struct BilinearEstimator<N> {
    /// P_{j+ℓ,j}/(2h) in row ℓ − 1, for the first half of the j's; P_{k−j,k−j−ℓ} is the same.
    weights: Vec<Vec<N>>,
    window: Window<N>,
    /// The pairs of each state in the window with those before it, ℓ = 1..k; the state n in place n mod (k + 1).
    pairs: Vec<Vec<N>>,
    sum: N,
    value: N,
}

impl<N: Number> BilinearEstimator<N> {
    /// Σ_ℓ Σ_j P_{j+ℓ,j}/(2h) (the pair of the states j + ℓ and j), two of them at once.
    fn sum_up(&mut self) {
        let k = self.weights.len();
        self.value.assign_zero();
        for (lag, weights) in (1..).zip(&self.weights) {
            for (j, weight) in weights.iter().enumerate() {
                let mirrored = k - lag - j;
                let [pair, other] = [j, mirrored].map(|j| &self.pairs[self.window.place(j)][lag - 1]);
                if mirrored == j {
                    self.value.add_product(weight, pair);
                } else {
                    self.sum.assign_sum(pair, other);
                    self.value.add_product(weight, &self.sum);
                }
            }
        }
    }
}

impl<N: Number> Estimator<N> for BilinearEstimator<N> {
    fn states(&self) -> usize {
        self.weights.len() + 1
    }

    fn push(&mut self, q: &[N], p: &[N], beta: &N) -> Option<Estimate<'_, N>> {
        self.window.push(q, p, beta);
        let newest = self.window.place(0);
        self.window.pairs(&mut self.pairs[newest]);
        if self.window.pushed() < self.states() {
            return None;
        }
        self.sum_up();
        let k = self.weights.len();
        let (q, p) = self.window.state(k.div_ceil(2));
        Some(Estimate { value: &self.value, error: None, order: k as u32, q, p })
    }
}
