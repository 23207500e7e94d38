//! The bilinear estimator with the k of each state chosen by its error.

use std::cmp::max;

use num_traits::Signed;

use crate::Rational;
use crate::motion::Increments;
use crate::number::Number;
use crate::shadow::bilinear::estimate;
use crate::shadow::form::{Form, Products};
use crate::shadow::{Estimate, Estimator, Method};

/// The bilinear estimator E_k with a k for each state, from the ladder 2, 4, 8, …, up to the largest even one allowed.
///
/// It is the least k whose estimated error is not above the `accuracy` wanted. Where there is none, or no accuracy is wanted, it is the
/// least k whose estimated error is at most twice the least of all: where more states would only add round-off, or where a close
/// encounter sets a limit, the k stays small. [`Estimate::order`] says which k it was, [`Estimate::error`] how good the value is.
///
/// All k of the ladder are tried at every state, whatever the accuracy, as an error is known only with the estimates at the states
/// beside: K products of vectors and some ⅔K² of numbers a state, K the largest k; and K/2 + 1 + ⌈√K⌉ states on each side. What a
/// longer ladder gains: the largest error of an orbit of the exact flow of Kepler's problem, at 120 digits,
///
/// | K | e = 0.3, h = 1/20 | e = 0.6, h = 1/10 | 1/20 | 1/40 | e = 0.9, h = 1/40 |
/// | --- | --- | --- | --- | --- | --- |
/// | 16 | 1.4e-25 | 3.0e-7 | 1.4e-12 | 4.0e-20 | 4.4e-3 |
/// | 32 | 2.1e-34 | 5.2e-8 | 2.0e-14 | 2.3e-25 | 4.4e-3 |
/// | 64 | 1.7e-41 | 1.6e-8 | 1.4e-15 | 5.7e-29 | 2.6e-3 |
/// | 128 | 6.6e-46 | 7.0e-9 | 2.9e-16 | 3.8e-31 | 1.7e-3 |
///
/// K = 64 takes some 2 900 products of numbers a state, a fourth of what 128 takes.
///
/// ```
/// use shadowstep::{Motion, UnitMasses, exact, problems::Kepler, run::ShadowRun, shadow::BestBilinear, tables::shipped};
///
/// let start = Motion::new(Kepler, UnitMasses, [0.4, 0.0], [0.0, 2.0]); // eccentricity 0.6
/// let (verlet, h) = (shipped("stormer-verlet").unwrap(), exact("1/40").unwrap());
/// let method = BestBilinear::to(64, exact("1e-10").unwrap());
/// let mut run = ShadowRun::new(&verlet, start, &h, 125, &method).unwrap();
/// let mut orders = Vec::new();
/// while let Some((_, found)) = run.advance().unwrap() {
///     assert!(*found.error.unwrap() <= 1e-10);
///     orders.push(found.order);
/// }
/// assert!(orders[0] > orders[125]); // pericentre and apocentre
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BestBilinear {
    /// The largest k allowed, at least 2; an odd one stands for the even one below it.
    pub largest: u32,
    /// The largest error wanted, in the units of the energy.
    pub accuracy: Option<Rational>,
}

impl BestBilinear {
    /// As accurate as the steps, the largest k and the numbers allow.
    pub fn new(largest: u32) -> Self {
        BestBilinear { largest, accuracy: None }
    }

    /// The least k for an accuracy.
    pub fn to(largest: u32, accuracy: Rational) -> Self {
        BestBilinear { largest, accuracy: Some(accuracy) }
    }

    /// 2, 4, 8, …, and the largest.
    fn ladder(&self) -> Vec<u32> {
        let largest = self.largest - self.largest % 2;
        (1..).map(|power| 1_u32 << power).take_while(|k| *k < largest).chain([largest]).collect()
    }
}

impl<N: Number> Method<N> for BestBilinear {
    type Estimator = BestBilinearEstimator<N>;

    /// # Panics
    /// If the largest k is less than 2, or the accuracy negative.
    fn estimator(&self, h: &Rational, dimension: usize, context: &N::Context) -> BestBilinearEstimator<N> {
        assert!(self.largest >= 2, "the best k is looked for among 2, 4, …");
        assert!(self.accuracy.as_ref().is_none_or(|wanted| !wanted.is_negative()), "an error has a size");
        let forms: Vec<Form<N>> = self.ladder().iter().map(|k| Form::new(*k, true, h, context)).collect();
        let reach = forms.iter().map(Form::delay).fold(0, max);
        // all forms have the same state in the middle
        let states = forms.iter().map(|form| reach - form.delay() + form.k()).fold(reach, max) + 1;
        let lags = forms.last().expect("there is k = 2").k();
        BestBilinearEstimator {
            products: Products::new(states, lags, dimension, context),
            forms,
            reach,
            wanted: self.accuracy.as_ref().map(|wanted| N::from_rational(wanted, context)),
            limit: N::zero(context),
        }
    }
}

/// The estimator that [`BestBilinear`] describes.
#[derive(Clone, Debug)]
pub struct BestBilinearEstimator<N> {
    products: Products<N>,
    /// From the least k to the largest.
    forms: Vec<Form<N>>,
    /// How many states before the newest one the state in the middle is.
    reach: usize,
    wanted: Option<N>,
    limit: N,
}

impl<N: Number> BestBilinearEstimator<N> {
    /// The first form whose error is good enough.
    fn best(&mut self) -> usize {
        let below = |limit: &N| self.forms.iter().position(|form| form.spread.error() <= limit);
        if let Some(found) = self.wanted.as_ref().and_then(below) {
            return found;
        }
        let errors = self.forms.iter().map(|form| form.spread.error());
        self.limit.assign(errors.reduce(|a, b| if b < a { b } else { a }).expect("there is k = 2"));
        self.limit.multiply_integer(2);
        // no error is below a limit that is not a number
        below(&self.limit).unwrap_or(0)
    }
}

impl<N: Number> Estimator<N> for BestBilinearEstimator<N> {
    fn states(&self) -> usize {
        2 * self.reach + 1
    }

    fn push(&mut self, q: &[N], p: &[N], increments: &Increments<N>) -> Option<Estimate<'_, N>> {
        self.products.push(q, p, increments);
        let mut all = true;
        for form in &mut self.forms {
            let back = self.reach - form.delay();
            if self.products.pushed() > back + form.k() {
                form.add_value(&self.products, back);
            }
            all &= form.spread.estimate();
        }
        if !all {
            return None;
        }
        let best = self.best();
        Some(estimate(&self.forms[best], self.products.state(self.reach)))
    }
}
