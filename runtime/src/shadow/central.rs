//! The paper's estimator: central differences D_m, at a fixed m or the best of all.

use num_traits::Zero;

use crate::Rational;
use crate::motion::Increments;
use crate::number::Number;
use crate::shadow::differences::AllOrders;
use crate::shadow::window::Window;
use crate::shadow::{Estimate, Estimator, Method, Stop};
use crate::weights::central;

/// Central differences (Moan & Niesen): T_{m,m} = ½(−qᵀD_m p + pᵀD_m q − D_m β).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Central {
    /// One m ≥ 1.
    Fixed {
        /// The m of D_m.
        m: u32,
        /// Whether |T_{m,m} − T_{m−1,m−1}| is wanted as well.
        with_error: bool,
    },
    /// The best m of each state.
    Best {
        /// The largest m allowed, at least 2.
        largest: u32,
        /// When the search ends.
        stop: Stop,
    },
}

impl Central {
    /// D_m at one m ≥ 1; no estimate of the error.
    pub fn fixed(m: u32) -> Self {
        Central::Fixed { m, with_error: false }
    }

    /// D_m at one m, with |T_{m,m} − T_{m−1,m−1}| for m ≥ 2.
    pub fn fixed_with_error(m: u32) -> Self {
        Central::Fixed { m, with_error: true }
    }

    /// At each state the m of 2..=`largest` with the smallest |T_{m,m} − T_{m−1,m−1}|, the first of equal ones.
    pub fn best(largest: u32, stop: Stop) -> Self {
        Central::Best { largest, stop }
    }
}

impl<N: Number> Method<N> for Central {
    type Estimator = CentralEstimator<N>;

    /// # Panics
    /// If m is 0, or the largest m less than 2.
    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> CentralEstimator<N> {
        CentralEstimator(match *self {
            Central::Fixed { m, with_error } => Kind::Fixed(FixedOrder::new(m, with_error, h, dimension, context)),
            Central::Best { largest, stop } => Kind::Best(AllOrders::new(largest, stop, h, dimension, context)),
        })
    }
}

/// The estimator that [`Central`] describes.
#[derive(Clone, Debug)]
pub struct CentralEstimator<N>(Kind<N>);

#[derive(Clone, Debug)]
enum Kind<N> {
    Fixed(FixedOrder<N>),
    Best(AllOrders<N>),
}

impl<N: Number> Estimator<N> for CentralEstimator<N> {
    fn states(&self) -> usize {
        match &self.0 {
            Kind::Fixed(fixed) => fixed.states(),
            Kind::Best(best) => best.states(),
        }
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        match &mut self.0 {
            Kind::Fixed(fixed) => fixed.push(q, p, increments),
            Kind::Best(best) => best.push(q, p, increments),
        }
    }
}

/// D_m at one m, by products of pairs.
///
/// With B(i,k) = q_i·p_k − p_i·q_k + (β_k − β_i), i < k, the estimate at n is
/// T_{m,m} = −1/(2h) Σ_j d_{m,j} (B(n, n+j) + B(n−j, n)), so each pair of states is multiplied once and serves both.
#[derive(Clone, Debug)]
struct FixedOrder<N> {
    m: usize,
    /// d_{m,j}/(2h)
    weights: Vec<N>,
    /// (d_{m,j} − d_{m−1,j})/(2h), for the last term alone; empty where no error is asked for
    last_term: Vec<N>,
    /// The newest m + 1 states, and what their estimates are so far.
    window: Window<N>,
    sums: Vec<Sums<N>>,
    /// B(n−j, n) for the newest state n
    pairs: Vec<N>,
    product: N,
    error: N,
}

#[derive(Clone, Debug)]
struct Sums<N> {
    value: N,
    last_term: N,
}

impl<N: Number> FixedOrder<N> {
    fn new(m: u32, with_error: bool, h: &Rational, dimension: usize, context: &N::Context) -> Self {
        assert!(m >= 1, "a central difference has m ≥ 1");
        let twice_h = h * Rational::from_integer(2.into());
        let zero = N::zero(context);
        let number = |weight: Rational| N::from_rational(&(weight / &twice_h), context);
        let size = m as usize;
        FixedOrder {
            m: size,
            weights: central(m).iter().map(|d| number(d.clone())).collect(),
            last_term: last_term_weights(m, with_error).into_iter().map(number).collect(),
            window: Window::new(size + 1, dimension, context),
            sums: vec![Sums { value: zero.clone(), last_term: zero.clone() }; size + 1],
            pairs: vec![zero.clone(); size],
            product: zero.clone(),
            error: zero,
        }
    }

    /// Adds the pair of the newest state and the one j places before it to the estimates at both.
    fn add_pair(&mut self, j: usize) {
        let places = [self.window.place(j), self.window.place(0)];
        let pair = &self.pairs[j - 1];
        self.product.assign_product(&self.weights[j - 1], pair);
        places.iter().for_each(|&place| self.sums[place].value.subtract(&self.product));
        if let Some(weight) = self.last_term.get(j - 1) {
            self.product.assign_product(weight, pair);
            places.iter().for_each(|&place| self.sums[place].last_term.subtract(&self.product));
        }
    }
}

impl<N: Number> Estimator<N> for FixedOrder<N> {
    fn states(&self) -> usize {
        2 * self.m + 1
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        self.window.push(q, p, increments);
        let newest = &mut self.sums[self.window.place(0)];
        newest.value.assign_zero();
        newest.last_term.assign_zero();
        for j in 1..=self.window.pairs(&mut self.pairs) {
            self.add_pair(j);
        }
        if self.window.pushed() < self.states() {
            return None;
        }
        let sums = &self.sums[self.window.place(self.m)];
        self.error.assign(&sums.last_term);
        self.error.make_absolute();
        let error = (!self.last_term.is_empty()).then_some(&self.error);
        let (q, p) = self.window.state(self.m);
        Some(Estimate { value: &sums.value, error, order: self.m as u32, q, p })
    }
}

/// d_{m,j} − d_{m−1,j}, j = 1..m; none for m = 1, whose one term is the derivative itself and no error.
fn last_term_weights(m: u32, with_error: bool) -> Vec<Rational> {
    if !with_error || m == 1 {
        return Vec::new();
    }
    let (this, last) = (central(m), central(m - 1));
    let before = |j: usize| last.get(j).cloned().unwrap_or_else(Rational::zero);
    this.iter().enumerate().map(|(j, weight)| weight - before(j)).collect()
}
