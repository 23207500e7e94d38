//! A form in the products of states with steps, for all windows that a state belongs to.

use crate::Rational;
use crate::number::Number;
use crate::shadow::weights::BilinearWeights;

/// The weights of a form, and its sums.
#[derive(Clone, Debug)]
pub(super) struct LaggedForm<N> {
    /// For the products of a state with the newest steps, the oldest first: the weights in the windows that end 0, 1, … states later, twice.
    weights: Vec<N>,
    /// Of the windows that are not at their end, each in turn.
    sums: Vec<N>,
    /// The place of the window that ends next.
    next: usize,
}

impl<N: Number> LaggedForm<N> {
    /// From the weights by windows that end j states later, and by steps, the newest first.
    pub(super) fn new(lags: usize, exact: &[Vec<Rational>], context: &N::Context) -> Self {
        let zero = N::zero(context);
        let mut weights = vec![zero.clone(); 2 * lags * lags];
        for (j, row) in exact.iter().enumerate() {
            for (step, weight) in row.iter().enumerate() {
                let weight = N::from_rational(weight, context);
                let row = &mut weights[(lags - 1 - step) * 2 * lags..][..2 * lags];
                row[j].assign(&weight);
                row[lags + j].assign(&weight);
            }
        }
        LaggedForm { weights, sums: vec![zero; lags], next: 0 }
    }

    /// Adds the products of the next state; value ← the sum of the window that it ends.
    #[inline(always)]
    pub(super) fn add<const K: usize>(&mut self, products: &[N; K], value: &mut N) {
        let own = self.sums.first_chunk_mut::<K>().expect("there are as many windows as lags");
        let mut sums = own.clone();
        let weights = &self.weights[K - self.next..][..(2 * K - 1) * K];
        for (step, product) in products.iter().enumerate() {
            for (window, sum) in sums.iter_mut().enumerate() {
                sum.add_product(&weights[step * 2 * K + window], product);
            }
        }
        *own = sums;
        let ends = &mut own[self.next];
        value.assign(ends);
        ends.assign_zero();
        self.next = if self.next + 1 < K { self.next + 1 } else { 0 };
    }
}

/// Those of E_k.
pub(super) fn value_weights(k: u32, h: &Rational) -> Vec<Vec<Rational>> {
    let of_k = BilinearWeights::new(k);
    of_steps(k, |lag, j| of_pair(&of_k, lag, j, h))
}

/// Those of E_k less the mean of E_{k−1} over its two windows within.
pub(super) fn last_term_weights(k: u32, h: &Rational) -> Vec<Vec<Rational>> {
    let [of_k, before] = [k, k - 1].map(BilinearWeights::new);
    of_steps(k, |lag, j| {
        let other = |j| of_pair(&before, lag, j, h);
        let others = other(j) + j.checked_sub(1).map_or_else(zero, other);
        of_pair(&of_k, lag, j, h) - others / Rational::from_integer(2.into())
    })
}

fn zero() -> Rational {
    Rational::from_integer(0.into())
}

/// P_{j+ℓ,j}/(2h), the weight of the states j and j + ℓ, counted back from the newest.
fn of_pair(weights: &BilinearWeights, lag: usize, j: usize, h: &Rational) -> Rational {
    Rational::new(weights.numerator(lag, j) * h.denom(), weights.denominator(lag) * h.numer() * 2)
}

/// A pair is a sum over the steps between its states, so that the weight of the state j with the m-th step before it, m = 0, 1, …, is the
/// sum of those of all pairs with a state j + ℓ before that step: ℓ > m.
fn of_steps(k: u32, weight: impl Fn(usize, usize) -> Rational) -> Vec<Vec<Rational>> {
    let of_state = |j: usize| {
        let mut sum = zero();
        let mut sums: Vec<Rational> = (1..=k as usize - j)
            .rev()
            .map(|lag| {
                sum += weight(lag, j);
                sum.clone()
            })
            .collect();
        sums.reverse();
        sums
    };
    (0..k as usize).map(of_state).collect()
}
