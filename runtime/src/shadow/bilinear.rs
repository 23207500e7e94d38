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

use std::collections::VecDeque;

use crate::Rational;
use crate::motion::Increments;
use crate::number::Number;
use crate::shadow::window::Window;
use crate::shadow::{Estimate, Estimator, Method};
use crate::weights::bilinear;

/// The bilinear estimator E_k of order 2k from the newest k + 1 states, k ≥ 1.
///
/// Its value belongs to the middle of these: for an odd k to the time between two states. A state costs k products of
/// vectors and some k²/2 of numbers.
///
/// **Its error** is estimated by the larger of two: its spread, max − min over the ⌈k/2⌉ windows on either side (the
/// modified energy is constant, so what changes from window to window is the estimator's error, or round-off), and, for
/// k ≥ 2, |E_k − E_{k−1}|, the mean of E_{k−1} over the two windows within. The spread alone does not see an error that is
/// the same everywhere, as on a circular orbit; the difference alone has zeros. That needs ⌈k/2⌉ states more on each side.
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

    /// E_k with an estimate of its error.
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
        let (k, zero) = (self.k as usize, N::zero(context));
        let twice_h = h * Rational::from_integer(2.into());
        // of rows that read the same backwards the first halves
        let number = |weight: &Rational| N::from_rational(&(weight / &twice_h), context);
        let half = |row: &Vec<Rational>| row[..row.len().div_ceil(2)].iter().map(number).collect();
        BilinearEstimator {
            weights: bilinear(self.k).iter().map(half).collect(),
            last_term: last_term_weights(self.k, self.with_error).iter().map(half).collect(),
            around: if self.with_error { k.div_ceil(2) } else { 0 },
            window: Window::new(k + 1, dimension, context),
            pairs: vec![vec![zero.clone(); k]; k + 1],
            values: VecDeque::new(),
            sum: zero.clone(),
            error: zero,
        }
    }
}

/// The estimator that [`Bilinear`] describes.
#[derive(Clone, Debug)]
pub struct BilinearEstimator<N> {
    /// P_{j+ℓ,j}/(2h) in row ℓ − 1, for the first half of the j's; P_{k−j,k−j−ℓ} is the same.
    weights: Vec<Vec<N>>,
    /// The same for E_k − E_{k−1}; empty where no error is asked for.
    last_term: Vec<Vec<N>>,
    window: Window<N>,
    /// The pairs of each state in the window with those before it, ℓ = 1..k; the state n in place n mod (k + 1).
    pairs: Vec<Vec<N>>,
    /// How many windows on either side of the one whose value is given.
    around: usize,
    /// The values of the newest 2·around + 1 windows with the states in their middles, the newest last.
    values: VecDeque<Value<N>>,
    sum: N,
    error: N,
}

#[derive(Clone, Debug)]
struct Value<N> {
    value: N,
    last_term: N,
    q: Vec<N>,
    p: Vec<N>,
}

/// P_{j+ℓ,j} of E_k less those of the mean of E_{k−1} over its two windows within; none for k = 1.
fn last_term_weights(k: u32, with_error: bool) -> Vec<Vec<Rational>> {
    if !with_error || k == 1 {
        return Vec::new();
    }
    let two = Rational::from_integer(2.into());
    let mut rows = bilinear(k);
    for (row, last) in rows.iter_mut().zip(bilinear(k - 1)) {
        for (j, weight) in last.iter().enumerate() {
            row[j] -= weight / &two;
            row[j + 1] -= weight / &two;
        }
    }
    rows
}

/// Σ_ℓ Σ_j w_{j+ℓ,j} (the pair of the states j + ℓ and j), two of them at once.
fn sum_up<N: Number>(weights: &[Vec<N>], window: &Window<N>, pairs: &[Vec<N>], sum: &mut N, value: &mut N) {
    value.assign_zero();
    for (lag, weights) in (1..).zip(weights) {
        let last = pairs.len() - 1 - lag;
        for (j, weight) in weights.iter().enumerate() {
            let [pair, other] = [j, last - j].map(|j| &pairs[window.place(j)][lag - 1]);
            if last - j == j {
                value.add_product(weight, pair);
            } else {
                sum.assign_sum(pair, other);
                value.add_product(weight, sum);
            }
        }
    }
}

impl<N: Number> BilinearEstimator<N> {
    /// The value of the newest window and the state in its middle, in the place of the oldest one's.
    fn add_value(&mut self) {
        let oldest = if self.values.len() > 2 * self.around { self.values.pop_front() } else { None };
        let (q, p) = self.window.state(self.weights.len().div_ceil(2));
        let mut place = oldest.unwrap_or_else(|| Value {
            value: self.sum.clone(),
            last_term: self.sum.clone(),
            q: q.to_vec(),
            p: p.to_vec(),
        });
        place.q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        place.p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        sum_up(&self.weights, &self.window, &self.pairs, &mut self.sum, &mut place.value);
        sum_up(&self.last_term, &self.window, &self.pairs, &mut self.sum, &mut place.last_term);
        place.last_term.make_absolute();
        self.values.push_back(place);
    }

    /// max − min of the values, or the last term in their middle if that is larger.
    fn estimate_error(&mut self) {
        let mut values = self.values.iter().map(|place| &place.value);
        let first = values.next().expect("there is a newest one");
        let (least, most) = values.fold((first, first), |(least, most), value| {
            (if value < least { value } else { least }, if value > most { value } else { most })
        });
        self.error.assign_difference(most, least);
        let last_term = &self.values[self.around].last_term;
        if *last_term > self.error {
            self.error.assign(last_term);
        }
    }
}

impl<N: Number> Estimator<N> for BilinearEstimator<N> {
    fn states(&self) -> usize {
        self.weights.len() + 1 + 2 * self.around
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        self.window.push(q, p, increments);
        let newest = self.window.place(0);
        self.window.pairs(&mut self.pairs[newest]);
        let k = self.weights.len();
        if self.window.pushed() <= k {
            return None;
        }
        self.add_value();
        if self.window.pushed() < self.states() {
            return None;
        }
        self.estimate_error();
        let Value { value, q, p, .. } = &self.values[self.around];
        Some(Estimate { value, error: (self.around > 0).then_some(&self.error), order: k as u32, q, p })
    }
}
