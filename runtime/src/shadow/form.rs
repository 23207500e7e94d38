//! E_k as a form in the products of the newest states in pairs.

use num_bigint::BigInt;

use crate::Rational;
use crate::number::Number;
use crate::shadow::error_estimate::{ErrorEstimate, Point};
use crate::shadow::estimator::Estimate;
use crate::shadow::weights::BilinearWeights;
use crate::shadow::window::Window;
use crate::system::Increments;

/// The newest states, and the products of each with those before it.
#[derive(Clone, Debug)]
pub(super) struct Products<N> {
    window: Window<N>,
    /// The number of states in the window.
    states: usize,
    /// q_i·p − p_i·q + (β − β_i) of each state in the window and the i-th before it, by i = 1, 2, …, as they are summed: for each i
    /// one after the other in memory, the state n in place n mod the number of states.
    pairs: Vec<N>,
    /// Those of the newest state.
    of_newest: Vec<N>,
}

impl<N: Number> Products<N> {
    /// For windows of `states` states, each with `lags` states before it.
    pub(super) fn new(states: usize, lags: usize, dimension: usize, context: &N::Context) -> Self {
        let zero = N::zero(context);
        Products {
            window: Window::new(states, dimension, context),
            states,
            pairs: vec![zero.clone(); lags * states],
            of_newest: vec![zero; lags],
        }
    }

    pub(super) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        self.window.push(q, p, increments);
        let newest = self.window.place(0);
        let count = self.window.pairs(&mut self.of_newest);
        let of_lags = self.pairs.chunks_exact_mut(self.states);
        of_lags.zip(&self.of_newest[..count]).for_each(|(of_lag, pair)| of_lag[newest].assign(pair));
    }

    /// How many states have come.
    pub(super) fn pushed(&self) -> usize {
        self.window.pushed()
    }

    /// Positions and momenta of the state `back` places before the newest.
    pub(super) fn state(&self, back: usize) -> (&[N], &[N]) {
        self.window.state(back)
    }

    /// The products of each state with the `lag`-th before it, by the place of the later one.
    fn of_lag(&self, lag: usize) -> &[N] {
        &self.pairs[(lag - 1) * self.states..lag * self.states]
    }
}

/// E_k with its last term, and what it was at the states beside.
#[derive(Clone, Debug)]
pub(super) struct Form<N> {
    /// P_{j+ℓ,j}/(2h) in row ℓ − 1, for the first half of the j's; P_{k−j,k−j−ℓ} is the same.
    weights: Vec<Vec<N>>,
    /// The same for the last term; empty where no error is computed, and for k = 1.
    last_term: Vec<Vec<N>>,
    pub(super) error_estimate: ErrorEstimate<N>,
    sum: N,
}

impl<N: Number> Form<N> {
    pub(super) fn new(k: u32, with_error: bool, h: &Rational, context: &N::Context) -> Self {
        let has_error = with_error && k > 1;
        Form {
            weights: weights(k, h, context),
            last_term: if has_error { last_term_weights(k, h, context) } else { Vec::new() },
            error_estimate: ErrorEstimate::new(if has_error { around(k) } else { 0 }, context),
            sum: N::zero(context),
        }
    }

    pub(super) fn k(&self) -> usize {
        self.weights.len()
    }

    /// Whether it estimates its error.
    pub(super) fn has_error(&self) -> bool {
        !self.last_term.is_empty()
    }

    /// How many states before the newest one of a value the state in the middle is to which its error is known; for an odd k
    /// the one just before the middle.
    pub(super) fn delay(&self) -> usize {
        self.k().div_ceil(2) + self.error_estimate.around()
    }

    /// The estimate of the state in the middle of the newest values, which has these q and p.
    pub(super) fn estimate<'a>(&'a self, (q, p): (&'a [N], &'a [N])) -> Estimate<'a, N> {
        let Point { value, last_term, order } = self.error_estimate.middle();
        let known = self.has_error();
        let (last_term, error) = (known.then_some(last_term), known.then(|| self.error_estimate.error()));
        Estimate { value, last_term, error, order: *order, q, p }
    }

    /// The value from the k + 1 states that end `back` places before the newest one.
    pub(super) fn add_value(&mut self, products: &Products<N>, back: usize) {
        let Point { value, last_term, order } = self.error_estimate.next();
        value.assign_zero();
        last_term.assign_zero();
        for lag in 1..=self.weights.len() {
            let of_term = self.last_term.get(lag - 1).map_or(&[][..], Vec::as_slice);
            let mut sums = [(&self.weights[lag - 1][..], &mut *value), (of_term, &mut *last_term)];
            add_row(&mut sums, products, (back, lag, self.weights.len() - lag), &mut self.sum);
        }
        last_term.make_absolute();
        *order = self.weights.len() as u32;
    }
}

