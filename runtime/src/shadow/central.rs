//! The paper's estimator: central differences D_m, at a fixed m or the best of all.

use num_traits::Zero;

use crate::Rational;
use crate::number::Number;
use crate::shadow::differences::AllOrders;
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
    fn reach(&self) -> usize {
        match &self.0 {
            Kind::Fixed(fixed) => fixed.reach(),
            Kind::Best(best) => best.reach(),
        }
    }

    fn push(&mut self, q: &[N], p: &[N], beta: &N) -> Option<Estimate<'_, N>> {
        match &mut self.0 {
            Kind::Fixed(fixed) => fixed.push(q, p, beta),
            Kind::Best(best) => best.push(q, p, beta),
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
    /// The newest m + 1 states, the state k in place k mod (m + 1).
    ring: Vec<Place<N>>,
    pushed: usize,
    pair: N,
    product: N,
    beta: N,
    error: N,
}

#[derive(Clone, Debug)]
struct Place<N> {
    q: Vec<N>,
    p: Vec<N>,
    /// What the step that led here added to β.
    beta: N,
    value: N,
    last_term: N,
}

impl<N: Number> FixedOrder<N> {
    fn new(m: u32, with_error: bool, h: &Rational, dimension: usize, context: &N::Context) -> Self {
        assert!(m >= 1, "a central difference has m ≥ 1");
        let this = central(m);
        let twice_h = h * Rational::from_integer(2.into());
        let zero = N::zero(context);
        let number = |weight: Rational| N::from_rational(&(weight / &twice_h), context);
        let place = Place {
            q: vec![zero.clone(); dimension],
            p: vec![zero.clone(); dimension],
            beta: zero.clone(),
            value: zero.clone(),
            last_term: zero.clone(),
        };
        FixedOrder {
            m: m as usize,
            weights: this.iter().map(|d| number(d.clone())).collect(),
            last_term: last_term_weights(m, with_error).into_iter().map(number).collect(),
            ring: vec![place; m as usize + 1],
            pushed: 0,
            pair: zero.clone(),
            product: zero.clone(),
            beta: zero.clone(),
            error: zero,
        }
    }

    fn place(&mut self, q: &[N], p: &[N], beta: &N) -> usize {
        let k = self.pushed % self.ring.len();
        let place = &mut self.ring[k];
        place.q.iter_mut().zip(q).for_each(|(own, q)| own.assign(q));
        place.p.iter_mut().zip(p).for_each(|(own, p)| own.assign(p));
        place.beta.assign(beta);
        place.value.assign_zero();
        place.last_term.assign_zero();
        self.pushed += 1;
        k
    }

    /// Adds the pair of the states in places i (older) and k to the estimates at both.
    fn add_pair(&mut self, i: usize, k: usize, j: usize) {
        let (older, newest) = two(&mut self.ring, i, k);
        self.pair.assign(&self.beta);
        for (((q_i, p_i), q_k), p_k) in older.q.iter().zip(&older.p).zip(&newest.q).zip(&newest.p) {
            self.pair.add_product(q_i, p_k);
            self.pair.subtract_product(p_i, q_k);
        }
        self.product.assign_product(&self.weights[j - 1], &self.pair);
        older.value.subtract(&self.product);
        newest.value.subtract(&self.product);
        if let Some(weight) = self.last_term.get(j - 1) {
            self.product.assign_product(weight, &self.pair);
            older.last_term.subtract(&self.product);
            newest.last_term.subtract(&self.product);
        }
    }
}

impl<N: Number> Estimator<N> for FixedOrder<N> {
    fn reach(&self) -> usize {
        self.m
    }

    fn push(&mut self, q: &[N], p: &[N], beta: &N) -> Option<Estimate<'_, N>> {
        let older = self.pushed.min(self.m);
        let k = self.place(q, p, beta);
        let size = self.ring.len();
        self.beta.assign_zero();
        for j in 1..=older {
            // β_k − β_i is the sum of the increments after i
            let after = (k + size - (j - 1)) % size;
            self.beta.add(&self.ring[after].beta);
            self.add_pair((k + size - j) % size, k, j);
        }
        if self.pushed <= 2 * self.m {
            return None;
        }
        let place = &self.ring[(k + 1) % size];
        self.error.assign(&place.last_term);
        self.error.make_absolute();
        let error = (!self.last_term.is_empty()).then_some(&self.error);
        Some(Estimate { value: &place.value, error, order: self.m as u32, q: &place.q, p: &place.p })
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

/// Two different elements, to be changed both.
fn two<T>(all: &mut [T], i: usize, k: usize) -> (&mut T, &mut T) {
    if i < k {
        let (left, right) = all.split_at_mut(k);
        (&mut left[i], &mut right[0])
    } else {
        let (left, right) = all.split_at_mut(i);
        (&mut right[0], &mut left[k])
    }
}
