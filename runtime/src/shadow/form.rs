//! E_k as a form in the products of the newest states in pairs.

use num_bigint::BigInt;

use crate::Rational;
use crate::number::saved::Fields;
use crate::number::{LimbAccess, Number};
use crate::shadow::error_estimate::{ErrorEstimate, Point, around};
use crate::shadow::estimator::Estimate;
use crate::shadow::fixed::{IntegerWeights, OfLag, Rows, StateRows, Sums};
use crate::shadow::weights::BilinearWeights;
use crate::shadow::window::Window;
use crate::systems::increments::Increments;

/// The newest states, and the products of each with the states before it.
#[derive(Clone, Debug)]
pub(super) struct Products<N> {
    window: Window<N>,
    /// The number of states in the window.
    states: usize,
    pairs: Pairs<N>,
    /// The products of the newest state.
    of_newest: Vec<N>,
    /// How many they are.
    reach: usize,
}

/// q_i·p − p_i·q + (β − β_i) of each state in the window and the i-th before it, by i = 1, 2, …, as they are summed:
/// for each i one after the other in memory, the state n in place n mod the number of states.
#[derive(Clone, Debug)]
enum Pairs<N> {
    Numbers(Vec<N>),
    /// In fixed point, divided by (−1)^i i, from states that may be so, too.
    Rows(LimbAccess<N>, Rows, Option<Box<StateRows>>),
}

impl<N: Number> Products<N> {
    /// For windows of `states` states, each with `lags` states before it.
    pub(super) fn new(states: usize, lags: usize, dimension: usize, context: &N::Context) -> Self {
        let zero = N::zero(context);
        Products {
            window: Window::new(states, dimension, context),
            states,
            pairs: match N::LIMBS {
                Some(access) => {
                    let limbs = (access.limbs)(&zero);
                    Pairs::Rows(
                        access,
                        Rows::new(limbs, lags * states),
                        StateRows::new(limbs, states, dimension).map(Box::new),
                    )
                }
                None => Pairs::Numbers(vec![zero.clone(); lags * states]),
            },
            of_newest: vec![zero; lags],
            reach: 0,
        }
    }

    pub(super) fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) {
        self.window.push(q, p, increments);
        let newest = self.window.place(0);
        if let (Pairs::Rows(access, rows, Some(states)), Some((q, p, beta))) =
            (&mut self.pairs, self.window.newest_with_beta())
        {
            self.reach = self.window.reach(self.of_newest.len());
            states.set(newest, q.iter().chain(p).map(access.parts), (access.parts)(beta));
            states.write_pairs(newest, self.reach, rows);
            return;
        }
        self.reach = self.window.pairs(&mut self.of_newest);
        let places = (0..self.reach).map(|i| i * self.states + newest);
        match &mut self.pairs {
            Pairs::Numbers(pairs) => places.zip(&self.of_newest).for_each(|(place, pair)| pairs[place].assign(pair)),
            Pairs::Rows(access, rows, _) => {
                for ((place, pair), lag) in places.zip(&mut self.of_newest).zip(1..) {
                    pair.divide_integer(if lag % 2 == 0 { lag } else { -lag });
                    rows.set(place, (access.parts)(pair));
                }
            }
        }
    }

    /// Products of the newest state are computed anew with each state.
    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.window.fields(to);
        match &mut self.pairs {
            Pairs::Numbers(pairs) => to.numbers(pairs),
            Pairs::Rows(_, rows, states) => {
                rows.fields(to);
                states.iter_mut().for_each(|states| states.fields(to));
            }
        }
        to.place(&mut self.reach, self.of_newest.len() + 1);
    }

    /// How many states have come.
    pub(super) fn pushed(&self) -> usize {
        self.window.pushed()
    }

    /// How many states before the newest one have a product with it.
    pub(super) fn reach(&self) -> usize {
        self.reach
    }

    /// Positions and momenta of the state `back` places before the newest.
    pub(super) fn state(&self, back: usize) -> (&[N], &[N]) {
        self.window.state(back)
    }
}

/// E_k with its last term, and what it was at the states beside.
#[derive(Clone, Debug)]
pub(super) struct Form<N> {
    k: usize,
    has_error: bool,
    weights: Weights<N>,
    pub(super) error_estimate: ErrorEstimate<N>,
}

/// The weights of the value and of the last term; the latter are empty or `None` where no error is computed, and for
/// k = 1.
#[derive(Clone, Debug)]
enum Weights<N> {
    Numbers {
        /// P_{j+ℓ,j}/(2h) in row ℓ − 1, for the first half of the j's; P_{k−j,k−j−ℓ} is the same.
        value: Vec<Vec<N>>,
        last_term: Vec<Vec<N>>,
        sum: N,
    },
    Integers {
        /// C(k,j+ℓ) C(k,j) and 1/(h C(2k,k))
        value: (IntegerWeights, N),
        last_term: Option<(IntegerWeights, N)>,
    },
}

impl<N: Number> Form<N> {
    pub(super) fn new(k: u32, with_error: bool, h: &Rational, context: &N::Context) -> Self {
        let has_error = with_error && k > 1;
        Form {
            k: k as usize,
            has_error,
            weights: Weights::new(k, has_error, h, context),
            error_estimate: ErrorEstimate::new(if has_error { around(k) } else { 0 }, context),
        }
    }

    pub(super) fn k(&self) -> usize {
        self.k
    }

    /// Whether it estimates its error.
    pub(super) fn has_error(&self) -> bool {
        self.has_error
    }

