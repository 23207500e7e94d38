//! The bilinear estimator with the k of each state selected by its error.

use std::cmp::max;

use crate::Rational;
use crate::number::Real;
use crate::number::saved::Fields;
use crate::shadow::estimator::{Estimate, Estimator};
use crate::shadow::form::{Form, Products};
use crate::systems::increments::Increments;

/// E_k with the best k of each state.
#[derive(Clone, Debug)]
pub(super) struct BestOrder<N> {
    products: Products<N>,
    /// From the smallest k to the largest.
    forms: Vec<Form<N>>,
    /// How many states before the newest one the state in the middle is.
    reach: usize,
    /// The target error.
    accuracy: Option<N>,
    limit: N,
}

/// 2, 4, 8, …, and the largest even one.
fn ladder(largest: u32) -> Vec<u32> {
    let largest = largest - largest % 2;
    (1..).map(|power| 1_u32 << power).take_while(|k| *k < largest).chain([largest]).collect()
}

impl<N: Real> BestOrder<N> {
    /// For a largest k ≥ 2.
    pub(super) fn new(
        largest: u32,
        accuracy: Option<&Rational>,
        h: &Rational,
        dimension: usize,
        context: &N::Context,
    ) -> Self {
        let forms: Vec<Form<N>> = ladder(largest).iter().map(|k| Form::new(*k, true, h, context)).collect();
        let reach = forms.iter().map(Form::delay).fold(0, max);
        // all forms have the same state in the middle
        let states = forms.iter().map(|form| reach - form.delay() + form.k()).fold(reach, max) + 1;
        let lags = forms.last().expect("there is k = 2").k();
        BestOrder {
            products: Products::new(states, lags, dimension, context),
            forms,
            reach,
            accuracy: accuracy.map(|accuracy| N::from_rational(accuracy, context)),
            limit: N::zero(context),
        }
    }

    pub(super) fn fields(&mut self, to: &mut dyn Fields<N>) {
        self.products.fields(to);
        self.forms.iter_mut().for_each(|form| form.error_estimate.fields(to));
    }

    /// The first form whose error is small enough.
    fn best(&mut self) -> usize {
        let below = |limit: &N| self.forms.iter().position(|form| form.error_estimate.error() <= limit);
        if let Some(found) = self.accuracy.as_ref().and_then(below) {
            return found;
        }
        let errors = self.forms.iter().map(|form| form.error_estimate.error());
        self.limit.assign(errors.reduce(|a, b| if b < a { b } else { a }).expect("there is k = 2"));
        self.limit.multiply_integer(2);
        // no error is below a limit that is NaN
        below(&self.limit).unwrap_or(0)
    }
}

impl<N: Real> Estimator<N> for BestOrder<N> {
    fn states(&self) -> usize {
        2 * self.reach + 1
    }

    fn push(&mut self, q: &[N], p: &[N], increments: Increments<'_, N>) -> Option<Estimate<'_, N>> {
        self.products.push(q, p, increments);
        let mut all = true;
        for form in &mut self.forms {
            let back = self.reach - form.delay();
            if self.products.pushed() > back + form.k() {
                form.add_value(&self.products, back);
            }
            all &= form.error_estimate.update();
        }
        if !all {
            return None;
        }
        let best = self.best();
        Some(self.forms[best].estimate(self.products.state(self.reach)))
    }
}