/// From how many values on either side the error of E_k is estimated.
///
/// The error is a bump of a few steps' width that grows like √k. With three, the largest true error/estimate on the orbits of
/// the tests grows from 1.0 for k ≤ 8 to 2.9 for k = 96; with ⌈k/2⌉ it is 1.0, and estimates are many decades too large where the error
/// changes fast; with this it is 1.01.
fn around(k: u32) -> usize {
    let root = k.isqrt();
    1 + root as usize + usize::from(root * root < k)
}

/// P_{j+ℓ,j}/(2h) of E_k, of the rows the first halves, each rounded once.
fn weights<N: Number>(k: u32, h: &Rational, context: &N::Context) -> Vec<Vec<N>> {
    let of_k = BilinearWeights::new(k);
    of_halves(k, |lag, j| {
        let above = of_k.numerator(lag, j) * h.denom();
        let below = of_k.denominator(lag) * h.numer() * 2;
        N::from_rational(&Rational::new(above, below), context)
    })
}

/// The same of P_{j+ℓ,j} of E_k less those of the mean of E_{k−1} over its two windows within.
fn last_term_weights<N: Number>(k: u32, h: &Rational, context: &N::Context) -> Vec<Vec<N>> {
    let [of_k, before] = [k, k - 1].map(BilinearWeights::new);
    of_halves(k, |lag, j| {
        // one common denominator, as reducing fractions takes most of the time
        let [own, other] = [of_k.denominator(lag), before.denominator(lag)];
        let sum =
            before.numerator(lag, j) + j.checked_sub(1).map_or_else(BigInt::default, |j| before.numerator(lag, j));
        let above = (of_k.numerator(lag, j) * &other * 2 - sum * &own) * h.denom();
        N::from_rational(&Rational::new(above, own * other * h.numer() * 4), context)
    })
}

/// The first halves of rows that read the same backwards: row ℓ − 1 has j = 0..=k−ℓ.
fn of_halves<N>(k: u32, weight: impl Fn(usize, usize) -> N) -> Vec<Vec<N>> {
    let k = k as usize;
    (1..=k).map(|lag| (0..(k - lag + 1).div_ceil(2)).map(|j| weight(lag, j)).collect()).collect()
}

/// Adds Σ_j w_{j+ℓ,j} (the pair of the states j + ℓ and j), j = 0..=last, for each row of weights that is not empty; two pairs at once,
/// whose sum all rows use. States are counted back from `back`.
fn add_row<N: Number>(
    sums: &mut [(&[N], &mut N); 2],
    products: &Products<N>,
    (back, lag, last): (usize, usize, usize),
    sum: &mut N,
) {
    let pairs = products.of_lag(lag);
    let newest = products.window.place(back);
    // the place of the state j places before
    let place = |j: usize| if j <= newest { newest - j } else { newest + pairs.len() - j };
    for j in 0..=last / 2 {
        let [pair, other] = [j, last - j].map(|j| &pairs[place(j)]);
        let pair = if last - j == j {
            pair
        } else {
            sum.assign_sum(pair, other);
            &*sum
        };
        for (weights, value) in sums.iter_mut() {
            if let Some(weight) = weights.get(j) {
                value.add_product(weight, pair);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact;
    use crate::shadow::weights::bilinear;

    /// By the definition: rows of exact weights, and those of E_{k−1} at two places subtracted.
    #[test]
    fn weights_are_those_of_the_definition() {
        let h = exact("-3/7").unwrap();
        let twice_h = &h * Rational::from_integer(2.into());
        let half = |row: &Vec<Rational>| -> Vec<f64> {
            row[..row.len().div_ceil(2)].iter().map(|weight| f64::from_rational(&(weight / &twice_h), &())).collect()
        };
        for k in 2..=20 {
            let mut rows = bilinear(k);
            assert_eq!(weights::<f64>(k, &h, &()), rows.iter().map(half).collect::<Vec<_>>());
            let two = Rational::from_integer(2.into());
            for (row, last) in rows.iter_mut().zip(bilinear(k - 1)) {
                for (j, weight) in last.iter().enumerate() {
                    row[j] -= weight / &two;
                    row[j + 1] -= weight / &two;
                }
            }
            assert_eq!(last_term_weights::<f64>(k, &h, &()), rows.iter().map(half).collect::<Vec<_>>(), "k = {k}");
        }
    }
}
