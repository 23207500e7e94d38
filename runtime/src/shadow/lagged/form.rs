//! A form in the products of states with steps.

use crate::Rational;
use crate::number::Number;
use crate::shadow::weights::BilinearWeights;

/// The weights of a form.
#[derive(Clone, Debug)]
pub(super) struct LaggedForm<N> {
    /// For each state of a window, the newest first, the weights of its products with the steps before it, the oldest
    /// first.
    weights: Vec<N>,
}

impl<N: Number> LaggedForm<N> {
    /// From the weights by states and by steps, the newest first.
    pub(super) fn new(lags: usize, exact: &[Vec<Rational>], context: &N::Context) -> Self {
        let mut weights = vec![N::zero(context); lags * lags];
        for (j, row) in exact.iter().enumerate() {
            for (step, weight) in row.iter().enumerate() {
                weights[j * lags + lags - 1 - step] = N::from_rational(weight, context);
            }
        }
        LaggedForm { weights }
    }

    /// value ← the form at the window that a state ends, from its products and the products of the states before it,
    /// the newest last.
    #[inline(always)]
    pub(super) fn evaluate<const K: usize>(&self, products: &[N; K], before: &[[N; K]; K], value: &mut N) {
        let weights: &[[N; K]; K] = self.weights.as_chunks().0.try_into().expect("as many states as lags");
        let mut sums: [N; K] = std::array::from_fn(|_| N::zero(&value.context()));
        for j in 0..K {
            let of_state = if j == 0 { products } else { &before[K - j] };
            // the other steps are before the window; from an even one on, as vectors have two numbers or more
            for step in j & !1..K {
                sums[step].add_product(&weights[j][step], &of_state[step]);
            }
        }
        value.assign_zero();
        sums.iter().for_each(|sum| value.add(sum));
    }
}

/// The weights of E_k.
pub(super) fn value_weights(k: u32, h: &Rational) -> Vec<Vec<Rational>> {
    let of_k = BilinearWeights::new(k);
    of_steps(k, |lag, j| of_pair(&of_k, lag, j, h))
}

/// The weights of E_k less the mean of E_{k−1} over its two windows within.
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

/// A pair is a sum over the steps between its states, so that the weight of the state j with the m-th step before it,
/// m = 0, 1, …, is the sum of the weights of all pairs with a state j + ℓ before that step: ℓ > m.
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