    /// How many states before the newest one of a value the state in the middle is to which its error is known; for an
    /// odd k the one just before the middle.
    pub(super) fn delay(&self) -> usize {
        self.k().div_ceil(2) + self.error_estimate.around()
    }

    /// The estimate of the state in the middle of the newest values, which has these q and p.
    pub(super) fn estimate<'a>(&'a self, (q, p): (&'a [N], &'a [N])) -> Estimate<'a, N> {
        let Point { value, last_term, order } = self.error_estimate.middle();
        let known = self.has_error();
        let (last_term, error) = (known.then_some(last_term), known.then(|| self.error_estimate.error()));
        Estimate { value, last_term, error, order: *order, q, p, particles: (&[], &[]) }
    }

    /// The value from the k + 1 states that end `back` places before the newest one.
    pub(super) fn add_value(&mut self, products: &Products<N>, back: usize) {
        let Point { value, last_term, order } = self.error_estimate.next();
        value.assign_zero();
        last_term.assign_zero();
        let (k, count) = (self.k, products.states);
        let lags = (1..=k).map(|lag| OfLag {
            lag,
            last: k - lag,
            first: (lag - 1) * count,
            count,
            newest: products.window.place(back),
        });
        match (&mut self.weights, &products.pairs) {
            (Weights::Numbers { value: weights, last_term: of_term, sum }, Pairs::Numbers(pairs)) => {
                for of_lag in lags {
                    let term_weights = of_term.get(of_lag.lag - 1).map_or(&[][..], Vec::as_slice);
                    let mut sums = [(&weights[of_lag.lag - 1][..], &mut *value), (term_weights, &mut *last_term)];
                    add_row(&mut sums, pairs, of_lag, sum);
                }
            }
            (Weights::Integers { value: of_value, last_term: of_term }, Pairs::Rows(access, rows, _)) => {
                let kinds = [Some(&*of_value), of_term.as_ref()];
                let weights = kinds.map(|kind| kind.map(|(weights, _)| weights));
                let mut sums = Sums::new(rows, weights);
                lags.for_each(|of_lag| sums.add(of_lag));
                for (at, (kind, x)) in kinds.into_iter().zip([value, &mut *last_term]).enumerate() {
                    if let Some((_, factor)) = kind {
                        sums.read(at, access, x);
                        x.multiply(factor);
                    }
                }
            }
            _ => unreachable!("a number type has limbs or not"),
        }
        last_term.make_absolute();
        *order = k as u32;
    }
}

impl<N: Number> Weights<N> {
    fn new(k: u32, has_error: bool, h: &Rational, context: &N::Context) -> Self {
        if N::LIMBS.is_some() {
            return Weights::Integers {
                value: integer_weights(k, h, context),
                last_term: has_error.then(|| integer_last_term_weights(k, h, context)),
            };
        }
        Weights::Numbers {
            value: weights(k, h, context),
            last_term: if has_error { last_term_weights(k, h, context) } else { Vec::new() },
            sum: N::zero(context),
        }
    }
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

/// The same for P_{j+ℓ,j} of E_k less the mean of E_{k−1} over its two windows within.
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

/// C(k,j+ℓ) C(k,j) and 1/(h C(2k,k)), whose products with (−1)^ℓ/ℓ are these weights.
fn integer_weights<N: Number>(k: u32, h: &Rational, context: &N::Context) -> (IntegerWeights, N) {
    let of_k = BilinearWeights::new(k);
    let factor = (h * Rational::from_integer(of_k.of_2k().clone())).recip();
    (IntegerWeights::new(&of_halves(k, |lag, j| of_k.product(lag, j))), N::from_rational(&factor, context))
}

/// The same for the last term, with C(2k,k) = C(2k−2,k−1) 2(2k − 1)/k: k times the integers of E_k less 2k − 1 times
/// the ones of E_{k−1} at two places.
fn integer_last_term_weights<N: Number>(k: u32, h: &Rational, context: &N::Context) -> (IntegerWeights, N) {
    let [of_k, before] = [k, k - 1].map(BilinearWeights::new);
    let factor = (h * Rational::from_integer(of_k.of_2k() * k)).recip();
    let weights = of_halves(k, |lag, j| {
        let others = before.product(lag, j) + j.checked_sub(1).map_or_else(BigInt::default, |j| before.product(lag, j));
        of_k.product(lag, j) * k - others * (2 * k - 1)
    });
    (IntegerWeights::new(&weights), N::from_rational(&factor, context))
}

/// The first halves of rows that read the same backwards: row ℓ − 1 has j = 0..=k−ℓ.
fn of_halves<N>(k: u32, weight: impl Fn(usize, usize) -> N) -> Vec<Vec<N>> {
    let k = k as usize;
    (1..=k).map(|lag| (0..(k - lag + 1).div_ceil(2)).map(|j| weight(lag, j)).collect()).collect()
}

/// Adds Σ_j w_{j+ℓ,j} (the pair of the states j + ℓ and j), j = 0..=last, for each row of weights that is not empty;
/// two pairs at once, whose sum all rows use.
fn add_row<N: Number>(sums: &mut [(&[N], &mut N); 2], pairs: &[N], of_lag: OfLag, sum: &mut N) {
    let last = of_lag.last;
    for j in 0..=last / 2 {
        let [pair, other] = [j, last - j].map(|j| &pairs[of_lag.place(j)]);
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

    /// By the definition: rows of exact weights, with the weights of E_{k−1} at two places subtracted.
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
