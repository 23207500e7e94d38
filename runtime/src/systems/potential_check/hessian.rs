//! Whether the Hessian–vector product of a potential belongs to its gradient and its rate.

use super::checked::Checked;
use super::comparison::{Comparison, add_absolute_product};
use super::derivative::{Derivative, directional_derivative};
use crate::number::Real;
use crate::systems::potential::Potential;

/// What was found of the Hessian–vector product: of each comparison the state where it is worst.
#[derive(Clone, Debug)]
pub struct HessianCheck<N> {
    /// wᵀU_qq v, and the derivative of wᵀU_q along v.
    pub product: Comparison<N>,
    /// The product that comes with its rate, and the product alone.
    pub product_with_rate: Comparison<N>,
    /// The rate, and the derivative of qᵀU_q − 2U along v.
    pub rate: Comparison<N>,
}

impl<N: Real> HessianCheck<N> {
    pub(super) fn all(&self) -> [&Comparison<N>; 3] {
        [&self.product, &self.product_with_rate, &self.rate]
    }

    pub(super) fn keep_worse(&mut self, other: Self) {
        self.product.keep_worse(other.product);
        self.product_with_rate.keep_worse(other.product_with_rate);
        self.rate.keep_worse(other.rate);
    }
}

impl<N: Real, P: Potential<N> + ?Sized> Checked<'_, N, P> {
    /// In two directions; `None` where the potential has no Hessian–vector product.
    pub(super) fn check_hessian(&mut self) -> Option<HessianCheck<N>> {
        let mut worst: Option<HessianCheck<N>> = None;
        for seeds in [(4, 5), (6, 7)] {
            let found = self.compare_hessian(&self.direction(seeds.0), &self.direction(seeds.1))?;
            match &mut worst {
                Some(worst) => worst.keep_worse(found),
                None => worst = Some(found),
            }
        }
        worst
    }

    fn compare_hessian(&mut self, v: &[N], w: &[N]) -> Option<HessianCheck<N>> {
        let (zero, q) = (N::zero(&self.epsilon.context()), self.q);
        let zeros = || vec![zero.clone(); q.len()];
        self.potential.update(q);
        let hessian = self.potential.hessian()?;
        let mut scratch = vec![zero.clone(); hessian.hessian_scratch()];
        hessian.prepare_hessian(&mut scratch, &zero.context());
        let (mut product, mut with_rate, mut rate) = (zeros(), zeros(), zero.clone());
        hessian.hessian_product(q, v, &mut product, &mut scratch);
        hessian.hessian_product_and_rate(q, v, &mut with_rate, &mut rate, &mut scratch);
        let product_with_rate = self.check_alike(&with_rate, &product);

        let (mut found, mut size) = (zero.clone(), zero.clone());
        for (w, product) in w.iter().zip(&product) {
            found.add_product(w, product);
            add_absolute_product(&mut size, w, product);
        }
        let Checked { potential, scratch, .. } = self;
        let mut gradient = zeros();
        let along = directional_derivative(
            &mut |q, sum| {
                potential.update(q);
                potential.gradient(q, &mut gradient, scratch);
                sum.assign_zero();
                w.iter().zip(&gradient).for_each(|(w, gradient)| sum.add_product(w, gradient));
            },
            q,
            v,
        );
        let of_rate = directional_derivative(
            &mut |q, rate| {
                potential.update(q);
                potential.gradient_and_rate(q, &mut gradient, rate, scratch);
            },
            q,
            v,
        );
        let product = self.compare_with(found, along, &size);
        let mut size = rate.clone();
        size.make_absolute();
        let rate = self.compare_with(rate, of_rate, &size);
        Some(HessianCheck { product, product_with_rate, rate })
    }

    fn compare_with(&self, found: N, Derivative { value, error }: Derivative<N>, size: &N) -> Comparison<N> {
        let mut uncertainty = self.rounding(size, self.q.len());
        uncertainty.add(&error);
        Comparison::new(self.state, None, (found, value), uncertainty, size)
    }
}
