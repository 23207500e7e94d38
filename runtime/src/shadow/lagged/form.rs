//! A form in the products of states with steps.

use crate::Rational;
use crate::number::Number;
use crate::shadow::weights::BilinearWeights;

/// The weights of a form.
#[derive(Clone, Debug)]
pub(super) struct LaggedForm<N> {
    /// For each state of a window, the newest first, the weights of its products with the steps before it, the oldest first.
    weights: Vec<N>,
    /// For each place of the newest state the weights of its products with the steps by their places; 0 for the newest step.
    by_places: Vec<N>,
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
        let mut by_places = vec![N::zero(context); lags * lags];
        for place in 0..lags {
            for (age, weight) in exact[0].iter().enumerate().skip(1) {
                by_places[place * lags + (place + lags - age) % lags] = N::from_rational(weight, context);
            }
        }
        LaggedForm { weights, by_places }
    }

    /// value ← the form at the window that the state at this place ends.
    #[inline(always)]
    pub(super) fn evaluate<const K: usize>(
        &self,
        place: usize,
        newest: &StateProducts<N, K>,
        kept: &KeptProducts<N, K>,
        value: &mut N,
    ) {
        let weights: &[[N; K]; K] = self.weights.as_chunks().0.try_into().expect("as many states as lags");
        let by_places: &[[N; K]; K] = self.by_places.as_chunks().0.try_into().expect("as many places as lags");
        let place = place % K;
        let mut of_newest = newest.by_places.clone();
        for l in 0..K {
            of_newest[l].multiply(&by_places[place][l]);
        }
        let mut sums: [N; K] = std::array::from_fn(|_| N::zero(&value.context()));
        #[expect(clippy::needless_range_loop, reason = "a loop over an iterator would not be unrolled")]
        for j in 1..K {
            let slot = (place + K - j) % K;
            let of_state: &[N; K] = kept[slot].as_flattened()[slot + 1..].first_chunk().expect("they are there twice");
            // the other steps are before the window; from an even one on, as vectors have two numbers or more
            for step in j & !1..K {
                sums[step].add_product(&weights[j][step], &of_state[step]);
            }
        }
        // in the order of the steps, so that a value does not depend on their places
        for l in 0..K - 1 {
            sums[l].add(&of_newest[(place + 1 + l) % K]);
        }
        sums[K - 1].add_product(&weights[0][K - 1], &newest.newest);
        let mut count = K;
        while count > 1 {
            count /= 2;
            let (sums, others) = sums.split_at_mut(count);
            for l in 0..count {
                sums[l].add(&others[l]);
            }
        }
        value.assign(&sums[0]);
    }
}

/// The products of a state with K steps.
pub(super) struct StateProducts<N, const K: usize> {
    /// By the places of the steps, but for the newest.
    pub(super) by_places: [N; K],
    /// With the newest step.
    pub(super) newest: N,
}

/// The products of the newest states, each at its place, twice: so those with the newest steps are contiguous wherever they begin.
pub(super) type KeptProducts<N, const K: usize> = [[[N; K]; 2]; K];

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

/// A pair is a sum over the steps between its states, so that the weight of the state j with the m-th step before it, m = 0, 1, …, is the
/// sum of the weights of all pairs with a state j + ℓ before that step: ℓ > m.
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
