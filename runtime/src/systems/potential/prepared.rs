//! A potential with its scratch space.

use super::Potential;
use crate::number::Number;

/// A potential with its scratch space, from the first Hessian–vector product on also that of second derivatives.
#[derive(Clone, Debug)]
pub(crate) struct Prepared<N, P> {
    pub(crate) function: P,
    pub(crate) scratch: Vec<N>,
    hessian_scratch: Option<Vec<N>>,
}

impl<N: Number, P: Potential<N>> Prepared<N, P> {
    pub(crate) fn new(function: P, context: &N::Context) -> Self {
        let mut scratch = vec![N::zero(context); function.scratch()];
        function.prepare(&mut scratch, context);
        Prepared { function, scratch, hessian_scratch: None }
    }

    /// energy ← U(q)
    #[inline(always)]
    pub(crate) fn energy(&mut self, q: &[N], energy: &mut N) {
        self.function.update(q);
        self.function.energy(q, energy, &mut self.scratch);
    }

    /// gradient ← U_q and, if asked for, rate ← qᵀU_q − 2U.
    #[inline(always)]
    pub(crate) fn gradient(&mut self, q: &[N], gradient: &mut [N], rate: Option<&mut N>) {
        self.function.update(q);
        match rate {
            Some(rate) => self.function.gradient_and_rate(q, gradient, rate, &mut self.scratch),
            None => self.function.gradient(q, gradient, &mut self.scratch),
        }
    }

    /// product ← U_qq v and, if asked for, rate ← vᵀ∂(qᵀU_q − 2U)/∂q.
    ///
    /// # Panics
    /// If the potential has no Hessian–vector product.
    pub(crate) fn hessian_product(&mut self, q: &[N], v: &[N], product: &mut [N], rate: Option<&mut N>) {
        self.function.update(q);
        let hessian = self.function.hessian().expect(
            "gradient kicks need the Hessian–vector product of the potential: write it as a formula, or implement \
                `Potential::hessian`",
        );
        let scratch = self.hessian_scratch.get_or_insert_with(|| {
            let context = q[0].context();
            let mut scratch = vec![N::zero(&context); hessian.hessian_scratch()];
            hessian.prepare_hessian(&mut scratch, &context);
            scratch
        });
        match rate {
            Some(rate) => hessian.hessian_product_and_rate(q, v, product, rate, scratch),
            None => hessian.hessian_product(q, v, product, scratch),
        }
    }
}
